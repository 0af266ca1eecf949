# shellcheck shell=bash
# Sourced by app/run, tests/run and what checks: installs what is missing and configures builds.
# Gives: root (the repository), build (its build folder), configure [CMake arguments], and of the
# builds with sanitizers folder_for address|threads and configure_for address|threads.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

packages=(
  build-essential cmake ninja-build ccache
  qt6-base-dev libqt6opengl6-dev libqt6svg6 libvtk9-dev libspnav-dev
  libopenmesh-dev libeigen3-dev libtbb-dev libxxhash-dev
  nlohmann-json3-dev libcli11-dev libexpected-dev libgtest-dev librapidcheck-dev libbenchmark-dev
  pkg-config zlib1g-dev libexpat1-dev libzip-dev libsqlite3-dev
  xvfb xauth libgl1-mesa-dri fonts-dejavu-core
  desktop-file-utils appstream shared-mime-info libglib2.0-bin man-db  # judge what is installed
)

missing_packages() {
  local installed
  installed=" $(dpkg-query -W -f='${db:Status-Abbrev}${Package} ' "${packages[@]}" 2>/dev/null || true)"
  for package in "${packages[@]}"; do
    [[ $installed == *" ii $package "* ]] || echo "$package"
  done
}

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "No apt here; make sure that these (or their like) are installed: ${packages[*]}" >&2
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  ((${#missing[@]})) || return 0
  ((EUID == 0)) || command -v sudo >/dev/null || {
    echo "Missing: ${missing[*]}. Install them as root: apt-get install ${missing[*]}" >&2
    exit 1
  }
  echo "Installing ${missing[*]}"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

as_root() { if ((EUID == 0)); then "$@"; else sudo "$@"; fi; }

configure() {
  mkdir -p "$build"
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" \
    >"$build/configure.log" 2>&1 || {
    cat "$build/configure.log" >&2
    exit 1
  }
}

# By Clang: it has libFuzzer, and reads the code with other eyes. Its warnings are its own.
folder_for() { echo "$build/$1"; }
configure_for() {
  local folder with=()
  folder=$(folder_for "$1")
  case $1 in
    address) with=(-DARRIS_SANITIZE=ON -DARRIS_FUZZ=ON) ;;
    threads) with=(-DARRIS_SANITIZE_THREAD=ON) ;;
  esac
  mkdir -p "$folder"
  cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
    -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang "${with[@]}" >"$folder/configure.log" 2>&1 || {
    cat "$folder/configure.log" >&2
    return 1
  }
}

install_packages
