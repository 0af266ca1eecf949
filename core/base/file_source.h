#pragma once

#include <string>

#include "core/base/context.h"
#include "core/base/read_file.h"
#include "core/base/result.h"

namespace arris {

/// Where work finds files by their content, wherever they are now: inside a session, beside it.
class FileSource {
 public:
  virtual ~FileSource() = default;
  /// The file that was at `path` and whose content has this hash (hash_of_content()). Errors: it is
  /// nowhere to be found, cannot be read, cancelled.
  virtual Result<FileContent> find(const std::string& path, const std::string& hash,
                                   const Context& context) const = 0;
};

}  // namespace arris
