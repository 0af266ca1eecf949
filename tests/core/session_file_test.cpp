// Sessions in one file: whole or not at all, and nothing of them lost.

#include "core/document/session_file.h"

#include <gtest/gtest.h>

#include <spawn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/base/file_lock.h"
#include "core/base/keyed_hash.h"
#include "core/base/random.h"
#include "core/document/document_bytes.h"
#include "core/document/journal.h"
#include "core/document/scan_places.h"
#include "tests/core/crash_worker.h"
#include "tests/support/documents.h"
#include "tests/support/older_session.h"
#include "tests/support/packing.h"

extern char** environ;

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;

class SessionFileTest : public ::testing::Test {
 protected:
  TempFolder folder;
  std::string part = write_mesh(folder, "part.ply", random_terrain(24, 3));
  std::string path = folder.file("session.arris");

  static void ok(const Result<void>& done) { ASSERT_TRUE(done) << done.error().message; }
  static void run_ok(History& history, const Operation& operation) { ok(history.run(operation)); }
  static Operation lines(double angle) { return {"find_sharp_lines", {{"angle", angle}}}; }

  /// Opens the part, with lines at two thresholds on two branches, the first of which has a name.
  History two_branches() const {
    History history;
    run_ok(history, {"open", {{"file", part}}});
    run_ok(history, lines(30.0));
    run_ok(history, {"find_partitions", json::object()});
    ok(history.set_name(3, "größer"));
    ok(history.travel(1));
    run_ok(history, lines(50.0));
    run_ok(history, {"smooth_curvature", {{"passes", 1}}});
    ok(history.travel(2));
    return history;
  }
  static void expect_same(const History& a, const History& b) {
    EXPECT_EQ(journal_text(a), journal_text(b));
    EXPECT_EQ(a.head(), b.head());
    EXPECT_EQ(a.names(), b.names());
    EXPECT_EQ(a.line_of_travel(), b.line_of_travel());
    EXPECT_EQ(hash_of(a.current()), hash_of(b.current()));
  }
  /// Changes a session behind its back.
  void change(const std::string& sql) const { change_session(path, sql); }
  /// It does not open, and one sentence says why.
  void expect_refused(const std::string& shown) const {
    for (const std::string& message :
         {message_of(replay(path)), message_of(SessionFile::go_on(path))}) {
      EXPECT_NE(message.find(shown), std::string::npos) << message;
      EXPECT_NE(message.find(path), std::string::npos) << message;
      EXPECT_TRUE(message.ends_with(".")) << message;
    }
  }
  template <class T>
  static std::string message_of(const Result<T>& result) {
    return result ? "it opens" : result.error().message;
  }
};

TEST_F(SessionFileTest, HoldsAllThatAHistoryHasAndNeedsNothingBesideIt) {
  const History history = two_branches();
  SessionExtras extras;
  extras.part = "Gehäuse.ply";
  extras.view = R"({"field": "Kabs"})";
  extras.picture = std::string("\x89PNG\0\xff", 6);
  ok(save_session(path, history, extras));
  std::filesystem::remove(part);

  const Replay again = value_of(replay(path));
  EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
  expect_same(again.history, history);
  const SessionExtras found = value_of(value_of(SessionFile::read(path))->extras());
  EXPECT_EQ(found.part, extras.part);
  EXPECT_EQ(found.view, extras.view);
  EXPECT_EQ(found.picture, extras.picture);
  EXPECT_EQ(found.saved_as, "");

  // Nor does what was opened from it: it is saved again under another name.
  std::filesystem::rename(path, folder.file("moved.arris"));
  ok(save_session(path, again.history, extras));
  std::filesystem::remove(folder.file("moved.arris"));
  expect_same(value_of(replay(path)).history, history);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 1u) << "no journal, no log, nothing half written is left beside it";
}

TEST_F(SessionFileTest, ASnapshotThatWasDroppedComesBackFromTheScanInside) {
  ok(save_session(path, two_branches(), {}));
  std::filesystem::remove(part);
  Replay again = value_of(replay(path));
  History frugal(0);
  frugal.set_files(again.history.files());
  for (const HistoryEntry& entry : again.history.entries()) {
    ok(frugal.travel(entry.parent));
    run_ok(frugal, entry.operation);
  }
  ok(frugal.travel(3));
  EXPECT_EQ(hash_of(frugal.current()), again.history.entries()[2].hash);
}

