#include "core/document/session_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>

#include <zlib.h>

#include "core/base/keyed_hash.h"
#include "core/base/parallel.h"
#include "core/base/write_file.h"
#include "core/document/document_bytes.h"
#include "core/document/parameters.h"
#include "core/document/perform.h"
#include "core/document/scan_places.h"
#include "core/mesh/gunzip.h"
#include "core/mesh/within_memory.h"

namespace arris {

namespace {

constexpr std::int64_t application_id = 0x41525253;  // "ARRS"

/// What each version of the format adds to the one before. A new file takes all of these steps, one
/// of an older version those that it lacks; what a version looks like is said nowhere else.
constexpr std::array format_steps{
    // 1: scan_blocks are pieces of 1 MiB, packed by zlib where that makes them smaller; `rows` of a
    // move are those that were there before it; the view "" is the one it was left with.
    R"(CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL);
       CREATE TABLE scans (hash TEXT PRIMARY KEY, name TEXT NOT NULL, bytes INTEGER NOT NULL);
       CREATE TABLE scan_blocks (hash TEXT NOT NULL, number INTEGER NOT NULL, packed BLOB NOT NULL,
                                 PRIMARY KEY (hash, number));
       CREATE TABLE rows (sequence INTEGER PRIMARY KEY, parent INTEGER NOT NULL,
                          operation TEXT NOT NULL, hash TEXT NOT NULL);
       CREATE TABLE moves (number INTEGER PRIMARY KEY, rows INTEGER NOT NULL,
                           head INTEGER NOT NULL);
       CREATE TABLE names (row INTEGER PRIMARY KEY, name TEXT NOT NULL);
       CREATE TABLE views (name TEXT PRIMARY KEY, view TEXT NOT NULL);)",
    // 2: pictures of the part, small, as PNG; "" is that of the start page.
    // `rows` of a snapshot are those that there were, `mark` is their keyed hash with the document.
    R"(CREATE TABLE pictures (name TEXT PRIMARY KEY, png BLOB NOT NULL);
       CREATE TABLE snapshots (row INTEGER PRIMARY KEY, rows INTEGER NOT NULL,
                               document BLOB NOT NULL, mark BLOB NOT NULL);)",
};
constexpr std::int64_t format_version = format_steps.size();

constexpr std::size_t block_size = std::size_t{1} << 20;
/// Blocks that are packed side by side, and so are in memory at a time beside the scan.
constexpr std::size_t blocks_at_a_time = 32;
/// Larger ones of the window's own are not taken from a file.
constexpr std::size_t most_extra = std::size_t{16} << 20;

Result<void> take_steps(Database& database, std::int64_t from, std::int64_t to) {
  for (std::int64_t k = from; k < to; ++k)
    if (const auto done = database.run(format_steps[static_cast<std::size_t>(k)]); !done)
      return done;
  return database.run(("PRAGMA user_version = " + std::to_string(to)).c_str());
}

/// What a database is made of, to be compared.
Result<std::vector<std::string>> schema_of(const Database& database) {
  std::vector<std::string> schema;
  Statement statement(database,
                      "SELECT type, name, tbl_name, coalesce(sql, '') FROM sqlite_schema "
                      "ORDER BY type, name");
  while (true) {
    const Result<bool> row = statement.step();
    if (!row) return tl::unexpected<Error>(row.error());
    if (!*row) return schema;
    for (int column = 0; column < 4; ++column) schema.emplace_back(statement.bytes(column));
  }
}

tl::unexpected<Error> damaged(const std::string& path, const std::string& what) {
  return fail(path + " is damaged: " + what + ".");
}

