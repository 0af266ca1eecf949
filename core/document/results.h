#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/document/history.h"

namespace arris {

/// A file that a finished part is handed on in.
struct ResultFile {
  std::string_view name;   ///< "lines.obj"; the window puts the name of the part before it.
  std::string_view title;  ///< What it is for, as the window's choice says it.
  bool usual;              ///< Written unless something else is chosen.
  /// Errors: the file cannot be written.
  Result<void> (*write)(const std::string& path, const History& history);

  /// What it holds and in which format: "lines" and ".obj".
  std::string_view what() const { return name.substr(0, name.rfind('.')); }
  std::string_view ending() const { return name.substr(name.rfind('.')); }
};

/// All of them, in the order in which they are written: what the window's export and the command
/// line write, whichever it is. Another kind of export is another row.
std::span<const ResultFile> result_files();

}  // namespace arris