TEST_F(SessionFileTest, TheScanIsThereToTheByteAndPackedWhereThatPays) {
  // Of several blocks: as text, and as what packs no further.
  Random random(3);
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#";
  for (int k = 0; k < 5 << 20; ++k) text += static_cast<char>('0' + random.bits() % 64);
  for (const bool is_packed : {false, true}) {
    const std::string content = is_packed ? gzipped(text) : text;
    History history;
    run_ok(history, {"open", {{"file", folder.write("scan.obj", content)}}});
    ASSERT_EQ(history.entries().size(), 1u);
    ok(save_session(path, history, {}));
    const std::string hash = history.entries()[0].operation.parameters["hash"];
    const auto found = value_of(value_of(SessionFile::read(path))->scan(hash, {}));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->view() == content);
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    const double share = size / static_cast<double>(content.size());
    EXPECT_TRUE(is_packed ? share < 1.05 : share < 0.85) << share;
  }
}

TEST_F(SessionFileTest, OpeningASessionChangesNothingOnDisk) {
  ok(save_session(path, two_branches(), {}));
  const std::string before = folder.read("session.arris");
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  ASSERT_TRUE(replay(path));
  EXPECT_TRUE(folder.read("session.arris") == before);
}

TEST_F(SessionFileTest, SavingReplacesOnlyByAWholeFile) {
  const History history = two_branches();
  ok(save_session(path, history, {}));
  const std::string before = folder.read("session.arris");
  History later = two_branches();
  run_ok(later, lines(40.0));
  // A full disk in the middle of it.
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  rlimit small = limit;
  small.rlim_cur = before.size() / 2;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Result<void> saved = save_session(path, later, {});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(saved);
  EXPECT_TRUE(saved.error().message.starts_with(path + " cannot be written"))
      << saved.error().message;
  EXPECT_TRUE(folder.read("session.arris") == before);
  for (const std::string& wrong :
       {folder.file("no/folder.arris"), folder.path().string(), std::string("/dev/null")}) {
    const std::string message = message_of(save_session(wrong, later, {}));
    EXPECT_NE(message.find(wrong), std::string::npos) << message;
  }
  ok(save_session(path, later, {}));
  expect_same(value_of(replay(path)).history, later);
}

TEST_F(SessionFileTest, ASessionCutShortAnywhereIsRefusedInASentence) {
  ok(save_session(path, two_branches(), {}));
  const std::string whole = folder.read("session.arris");
  ASSERT_GT(whole.size(), 8u * 4096u);
  for (std::size_t keep = 0; keep < whole.size(); keep += keep < 4096 ? 61 : 509) {
    folder.write("session.arris", whole.substr(0, keep));
    const Result<Replay> result = replay(path);
    ASSERT_FALSE(result) << keep;
    EXPECT_NE(result.error().message.find(path), std::string::npos) << result.error().message;
  }
  for (std::size_t pages = 1; pages < whole.size() / 4096; ++pages) {
    folder.write("session.arris", whole.substr(0, pages * 4096));
    EXPECT_FALSE(replay(path)) << pages;
  }
}

TEST_F(SessionFileTest, ADamagedSessionIsRefusedOrGivesTheSameOrSaysSo) {
  History history;
  for (const Operation& operation :
       {Operation{"open", {{"file", part}}}, lines(30.0), {"find_partitions", json::object()}})
    run_ok(history, operation);
  ok(save_session(path, history, {}));
  const std::string whole = folder.read("session.arris");
  Random random(17);
  std::size_t refused = 0;
  for (int k = 0; k < 300; ++k) {
    std::string text = whole;
    // The pages of tables and rows as often as those of the scan.
    const std::size_t most = k % 2 == 0 ? whole.size() : std::min<std::size_t>(whole.size(), 65536);
    for (int changes = 0; changes < 1 + k % 3; ++changes)
      text[random.bits() % most] = static_cast<char>(random.bits());
    if (text == whole) continue;
    folder.write("session.arris", text);
    const Result<Replay> result = replay(path);
    if (!result) {
      ++refused;
      EXPECT_NE(result.error().message.find(path), std::string::npos) << result.error().message;
    } else if (result->warnings.empty()) {
      EXPECT_EQ(hash_of(result->history.current()), hash_of(history.current())) << k;
    }
  }
  EXPECT_GT(refused, 100u);
}

