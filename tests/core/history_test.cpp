#include "core/document/history.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <csignal>

#include <algorithm>
#include <map>
#include <set>

#include "core/base/random.h"
#include "core/document/journal.h"
#include "core/document/session_file.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;

void run_ok(History& history, const Operation& operation) {
  const Result<void> done = history.run(operation);
  ASSERT_TRUE(done) << operation.text() << ": " << done.error().message;
}

/// From here on the history is on disk, too, as in the window.
void keep_in(History& history, const std::string& path) {
  history.set_journal(value_of(SessionFile::start(path, history)));
}

/// What another reader finds in a session while it is written.
std::vector<json> records_in(const std::string& path) {
  std::vector<json> found;
  for (JournalRecord& record : value_of(value_of(SessionFile::read(path))->records()))
    found.push_back(std::move(record.json));
  return found;
}

void ok(const Result<void>& done) { ASSERT_TRUE(done) << done.error().message; }

/// An operation that any part can take; not all change something, some fail.
Operation random_operation(const Document& document, Random& random, const std::string& path) {
  const auto& mesh = *document.mesh;
  switch (random.bits() % 10) {
    case 0:
      return {"flip_orientation", json::object()};
    case 1:
      return {"delete_faces",
              {{"faces", {mesh.triangle(static_cast<FaceId>(random.bits() % mesh.face_count()))}}}};
    case 2: {
      const Point at = mesh.point(static_cast<VertexId>(random.bits() % mesh.vertex_count()));
      return {"delete_faces", {{"box", {at.x() - 1, at.y() - 1, -9, at.x() + 1, at.y() + 1, 9}}}};
    }
    case 3:
      if (random.bits() % 4 == 0) return {"open", {{"file", path}}};
      return {"delete_faces", {{"components_under", 1 + random.bits() % 20}}};
    case 4:
      return {"smooth_curvature", {{"passes", 1 + random.bits() % 3}}};
    case 5:
      switch (random.bits() % 3) {
        case 0:
          return {"simplify",
                  {{"error_zone", random.uniform(0.0, 0.1)}, {"again", random.bits() % 2 == 0}}};
        case 1:
          return {"swap_edges", json::object()};
        default:
          return {"equilateralize", json::object()};
      }
    case 6:
      return {"find_sharp_lines",
              {{"angle", random.uniform(10.0, 70.0)}, {"parallel_distance", random.bits() % 3}}};
    case 7:
      return {"find_partitions", {{"criterion", "ikabs"}}};
    default: {
      const double cut = random.uniform(0.05, 2.0);
      return {"find_partitions",
              {{"intervals", {{0, cut}, {cut, nullptr}}}, {"min_faces", 1 + random.bits() % 6}}};
    }
  }
}

class Travel : public ::testing::Test {
 protected:
  TempFolder folder;
  std::string path = write_mesh(folder, "part.ply", random_terrain(24, 3));

  Operation open() const { return {"open", {{"file", path}}}; }
  static Operation lines(double angle) { return {"find_sharp_lines", {{"angle", angle}}}; }
  static Operation areas(double cut) {
    return {"find_partitions", {{"intervals", {{0, cut}, {cut, nullptr}}}}};
  }
};

TEST_F(Travel, BeginsWithTheEmptyDocument) {
  History history;
  EXPECT_TRUE(history.current().empty());
  EXPECT_EQ(history.head(), 0u);
  EXPECT_FALSE(history.can_undo());
  EXPECT_FALSE(history.can_redo());
  EXPECT_FALSE(history.undo());
  EXPECT_FALSE(history.redo());
  EXPECT_FALSE(history.travel(1));
  EXPECT_TRUE(history.line_of_travel().empty());
}

