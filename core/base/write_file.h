#pragma once

#include <functional>
#include <string>

#include "core/base/result.h"

namespace arris {

/// Writes `content` to `path` so that the file is replaced only by a whole new one (written beside
/// it, then renamed). Errors: cannot create, write or rename, with the path and the system's
/// reason.
Result<void> write_file_whole(const std::string& path, const std::string& content);

/// The same for a file that `fill` writes by itself, given the name of an empty one beside `path`,
/// which takes its place once the disk has all of it. Errors: the same, and those of `fill`; `path`
/// is as it was then.
Result<void> replace_file(const std::string& path,
                          const std::function<Result<void>(const std::string& part)>& fill);

/// Whether write_file_whole() could write to `path` now: to be asked before long work whose result
/// goes there. Errors: its own. Leaves nothing behind.
Result<void> check_writable(const std::string& path);
/// The same for a folder that may have to be made first. Errors: the folder, or one above it, is a
/// file; nothing can be made there.
Result<void> check_folder_writable(const std::string& folder);

}  // namespace arris
