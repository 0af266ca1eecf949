#include "core/base/write_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace arris {

namespace {

std::string system_reason() { return std::strerror(errno); }

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
      const std::string name = (folder / (".arris-" + std::to_string(::getpid()) + "-" +
                                          std::to_string(serial++) + ".part"))
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