TEST_F(Travel, UndoAndRedoGoThereAndBack) {
  History history;
  run_ok(history, open());
  run_ok(history, lines(30.0));
  run_ok(history, areas(0.5));
  const std::vector<HistoryEntry>& rows = history.entries();
  for (int times = 0; times < 3; ++times) {
    for (std::uint32_t s = 3; s-- > 0;) {
      ok(history.undo());
      EXPECT_EQ(history.head(), s);
      EXPECT_EQ(hash_of(history.current()), s == 0 ? hash_of({}) : rows[s - 1].hash);
    }
    EXPECT_FALSE(history.can_undo());
    for (std::uint32_t s = 1; s <= 3; ++s) {
      ok(history.redo());
      EXPECT_EQ(hash_of(history.current()), rows[s - 1].hash);
    }
    EXPECT_FALSE(history.can_redo());
  }
  EXPECT_EQ(rows.size(), 3u) << "undo and redo make no rows";
}

TEST_F(Travel, NewEditAfterUndoBranchesAndNothingIsLost) {
  History history;
  run_ok(history, open());       // 1
  run_ok(history, lines(30.0));  // 2
  run_ok(history, areas(0.5));   // 3
  ok(history.undo());
  ok(history.undo());
  run_ok(history, lines(50.0));  // 4, beside 2
  EXPECT_EQ(history.head(), 4u);
  EXPECT_EQ(history.entries()[3].parent, 1u);
  EXPECT_FALSE(history.can_redo());
  using Rows = std::vector<std::uint32_t>;
  EXPECT_EQ(history.line_of_travel(), (Rows{1, 4}));
  ok(history.undo());
  ok(history.redo());
  EXPECT_EQ(history.head(), 4u) << "redo leads where one last was";
  ok(history.travel(3));
  EXPECT_EQ(hash_of(history.current()), history.entries()[2].hash);
  EXPECT_EQ(history.line_of_travel(), (Rows{1, 2, 3}));
  ok(history.undo());
  ok(history.undo());
  EXPECT_EQ(history.head(), 1u);
  ok(history.redo());
  EXPECT_EQ(history.head(), 2u);
  ok(history.travel(0));
  EXPECT_TRUE(history.current().empty());
}

TEST_F(Travel, FailedOperationChangesNothing) {
  History history;
  run_ok(history, open());
  const std::string hash = hash_of(history.current());
  EXPECT_FALSE(history.run({"find_sharp_lines", {{"angle", -1}}}));
  EXPECT_FALSE(history.run({"delete_faces", {{"faces", {{0, 1, 99999}}}}}));
  EXPECT_EQ(history.entries().size(), 1u);
  EXPECT_EQ(hash_of(history.current()), hash);
}

TEST_F(Travel, IdsComeBackOnlyWithTheirState) {
  // On a new branch the counter goes on from the state edited, not from the abandoned one.
  History history;
  run_ok(history, open());
  run_ok(history, lines(30.0));
  const std::uint32_t first = history.current().next_id;
  ok(history.undo());
  run_ok(history, lines(30.0));
  EXPECT_EQ(history.current().next_id, first);
  EXPECT_EQ(history.entries()[2].hash, history.entries()[1].hash) << "same operations, same hash";
}

TEST_F(Travel, TwoThousandRandomEditsAndASecondDocumentFedTheirJson) {
  Random random(2024);
  History history, second;
  run_ok(history, open());
  run_ok(second, value_of(Operation::parse(history.entries()[0].operation.text())));
  std::vector<std::string> hashes{hash_of({}), hash_of(history.current())};
  std::size_t failed = 0, moves = 0;
  for (int k = 0; k < 2000; ++k) {
    const std::uint64_t choice = random.bits() % 10;
    if (choice < 3) {  // undo, redo, travel
      ++moves;
      if (choice == 0 && history.can_undo()) {
        ok(history.undo());
        ok(second.undo());
      } else if (choice == 1 && history.can_redo()) {
        ok(history.redo());
        ok(second.redo());
      } else if (choice == 2) {
        const auto row = static_cast<std::uint32_t>(random.bits() % hashes.size());
        ok(history.travel(row));
        ok(second.travel(row));
      }
    } else {
      const Operation operation =
          history.current().empty() ? open() : random_operation(history.current(), random, path);
      const Result<void> done = history.run(operation);
      if (!done) {
        ++failed;
        EXPECT_FALSE(done.error().message.empty());
        EXPECT_FALSE(second.run(operation));
      } else {
        run_ok(second, value_of(Operation::parse(history.entries().back().operation.text())));
        hashes.push_back(history.entries().back().hash);
      }
    }
    ASSERT_EQ(history.head(), second.head()) << "after " << k;
    ASSERT_EQ(hash_of(history.current()), hashes[history.head()]) << "after " << k;
    ASSERT_EQ(hash_of(second.current()), hashes[second.head()]) << "after " << k;
    ASSERT_EQ(history.line_of_travel(), second.line_of_travel());
    if (k == 300 || k == 1999) {  // the journal alone gives everything back
      const Replay again = value_of(replay(folder.write("all.jsonl", journal_text(history))));
      EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
      EXPECT_EQ(again.history.head(), history.head());
      EXPECT_EQ(journal_text(again.history), journal_text(history));
      EXPECT_EQ(hash_of(again.history.current()), hash_of(history.current()));
    }
  }
  EXPECT_GT(hashes.size(), 1000u);
  EXPECT_LT(failed, 300u);
  EXPECT_GT(moves, 400u);
}

