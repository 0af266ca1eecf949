#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace arris {

/// A file of SQLite, opened so that nothing in it is trusted: its schema runs no functions, there
/// are no triggers, no views, no extensions, no other files; what it holds is data.
class Database {
 public:
  enum class Mode {
    create,  ///< A new file, or an empty one that is there.
    append,  ///< To write to; what a crash left half done is taken back first.
    read,    ///< Nothing is written anywhere.
  };
  /// Errors: it cannot be opened, is no database, needs what `mode` forbids.
  static Result<Database> open(const std::string& path, Mode mode);
  /// An empty one in memory.
  static Result<Database> in_memory();

  /// Statements without results, several in one text. Errors, here and below, name the file and the
  /// reason: "x.arris cannot be written: the disk is full."
  Result<void> run(const char* sql);
  /// A number that a statement gives, as of a pragma. 0 where it gives none.
  Result<std::int64_t> number(const char* sql);
  /// Everything of another one.
  Result<void> copy_from(Database& other);
  /// False where the file was removed, or another one is in its place by now.
  bool is_in_place() const;
  const std::string& path() const { return path_; }
  /// What its errors name instead, as the file that it is to become.
  void set_path(std::string path) { path_ = std::move(path); }

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  Database(std::unique_ptr<sqlite3, Close> connection, std::string path, bool writes)
      : connection_(std::move(connection)), path_(std::move(path)), writes_(writes) {}
  static Result<Database> open_file(const std::string& name, const std::string& path, int flags,
                                    bool writes);
  Error error(int code) const;

  std::unique_ptr<sqlite3, Close> connection_;
  std::string path_;
  bool writes_;
};

/// One statement of SQL. Bound values must live until it was run.
class Statement {
 public:
  Statement(const Database& database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::int64_t value);
  Statement& bind_text(std::string_view value);
  Statement& bind_bytes(std::string_view value);

  /// True: a row is there; false: there is no further one, and the statement can be bound anew.
  Result<bool> step();
  /// For a statement that gives no rows.
  Result<void> run();

  std::int64_t integer(int column) const;
  /// Text or bytes; empty where it is neither. Good until the next step.
  std::string_view bytes(int column) const;

 private:
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int error_ = 0;
  int bound_ = 0;
};

}  // namespace arris
