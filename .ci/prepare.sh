# shellcheck shell=bash
# Sourced by app/run and tests/run: installs what is missing and configures a Release build.
# Gives: root (the repository), build (its build folder), configure [CMake arguments].

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

packages=(
  build-essential cmake ninja-build ccache
  qt6-base-dev libqt6opengl6-dev libqt6svg6 libvtk9-dev
  libopenmesh-dev libeigen3-dev libtbb-dev libxxhash-dev
  nlohmann-json3-dev libcli11-dev libexpected-dev libgtest-dev
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
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || {
      echo "Missing: ${missing[*]}. Install them as root: apt-get install ${missing[*]}" >&2
      exit 1
    }
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

configure() {
  mkdir -p "$build"
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" \
    >"$build/configure.log" 2>&1 || {
    cat "$build/configure.log" >&2
    exit 1
  }
}

install_packages