// ---- memory ----

TEST_F(Travel, SmallBudgetDropsSnapshotsAndUndoIsStillRight) {
  History probe;
  run_ok(probe, open());
  run_ok(probe, {"flip_orientation", json::object()});
  const std::size_t budget = 2 * probe.bytes();
  History history(budget);
  Random random(7);
  run_ok(history, open());
  for (int k = 0; k < 25; ++k) {
    run_ok(history, {"flip_orientation", json::object()});
    EXPECT_LE(history.bytes(), budget);
    run_ok(history, lines(random.uniform(20.0, 60.0)));
    EXPECT_LE(history.bytes(), budget);
  }
  const std::vector<HistoryEntry> rows = history.entries();
  EXPECT_EQ(rows.size(), 51u) << "operations are never dropped";
  while (history.can_undo()) {
    EXPECT_EQ(hash_of(history.current()), rows[history.head() - 1].hash);
    ok(history.undo());
    EXPECT_LE(history.bytes(), budget);
  }
  for (int k = 0; k < 20; ++k) {
    const auto row = static_cast<std::uint32_t>(1 + random.bits() % rows.size());
    ok(history.travel(row));
    EXPECT_EQ(hash_of(history.current()), rows[row - 1].hash);
    EXPECT_LE(history.bytes(), budget);
  }
}

TEST_F(Travel, NoBudgetAtAllStillHoldsTheCurrentDocument) {
  History history(0);
  run_ok(history, open());
  run_ok(history, lines(30.0));
  run_ok(history, areas(0.5));
  EXPECT_EQ(hash_of(history.current()), history.entries()[2].hash);
  ok(history.undo());
  EXPECT_EQ(hash_of(history.current()), history.entries()[1].hash);
  ok(history.travel(0));
  ok(history.travel(3));
  EXPECT_EQ(hash_of(history.current()), history.entries()[2].hash);
}

TEST_F(Travel, DroppedSnapshotOfAScanThatChangedIsAnErrorAndNotAnotherPart) {
  History history(0);
  run_ok(history, open());
  run_ok(history, {"flip_orientation", json::object()});
  run_ok(history, {"flip_orientation", json::object()});
  write_mesh(folder, "part.ply", random_terrain(24, 4));
  const std::string hash = hash_of(history.current());
  const Result<void> done = history.undo();
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("part.ply"), std::string::npos) << done.error().message;
  EXPECT_EQ(history.head(), 3u);
  EXPECT_EQ(hash_of(history.current()), hash);
}

