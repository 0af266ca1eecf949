#include "core/base/database.h"

#include <cstring>
#include <filesystem>
#include <utility>

#include <sqlite3.h>

namespace arris {

namespace {

/// No value, and so no operation and no block of a scan, is larger.
constexpr int most_bytes = 512 << 20;
constexpr int most_sql = 16 << 10;
constexpr int patience = 2000;  // ms that another program may hold the file

std::string words_of(int code, int system_error) {
  const std::string reason =
      system_error == 0 ? "" : std::string(" (") + std::strerror(system_error) + ")";
  switch (code & 0xFF) {
    case SQLITE_FULL:
      return "the disk is full";
    case SQLITE_CORRUPT:
      return "its content is damaged";
    case SQLITE_NOTADB:
      return "it is not a database";
    case SQLITE_READONLY:
      return code == SQLITE_READONLY_ROLLBACK
                 ? "it was left in the middle of being written (its -journal lies beside it)"
                 : "it may not be written";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program is using it";
    case SQLITE_CANTOPEN:
      return "it cannot be opened" + reason;
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return "permission is denied";
    case SQLITE_IOERR:
      return "the disk reports an error" + reason;
    case SQLITE_NOMEM:
      return "there is too little memory";
    case SQLITE_TOOBIG:
      return "a value in it is too large";
    case SQLITE_CONSTRAINT:
      return "it holds this already, or other than was expected";
    default:
      return sqlite3_errstr(code);
  }
}

}  // namespace

void Database::Close::operator()(sqlite3* connection) const { sqlite3_close(connection); }

Error Database::error(int code) const {
  return Error{path_ + (writes_ ? " cannot be written: " : " cannot be read: ") +
               words_of(code, sqlite3_system_errno(connection_.get())) + "."};
}

Result<Database> Database::open(const std::string& path, Mode mode) {
  // An absolute name is never taken for a URI, with which a file could ask for more than reading.
  std::error_code failed;
  const std::filesystem::path name = std::filesystem::absolute(path, failed);
  if (failed) return fail(path + " cannot be opened: " + failed.message() + ".");
  const int flags = mode == Mode::read     ? SQLITE_OPEN_READONLY
                    : mode == Mode::append ? SQLITE_OPEN_READWRITE
                                           : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  return open_file(name.string(), path, flags, mode != Mode::read);
}

Result<Database> Database::in_memory() {
  return open_file(":memory:", "The copy in memory", SQLITE_OPEN_READWRITE, true);
}

Result<Database> Database::open_file(const std::string& name, const std::string& path, int flags,
                                     bool writes) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &opened, flags | SQLITE_OPEN_FULLMUTEX, nullptr);
  Database database({opened, {}}, path, writes);
  if (code != SQLITE_OK) return tl::unexpected<Error>(database.error(code));
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, patience);
  for (const auto& [option, value] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                      {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                      {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                      {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0},
                                      {SQLITE_DBCONFIG_DQS_DML, 0},
                                      {SQLITE_DBCONFIG_DQS_DDL, 0}})
    sqlite3_db_config(opened, option, value, nullptr);
  for (const auto& [limit, value] : {std::pair{SQLITE_LIMIT_LENGTH, most_bytes},
                                     {SQLITE_LIMIT_SQL_LENGTH, most_sql},
                                     {SQLITE_LIMIT_ATTACHED, 0},
                                     {SQLITE_LIMIT_COLUMN, 32},
                                     {SQLITE_LIMIT_EXPR_DEPTH, 20},
                                     {SQLITE_LIMIT_TRIGGER_DEPTH, 1},
                                     {SQLITE_LIMIT_WORKER_THREADS, 0}})
    sqlite3_limit(opened, limit, value);
  // A mapped file that another program shortens kills us, and nothing goes to files of its own.
  for (const char* pragma : {"PRAGMA mmap_size = 0", "PRAGMA temp_store = MEMORY",
                             "PRAGMA cell_size_check = ON", "PRAGMA foreign_keys = OFF"})
    if (const auto set = database.run(pragma); !set) return tl::unexpected<Error>(set.error());
  return database;
}

Result<void> Database::run(const char* sql) {
  const int code = sqlite3_exec(connection_.get(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return tl::unexpected<Error>(error(code));
  return {};
}

Result<std::int64_t> Database::number(const char* sql) {
  Statement statement(*this, sql);
  const Result<bool> row = statement.step();
  if (!row) return tl::unexpected<Error>(row.error());
  return *row ? statement.integer(0) : 0;
}

Result<void> Database::copy_from(Database& other) {
  sqlite3_backup* backup =
      sqlite3_backup_init(connection_.get(), "main", other.connection_.get(), "main");
  if (!backup) return tl::unexpected<Error>(error(sqlite3_extended_errcode(connection_.get())));
  sqlite3_backup_step(backup, -1);
  const int code = sqlite3_backup_finish(backup);
  if (code != SQLITE_OK) return tl::unexpected<Error>(other.error(code));
  return {};
}

bool Database::is_in_place() const {
  int moved = 0;
  const int code = sqlite3_file_control(connection_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  return code != SQLITE_OK || moved == 0;
}

Statement::Statement(const Database& database, const char* sql) : database_(database) {
  error_ = sqlite3_prepare_v2(database.connection_.get(), sql, -1, &statement_, nullptr);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_, ++bound_, value);
  if (error_ == SQLITE_OK) error_ = code;
  return *this;
}

Statement& Statement::bind_text(std::string_view value) {
  const int code = sqlite3_bind_text64(statement_, ++bound_, value.data(), value.size(),
                                       SQLITE_STATIC, SQLITE_UTF8);
  if (error_ == SQLITE_OK) error_ = code;
  return *this;
}

Statement& Statement::bind_bytes(std::string_view value) {
  const int code =
      sqlite3_bind_blob64(statement_, ++bound_, value.data(), value.size(), SQLITE_STATIC);
  if (error_ == SQLITE_OK) error_ = code;
  return *this;
}

Result<bool> Statement::step() {
  if (error_ != SQLITE_OK) return tl::unexpected<Error>(database_.error(error_));
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(statement_);
  bound_ = 0;
  if (code == SQLITE_DONE) return false;
  return tl::unexpected<Error>(database_.error(code));
}

Result<void> Statement::run() {
  const Result<bool> done = step();
  if (!done) return tl::unexpected<Error>(done.error());
  return {};
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::string_view Statement::bytes(int column) const {
  const int type = sqlite3_column_type(statement_, column);
  if (type != SQLITE_TEXT && type != SQLITE_BLOB) return {};
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return {data, data ? static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)) : 0};
}

}  // namespace arris