TEST_F(SessionFileTest, DatabasesOfOthersAreToldFromSessions) {
  change("CREATE TABLE rows (x); INSERT INTO rows VALUES (1);");
  expect_refused("another program");
  std::filesystem::remove(path);
  ok(save_session(path, two_branches(), {}));
  change("PRAGMA journal_mode = WAL;");  // reading it would write beside it
  expect_refused("another program");
  folder.write("session.arris", "solid cube\nendsolid cube\n");
  EXPECT_FALSE(SessionFile::is_session(path));
}

TEST_F(SessionFileTest, OneOfANewerFormatIsRefusedInASentence) {
  ok(save_session(path, two_branches(), {}));
  change("PRAGMA user_version = 99;");
  expect_refused("newer Arris");
}

TEST_F(SessionFileTest, OneOfAnOlderFormatIsBroughtUpToDateWhereItIsWrittenTo) {
  const History history = two_branches();
  ok(save_session(path, history, {}));
  make_older(path);
  const std::string before = folder.read("session.arris");
  expect_same(value_of(replay(path)).history, history);
  EXPECT_EQ(value_of(value_of(SessionFile::read(path))->extras()).picture, "");
  EXPECT_TRUE(folder.read("session.arris") == before) << "reading writes nothing";

  Replay again = value_of(replay(path));
  again.history.set_journal(value_of(SessionFile::go_on(path)));
  run_ok(again.history, lines(33.0));
  again.history.set_journal(nullptr);
  expect_same(value_of(replay(path)).history, again.history);
}

TEST_F(SessionFileTest, TablesThatAreNotThoseOfASessionAreRefused) {
  for (const char* sql : {"CREATE TABLE more (x)", "CREATE VIEW more AS SELECT * FROM rows",
                          "CREATE TRIGGER more AFTER INSERT ON rows BEGIN DELETE FROM rows; END",
                          "ALTER TABLE names ADD COLUMN more DEFAULT 1", "DROP TABLE views",
                          "CREATE INDEX more ON rows (hash)", "PRAGMA user_version = 1"}) {
    ok(save_session(path, two_branches(), {}));
    change(sql);
    expect_refused("is damaged: its tables");
  }
}

// What a stranger's session could try: each is refused, in a sentence, before harm is done.
TEST_F(SessionFileTest, AStrangersSessionReadsNoOtherFileAndTakesNoMemory) {
  const std::string secret = write_mesh(folder, "secret.ply", random_terrain(8, 9));
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  const std::vector<std::pair<std::string, std::string>> tries{
      // A file of any content.
      {"UPDATE rows SET operation = json_remove(operation, '$.hash') WHERE sequence = 1",
       "unknown content"},
      {"UPDATE rows SET operation = '{\"operation\": \"open\", \"file\": \"" + secret +
           "\"}' WHERE sequence = 2",
       "unknown content"},
      // A file whose content is not what was opened.
      {"DELETE FROM scan_blocks; DELETE FROM scans; UPDATE rows SET operation = "
       "json_set(operation, '$.file', '" +
           secret + "') WHERE sequence = 1",
       "its content has changed"},
      {"UPDATE scans SET bytes = 1000000000000000", "cannot be"},
      {"UPDATE scans SET bytes = -5", "cannot be"},
      {"UPDATE scans SET bytes = bytes + 1", "scan"},
      {"UPDATE scan_blocks SET packed = zeroblob(100)", "its scan"},
      {"UPDATE rows SET operation = '{\"operation\": " + deep + "}' WHERE sequence = 2", "row 2"},
      {"UPDATE rows SET parent = 77 WHERE sequence = 2", "row"},
      {"UPDATE rows SET parent = -1 WHERE sequence = 2", "row"},
      {"UPDATE rows SET operation = 'rm -rf' WHERE sequence = 2", "row 2"},
      {"UPDATE rows SET operation = 7.5 WHERE sequence = 2", "row 2"},
      {"UPDATE rows SET sequence = 90 WHERE sequence = 2", "row 2"},
      {"UPDATE rows SET hash = x'ff00ff' WHERE sequence = 2", "row 2"},
      {"INSERT INTO moves VALUES (99, 1, 4000000000)", "move"},
      {"INSERT INTO moves VALUES (99, 1, -1)", "move"},
      {"INSERT INTO names VALUES (900, 'x')", "row 900"},
      {"INSERT INTO names VALUES (1, x'ff')", "row 1"},
      {"DELETE FROM rows; DELETE FROM moves; DELETE FROM names", "no operation"},
  };
  for (const auto& [sql, shown] : tries) {
    ok(save_session(path, two_branches(), {}));
    change(sql);
    const std::string message = message_of(replay(path));
    EXPECT_NE(message.find(path), std::string::npos) << sql << "\n" << message;
    EXPECT_NE(message.find(shown), std::string::npos) << sql << "\n" << message;
  }
}

