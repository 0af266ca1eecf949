// The bytes as a session: the database as it is, then all that is read of it, then its replay.

#include "core/base/keyed_hash.h"
#include "core/base/thread_limit.h"
#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arris;
  static const ThreadLimit one_thread(1);
  const std::string path = fuzz::file_with("session.arris", fuzz::text_of(data, size));
  static_cast<void>(SessionFile::picture_of(path));
  const Result<std::shared_ptr<SessionFile>> session = SessionFile::read(path);
  if (!session) {
    fuzz::require_sentence(session.error().message);
    return 0;
  }
  if (const auto extras = (*session)->extras(); !extras)
    fuzz::require_sentence(extras.error().message);
  // The key of hash_key_size bytes that the seeds are signed with.
  if (const auto snapshot = (*session)->snapshot(std::string(hash_key_size, 'k')); !snapshot)
    fuzz::require_sentence(snapshot.error().message);
  if (const auto same = hold_the_same(**session, **session); !same)
    fuzz::require_sentence(same.error().message);
  static_cast<void>(lost_scan(path));
  const Result<Replay> again = replay(path);
  if (!again) fuzz::require_sentence(again.error().message);
  return 0;
}
