#pragma once

#include <memory>
#include <string>

namespace arris {

/// Tells other programs, and other windows of this one, that a file is in use. It only advises, it
/// needs no right to write and leaves nothing behind: the system lets go of it with the program,
/// however that ends. It belongs to the file, not to its name: a file that takes its place has a
/// lock of its own.
class FileLock {
 public:
  /// Null: somebody else has it, or there is no such file.
  static std::unique_ptr<FileLock> take(const std::string& path);
  /// Whether somebody else has it now. False where there is no such file.
  static bool is_taken(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace arris