/// Whether a database is a session that can be read here, to the letter of its schema: one that a
/// stranger gave more, or other, tables is none. Gives its version.
Result<std::int64_t> check_format(Database& database) {
  const std::string& path = database.path();
  const Result<std::int64_t> program = database.number("PRAGMA application_id");
  if (!program) return tl::unexpected<Error>(program.error());
  if (*program != application_id)
    return fail(path + " is a database of another program, not a session of Arris.");
  const Result<std::int64_t> version = database.number("PRAGMA user_version");
  if (!version) return tl::unexpected<Error>(version.error());
  if (*version > format_version)
    return fail(path + " was saved by a newer Arris (format " + std::to_string(*version) +
                "; this one reads up to " + std::to_string(format_version) +
                "). Open it with that one.");
  if (*version < 1) return damaged(path, "its format has no version");
  Statement check(database, "PRAGMA quick_check(1)");
  const Result<bool> checked = check.step();
  if (!checked) return tl::unexpected<Error>(checked.error());
  if (check.bytes(0) != "ok") {
    // SQLite says where in lines, of which the last is the one that means something.
    std::string found(check.bytes(0));
    while (!found.empty() && (found.back() == '.' || found.back() == '\n')) found.pop_back();
    return damaged(path, "its database is not sound (" + found.substr(found.rfind('\n') + 1) + ")");
  }

  Result<Database> model = Database::in_memory();
  if (!model) return tl::unexpected<Error>(model.error());
  if (const auto made = take_steps(*model, 0, *version); !made)
    return tl::unexpected<Error>(made.error());
  const Result<std::vector<std::string>> expected = schema_of(*model), found = schema_of(database);
  if (!expected) return tl::unexpected<Error>(expected.error());
  if (!found) return tl::unexpected<Error>(found.error());
  if (*expected != *found) return damaged(path, "its tables are not those of a session");
  return version;
}

/// The first bytes of a database.
struct Header {
  std::array<unsigned char, 100> bytes{};
  bool is_database = false;
  explicit Header(const std::string& path) {
    constexpr std::string_view magic("SQLite format 3\0", 16);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return;
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    is_database =
        file && std::equal(magic.begin(), magic.end(), reinterpret_cast<char*>(bytes.data()));
  }
  /// Reading a database with a write-ahead log makes files beside it.
  bool keeps_to_itself() const { return bytes[18] == 1 && bytes[19] == 1; }
};

std::string packed(std::string_view block) {
  uLongf size = compressBound(block.size());
  std::string result(size, '\0');
  // The fastest: a mesh's numbers pack little better by trying harder.
  const int code =
      compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                reinterpret_cast<const Bytef*>(block.data()), block.size(), Z_BEST_SPEED);
  if (code != Z_OK || size >= block.size()) return std::string(block);
  result.resize(size);
  return result;
}

bool unpack(std::string_view block, char* to, std::size_t size) {
  if (block.size() == size) {
    std::copy(block.begin(), block.end(), to);
    return true;
  }
  uLongf made = size;
  return uncompress(reinterpret_cast<Bytef*>(to), &made,
                    reinterpret_cast<const Bytef*>(block.data()), block.size()) == Z_OK &&
         made == size;
}

/// The scans of a session, then those that it names.
class SessionScans : public FileSource {
 public:
  SessionScans(std::shared_ptr<const SessionFile> session, std::vector<std::string> located)
      : session_(std::move(session)), places_(session_->path(), std::move(located)) {}

  Result<FileContent> find(const std::string& path, const std::string& hash,
                           const Context& context) const override {
    Result<std::optional<FileContent>> inside = session_->scan(hash, context);
    if (!inside) return tl::unexpected<Error>(inside.error());
    if (*inside) return std::move(**inside);
    return places_.find(path, hash, context);
  }

 private:
  std::shared_ptr<const SessionFile> session_;
  ScanPlaces places_;
};

}  // namespace

bool SessionFile::is_session(const std::string& path) { return Header(path).is_database; }

std::string SessionFile::picture_of(const std::string& path) {
  const Header header(path);
  if (!header.is_database || !header.keeps_to_itself()) return {};
  Result<Database> database = Database::open(path, Database::Mode::read);
  if (!database || database->number("PRAGMA application_id") != application_id) return {};
  Statement statement(*database, "SELECT png FROM pictures WHERE name = ''");
  const Result<bool> row = statement.step();
  return row && *row && statement.bytes(0).size() <= most_extra ? std::string(statement.bytes(0))
                                                                : std::string();
}

std::shared_ptr<const FileSource> SessionFile::files(std::shared_ptr<const SessionFile> session,
                                                     std::vector<std::string> located) {
  return std::make_shared<const SessionScans>(std::move(session), std::move(located));
}

