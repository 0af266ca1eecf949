#include "core/base/write_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace arris {

namespace {

std::string system_reason() { return std::strerror(errno); }

/// Files of this computer and this process are told by their names: ".arris-" HOST "-" PROCESS "-"
/// NUMBER ".part".
constexpr std::string_view part_begin = ".arris-", part_end = ".part";

/// Of this computer, without a minus: folders may be shared with others.
std::string host_mark() {
  char name[256] = {};
  if (::gethostname(name, sizeof name - 1) != 0) return "0";
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (const char* c = name; *c; ++c) hash = (hash ^ static_cast<unsigned char>(*c)) * 16777619u;
  return std::to_string(hash);
}

/// The process that made a file of such a name; 0: it is none, or of another computer.
pid_t maker_of(std::string_view name) {
  const std::string begin = std::string(part_begin) + host_mark() + "-";
  if (!name.starts_with(begin) || !name.ends_with(part_end)) return 0;
  name.remove_prefix(begin.size());
  name.remove_suffix(part_end.size());
  pid_t process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  if (error != std::errc() || process <= 0 || *end != '-') return 0;
  const std::string_view number(end + 1, name.data() + name.size());
  const bool is_number =
      !number.empty() && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? process : 0;
}

/// A process that was killed while it wrote leaves its new file behind. Nobody else's is touched,
/// and none of a process that is still there.
void remove_left_overs(const std::filesystem::path& folder) {
  DIR* const all = ::opendir(folder.empty() ? "." : folder.c_str());
  if (!all) return;
  while (const dirent* entry = ::readdir(all)) {
    const pid_t maker = maker_of(entry->d_name);
    if (maker == 0 || ::kill(maker, 0) == 0 || errno != ESRCH) continue;
    struct stat left {};
    if (::fstatat(::dirfd(all), entry->d_name, &left, AT_SYMLINK_NOFOLLOW) == 0 &&
        S_ISREG(left.st_mode) && left.st_uid == ::geteuid())
      ::unlinkat(::dirfd(all), entry->d_name, 0);
  }
  ::closedir(all);
}

/// A file made beside its place; removed again unless it was put there.
class NewFile {
 public:
  NewFile() = default;
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }

  bool create(const std::filesystem::path& folder) {
    static std::atomic<unsigned> serial = 0;
    for (int tries = 0; tries < 100; ++tries) {
      const std::string name =
          (folder / (std::string(part_begin) + host_mark() + "-" + std::to_string(::getpid()) +
                     "-" + std::to_string(serial++) + std::string(part_end)))
              .string();
      descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0) {
        name_ = name;
        return true;
      }
      if (errno != EEXIST) return false;
    }
    return false;
  }

  /// Writes all of it and waits until the disk has it.
  bool write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    return close_durable();
  }

  /// Waits until the disk has all that was written, by whatever way.
  bool close_durable() {
    if (::fsync(descriptor_) != 0) return false;
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0;
  }

  const std::string& name() const { return name_; }
  void set_mode(mode_t mode) { ::fchmod(descriptor_, mode & 07777); }

  bool rename_to(const std::string& path) {
    if (::rename(name_.c_str(), path.c_str()) != 0) return false;
    name_.clear();
    return true;
  }

 private:
  int descriptor_ = -1;
  std::string name_;
};

/// The renaming itself lives in the folder; some file systems cannot be asked to wait for it.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// Where a file goes, and a new file beside it that will take its place.
struct Place {
  std::filesystem::path target, folder;
  NewFile file;
};

/// Makes the new file.
Result<void> prepare(const std::string& path, Place& place) {
  // A link keeps pointing to its file: that file is replaced, not the link.
  place.target = path;
  std::error_code ignored;  // an absent file is no error here, and what else is wrong shows below
  if (std::filesystem::is_symlink(place.target, ignored)) {
    const std::filesystem::path file = std::filesystem::weakly_canonical(place.target, ignored);
    if (!ignored) place.target = file;
  }
  if (place.target.filename().empty())
    return fail(path + " cannot be written: it is not the name of a file.");
  struct stat existing {};
  const bool exists = ::stat(place.target.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode))
    return fail(path + " cannot be written: it is a directory.");
  if (exists && !S_ISREG(existing.st_mode))
    return fail(path + " cannot be written: it is not an ordinary file.");
  if (exists && ::access(place.target.c_str(), W_OK) != 0)
    return fail(path + " cannot be written: " + system_reason() + ".");
  place.folder = place.target.has_parent_path() ? place.target.parent_path() : ".";
  remove_left_overs(place.folder);  // first: they take room
  if (!place.file.create(place.folder))
    return fail(path + " cannot be created: " + system_reason() + ".");
  if (exists) place.file.set_mode(existing.st_mode);
  return {};
}

}  // namespace

Result<void> check_writable(const std::string& path) {
  Place place;
  return prepare(path, place);
}

Result<void> check_folder_writable(const std::string& folder) {
  // The nearest one above that is there.
  std::filesystem::path there = std::filesystem::path(folder).lexically_normal();
  if (there.filename().empty() && there.has_parent_path()) there = there.parent_path();
  struct stat existing {};
  while (::stat(there.empty() ? "." : there.c_str(), &existing) != 0) {
    if (errno != ENOENT || there == there.parent_path())
      return fail("The folder " + folder + " cannot be made: " + system_reason() + ".");
    there = there.parent_path();
  }
  if (there.empty()) there = ".";
  if (!S_ISDIR(existing.st_mode))
    return fail("The folder " + folder + " cannot be made: " + there.string() +
                " is a file, not a folder.");
  NewFile file;
  if (!file.create(there))
    return fail("Nothing can be written to the folder " + folder + ": " + system_reason() + ".");
  return {};
}

namespace {

/// Puts what was written in its place.
Result<void> put_in_place(const std::string& path, Place& place) {
  if (!place.file.rename_to(place.target.string()))
    return fail(path + " cannot be replaced: " + system_reason() + ".");
  sync_folder(place.folder);
  return {};
}

}  // namespace

Result<void> write_file_whole(const std::string& path, const std::string& content) {
  Place place;
  if (const Result<void> ready = prepare(path, place); !ready) return ready;
  if (!place.file.write(content))
    return fail(path + " cannot be written: " + system_reason() + ".");
  return put_in_place(path, place);
}

Result<void> replace_file(const std::string& path,
                          const std::function<Result<void>(const std::string& part)>& fill) {
  Place place;
  if (const Result<void> ready = prepare(path, place); !ready) return ready;
  if (const Result<void> filled = fill(place.file.name()); !filled) return filled;
  if (!place.file.close_durable())
    return fail(path + " cannot be written: " + system_reason() + ".");
  return put_in_place(path, place);
}

}  // namespace arris