// ---- scans outside ----

TEST_F(SessionFileTest, AScanOutsideIsLookedForBesideThenWhereItWasThenWhereOneIsPointedAt) {
  std::filesystem::create_directory(folder.file("old"));
  std::filesystem::create_directory(folder.file("new"));
  const std::string old = folder.file("old/part.ply"), other = folder.file("old/other.ply");
  std::filesystem::rename(part, old);
  History history;
  run_ok(history, {"open", {{"file", old}}});
  const std::string text = journal_text(history), hash = hash_of(history.current());
  const std::string session = folder.write("new/session.jsonl", text);
  EXPECT_EQ(hash_of(value_of(replay(session)).history.current()), hash) << "where it was";
  EXPECT_FALSE(lost_scan(session));

  const std::string beside = folder.file("new/part.ply");
  std::filesystem::rename(old, beside);
  EXPECT_EQ(hash_of(value_of(replay(session)).history.current()), hash) << "beside";

  // Another part of that name is not taken; the right one is, wherever it is.
  std::filesystem::rename(beside, other);
  write_mesh(folder, "new/part.ply", random_terrain(24, 8));
  EXPECT_NE(message_of(replay(session)).find("its content has changed"), std::string::npos);
  EXPECT_EQ(lost_scan(session), old);
  EXPECT_EQ(lost_scan(session, {.located = {beside}}), old);
  EXPECT_FALSE(replay(session, {.located = {beside}}));
  EXPECT_FALSE(lost_scan(session, {.located = {other}}));
  EXPECT_EQ(hash_of(value_of(replay(session, {.located = {other}})).history.current()), hash);

  std::filesystem::remove(beside);
  const std::string message = message_of(replay(session));
  EXPECT_NE(message.find(old), std::string::npos) << message;
  EXPECT_NE(message.find("beside"), std::string::npos) << message;
}

TEST_F(SessionFileTest, TheContentDecidesWhatAFileIs) {
  const History history = two_branches();
  const std::string named = folder.file("session.stl");
  ok(save_session(named, history, {}));
  EXPECT_TRUE(holds_operations(named));
  expect_same(value_of(replay(named)).history, history);
  const std::string text = folder.write("text.arris", "\n " + journal_text(history));
  EXPECT_TRUE(holds_operations(text));
  expect_same(value_of(replay(text)).history, history);
  EXPECT_FALSE(holds_operations(part));
  EXPECT_FALSE(holds_operations(folder.file("none.stl")));
  EXPECT_TRUE(holds_operations(folder.file("none.arris")));
  EXPECT_FALSE(holds_operations(folder.path().string()));
}

TEST_F(SessionFileTest, ALockIsHeldByOneAndGoesWithIt) {
  auto first = FileLock::take(part);
  ASSERT_TRUE(first);
  EXPECT_FALSE(FileLock::take(part));
  EXPECT_TRUE(FileLock::is_taken(part));
  first.reset();
  EXPECT_FALSE(FileLock::is_taken(part));
  EXPECT_TRUE(FileLock::take(part));
  EXPECT_FALSE(FileLock::take(folder.file("none")));
  EXPECT_FALSE(FileLock::is_taken(folder.file("none")));
}

