// The bytes as a journal (*.jsonl) or a plain list of operations, a recipe, run on a part of our
// own; whatever scan the text names, it is that part which is opened.

#include "core/base/thread_limit.h"
#include "core/document/journal.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/part.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arris;
  static const ThreadLimit one_thread(1);
  static const std::string part = fuzz::file_with("part.ply", fuzz::part_bytes());
  const std::string path = fuzz::file_with("journal.jsonl", fuzz::text_of(data, size));
  ReplayOptions options;
  options.scan = part;
  const Result<Replay> run = replay(path, options);
  if (!run) {
    fuzz::require_sentence(run.error().message);
    return 0;
  }
  for (const std::string& warning : run->warnings) fuzz::require_sentence(warning);
  // What was run can be written down and is the same when it is run again.
  const std::string text = journal_text(run->history);
  const Result<Replay> again = replay(fuzz::file_with("again.jsonl", text));
  if (!again) fuzz::require_none("its own journal fails: " + again.error().message);
  if (hash_of(again->history.current()) != hash_of(run->history.current()))
    fuzz::require_none("its own journal gives another document");
  return 0;
}
