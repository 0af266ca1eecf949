// What a session of many operations costs: each row on disk, saving, opening it by running its rows
// and from its snapshot. Not a test: figures. Usage: arris_session_bench SCAN [EDITS]

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace testing;
using Clock = std::chrono::steady_clock;

template <class Work>
double seconds(const Work& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void ok(const Result<void>& done) {
  if (!done) throw std::logic_error(done.error().message);
}

int run(const std::string& scan, int edits) {
  const TempFolder folder;
  const std::string path = folder.file("bench.arris"), recovery = folder.file("recovery.arris");
  const std::string key(16, 'k');
  History history;
  ok(history.run({"open", {{"file", scan}}}));
  const double start =
      seconds([&] { history.set_journal(value_of(SessionFile::start(recovery, history))); });
  const double find = seconds([&] {
    ok(history.run({"find_sharp_lines"}));
    ok(history.run({"find_partitions"}));
  });
  // Lines taken away one after the other, partitions locked, the threshold moved now and then.
  double threshold = 0.0;
  const double edit = seconds([&] {
    for (int k = 0; k < edits; ++k) {
      const Document& document = history.current();
      const auto& lines = document.lines.lines;
      const auto& areas = document.partitions.partitions;
      if (k % 30 == 29)
        threshold += seconds([&] {
          ok(history.run({"find_sharp_lines", {{"angle", 22.0 + k % 7}}}));
          ok(history.run({"find_partitions"}));
        });
      else if (k % 2 == 0 && !lines.empty())
        ok(history.run({"delete_lines", {{"lines", {lines[k % lines.size()]->id}}}}));
      else if (!areas.empty())
        ok(history.run({"lock",
                        {{"partitions", {areas[k % areas.size()]->id}},
                         {"locked", !areas[k % areas.size()]->locked}}}));
    }
  });
  history.set_journal(nullptr);
  SessionExtras extras;
  extras.key = key;
  const double save = seconds([&] { ok(save_session(path, history, extras)); });
  const std::string last = hash_of(history.current());
  const auto open = [&](const std::string& with) {
    return seconds([&] {
      const Replay again = value_of(replay(path, {.key = with}));
      if (hash_of(again.history.current()) != last || !again.warnings.empty())
        throw std::logic_error("not the same");
    });
  };
  const double rows = open(""), snapshot = open(key);
  std::printf(
      "%s: %zu faces, %zu operations; scan %.1f MB, session %.1f MB\n"
      "  finding %.2f s, edits %.2f s (of which moves of the threshold %.2f s)\n"
      "  recovery begun %.2f s, saved %.2f s; opened by running the rows %.2f s, from the snapshot "
      "%.2f s\n",
      std::filesystem::path(scan).filename().c_str(), history.current().mesh->face_count(),
      history.entries().size(), static_cast<double>(std::filesystem::file_size(scan)) / 1e6,
      static_cast<double>(std::filesystem::file_size(path)) / 1e6, find, edit, threshold, start,
      save, rows, snapshot);
  return 0;
}

}  // namespace
}  // namespace arris

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  return arris::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 300);
}
