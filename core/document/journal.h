#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/document/history.h"

namespace arris {

/// The rows of a history on disk, one JSON object a line, each durable (fsync) before append()
/// returns:
///   {"sequence": 3, "parent": 2, "operation": {...}, "hash": "..."}   an edit
///   {"head": 2}                                                      undo, redo or travel
///   {"name": "tight", "row": 3}                          a version's name; "" takes it away
/// A last line cut short by a crash is left out when the journal is read again.
class Journal {
 public:
  /// Creates or continues the file. Errors: cannot be opened for writing.
  static Result<std::shared_ptr<Journal>> open(const std::string& path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  Result<void> append(const HistoryEntry& entry);
  Result<void> append_head(std::uint32_t sequence);
  Result<void> append_name(std::uint32_t sequence, const std::string& name);
  const std::string& path() const { return path_; }

 private:
  Journal(int file, std::string path) : file_(file), path_(std::move(path)) {}
  Result<void> append_line(const std::string& line);
  int file_;
  std::string path_;
};

struct ReplayOptions {
  std::string scan;  // file to open instead of the named one; empty: the named one
};

struct Replay {
  History history;
  std::vector<std::string>
      warnings;  ///< Rows whose result differs from the stored hash, cut lines.
};

/// Runs a journal, or a plain list of operations one a line. `open` opens the named file only if
/// its content is that of the journal. Errors: cannot be read, a line is not an operation (with its
/// number), an operation fails (with its line).
Result<Replay> replay(const std::string& path, const ReplayOptions& options = {},
                      const Context& context = {});

/// The journal of a history as text: rows in order, names of versions, and the head where it is not
/// the last row. `operations.jsonl` is this.
std::string journal_text(const History& history);

}  // namespace arris