Result<std::shared_ptr<SessionFile>> SessionFile::open(const std::string& path,
                                                       Database::Mode mode) {
  const Header header(path);
  if (!header.is_database) return fail(path + " is not a session of Arris, or it is damaged.");
  if (!header.keeps_to_itself())
    return fail(path + " is a database of another program, not a session of Arris.");
  Result<Database> database = Database::open(path, mode);
  if (!database) return tl::unexpected<Error>(database.error());
  const Result<std::int64_t> version = check_format(*database);
  if (!version) return tl::unexpected<Error>(version.error());
  if (*version < format_version && mode == Database::Mode::read) {
    Result<Database> copy = Database::in_memory();
    if (!copy) return tl::unexpected<Error>(copy.error());
    if (const auto copied = copy->copy_from(*database); !copied)
      return tl::unexpected<Error>(copied.error());
    copy->set_path(path);
    database = std::move(copy);
  }
  std::shared_ptr<SessionFile> session(new SessionFile(std::move(*database)));
  if (*version < format_version) {
    const auto updated = session->in_transaction(
        [&] { return take_steps(session->database_, *version, format_version); });
    if (!updated) return tl::unexpected<Error>(updated.error());
  }
  return session;
}

Result<std::shared_ptr<SessionFile>> SessionFile::read(const std::string& path) {
  return open(path, Database::Mode::read);
}

Result<std::shared_ptr<SessionFile>> SessionFile::go_on(const std::string& path) {
  Result<std::shared_ptr<SessionFile>> session = open(path, Database::Mode::append);
  if (!session) return session;
  // A rollback journal, removed by each commit, so that a closed session is one file; a write-ahead
  // log would be faster but is a second and a third one. EXTRA: the folder is synchronised after
  // that, too, or a power cut could bring the journal back, which would take the row away again
  // after its result was shown.
  for (const char* pragma : {"PRAGMA journal_mode = DELETE", "PRAGMA synchronous = EXTRA"})
    if (const auto set = (*session)->database_.run(pragma); !set)
      return tl::unexpected<Error>(set.error());
  return session;
}

Result<std::shared_ptr<SessionFile>> SessionFile::start(const std::string& path,
                                                        const History& history,
                                                        const SessionExtras& extras,
                                                        const Context& context) {
  if (const auto saved = save_session(path, history, extras, context); !saved)
    return tl::unexpected<Error>(saved.error());
  return go_on(path);
}

template <class Write>
Result<void> SessionFile::in_transaction(const Write& write) {
  if (!database_.is_in_place())
    return fail(path() + " was removed or replaced. Save the session under another name.");
  Result<void> done = database_.run("BEGIN IMMEDIATE");
  if (!done) return done;
  done = write();
  if (done) done = database_.run("COMMIT");
  // Where the commit failed for want of room SQLite has gone back already: no harm in saying so.
  if (!done) static_cast<void>(database_.run("ROLLBACK"));
  return done;
}

Result<void> SessionFile::append(const HistoryEntry& entry) {
  Result<void> done = in_transaction([&]() -> Result<void> {
    if (const auto scan = write_scan(entry.operation, nullptr, {}); !scan) return scan;
    return write_row(entry);
  });
  if (!done) done.error().message += " The edit was not made.";
  return done;
}

Result<void> SessionFile::append_head(std::uint32_t sequence) {
  return in_transaction([&] { return write_move(sequence); });
}

Result<void> SessionFile::append_name(std::uint32_t sequence, const std::string& name) {
  return in_transaction([&] { return write_name(sequence, name); });
}

Result<void> SessionFile::set_saved_as(const std::string& file) {
  return in_transaction([&] {
    return Statement(database_, "INSERT OR REPLACE INTO meta VALUES ('saved_as', ?)")
        .bind_text(file)
        .run();
  });
}

Result<void> SessionFile::set_view(const std::string& view) {
  return in_transaction([&] {
    return Statement(database_, "INSERT OR REPLACE INTO views VALUES ('', ?)")
        .bind_text(view)
        .run();
  });
}

Result<void> SessionFile::write_row(const HistoryEntry& entry) {
  Statement insert(database_, "INSERT INTO rows VALUES (?, ?, ?, ?)");
  const std::string operation = entry.operation.text();
  return insert.bind(entry.sequence)
      .bind(entry.parent)
      .bind_text(operation)
      .bind_text(entry.hash)
      .run();
}

Result<void> SessionFile::write_move(std::uint32_t head) {
  Statement insert(database_,
                   "INSERT INTO moves (rows, head) VALUES ((SELECT count(*) FROM rows), ?)");
  return insert.bind(head).run();
}