// ---- snapshots ----

std::string bytes_from(std::string_view hexadecimal) {
  std::string bytes;
  for (std::size_t k = 0; k < hexadecimal.size(); k += 2)
    bytes += static_cast<char>(std::stoi(std::string(hexadecimal.substr(k, 2)), nullptr, 16));
  return bytes;
}

TEST(KeyedHash, IsSipHashOfItsAuthors) {
  // vectors_sip128 of their reference implementation.
  const std::string key = bytes_from("000102030405060708090a0b0c0d0e0f");
  EXPECT_EQ(keyed_hash(key, ""), bytes_from("a3817f04ba25a8e66df67214c7550293"));
  EXPECT_EQ(keyed_hash(key, std::string(1, '\0')), bytes_from("da87c1d86b99af44347659119b22fc45"));
  EXPECT_NE(
      keyed_hash(key, "a longer text than one word"),
      keyed_hash(bytes_from("100102030405060708090a0b0c0d0e0f"), "a longer text than one word"));
}

class SessionSnapshots : public SessionFileTest {
 protected:
  SessionExtras signed_by_us() const {
    SessionExtras extras;
    extras.key = key;
    return extras;
  }
  static void expect_same_document(const Document& a, const Document& b) {
    EXPECT_EQ(a.mesh->hash(), b.mesh->hash());
    ASSERT_EQ(a.zones != nullptr, b.zones != nullptr);
    if (a.zones) {
      EXPECT_EQ(a.zones->hash(), b.zones->hash());
    }
    EXPECT_TRUE(a.lines.edges == b.lines.edges);
    EXPECT_EQ(a.lines.cuts, b.lines.cuts);
    EXPECT_TRUE(a.partitions.labels == b.partitions.labels);
    ASSERT_EQ(a.corrections.size(), b.corrections.size());
    for (std::size_t k = 0; k < a.corrections.size(); ++k)
      EXPECT_EQ(a.corrections[k]->hash, b.corrections[k]->hash);
    const auto same_mesh = [](const MeshPtr& own, const MeshPtr& other) {
      return own && other ? own->hash() == other->hash() : own == other;
    };
    EXPECT_TRUE(same_mesh(a.opened.mesh, b.opened.mesh));
    for (std::size_t k = 0; k < chain_steps.size(); ++k) {
      EXPECT_EQ(a.steps[k], b.steps[k]) << chain_steps[k].name;
      EXPECT_TRUE(same_mesh(a.outputs[k].mesh, b.outputs[k].mesh)) << chain_steps[k].name;
    }
    EXPECT_EQ(a.next_id, b.next_id);
    ASSERT_EQ(a.lines.lines.size(), b.lines.lines.size());
    for (std::size_t k = 0; k < a.lines.lines.size(); ++k)
      EXPECT_EQ(*a.lines.lines[k], *b.lines.lines[k]);
    ASSERT_EQ(a.partitions.partitions.size(), b.partitions.partitions.size());
    for (std::size_t k = 0; k < a.partitions.partitions.size(); ++k)
      EXPECT_EQ(*a.partitions.partitions[k], *b.partitions.partitions[k]);
    ASSERT_EQ(a.boundaries->size(), b.boundaries->size());
    for (std::size_t k = 0; k < a.boundaries->size(); ++k)
      EXPECT_EQ(*(*a.boundaries)[k], *(*b.boundaries)[k]);
    EXPECT_EQ(a.mesh == a.opened.mesh, b.mesh == b.opened.mesh);
    const auto &h = a.curvatures->h, &same = b.curvatures->h;
    ASSERT_EQ(h.size(), same.size());
    EXPECT_EQ(std::memcmp(h.data(), same.data(), h.size() * sizeof h[0]), 0) << "NaN included";
    EXPECT_EQ(a.scan_path, b.scan_path);
  }
  /// A session with all that a document can have but smoothed curvatures.
  History of_everything() const {
    History history;
    const std::string mould = write_mesh(folder, "mould.ply", sample_mould(2.5));
    for (const Operation& operation : {Operation{"open", {{"file", mould}}},
                                       {"flip_orientation", json::object()},
                                       {"delete_faces", {{"faces", {{}}}}},
                                       {"simplify", json::object()},
                                       {"find_sharp_lines", json::object()},
                                       {"equilateralize", json::object()},
                                       {"find_partitions", json::object()}}) {
      Operation wanted = operation;
      if (wanted.name == "delete_faces")
        wanted.parameters["faces"] = {history.current().mesh->triangle(7)};
      run_ok(history, wanted);
    }
    run_ok(history, {"delete_lines", {{"lines", {history.current().lines.lines[1]->id}}}});
    run_ok(history, {"lock", {{"lines", {history.current().lines.lines[0]->id}}}});
    return history;
  }
  const std::string key = std::string(16, 'k');
};

