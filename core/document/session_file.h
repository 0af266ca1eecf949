#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/database.h"
#include "core/base/file_source.h"
#include "core/document/history.h"
#include "core/document/journal.h"

namespace arris {

/// What a session holds beside its history.
struct SessionExtras {
  std::string part;     ///< The name of the part, to be shown.
  std::string view;     ///< How it was looked at: JSON of the window's own; empty: not known.
  std::string picture;  ///< A small PNG of the part; may be empty.
  /// In a recovery session: the file that was saved last, of which this is the continuation.
  std::string saved_as;
  /// Not held, but used: the user's own key, with which a snapshot of the document is signed that
  /// spares whoever has the key the replay. Empty: no snapshot.
  std::string key;
};

/// The document after a row, as it was when there were so many rows.
struct SessionSnapshot {
  std::uint32_t row = 0;
  std::uint32_t rows = 0;
  std::string bytes;  ///< As bytes_of() made them.
};

/// A session on disk (*.arris): one SQLite database that needs nothing beside it. It holds the scan
/// as it was opened, every operation as a row with the hash of its result, the moves of the head,
/// names of versions, and extras.
///
/// A saved session is written whole and never changed (save_session()); what is done between two
/// saves goes to a recovery session, row by row, each durable when the call returns.
class SessionFile : public Journal {
 public:
  /// Whether a file begins as a session does, whatever its name.
  static bool is_session(const std::string& path);

  /// The picture of a session, without a look at the rest; empty where it has none, or is none.
  static std::string picture_of(const std::string& path);

  /// To read what is in it; nothing is written anywhere. A session of an older format is brought up
  /// to date in memory. Errors: it cannot be read, is damaged, is another program's, or was written
  /// by a newer Arris.
  static Result<std::shared_ptr<SessionFile>> read(const std::string& path);
  /// To go on with: what a crash left half written is taken back, an older format is brought up to
  /// date. Errors: as read(); it cannot be written.
  static Result<std::shared_ptr<SessionFile>> go_on(const std::string& path);

  /// Saves the history as save_session() does, and goes on with that.
  static Result<std::shared_ptr<SessionFile>> start(const std::string& path, const History& history,
                                                    const SessionExtras& extras = {},
                                                    const Context& context = {});

  // Journal. Errors leave the file as it was: the disk is full, the file was removed.
  Result<void> append(const HistoryEntry& entry) override;
  Result<void> append_head(std::uint32_t sequence) override;
  Result<void> append_name(std::uint32_t sequence, const std::string& name) override;

  /// The file that was saved last (SessionExtras::saved_as).
  Result<void> set_saved_as(const std::string& file);
  /// How the part is looked at by now (SessionExtras::view).
  Result<void> set_view(const std::string& view);

  /// What it holds, in the order of a journal.
  Result<std::vector<JournalRecord>> records() const;
  Result<SessionExtras> extras() const;
  /// A scan by the hash of its content; nothing where it is not in here. Errors: damaged.
  Result<std::optional<FileContent>> scan(const std::string& hash, const Context& context) const;
  /// Where scans that are not in here are looked for, too: see ScanPlaces.
  static std::shared_ptr<const FileSource> files(std::shared_ptr<const SessionFile> session,
                                                 std::vector<std::string> located = {});
  /// The snapshot, where this key signed it and the rows before it. A stranger's is none: what it
  /// says could not be checked as a replay checks each row, and so it is replayed.
  Result<std::optional<SessionSnapshot>> snapshot(const std::string& key) const;
  const std::string& path() const { return database_.path(); }

 private:
  friend Result<void> save_session(const std::string& path, const History& history,
                                   const SessionExtras& extras, const Context& context);
  explicit SessionFile(Database database) : database_(std::move(database)) {}
  static Result<std::shared_ptr<SessionFile>> open(const std::string& path, Database::Mode mode);
  Result<void> write_scan(const Operation& operation, const FileSource* files,
                          const Context& context);
  Result<void> write_row(const HistoryEntry& entry);
  Result<void> write_move(std::uint32_t head);
  Result<void> write_name(std::uint32_t sequence, const std::string& name);
  Result<void> write_snapshot(const History& history, const std::string& key);
  Result<std::string> mark_of(const SessionSnapshot& snapshot, const std::string& key) const;
  /// All of `write`, or nothing of it, and on disk when this returns.
  template <class Write>
  Result<void> in_transaction(const Write& write);

  Database database_;
};

/// Whether two sessions hold the same operations and names of versions, and stand at the same row.
/// The way there, and how the part was looked at, do not count. Errors: as records().
Result<bool> hold_the_same(const SessionFile& a, const SessionFile& b);

/// Writes a history as a session, replacing `path` only by a whole new file. Scans come from
/// history.files(), or from where they were opened. Errors: cannot be written, a scan is nowhere to
/// be found any more, cancelled.
Result<void> save_session(const std::string& path, const History& history,
                          const SessionExtras& extras, const Context& context = {});

}  // namespace arris