Result<void> SessionFile::write_name(std::uint32_t sequence, const std::string& name) {
  Statement statement(database_, name.empty() ? "DELETE FROM names WHERE row = ?"
                                              : "INSERT OR REPLACE INTO names VALUES (?, ?)");
  statement.bind(sequence);
  if (!name.empty()) statement.bind_text(name);
  return statement.run();
}

Result<std::string> SessionFile::mark_of(const SessionSnapshot& snapshot,
                                         const std::string& key) const {
  // Each part with its length, so that none can pass for another.
  std::string all;
  const auto add = [&](std::string_view bytes) {
    all += std::to_string(bytes.size()) + ":";
    all += bytes;
  };
  add(std::to_string(snapshot.row));
  add(std::to_string(snapshot.rows));
  Statement rows(database_,
                 "SELECT sequence, parent, operation, hash FROM rows WHERE sequence <= ? "
                 "ORDER BY sequence");
  rows.bind(snapshot.rows);
  Result<bool> row = rows.step();
  for (; row && *row; row = rows.step()) {
    add(std::to_string(rows.integer(0)));
    add(std::to_string(rows.integer(1)));
    add(rows.bytes(2));
    add(rows.bytes(3));
  }
  if (!row) return tl::unexpected<Error>(row.error());
  add(snapshot.bytes);
  return keyed_hash(key, all);
}

Result<void> SessionFile::write_snapshot(const History& history, const std::string& key) {
  const auto rows = static_cast<std::uint32_t>(history.entries().size());
  // An opened part is as soon opened again.
  if (history.head() == 0 || history.entries()[history.head() - 1].operation.name == "open")
    return {};
  std::optional<std::string> bytes = bytes_of(history.current());
  if (!bytes) return {};
  const SessionSnapshot snapshot{history.head(), rows, std::move(*bytes)};
  const Result<std::string> mark = mark_of(snapshot, key);
  if (!mark) return tl::unexpected<Error>(mark.error());
  Statement insert(database_, "INSERT INTO snapshots VALUES (?, ?, ?, ?)");
  return insert.bind(snapshot.row)
      .bind(snapshot.rows)
      .bind_bytes(snapshot.bytes)
      .bind_bytes(*mark)
      .run();
}

Result<std::optional<SessionSnapshot>> SessionFile::snapshot(const std::string& key) const {
  if (key.size() != hash_key_size) return std::nullopt;
  Statement statement(database_, "SELECT row, rows, document, mark FROM snapshots LIMIT 1");
  const Result<bool> row = statement.step();
  if (!row) return tl::unexpected<Error>(row.error());
  if (!*row) return std::nullopt;
  SessionSnapshot snapshot;
  snapshot.row = static_cast<std::uint32_t>(statement.integer(0));
  snapshot.rows = static_cast<std::uint32_t>(statement.integer(1));
  snapshot.bytes = statement.bytes(2);
  const std::string mark(statement.bytes(3));
  const Result<std::string> own = mark_of(snapshot, key);
  if (!own) return tl::unexpected<Error>(own.error());
  return *own == mark ? std::optional(std::move(snapshot)) : std::nullopt;
}

Result<void> SessionFile::write_scan(const Operation& operation, const FileSource* files,
                                     const Context& context) {
  if (operation.name != "open") return {};
  const std::string hash = operation.parameters.at("hash");
  Statement known(database_, "SELECT 1 FROM scans WHERE hash = ?");
  const Result<bool> is_known = known.bind_text(hash).step();
  if (!is_known) return tl::unexpected<Error>(is_known.error());
  if (*is_known) return {};

  const std::string from = opened_path(operation.parameters);
  Result<FileContent> content =
      files ? files->find(from, hash, context) : ScanPlaces(from).find(from, hash, context);
  if (!content) return tl::unexpected<Error>(content.error());
  const std::string_view bytes = content->view();
  Statement insert(database_, "INSERT INTO scans VALUES (?, ?, ?)");
  const std::string name = operation.parameters.at("file");
  if (const auto done =
          insert.bind_text(hash).bind_text(name).bind(std::int64_t(bytes.size())).run();
      !done)
    return done;
  Statement block(database_, "INSERT INTO scan_blocks VALUES (?, ?, ?)");
  const std::size_t count = (bytes.size() + block_size - 1) / block_size;
  for (std::size_t first = 0; first < count; first += blocks_at_a_time) {
    if (context.cancelled()) return cancelled();
    context.report(static_cast<double>(first) / static_cast<double>(count), "saving");
    std::vector<std::string> blocks(std::min(blocks_at_a_time, count - first));
    parallel_for(
        blocks.size(),
        [&](std::size_t k) {
          blocks[k] = packed(bytes.substr((first + k) * block_size, block_size));
        },
        1);
    for (std::size_t k = 0; k < blocks.size(); ++k)
      if (const auto done =
              block.bind_text(hash).bind(std::int64_t(first + k)).bind_bytes(blocks[k]).run();
          !done)
        return done;
  }
  return {};
}