TEST_F(SessionSnapshots, ASignedSnapshotTakesThePlaceOfTheRowsBeforeIt) {
  const History made = of_everything();
  ASSERT_TRUE(bytes_of(made.current()));
  // As another build would have made row 5: its result cannot be had again.
  std::vector<HistoryEntry> entries = made.entries();
  entries[4].hash = std::string(32, '0');
  const auto last = static_cast<std::uint32_t>(entries.size());
  const History history = value_of(History::restored(entries, {}, last, made.current()));
  ok(save_session(path, history, signed_by_us()));

  ASSERT_EQ(value_of(replay(path)).warnings.size(), 1u) << "run without the key";
  Replay again = value_of(replay(path, {.key = key}));
  EXPECT_TRUE(again.warnings.empty()) << "not run";
  expect_same(again.history, history);
  expect_same_document(again.history.current(), made.current());
  // All of it can be worked with: a correction, other thresholds, and any row is there.
  History other = of_everything();
  for (const Operation& operation :
       {Operation{"lock", {{"lines", {made.current().lines.lines[0]->id}}, {"locked", false}}},
        {"find_sharp_lines", {{"angle", 40.0}}},
        {"find_partitions", json::object()}}) {
    run_ok(again.history, operation);
    run_ok(other, operation);
    expect_same_document(again.history.current(), other.current());
  }
  ok(again.history.travel(3));
  EXPECT_EQ(hash_of(again.history.current()), made.entries()[2].hash);

  // With another key, or with anything changed, the rows are run.
  EXPECT_EQ(value_of(replay(path, {.key = std::string(16, 'x')})).warnings.size(), 1u);
  EXPECT_EQ(value_of(replay(path, {.key = "short"})).warnings.size(), 1u);
  for (const char* sql :
       {"UPDATE snapshots SET document = document || x'00'",
        "UPDATE snapshots SET mark = zeroblob(16)", "UPDATE rows SET hash = 'x' WHERE sequence = 5",
        "UPDATE snapshots SET row = row - 1", "DELETE FROM snapshots"}) {
    ok(save_session(path, history, signed_by_us()));
    change(sql);
    EXPECT_EQ(value_of(replay(path, {.key = key})).warnings.size(), 1u) << sql;
  }
}

// Running the rows gives what was saved, to the byte.
TEST_F(SessionSnapshots, ReplayGivesTheSnapshotByteForByte) {
  for (const std::uint32_t head : {9u, 8u, 7u, 5u, 4u, 2u}) {
    History history = of_everything();
    ok(history.travel(head));
    ok(save_session(path, history, signed_by_us()));
    const auto saved = value_of(value_of(SessionFile::read(path))->snapshot(key));
    ASSERT_TRUE(saved);
    EXPECT_EQ(saved->row, head);
    const Replay run = value_of(replay(path));
    EXPECT_EQ(run.history.head(), head);
    EXPECT_TRUE(bytes_of(run.history.current()) == saved->bytes) << head;
  }
}

TEST_F(SessionSnapshots, WhatWasDoneAfterTheSnapshotIsRun) {
  for (const std::uint32_t head : {9u, 6u, 1u}) {  // where the snapshot is
    History history = of_everything();
    ok(history.travel(head));
    history.set_journal(value_of(SessionFile::start(path, history, signed_by_us())));
    run_ok(history, {"flip_orientation", json::object()});
    run_ok(history, {"find_sharp_lines", {{"angle", 35.0}}});
    ok(history.set_name(10, "flipped"));
    ok(history.undo());
    ok(history.travel(4));
    run_ok(history, {"flip_orientation", json::object()});
    ok(history.travel(10));
    history.set_journal(nullptr);
    const Replay again = value_of(replay(path, {.key = key}));
    EXPECT_TRUE(again.warnings.empty());
    expect_same(again.history, history);
    expect_same_document(again.history.current(), history.current());
  }
}

