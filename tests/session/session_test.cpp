// The open part and the work on it: what the window may rely on while a worker thread is busy.

#include "ui/window/session.h"

#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <QTemporaryDir>
#include <QTest>

#include "core/document/journal.h"
#include "core/mesh/write_ply.h"
#include "tests/support/meshes.h"

namespace arris::ui {
namespace {

constexpr int patience = 60000;  // ms

class SessionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const MeshPtr mesh = testing::mesh_of(testing::random_terrain(60, 3));
    ASSERT_TRUE(write_ply(path().toStdString(), *mesh, {}));
    session.open(path());
    wait();
    ASSERT_FALSE(session.current().document.empty());
  }
  void TearDown() override { session.close(); }

  QString path() const { return folder.filePath("terrain.ply"); }
  void wait() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !session.busy(); }, patience));
  }
  /// Rows 2 and 3: lines at two thresholds.
  void find_lines_twice() {
    session.run({{"find_sharp_lines", {{"method", "walk"}, {"angle", 20.0}}},
                 {"find_sharp_lines", {{"method", "walk"}, {"angle", 40.0}}}});
    wait();
    ASSERT_EQ(session.history().entries().size(), 3u);
  }
  std::string hash_of_row(std::uint32_t row) const {
    return session.history().entries()[row - 1].hash;
  }

  const QTemporaryDir folder;
  Session session;
};

TEST(Session, OnlyTheLatestPreviewCounts) {
  const MeshPtr mesh = testing::mesh_of(testing::random_terrain(150, 3));
  const QTemporaryDir folder;
  const QString path = folder.filePath("fine.ply");
  ASSERT_TRUE(write_ply(path.toStdString(), *mesh, {}));
  Session session;
  session.open(path);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !session.busy(); }, patience));
  int answers = 0;
  QObject::connect(&session, &Session::changed, &session, [&] { ++answers; });
  for (int k = 0; k < 50; ++k) session.preview({"find_sharp_lines", {{"angle", 20.0 + k}}});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto& step = session.shown().document.step("find_sharp_lines");
        return step && step->parameters["angle"] == 69.0;
      },
      patience));
  EXPECT_LT(answers, 10) << "values that came too late are left out";
  session.cancel_preview();
  EXPECT_FALSE(session.shown().document.step("find_sharp_lines"));
  EXPECT_EQ(session.history().entries().size(), 1u);
}

// Saving (Ctrl+S) and exporting (Ctrl+E) read the history while work runs.
TEST_F(SessionTest, OnlyTheUiThreadMovesTheHistory) {
  find_lines_twice();
  const std::string text = journal_text(session.history());
  session.travel(2);
  ASSERT_TRUE(session.busy());
  // As long as this thread does not look at its events, nothing may change under it.
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  while (std::chrono::steady_clock::now() < end) {
    ASSERT_EQ(session.history().head(), 3u);
    ASSERT_EQ(journal_text(session.history()), text);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  wait();
  EXPECT_EQ(session.history().head(), 2u);
  EXPECT_EQ(hash_of(session.current().document), hash_of_row(2));
}

TEST_F(SessionTest, FetchingAVersionGoesNowhere) {
  find_lines_twice();
  std::vector<std::string> hashes;
  bool was_busy = true;
  session.fetch(2, [&](const Document& document) {
    hashes.push_back(hash_of(document));
    was_busy = session.busy();
  });
  wait();
  EXPECT_FALSE(was_busy) << "whoever takes it may ask for more work";
  session.fetch(3, [&](const Document& document) { hashes.push_back(hash_of(document)); });
  EXPECT_EQ(hashes, (std::vector{hash_of_row(2), hash_of_row(3)}));
  EXPECT_EQ(session.history().head(), 3u);
}

TEST_F(SessionTest, BusyIsToldOnceForAllOperationsOfARun) {
  std::vector<bool> told;
  std::vector<std::string> done;
  QObject::connect(&session, &Session::busy_changed, &session,
                   [&](bool busy) { told.push_back(busy); });
  QObject::connect(&session, &Session::done, &session,
                   [&](const QString& name) { done.push_back(name.toStdString()); });
  find_lines_twice();
  EXPECT_EQ(told, (std::vector<bool>{true, false}));
  EXPECT_EQ(done, (std::vector<std::string>(2, "find_sharp_lines")));
}

TEST_F(SessionTest, ARunStopsAtTheFirstFaultAndTellsIt) {
  std::vector<std::string> told;
  QObject::connect(&session, &Session::failed, &session,
                   [&](const QString& why) { told.push_back(why.toStdString()); });
  session.run({{"find_sharp_lines", {{"method", "walk"}, {"angle", 999.0}}},
               {"find_sharp_lines", {{"method", "walk"}, {"angle", 20.0}}}});
  wait();
  EXPECT_EQ(told.size(), 1u);
  EXPECT_EQ(session.history().entries().size(), 1u);
  find_lines_twice();  // and goes on
}

// Steps asked for while one is on its way are not lost.
TEST_F(SessionTest, UndoIsCountedWhileTravelling) {
  find_lines_twice();
  session.undo();
  session.undo();
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.history().head() == 1; }, patience));
  wait();
  session.preview({"find_sharp_lines", {{"method", "walk"}, {"angle", 30.0}}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.is_previewing(); }, patience));
  EXPECT_EQ(session.history().head(), 1u);
  EXPECT_EQ(hash_of(session.current().document), hash_of_row(1));
  session.commit_preview({"find_sharp_lines", {{"method", "walk"}, {"angle", 30.0}}});
  EXPECT_EQ(session.history().entries().size(), 4u);
  EXPECT_EQ(session.history().entries().back().parent, 1u);
  EXPECT_EQ(hash_of(session.current().document), hash_of_row(4));
}

TEST_F(SessionTest, EndsInTheMiddleOfItsWork) {
  for (int k = 0; k < 20; ++k) {
    Session other;
    other.open(path());
    if (k % 2 == 0) QTest::qWait(k);  // at another moment of its work each time
    other.close();
  }
}

}  // namespace
}  // namespace arris::ui