TEST_F(Travel, ThousandFindingsShareMemory) {
  History history;
  run_ok(history, {"open", {{"file", write_mesh(folder, "cube.ply", divided_cube(10.0, 20))}}});
  const std::size_t part_bytes = history.bytes();
  for (int k = 0; k < 500; ++k) {
    run_ok(history, lines(k % 2 ? 30.0 : 45.0));
    run_ok(history, areas(0.5));
  }
  EXPECT_EQ(history.entries().size(), 1001u);
  // Twelve lines and six partitions that stay the same: a handful of pointers a step.
  EXPECT_LT((history.bytes() - part_bytes) / 1000, 3000u);
  EXPECT_LT(history.bytes(), 2 * part_bytes + (std::size_t{3} << 20));
  ok(history.travel(2));
  EXPECT_EQ(hash_of(history.current()), history.entries()[1].hash);
}

TEST_F(Travel, EditThatTouchesLittleCostsLittle) {
  History history;
  run_ok(history, {"open", {{"file", write_mesh(folder, "mould.ply", sample_mould(1.2))}}});
  run_ok(history, lines(30.0));
  const std::size_t before = history.bytes();
  run_ok(history, lines(30.5));
  const Document& document = history.current();
  const std::size_t copy = document.mesh->bytes() + document.curvatures->bytes();
  EXPECT_LT(history.bytes() - before, copy / 20);
}

// ---- journal ----

TEST_F(Travel, JournalHoldsEveryRowAndMoveWhenTheCallReturns) {
  const std::string journal = folder.file("journal.arris");
  History history;
  keep_in(history, journal);
  const auto rows = [&] { return records_in(journal).size(); };
  run_ok(history, open());
  EXPECT_EQ(rows(), 1u);
  run_ok(history, lines(30.0));
  EXPECT_EQ(rows(), 2u);
  ok(history.undo());
  EXPECT_EQ(rows(), 3u);
  run_ok(history, lines(50.0));
  EXPECT_EQ(rows(), 4u);
  EXPECT_FALSE(history.run({"find_sharp_lines", {{"angle", -1}}}));
  EXPECT_EQ(rows(), 4u) << "what failed is no row";
  ok(history.travel(2));
  const std::vector<json> objects = records_in(journal);
  EXPECT_EQ(objects[1]["sequence"], 2);
  EXPECT_EQ(objects[1]["parent"], 1);
  EXPECT_EQ(objects[1]["hash"], history.entries()[1].hash);
  EXPECT_EQ(objects[1]["operation"]["operation"], "find_sharp_lines");
  EXPECT_EQ(objects[2], (json{{"head", 1}}));
  EXPECT_EQ(objects[3]["parent"], 1);
  EXPECT_EQ(objects[4], (json{{"head", 2}}));

  const Replay again = value_of(replay(journal));
  EXPECT_TRUE(again.warnings.empty());
  EXPECT_EQ(again.history.head(), 2u);
  EXPECT_EQ(hash_of(again.history.current()), hash_of(history.current()));
  EXPECT_EQ(journal_text(again.history), journal_text(history));
}

TEST_F(Travel, JournalOnDiskGivesBackARandomSession) {
  Random random(5);
  const std::string journal = folder.file("journal.arris");
  History history;
  keep_in(history, journal);
  run_ok(history, open());
  for (int k = 0; k < 120; ++k) {
    if (random.bits() % 4 == 0 && history.can_undo())
      ok(history.undo());
    else if (random.bits() % 4 == 0 && history.can_redo())
      ok(history.redo());
    else if (history.current().empty())
      run_ok(history, open());
    else
      static_cast<void>(history.run(random_operation(history.current(), random, path)));
  }
  const Replay again = value_of(replay(journal));
  EXPECT_TRUE(again.warnings.empty());
  EXPECT_EQ(again.history.head(), history.head());
  EXPECT_EQ(journal_text(again.history), journal_text(history));
  EXPECT_EQ(hash_of(again.history.current()), hash_of(history.current()));
}