Result<std::optional<FileContent>> SessionFile::scan(const std::string& hash,
                                                     const Context& context) const {
  Statement known(database_, "SELECT bytes FROM scans WHERE hash = ?");
  const Result<bool> is_known = known.bind_text(hash).step();
  if (!is_known) return tl::unexpected<Error>(is_known.error());
  if (!*is_known) return std::nullopt;
  Statement total(database_,
                  "SELECT sum(length(packed)), count(*) FROM scan_blocks WHERE hash = ?");
  if (const Result<bool> row = total.bind_text(hash).step(); !row)
    return tl::unexpected<Error>(row.error());
  const std::int64_t bytes = known.integer(0);
  // Checked against what there is before anything is allocated.
  if (bytes <= 0 ||
      static_cast<std::size_t>(bytes) > most_growth(static_cast<std::size_t>(total.integer(0))))
    return damaged(path(), "the size of its scan cannot be");
  const auto size = static_cast<std::size_t>(bytes);
  const std::size_t count = (size + block_size - 1) / block_size;
  if (total.integer(1) != static_cast<std::int64_t>(count))
    return damaged(path(), "its scan is not complete");
  return within_memory(path(), [&]() -> Result<std::optional<FileContent>> {
    FileContent content{std::make_unique_for_overwrite<char[]>(size), size};
    Statement blocks(database_, "SELECT packed FROM scan_blocks WHERE hash = ? ORDER BY number");
    blocks.bind_text(hash);
    for (std::size_t k = 0; k < count; ++k) {
      if (context.cancelled()) return cancelled();
      const Result<bool> row = blocks.step();
      if (!row) return tl::unexpected<Error>(row.error());
      const std::size_t begin = k * block_size;
      if (!*row ||
          !unpack(blocks.bytes(0), content.bytes.get() + begin, std::min(block_size, size - begin)))
        return damaged(path(), "its scan cannot be unpacked");
    }
    if (hash_of_content(content.view()) != hash)
      return damaged(path(), "its scan is not the one that was opened");
    return content;
  });
}

Result<std::vector<JournalRecord>> SessionFile::records() const {
  std::vector<JournalRecord> records;
  Statement moves(database_, "SELECT rows, head FROM moves ORDER BY number");
  Result<bool> move = moves.step();
  std::int64_t count = 0;
  /// The moves that were made when there were so many rows.
  const auto add_moves = [&]() -> Result<void> {
    for (; move && *move && moves.integer(0) <= count; move = moves.step())
      records.push_back(
          {"move after row " + std::to_string(count), {{"head", std::uint64_t(moves.integer(1))}}});
    if (!move) return tl::unexpected<Error>(move.error());
    return {};
  };
  Statement rows(database_, "SELECT sequence, parent, operation, hash FROM rows ORDER BY sequence");
  Result<bool> row = rows.step();
  for (; row && *row; row = rows.step()) {
    if (const auto added = add_moves(); !added) return tl::unexpected<Error>(added.error());
    const std::string where = "row " + std::to_string(++count);
    nlohmann::json operation = parse_record(rows.bytes(2));
    if (rows.integer(0) != count || !operation.is_object())
      return damaged(path(), where + " cannot be read");
    // A file is known by its content here, not by its name: a stranger's session opens no other.
    if (operation.value("operation", nlohmann::json()) == "open" &&
        !operation.value("hash", nlohmann::json()).is_string())
      return damaged(path(), where + " opens a scan of unknown content");
    if (!is_utf8(std::string(rows.bytes(3)))) return damaged(path(), where + " has no hash");
    records.push_back({where,
                       {{"sequence", std::uint64_t(rows.integer(0))},
                        {"parent", std::uint64_t(rows.integer(1))},
                        {"operation", std::move(operation)},
                        {"hash", rows.bytes(3)}}});
  }
  if (!row) return tl::unexpected<Error>(row.error());
  if (const auto added = add_moves(); !added) return tl::unexpected<Error>(added.error());
  Statement names(database_, "SELECT row, name FROM names ORDER BY row");
  Result<bool> name = names.step();
  for (; name && *name; name = names.step())
    records.push_back({"the name of row " + std::to_string(names.integer(0)),
                       {{"row", std::uint64_t(names.integer(0))}, {"name", names.bytes(1)}}});
  if (!name) return tl::unexpected<Error>(name.error());
  return records;
}

