#pragma once

#include <stdexcept>
#include <string>

#include <sqlite3.h>

namespace arris::testing {

/// Changes a session by SQL behind its back.
inline void change_session(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  char* error = nullptr;
  const bool done = sqlite3_open(path.c_str(), &database) == SQLITE_OK &&
                    sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &error) == SQLITE_OK;
  const std::string what = error ? error : "";
  sqlite3_free(error);
  sqlite3_close(database);
  if (!done) throw std::logic_error(sql + ": " + what);
}

/// Makes a session as the first version of the format had it.
inline void make_older(const std::string& path) {
  change_session(path,
                 "DROP TABLE pictures; DROP TABLE snapshots; PRAGMA user_version = 1; VACUUM;");
}

}  // namespace arris::testing