TEST_F(SessionSnapshots, HoldEveryDocumentButThoseWithSmoothedCurvatures) {
  Random random(11);
  History history;
  run_ok(history, {"open", {{"file", part}}});
  const Document opened = history.current();
  std::size_t held = 0;
  for (int k = 0; k < 80; ++k) {
    const Mesh& mesh = *history.current().mesh;
    const std::vector<Operation> choices{
        {"flip_orientation", json::object()},
        {"delete_faces",
         {{"faces", {mesh.triangle(static_cast<FaceId>(random.bits() % mesh.face_count()))}}}},
        {"simplify", {{"error_zone", random.uniform(0.0, 0.05)}}},
        {"swap_edges", json::object()},
        {"equilateralize", json::object()},
        {"smooth_curvature", {{"passes", 1}}},
        lines(random.uniform(10.0, 60.0)),
        {"find_partitions", {{"method", k % 2 ? "fronts" : "surfaces"}}},
        {"remove_small_partitions", {{"faces", 5}}},
        {"set_unit", {{"unit", k % 2 ? "mm" : "in"}}}};
    static_cast<void>(history.run(choices[random.bits() % choices.size()]));
    const Document& document = history.current();
    const std::optional<std::string> bytes = bytes_of(document);
    EXPECT_EQ(bytes.has_value(), document.smoothed == nullptr);
    if (!bytes) continue;
    ++held;
    const std::optional<Document> again = document_from(*bytes, opened);
    ASSERT_TRUE(again) << history.entries().back().operation.text();
    expect_same_document(*again, document);
  }
  EXPECT_GT(held, 40u);
}

TEST_F(SessionSnapshots, DamagedBytesAreNoDocument) {
  const History history = of_everything();
  const std::string bytes = value_of([&]() -> Result<std::string> {
    if (auto made = bytes_of(history.current())) return *made;
    return fail("none");
  }());
  const Document opened = value_of(history.document_at(1));
  for (std::size_t keep = 0; keep < bytes.size(); keep += 1 + bytes.size() / 60)
    EXPECT_FALSE(document_from(bytes.substr(0, keep), opened));
  EXPECT_FALSE(document_from(bytes, document_of(cube(1.0)))) << "of another part";
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    std::string damaged = bytes;
    damaged[random.bits() % damaged.size()] = static_cast<char>(random.bits());
    // Packed with a sum of its own: a change is found.
    if (damaged != bytes) {
      EXPECT_FALSE(document_from(damaged, opened)) << k;
    }
  }
}

// ---- crashes ----

class SessionCrash : public SessionFileTest {
 protected:
  int kills() const {
    const char* wanted = std::getenv("ARRIS_KILLS");  // more of them, by hand
    return wanted ? std::atoi(wanted) : 15;
  }
  /// Starts the process of crash_worker.cpp on `what`, kills it some time after its first word, and
  /// gives its last one.
  Acknowledged work_and_kill(std::uint64_t microseconds, const std::string& what) const {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], to_the_parent);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    std::vector<std::string> words{ARRIS_CRASH_WORKER, path, what};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int started =
        ::posix_spawn(&child, ARRIS_CRASH_WORKER, &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (started != 0) throw std::runtime_error("no process");
    std::string heard;
    char buffer[4096];
    const auto listen = [&] {
      const ssize_t count = ::read(ends[0], buffer, sizeof buffer);
      if (count > 0) heard.append(buffer, static_cast<std::size_t>(count));
      return count > 0;
    };
    listen();
    ::usleep(static_cast<useconds_t>(microseconds));
    ::kill(child, SIGKILL);
    while (listen()) {
    }
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << heard;
    Acknowledged last;
    if (heard.size() >= sizeof last)
      std::memcpy(&last, heard.data() + heard.size() - heard.size() % sizeof last - sizeof last,
                  sizeof last);
    return last;
  }
};

