// The process that crash tests kill: works on a session until that happens, and says on a
// descriptor what it was told to be on disk.
//   arris_crash_worker SESSION append|save|migrate|import
// "migrate" copies a session of an older format to SESSION.1, SESSION.2, ... and brings each up to
// date, "import" makes sessions of a journal there; each says its number with 1 as it begins and
// with 2 once it is done.

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/core/crash_worker.h"

namespace {

void say(std::uint32_t rows, std::uint32_t head) {
  const arris::testing::Acknowledged word{rows, head};
  if (::write(arris::testing::to_the_parent, &word, sizeof word) != sizeof word) std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace arris;
  if (argc != 3) return 2;
  const char* path = argv[1];
  const std::string_view what = argv[2];
  if (what == "migrate" || what == "import")
    for (std::uint32_t k = 1;; ++k) {
      const std::string made = std::string(path) + "." + std::to_string(k);
      if (what == "migrate") {
        std::filesystem::copy_file(path, made, std::filesystem::copy_options::overwrite_existing);
        say(k, 1);
        if (!SessionFile::go_on(made)) std::abort();
      } else {
        std::filesystem::remove(made);
        say(k, 1);
        const Result<Replay> journal = replay(path);
        if (!journal || !SessionFile::start(made, journal->history)) std::abort();
      }
      say(k, 2);
    }
  const auto session = SessionFile::go_on(path);
  Result<Replay> replayed = replay(path);
  if (!session || !replayed) std::abort();
  History history = std::move(replayed->history);
  if (what == "save")
    for (std::uint32_t row = 1;; row = 3 - row) {
      if (!history.travel(row) || !save_session(path, history, {})) std::abort();
      say(0, row);
    }
  history.set_journal(*session);
  for (std::uint32_t k = 0;; ++k) {
    const auto done = k % 5 == 3 ? history.travel(history.head() - 1)
                                 : history.run({"flip_orientation", nlohmann::json::object()});
    if (!done) std::abort();
    say(static_cast<std::uint32_t>(history.entries().size()), history.head());
  }
}
