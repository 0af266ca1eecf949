#include "core/base/file_lock.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace arris {

std::unique_ptr<FileLock> FileLock::take(const std::string& path) {
  // flock(), not the locks of fcntl(): those are SQLite's, and go when any descriptor is closed.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return nullptr;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const bool taken = errno == EWOULDBLOCK;
    // A file system without such locks: nobody can tell, and nobody has it.
    if (!taken) return std::unique_ptr<FileLock>(new FileLock(descriptor));
    ::close(descriptor);
    return nullptr;
  }
  return std::unique_ptr<FileLock>(new FileLock(descriptor));
}

bool FileLock::is_taken(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);  // and lets go of it
  return taken;
}

FileLock::~FileLock() { ::close(descriptor_); }

}  // namespace arris