Result<SessionExtras> SessionFile::extras() const {
  SessionExtras extras;
  for (const auto& [sql, to] :
       {std::pair{"SELECT value FROM meta WHERE key = 'part'", &extras.part},
        {"SELECT value FROM meta WHERE key = 'saved_as'", &extras.saved_as},
        {"SELECT view FROM views WHERE name = ''", &extras.view},
        {"SELECT png FROM pictures WHERE name = ''", &extras.picture}}) {
    Statement statement(database_, sql);
    const Result<bool> row = statement.step();
    if (!row) return tl::unexpected<Error>(row.error());
    if (*row && statement.bytes(0).size() <= most_extra) *to = statement.bytes(0);
  }
  return extras;
}

Result<bool> hold_the_same(const SessionFile& a, const SessionFile& b) {
  struct Held {
    std::vector<nlohmann::json> rows, names;
    std::uint64_t head = 0;
    bool operator==(const Held&) const = default;
  };
  std::array<Held, 2> held;
  for (std::size_t k = 0; k < 2; ++k) {
    Result<std::vector<JournalRecord>> records = (k == 0 ? a : b).records();
    if (!records) return tl::unexpected<Error>(records.error());
    for (JournalRecord& record : *records) {
      if (record.json.contains("sequence")) {
        held[k].head = record.json["sequence"];
        held[k].rows.push_back(std::move(record.json));
      } else if (record.json.contains("head")) {
        held[k].head = record.json["head"];
      } else {
        held[k].names.push_back(std::move(record.json));
      }
    }
  }
  return held[0] == held[1];
}

Result<void> save_session(const std::string& path, const History& history,
                          const SessionExtras& extras, const Context& context) {
  const auto fill = [&](const std::string& part) -> Result<void> {
    Result<Database> made = Database::open(part, Database::Mode::create);
    if (!made) return tl::unexpected<Error>(made.error());
    made->set_path(path);
    SessionFile session(std::move(*made));
    Database& database = session.database_;
    // Nobody sees the file before all of it is on disk: nothing has to be taken back.
    if (const auto set = database.run(
            ("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF; PRAGMA application_id = " +
             std::to_string(application_id))
                .c_str());
        !set)
      return set;
    return session.in_transaction([&]() -> Result<void> {
      Result<void> done = take_steps(database, 0, format_version);
      const std::vector<HistoryEntry>& entries = history.entries();
      for (std::size_t k = 0; done && k < entries.size(); ++k) {
        done = session.write_scan(entries[k].operation, history.files().get(), context);
        if (done) done = session.write_row(entries[k]);
      }
      for (const std::uint32_t head : history.closing_moves())
        if (done) done = session.write_move(head);
      for (const auto& [row, name] : history.names())
        if (done) done = session.write_name(row, name);
      const auto put = [&](const char* sql, const std::string& value) {
        if (done && !value.empty()) done = Statement(database, sql).bind_bytes(value).run();
      };
      put("INSERT INTO meta VALUES ('program', CAST(? AS TEXT))", "Arris " ARRIS_VERSION);
      put("INSERT INTO meta VALUES ('part', CAST(? AS TEXT))", extras.part);
      put("INSERT INTO meta VALUES ('saved_as', CAST(? AS TEXT))", extras.saved_as);
      put("INSERT INTO views VALUES ('', CAST(? AS TEXT))", extras.view);
      put("INSERT INTO pictures VALUES ('', ?)", extras.picture);
      if (done && extras.key.size() == hash_key_size)
        done = session.write_snapshot(history, extras.key);
      return done;
    });
  };
  return replace_file(path, fill);
}

}  // namespace arris
