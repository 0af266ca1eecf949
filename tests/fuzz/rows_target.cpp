// A session of one scan whose rows are the lines of the input: what a stranger can write into a
// database that is sound. A line is the text of a row's operation, "move N", "name N TEXT",
// "parent N" (of the rows to come) or "blocks N" (bytes that the scan is said to have).

#include <charconv>
#include <filesystem>

#include "core/base/database.h"
#include "core/base/thread_limit.h"
#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/part.h"

namespace {

using namespace arris;

std::int64_t number_in(std::string_view& rest) {
  std::int64_t value = 0;
  const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  rest.remove_prefix(static_cast<std::size_t>(read.ptr - rest.data()));
  if (!rest.empty()) rest.remove_prefix(1);
  return value;
}

bool take(std::string_view& line, std::string_view word) {
  if (!line.starts_with(word)) return false;
  line.remove_prefix(word.size());
  return true;
}

void require(const Result<void>& done) {
  if (!done) fuzz::require_sentence(done.error().message);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ThreadLimit one_thread(1);
  static const std::string empty = [] {
    const std::string path = fuzz::file_with("empty.arris", "");
    History history;
    require(history.run({"open", {{"file", fuzz::file_with("part.ply", fuzz::part_bytes())}}}));
    require(save_session(path, history, {}));
    return path;
  }();
  const std::string path = fuzz::file_with("rows.arris", "");
  std::filesystem::copy_file(empty, path, std::filesystem::copy_options::overwrite_existing);
  {
    Result<Database> database = Database::open(path, Database::Mode::append);
    if (!database) fuzz::require_none(database.error().message);
    require(database->run("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN"));
    std::int64_t row = 1, parent = 1;
    std::string_view rest = fuzz::text_of(data, size);
    while (!rest.empty() && row < 12) {
      std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
      if (take(line, "move ")) {
        require(Statement(*database, "INSERT INTO moves (rows, head) VALUES (?, ?)")
                    .bind(row)
                    .bind(number_in(line))
                    .run());
      } else if (take(line, "name ")) {
        const std::int64_t of = number_in(line);
        require(Statement(*database, "INSERT OR REPLACE INTO names VALUES (?, ?)")
                    .bind(of)
                    .bind_text(line)
                    .run());
      } else if (take(line, "parent ")) {
        parent = number_in(line);
      } else if (take(line, "blocks ")) {
        require(Statement(*database, "UPDATE scans SET bytes = ?").bind(number_in(line)).run());
      } else {
        require(Statement(*database, "INSERT INTO rows VALUES (?, ?, ?, '')")
                    .bind(++row)
                    .bind(parent)
                    .bind_text(line)
                    .run());
        parent = row;
      }
    }
    require(database->run("COMMIT"));
  }
  const Result<Replay> again = replay(path);
  if (!again) fuzz::require_sentence(again.error().message);
  return 0;
}
