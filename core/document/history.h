#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/base/file_source.h"
#include "core/base/result.h"
#include "core/document/document.h"
#include "core/document/operation.h"

namespace arris {

class Journal;

/// One row: an operation that was applied to the state after row `parent`.
struct HistoryEntry {
  std::uint32_t sequence = 0;  ///< From 1; 0 is the empty document.
  std::uint32_t parent = 0;
  Operation operation;  ///< Resolved.
  std::string hash;     ///< hash_of() the result.
};

/// Undo, redo and travel over snapshots that share their parts. A new edit after undo branches;
/// nothing is ever deleted. Under a byte budget snapshots may be dropped (the current one never);
/// they come back by replay.
class History {
 public:
  static constexpr std::size_t default_budget = std::size_t{2} << 30;  // bytes

  explicit History(std::size_t budget = default_budget);
  ~History();
  History(History&&) noexcept;
  History& operator=(History&&) noexcept;

  /// A move of the head that was made when there were so many rows.
  struct Move {
    std::uint32_t rows = 0;
    std::uint32_t head = 0;
  };
  /// A history as it was written down, of which only the document after row `at` is known; the head
  /// is there. Those of the other rows come by replay, as snapshots that were dropped do. Moves are
  /// in their order. Errors: rows are not numbered one after the other, or a parent or a move is of
  /// a row that is not there then.
  static Result<History> restored(std::vector<HistoryEntry> entries, const std::vector<Move>& moves,
                                  std::uint32_t at, Document document);

  const Document& current() const { return current_; }
  std::uint32_t head() const { return head_; }
  const std::vector<HistoryEntry>& entries() const { return entries_; }

  /// Adds the result of applying `operation` (resolved) to the current document. With a journal the
  /// row is on disk when this returns. Errors: the journal cannot be written; nothing changed then.
  Result<void> commit(Operation operation, Document result);
  /// Resolves, applies and commits.
  Result<void> run(const Operation& operation, const Context& context = {});

  bool can_undo() const { return head_ != 0; }
  bool can_redo() const;
  /// Goes to a row's state (0: the empty document). Errors: no such row; the snapshot had been
  /// dropped and its replay failed.
  Result<void> travel(std::uint32_t sequence, const Context& context = {});
  /// The last part of travel(), which takes no time: `document` is document_at(sequence). A window
  /// lets a worker thread make the document and moves the head itself. Errors: no such row, the
  /// journal cannot be written; nothing changed then.
  Result<void> go_to(std::uint32_t sequence, Document document);
  Result<void> undo(const Context& context = {});
  Result<void> redo(const Context& context = {});

  /// The document as it was after a row (0: the empty one), without going there. Errors as
  /// travel(). May run on another thread as long as nothing changes the history.
  Result<Document> document_at(std::uint32_t sequence, const Context& context = {}) const;

  /// Names given to rows: versions to come back to and to compare, wherever the head is.
  const std::map<std::uint32_t, std::string>& names() const { return names_; }
  /// Names a row, or takes its name away where `name` is empty. Blanks about it do not count; it is
  /// one line of at most 80 bytes. Errors: no such row, another row has this name, no such text,
  /// the journal cannot be written; nothing changed then.
  Result<void> set_name(std::uint32_t sequence, const std::string& name);
  /// The row of this name; absent: none.
  std::optional<std::uint32_t> find_name(const std::string& name) const;

  /// The rows from the first edit through the head to where redo would lead at last.
  std::vector<std::uint32_t> line_of_travel() const;

  /// The moves of the head that, after all rows in their order, lead to where it is, and redo to
  /// where it leads.
  std::vector<std::uint32_t> closing_moves() const;

  /// What another thread needs to save it while this one goes on: rows, names and the current
  /// document, which it shares; neither the snapshots of other rows nor the journal.
  History copy_to_save() const;

  /// Rows from now on are also written there.
  void set_journal(std::shared_ptr<Journal> journal);
  /// Where `open` finds files whose content is known when it is done again. Null: where they were.
  void set_files(std::shared_ptr<const FileSource> files) { files_ = std::move(files); }
  const std::shared_ptr<const FileSource>& files() const { return files_; }
  /// Bytes held by the snapshots over and above the current document.
  std::size_t bytes() const;

 private:
  struct Snapshot {
    Document document;
    std::size_t bytes = 0;       // beyond its parent
    std::uint64_t last_use = 0;  // for dropping the least recently used
  };

  void go(std::uint32_t sequence, Document document);
  /// Redo from `sequence` on retraces the way back to where the head is.
  void keep_way_back(std::uint32_t sequence);
  void keep_budget();

  std::size_t budget_;
  std::vector<HistoryEntry> entries_;               // entries_[k] has sequence k + 1
  std::vector<std::optional<Snapshot>> snapshots_;  // of entries_[k]
  std::map<std::uint32_t, std::string> names_;      // by sequence
  std::vector<std::uint32_t> redo_child_;           // of sequence s: the child last visited, or 0
  Document current_;
  std::uint32_t head_ = 0;
  std::uint64_t clock_ = 0;
  std::shared_ptr<Journal> journal_;
  std::shared_ptr<const FileSource> files_;
};

}  // namespace arris