TEST_F(SessionCrash, NoAcknowledgedRowIsLostByAKill) {
  History history;
  run_ok(history, {"open", {{"file", write_mesh(folder, "cube.ply", divided_cube(10.0, 2))}}});
  run_ok(history, {"flip_orientation", json::object()});
  ok(save_session(path, history, {}));
  Random random(::getpid());
  std::size_t begun = 2;
  for (int k = 0; k < kills(); ++k) {
    const Acknowledged last = work_and_kill(random.bits() % 60000, "append");
    ASSERT_GT(last.rows, begun) << "it worked before it was killed";
    // The next start takes back what was half written.
    ASSERT_TRUE(SessionFile::go_on(path));
    const Replay again = value_of(replay(path));
    EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
    const auto rows = again.history.entries().size();
    ASSERT_GE(rows, last.rows);
    ASSERT_LE(rows, last.rows + 1) << "one more may be on disk that was not told yet";
    if (rows == last.rows && again.history.head() != last.head) {  // the same of a move
      ASSERT_EQ(again.history.head() + 1, last.head);
    }
    begun = rows;
  }
}

TEST_F(SessionCrash, AKillWhileSavingLeavesTheOldFileOrTheNew) {
  History history;
  run_ok(history, {"open", {{"file", part}}});
  run_ok(history, lines(30.0));
  const std::string hashes[]{history.entries()[0].hash, history.entries()[1].hash};
  ok(save_session(path, history, {}));
  Random random(::getpid());
  for (int k = 0; k < kills(); ++k) {
    const Acknowledged last = work_and_kill(random.bits() % 30000, "save");
    ASSERT_NE(last.head, 0u) << "it saved before it was killed";
    const Replay again = value_of(replay(path));
    EXPECT_TRUE(again.warnings.empty());
    EXPECT_EQ(again.history.entries().size(), 2u);
    EXPECT_EQ(hash_of(again.history.current()), hashes[again.history.head() - 1]);
  }
  // What the killed ones left half written goes with the next saving.
  folder.write(".arris-notes.part", "of somebody else");
  ok(save_session(path, history, {}));
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().extension() == ".part") left.push_back(entry.path().filename().string());
  EXPECT_EQ(left, std::vector<std::string>{".arris-notes.part"});
}

// The first version of the format, brought up to date: in one step, or not at all.
TEST_F(SessionCrash, AKillInTheMiddleOfAMigrationLosesNothing) {
  const History history = two_branches();
  ok(save_session(path, history, {}));
  make_older(path);
  Random random(::getpid());
  std::size_t in_the_middle = 0;
  for (int k = 0; k < kills(); ++k) {
    const Acknowledged last = work_and_kill(random.bits() % 40000, "migrate");
    ASSERT_NE(last.rows, 0u) << "it began before it was killed";
    in_the_middle += last.head == 1;
    const std::string migrated = path + "." + std::to_string(last.rows);
    const auto again = SessionFile::go_on(migrated);
    ASSERT_TRUE(again) << again.error().message;
    expect_same(value_of(replay(migrated)).history, history);
  }
  EXPECT_GT(in_the_middle, 0u);
}

// A journal of version 0.1 becomes a session, whole or not at all, and stays until it has.
TEST_F(SessionCrash, AKillWhileAnOldJournalBecomesASessionLosesNothing) {
  const History history = two_branches();
  const std::string text = journal_text(history);
  folder.write("session.arris", text);  // what is in it decides, not its name
  Random random(::getpid());
  std::size_t in_the_middle = 0;
  for (int k = 0; k < kills(); ++k) {
    const Acknowledged last = work_and_kill(random.bits() % 80000, "import");
    ASSERT_NE(last.rows, 0u) << "it began before it was killed";
    EXPECT_EQ(folder.read("session.arris"), text);
    const std::string made = path + "." + std::to_string(last.rows);
    in_the_middle += last.head == 1;
    ASSERT_TRUE(last.head == 1 || std::filesystem::exists(made));
    if (std::filesystem::exists(made)) expect_same(value_of(replay(made)).history, history);
  }
  EXPECT_GT(in_the_middle, 0u);
}

}  // namespace
}  // namespace arris
