// Sessions on a disk that fails them: the power goes, it is full, it may not be written to.

#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/write_file.h"
#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/support/documents.h"
#include "tests/support/fake_disk.h"
#include "tests/support/older_session.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;

class Disk : public ::testing::Test {
 protected:
  TempFolder folder, elsewhere;
  std::string part = write_mesh(elsewhere, "cube.ply", divided_cube(10.0, 2));
  std::string path = folder.file("session.arris");

  static void ok(const Result<void>& done) { ASSERT_TRUE(done) << done.error().message; }
  static void run_ok(History& history, const Operation& operation) { ok(history.run(operation)); }
  static Operation flip() { return {"flip_orientation", json::object()}; }
  History opened() const {
    History history;
    run_ok(history, {"open", {{"file", part}}});
    return history;
  }
  static int tries() {
    const char* wanted = std::getenv("ARRIS_POWER_CUTS");  // more of them, by hand
    return wanted ? std::atoi(wanted) : 2;
  }
  /// What a row or move counts as, so that one number says how far the work was.
  static std::uint32_t extent_of(const std::vector<JournalRecord>& records) {
    return static_cast<std::uint32_t>(records.size());
  }
  std::string file_left(const std::filesystem::path& there) const {
    return (there / "session.arris").string();
  }
  std::size_t parts_in(const std::filesystem::path& there) const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(there))
      count += entry.path().extension() == ".part";
    return count;
  }
};

// Rows, moves and names are on the disk when the call returns, whatever it had not written yet of
// what comes after.
TEST_F(Disk, APowerCutLosesNothingThatWasAcknowledged) {
  FakeDisk disk(folder.path());
  History history = opened();
  const auto session = value_of(SessionFile::start(path, history));
  const auto extent = [&] { return extent_of(value_of(session->records())); };
  disk.acknowledge(extent());
  history.set_journal(session);
  for (int k = 0; k < 14; ++k) {
    if (k % 5 == 3)
      ok(history.travel(history.head() - 1));
    else if (k % 7 == 5)
      ok(history.set_name(history.head(), "version " + std::to_string(k)));
    else if (k % 6 == 4)
      ok(session->set_view(std::string(3000, 'v')));
    else
      run_ok(history, flip());
    disk.acknowledge(extent());
  }
  history.set_journal(nullptr);
  ASSERT_GT(disk.syncs(), 30u) << "nothing was noted";
  ASSERT_GT(disk.writes(), 100u);
  Random random(77);
  std::size_t cuts = 0;
  const std::filesystem::path left = elsewhere.path() / "left";
  for (int round = 0; round < tries(); ++round)
    for (std::size_t events = 0; events <= disk.events(); ++events) {
      const std::uint32_t acknowledged = disk.after_power_cut(events, random, left);
      ++cuts;
      const bool is_there = std::filesystem::exists(file_left(left));
      ASSERT_TRUE(is_there || acknowledged == 0) << events;
      if (!is_there) continue;
      const auto again = SessionFile::go_on(file_left(left));
      ASSERT_TRUE(again) << events << ": " << again.error().message;
      const std::uint32_t kept = extent_of(value_of((*again)->records()));
      ASSERT_GE(kept, acknowledged) << events;
      ASSERT_LE(kept, acknowledged + 1) << "one more may be there that was not told yet";
    }
  RecordProperty("cuts", static_cast<int>(cuts));
  std::printf("%zu power cuts, %zu writes, %zu syncs\n", cuts, disk.writes(), disk.syncs());
}

TEST_F(Disk, APowerCutWhileSavingLeavesTheOldFileOrTheNew) {
  FakeDisk disk(folder.path());
  History history = opened();
  SessionExtras extras;
  extras.key = std::string(16, 'k');
  for (int k = 0; k < 4; ++k) {
    run_ok(history, flip());
    ok(save_session(path, history, extras));
    disk.acknowledge(static_cast<std::uint32_t>(history.entries().size()));
  }
  Random random(78);
  std::size_t cuts = 0;
  const std::filesystem::path left = elsewhere.path() / "left";
  for (int round = 0; round < 3 * tries(); ++round)
    for (std::size_t events = 0; events <= disk.events(); ++events) {
      const std::uint32_t acknowledged = disk.after_power_cut(events, random, left);
      ++cuts;
      if (!std::filesystem::exists(file_left(left))) {
        ASSERT_EQ(acknowledged, 0u) << events;
        continue;
      }
      const auto again = SessionFile::read(file_left(left));
      ASSERT_TRUE(again) << events << ": " << again.error().message;
      const std::uint32_t kept = extent_of(value_of((*again)->records()));
      ASSERT_GE(kept, acknowledged) << events;
      ASSERT_LE(kept, acknowledged + 1 + (acknowledged == 0)) << events;
    }
  std::printf("%zu power cuts\n", cuts);
}

