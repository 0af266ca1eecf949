#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/document/history.h"

namespace arris {

/// A file that a finished part is handed on in.
struct ResultFile {
  std::string_view name;  ///< "lines.obj"; the window puts the name of the part before it.
  /// Errors: the file cannot be written.
  Result<void> (*write)(const std::string& path, const History& history);
};

/// All of them, in the order in which they are written: what the window's export and the command
/// line write, whichever it is. Another kind of export is another row.
std::span<const ResultFile> result_files();

}  // namespace arris