TEST_F(Travel, VersionKeepsItsNameWhereverTheHeadIs) {
  const std::string journal = folder.file("journal.arris");
  History history;
  keep_in(history, journal);
  run_ok(history, open());
  run_ok(history, lines(30.0));
  ok(history.set_name(2, "  tight \n"));
  EXPECT_EQ(history.names().at(2), "tight") << "blanks about a name do not count";
  EXPECT_EQ(history.find_name("tight"), 2u);
  const std::string tight = hash_of(history.current());
  ok(history.undo());
  run_ok(history, lines(50.0));
  ok(history.set_name(3, "größer"));
  // On the other branch, not on the way of undo and redo, and there all the same.
  EXPECT_EQ(std::ranges::count(history.line_of_travel(), 2u), 0);
  EXPECT_EQ(hash_of(value_of(history.document_at(2))), tight);
  EXPECT_EQ(history.head(), 3u) << "looking is not travelling";
  EXPECT_TRUE(value_of(history.document_at(0)).empty());
  EXPECT_FALSE(history.document_at(4));

  for (const Replay& again :
       {value_of(replay(journal)), value_of(replay(folder.write("b", journal_text(history))))}) {
    EXPECT_TRUE(again.warnings.empty());
    EXPECT_EQ(again.history.names(), history.names());
    EXPECT_EQ(again.history.head(), history.head());
  }
  ok(history.set_name(2, ""));
  EXPECT_EQ(history.names().size(), 1u);
  EXPECT_EQ(value_of(replay(journal)).history.names(), history.names());
}

TEST_F(Travel, NameThatCannotBeIsRefusedAndNothingChanges) {
  const std::string journal = folder.file("journal.arris");
  History history;
  keep_in(history, journal);
  run_ok(history, open());
  run_ok(history, lines(30.0));
  ok(history.set_name(1, "as scanned"));
  const std::string before = folder.read("journal.arris");
  for (const auto& [row, name] :
       std::vector<std::pair<std::uint32_t, std::string>>{{2, "as scanned"},
                                                          {0, "x"},
                                                          {3, "x"},
                                                          {2, "two\nlines"},
                                                          {2, "\xff"},
                                                          {2, std::string(81, 'x')}}) {
    const Result<void> named = history.set_name(row, name);
    ASSERT_FALSE(named) << name;
    EXPECT_TRUE(named.error().message.ends_with(".")) << named.error().message;
  }
  ok(history.set_name(1, "as scanned"));  // is so already
  EXPECT_EQ(folder.read("journal.arris"), before);
  EXPECT_EQ(history.names().size(), 1u);
}

TEST_F(Travel, NamedVersionWhoseSnapshotWasDroppedComesBackByReplay) {
  History history(0);
  run_ok(history, open());
  run_ok(history, lines(30.0));
  const std::string hash = hash_of(history.current());
  ok(history.set_name(2, "first"));
  run_ok(history, lines(50.0));
  EXPECT_EQ(hash_of(value_of(history.document_at(2))), hash);
}

class JournalFile : public Travel {
 protected:
  /// The journal of open, lines, areas.
  std::string three_rows() {
    History history;
    for (const Operation& operation : {open(), lines(30.0), areas(0.5)}) run_ok(history, operation);
    return journal_text(history);
  }
};

TEST_F(JournalFile, LastLineCutShortIsLeftOut) {
  const std::string text = three_rows();
  const std::size_t last = text.rfind("{\"hash\"");
  ASSERT_NE(last, std::string::npos);
  for (const std::size_t keep : {last + 1, last + 30, text.size() - 2}) {
    const Replay again = value_of(replay(folder.write("torn.jsonl", text.substr(0, keep))));
    EXPECT_EQ(again.history.head(), 2u) << keep;
    ASSERT_EQ(again.warnings.size(), 1u);
    EXPECT_NE(again.warnings[0].find("line 3"), std::string::npos) << again.warnings[0];
  }
  // Whole but for its line end: nothing is missing.
  const Replay whole =
      value_of(replay(folder.write("torn.jsonl", text.substr(0, text.size() - 1))));
  EXPECT_EQ(whole.history.head(), 3u);
}

