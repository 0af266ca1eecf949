#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/context.h"
#include "core/base/json.h"
#include "core/base/result.h"
#include "core/document/history.h"

namespace arris {

/// Where the rows of a history go, each durable before the call returns, so that what was shown is
/// never lost. Errors: it cannot be written; nothing was added then.
class Journal {
 public:
  virtual ~Journal() = default;
  virtual Result<void> append(const HistoryEntry& entry) = 0;
  virtual Result<void> append_head(std::uint32_t sequence) = 0;
  /// An empty name takes the row's name away.
  virtual Result<void> append_name(std::uint32_t sequence, const std::string& name) = 0;
};

/// One thing that a journal holds, and where, for messages ("line 3"):
///   {"sequence": 3, "parent": 2, "operation": {...}, "hash": "..."}   an edit
///   {"operation": "find_sharp_lines", ...}               an edit of a list of operations
///   {"head": 2}                                          undo, redo or travel
///   {"name": "tight", "row": 3}                          a version's name; "" takes it away
/// As text (*.jsonl), which journal_text() writes, each is a line.
struct JournalRecord {
  std::string where;
  nlohmann::json json;
};

/// A value from a file that may be a stranger's: discarded where the text is not JSON, or is nested
/// deeper than any operation (which could overflow the stack of who looks into it).
nlohmann::json parse_record(std::string_view text);

struct ReplayOptions {
  std::string scan = {};  // file to open instead of the named one; empty: the named one
  /// Files that the user pointed at, for scans that are not where they were: taken where the
  /// content is that of the journal.
  std::vector<std::string> located = {};
  /// The user's own key: a snapshot in a session that it signed takes the place of the rows before
  /// it, which are not run. Empty: all rows are run.
  std::string key = {};
};

struct Replay {
  History history;
  std::vector<std::string>
      warnings;  ///< Rows whose result differs from the stored hash, cut lines.
};

/// Whether a file is a session or a list of operations rather than a scan, by what is in it; by its
/// name (*.arris, *.jsonl) where it holds nothing, or cannot be read.
bool holds_operations(const std::string& path);

/// Runs a session, a journal as text, or a plain list of operations one a line; the content decides
/// which. `open` opens a file only if its content is that of the journal: the session's own copy,
/// else what ScanPlaces finds. A last line cut short by a crash is left out. Errors: cannot be
/// read, a row is not an operation (with its number), an operation fails (with its row).
Result<Replay> replay(const std::string& path, const ReplayOptions& options = {},
                      const Context& context = {});

/// The first scan that the session or journal names and that is nowhere to be found with the
/// content it had; nothing where all are there, or the file cannot be read.
std::optional<std::string> lost_scan(const std::string& path, const ReplayOptions& options = {});

/// The journal of a history as text: rows in order, names of versions, and moves of the head that
/// lead to where it is. `operations.jsonl` is this.
std::string journal_text(const History& history);

}  // namespace arris