// An older format is brought up to date in one step.
TEST_F(Disk, APowerCutInTheMiddleOfAMigrationLosesNothing) {
  History history = opened();
  for (int k = 0; k < 3; ++k) run_ok(history, flip());
  ok(save_session(elsewhere.file("old.arris"), history, {}));
  make_older(elsewhere.file("old.arris"));
  const std::string old = elsewhere.read("old.arris");
  FakeDisk disk(folder.path());
  ok(write_file_whole(path, old));
  const std::size_t begun = disk.events();
  ASSERT_TRUE(SessionFile::go_on(path));
  ASSERT_GT(disk.events(), begun) << "it was brought up to date";
  Random random(79);
  const std::filesystem::path left = elsewhere.path() / "left";
  for (int round = 0; round < 10 * tries(); ++round)
    for (std::size_t events = begun; events <= disk.events(); ++events) {
      disk.after_power_cut(events, random, left);
      const auto again = SessionFile::go_on(file_left(left));
      ASSERT_TRUE(again) << events << ": " << again.error().message;
      ASSERT_EQ(extent_of(value_of((*again)->records())), 4u);
    }
}

// Whatever room is left when it runs out: one sentence, nothing is lost, and it goes on with room.
TEST_F(Disk, WhereItIsFullNothingIsLostAndThereIsAWayOn) {
  FakeDisk disk(folder.path());
  History history = opened();
  const auto session = value_of(SessionFile::start(path, history));
  history.set_journal(session);
  std::size_t refused = 0;
  for (std::uint64_t room = 0; room < 40000; room += 500) {
    const std::string before = hash_of(history.current());
    const std::size_t rows = history.entries().size();
    disk.set_room(room);
    const Result<void> done = history.run(flip());
    disk.set_room(FakeDisk::endless);
    if (!done) {
      ++refused;
      EXPECT_NE(done.error().message.find(path + " cannot be written: the disk is full."),
                std::string::npos)
          << done.error().message;
      EXPECT_NE(done.error().message.find("The edit was not made."), std::string::npos);
      EXPECT_EQ(hash_of(history.current()), before);
      EXPECT_EQ(history.entries().size(), rows);
      run_ok(history, flip());
    }
    EXPECT_EQ(value_of(session->records()).size(), history.entries().size());
  }
  EXPECT_GT(refused, 5u);
  history.set_journal(nullptr);

  // Saving: the old file stays as it was, nothing is left beside it, another place will do.
  const std::string saved = folder.file("saved.arris");
  ok(save_session(saved, history, {}));
  const std::string before = folder.read("saved.arris");
  run_ok(history, flip());
  for (std::uint64_t room = 0; room < before.size(); room += 1 + before.size() / 25) {
    disk.set_room(room);
    const Result<void> done = save_session(saved, history, {});
    ASSERT_FALSE(done) << room;
    EXPECT_NE(done.error().message.find(saved + " cannot be written: the disk is full."),
              std::string::npos)
        << done.error().message;
    EXPECT_TRUE(folder.read("saved.arris") == before);
    EXPECT_EQ(parts_in(folder.path()), 0u);
  }
  ok(save_session(elsewhere.file("saved.arris"), history, {}));
  disk.set_room(FakeDisk::endless);
  ok(save_session(saved, history, {}));
  EXPECT_EQ(hash_of(value_of(replay(saved)).history.current()), hash_of(history.current()));
}

TEST_F(Disk, WhereNothingMayBeWrittenNothingIsLostAndAnotherPlaceWillDo) {
  FakeDisk disk(folder.path());
  History history = opened();
  const auto session = value_of(SessionFile::start(path, history));
  history.set_journal(session);
  run_ok(history, flip());
  const std::string saved = folder.file("saved.arris");
  ok(save_session(saved, history, {}));
  const std::string before = folder.read("saved.arris");
  disk.set_read_only(true);
  const Result<void> edit = history.run(flip());
  ASSERT_FALSE(edit);
  EXPECT_TRUE(edit.error().message.starts_with(path)) << edit.error().message;
  EXPECT_TRUE(edit.error().message.ends_with(". The edit was not made.")) << edit.error().message;
  EXPECT_EQ(history.entries().size(), 2u);
  const Result<void> done = save_session(saved, history, {});
  ASSERT_FALSE(done);
  EXPECT_TRUE(done.error().message.starts_with(saved)) << done.error().message;
  EXPECT_NE(done.error().message.find("Read-only file system"), std::string::npos)
      << done.error().message;
  EXPECT_TRUE(folder.read("saved.arris") == before);
  // What is there can be looked at, and the work goes on elsewhere.
  EXPECT_EQ(value_of(replay(saved)).history.entries().size(), 2u);
  const auto other = value_of(SessionFile::start(elsewhere.file("other.arris"), history));
  history.set_journal(other);
  run_ok(history, flip());
  EXPECT_EQ(value_of(other->records()).size(), 3u);
}

}  // namespace
}  // namespace arris