TEST_F(JournalFile, IsContinuedAfterACrashWithoutLosingWhatFollows) {
  const std::string text = three_rows();
  for (const std::size_t cut :
       {std::size_t{40}, std::size_t{1}}) {  // torn; only its end is missing
    const std::string journal = folder.write("torn.jsonl", text.substr(0, text.size() - cut));
    Replay after_crash = value_of(replay(journal));
    const std::size_t kept = after_crash.history.entries().size();
    keep_in(after_crash.history, journal);
    run_ok(after_crash.history, lines(45.0));
    run_ok(after_crash.history, areas(0.7));
    const Result<Replay> again = replay(journal);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->history.entries().size(), kept + 2);
    EXPECT_EQ(hash_of(again->history.current()), hash_of(after_crash.history.current()));
  }
}

TEST_F(JournalFile, LineBrokenInTheMiddleIsAnErrorWithItsNumber) {
  std::string text = three_rows();
  const std::size_t second = text.find('\n') + 1;
  text.erase(second, 20);
  const Result<Replay> result = replay(folder.write("broken.jsonl", text));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("line 2"), std::string::npos) << result.error().message;
}

TEST_F(JournalFile, FaultsAreErrorsWithTheLine) {
  const std::string first = three_rows().substr(0, three_rows().find('\n') + 1);
  const std::vector<std::pair<std::string, std::string>> faults{
      {"", "no operation"},
      {"\n\n", "no operation"},
      {"7\n", "line 1"},
      {"hello\n", "line 1"},
      {first + "{\"operation\": \"paint\"}\n", "line 2"},
      {first + "{\"operation\": \"find_sharp_lines\", \"angle\": -4}\n", "line 2"},
      {first + "{\"head\": 5}\n", "line 2"},
      {first + "{\"head\": \"top\"}\n", "line 2"},
      {first + "{\"head\": -1}\n", "line 2"},
      {first + "{\"head\": 4294967297}\n", "line 2"},
      {first + "{\"sequence\": 2, \"parent\": 9, \"operation\": {\"operation\": "
               "\"flip_orientation\"}}\n",
       "line 2"},
      {first + "{\"sequence\": \"x\", \"parent\": 1, \"operation\": {\"operation\": "
               "\"flip_orientation\"}}\n",
       "line 2"},
      {first + "{\"sequence\": 2, \"parent\": 1, \"operation\": 5}\n", "line 2"},
      {first + "{\"name\": \"x\", \"row\": 7}\n", "line 2"},
      {first + "{\"name\": 5, \"row\": 1}\n", "line 2"},
      {first + "{\"row\": 1}\n", "line 2"},
      {"{\"operation\": \"flip_orientation\"}\n", "line 1"},
  };
  for (const auto& [text, shown] : faults) {
    const Result<Replay> result = replay(folder.write("bad.jsonl", text));
    ASSERT_FALSE(result) << text;
    EXPECT_NE(result.error().message.find("bad.jsonl"), std::string::npos);
    EXPECT_NE(result.error().message.find(shown), std::string::npos) << result.error().message;
  }
  EXPECT_FALSE(replay(folder.file("none.jsonl")));
  EXPECT_FALSE(replay(folder.path().string())) << "a folder";
}

TEST_F(JournalFile, PlainListOfOperationsRunsToo) {
  const std::string list =
      folder.write("list.jsonl", "{\"operation\": \"open\", \"file\": \"" + path + "\"}\r\n\n" +
                                     "{\"operation\": \"find_sharp_lines\", \"angle\": 30}\n" +
                                     "{\"operation\": \"find_partitions\"}");
  const Replay result = value_of(replay(list));
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.history.entries().size(), 3u);
  EXPECT_EQ(result.history.entries()[1].operation.parameters["angle"], 30);
}

TEST_F(JournalFile, ChangedScanIsRefusedUnlessAnotherIsNamed) {
  const std::string journal = folder.write("j.jsonl", three_rows());
  const std::string same = write_mesh(folder, "same.ply", random_terrain(24, 3));
  const std::string other = write_mesh(folder, "other.ply", random_terrain(24, 8));
  write_mesh(folder, "part.ply", random_terrain(24, 8));  // the named file has changed
  const Result<Replay> refused = replay(journal);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("part.ply"), std::string::npos);
  EXPECT_NE(refused.error().message.find("changed"), std::string::npos) << refused.error().message;

  const Replay moved = value_of(replay(journal, {same}));
  EXPECT_NE(journal.find("j.jsonl"), std::string::npos);
  EXPECT_NE(folder.read("j.jsonl").find(hash_of(moved.history.current())), std::string::npos)
      << "the same scan elsewhere gives the stored hash";
  const Replay different = value_of(replay(journal, {other}));
  EXPECT_EQ(different.history.entries().size(), 3u);
  EXPECT_NE(hash_of(different.history.current()), hash_of(moved.history.current()));
}

TEST_F(JournalFile, DifferentResultIsTold) {
  std::string text = three_rows();
  const std::size_t at = text.rfind("\"hash\":\"") + 8;
  text[at] = text[at] == '0' ? '1' : '0';
  const Replay result = value_of(replay(folder.write("other_build.jsonl", text)));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("line 3"), std::string::npos);
}

TEST_F(JournalFile, ThatCannotBeWrittenStopsTheEdit) {
  History history;
  EXPECT_FALSE(SessionFile::start(folder.file("no/such/folder/j.arris"), history));
  EXPECT_FALSE(SessionFile::start(folder.path().string(), history));
  EXPECT_FALSE(SessionFile::start("/dev/full", history));
  run_ok(history, open());
  const std::string journal = folder.file("j.arris");
  keep_in(history, journal);
  std::filesystem::remove(journal);
  const Result<void> done = history.run(lines(30.0));
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("j.arris was removed"), std::string::npos)
      << done.error().message;
  EXPECT_EQ(history.entries().size(), 1u);
  EXPECT_EQ(history.head(), 1u);
  EXPECT_FALSE(history.undo()) << "undo is a row, too";
  EXPECT_EQ(history.head(), 1u);
  // What is in memory is saved elsewhere, and goes on there.
  const std::string elsewhere = folder.file("elsewhere.arris");
  keep_in(history, elsewhere);
  run_ok(history, lines(30.0));
  EXPECT_EQ(hash_of(value_of(replay(elsewhere)).history.current()), hash_of(history.current()));
}

TEST_F(JournalFile, RowThatWasCutOffByAFullDiskDoesNotSpoilThoseAfterIt) {
  const std::string journal = folder.file("full.arris");
  History history;
  keep_in(history, journal);
  run_ok(history, open());
  // No file may grow beyond 40 bytes: less than a row.
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  rlimit small = limit;
  small.rlim_cur = 40;
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Result<void> failed = history.run(lines(30.0));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  ASSERT_FALSE(failed);
  EXPECT_EQ(history.head(), 1u);
  run_ok(history, lines(40.0));
  const Result<Replay> again = replay(journal);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(hash_of(again->history.current()), hash_of(history.current()));
}

TEST_F(JournalFile, ARowThatFindsNothingToDoIsLeftOutWithAWarning) {
  // As a recipe tuned on another part: nothing there is as small.
  const std::string recipe = folder.write("recipe.jsonl", open().to_json().dump() + R"(
{"operation": "find_sharp_lines"}
{"operation": "find_partitions"}
{"operation": "remove_small_partitions", "faces": 2}
{"operation": "smooth_curvature", "passes": 1}
)");
  const Replay again = value_of(replay(recipe));
  ASSERT_EQ(again.warnings.size(), 1u);
  EXPECT_NE(again.warnings[0].find("has fewer than 2 faces"), std::string::npos)
      << again.warnings[0];
  EXPECT_NE(again.warnings[0].find("the smallest has"), std::string::npos) << again.warnings[0];
  EXPECT_EQ(again.history.entries().size(), 4u);
  EXPECT_EQ(again.history.entries().back().operation.name, "smooth_curvature");
}

TEST_F(JournalFile, CancelledReplayIsAnErrorThatSaysSo) {
  std::stop_source stop;
  stop.request_stop();
  const Result<Replay> result =
      replay(folder.write("j.jsonl", three_rows()), {}, Context(nullptr, stop.get_token()));
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().cancelled);
}

}  // namespace
}  // namespace arris
