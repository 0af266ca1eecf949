// Named versions, and one of them beside the part: driven as a user would.

#include <algorithm>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QInputDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>

#include "tests/ui/window_fixture.h"
#include "ui/panels/history_panel.h"

namespace arris::ui {
namespace {

class Versions : public MainWindowTest {
 protected:
  ComparisonPresenter& comparison() { return window->comparison(); }
  const History& history() { return window->session().history(); }

  void settle() {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return idle() && (!comparison().active() || comparison().comparison().has_value()); },
        patience));
    ASSERT_TRUE(comes_to_rest());
  }
  void find_lines(double angle) { run({"find_sharp_lines", {{"angle", angle}}}); }

  /// Answers the next dialog for a name; tells what it was asked with.
  void answer_name(const QString& name) {
    QTimer::singleShot(100, window.get(), [name] {
      auto* dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
      ASSERT_NE(dialog, nullptr);
      auto* edit = dialog->findChild<QLineEdit*>();
      edit->clear();
      QTest::keyClicks(edit, name);
      QTest::keyClick(edit, Qt::Key_Return);
    });
  }
  void name_version(const QString& name) {
    answer_name(name);
    QTest::keySequence(window.get(), QKeySequence("Ctrl+Shift+N"));
    window->activateWindow();  // no window manager gives the focus back after a dialog
    ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), patience));
  }
  void toggle_comparison() {
    QTest::keySequence(window.get(), QKeySequence("Ctrl+K"));
    ASSERT_NO_FATAL_FAILURE(settle());
  }

  QListWidget* rows_shown() {
    return window->findChild<HistoryPanel*>()->findChild<QListWidget*>();
  }
  int row_with(const QString& text) {
    for (int k = 0; k < rows_shown()->count(); ++k)
      if (rows_shown()->item(k)->data(Qt::AccessibleTextRole).toString().contains(text)) return k;
    return -1;
  }
  QToolButton* button(const QString& text) {
    for (QToolButton* found : window->findChild<SideBySide*>()->findChildren<QToolButton*>())
      if (found->text() == text) return found;
    return nullptr;
  }
  /// Pixels of a view in the colour of the marks.
  int marked_pixels(MeshView& view) {
    PictureOptions options;
    options.size = view.size();
    const QImage image = view.picture(options);
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor c = image.pixelColor(x, y);
        count += c.red() > 225 && c.green() < 120 && c.blue() > 130 && c.blue() < 200;
      }
    return count;
  }
  std::uint32_t longest_line() {
    return (*std::ranges::max_element(document().lines.lines, {},
                                      [](const LinePtr& line) { return line->length; }))
        ->id;
  }
};

TEST_F(Versions, AreNamedByKeyboardAndStayInReachFromOtherBranches) {
  open_sample();
  find_lines(20.0);
  const std::string tight = hash_of(document());
  name_version("tight");
  ASSERT_EQ(history().names().size(), 1u);
  EXPECT_GE(row_with("tight"), 0);
  EXPECT_TRUE(window->session().has_unsaved_edits());

  QTest::keySequence(window.get(), QKeySequence::Undo);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && history().head() == 1; }, patience));
  find_lines(50.0);
  // Undo and redo do not come by it any more; the list still leads there.
  const int row = row_with("tight");
  ASSERT_GE(row, 1);
  QListWidget* list = rows_shown();
  EXPECT_TRUE(list->item(row - 1)->text().contains("other branches"));
  window->findChild<QDockWidget*>("history")->raise();
  ASSERT_TRUE(comes_to_rest());
  list->scrollToItem(list->item(row));
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                    list->visualItemRect(list->item(row - 1)).center());
  EXPECT_EQ(history().head(), 3u) << "the heading leads nowhere";
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                    list->visualItemRect(list->item(row)).center());
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && history().head() == 2; }, patience));
  EXPECT_EQ(hash_of(document()), tight);

  // F2 in the list renames; an empty name takes it away.
  list->setFocus();
  list->setCurrentRow(row_with("tight"));
  answer_name("20 degrees");
  QTest::keyClick(list, Qt::Key_F2);
  EXPECT_EQ(history().names().at(2), "20 degrees");
  answer_name("");
  QTest::keyClick(list, Qt::Key_F2);
  EXPECT_TRUE(history().names().empty());
}

TEST_F(Versions, NameThatIsTakenIsToldAndAskedAgain) {
  open_sample();
  name_version("as scanned");
  find_lines(30.0);
  bool told = false;
  answer_name("as scanned");
  QTimer::singleShot(600, window.get(), [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    ASSERT_NE(box, nullptr);
    told = box->text().contains("as scanned");
    answer_name("first lines");
    box->accept();
  });
  QTest::keySequence(window.get(), QKeySequence("Ctrl+Shift+N"));
  EXPECT_TRUE(told);
  EXPECT_EQ(history().names().at(2), "first lines");
}

TEST_F(Versions, SideBySideMarkWhatOnlyOneHas) {
  open_sample();
  run_both();
  name_version("as found");
  run({"delete_lines", {{"lines", {longest_line()}}}});
  const int width = window->view().width();
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  ASSERT_TRUE(comparison().active());
  MeshView& other = *comparison().other_view();
  EXPECT_EQ(other.height(), window->view().height());
  EXPECT_NEAR(other.width(), window->view().width(), 2);

  const Comparison& found = *comparison().comparison();
  EXPECT_GT(found.only[0].sharp_length, 0.0);
  EXPECT_TRUE(found.only[1].stretches.empty());
  EXPECT_GT(marked_pixels(other), 40);
  EXPECT_EQ(marked_pixels(window->view()), 0);
  QTest::mouseClick(window->findChild<SideBySide*>()->findChild<QCheckBox*>(), Qt::LeftButton, {},
                    QPoint(8, 8));
  EXPECT_EQ(marked_pixels(other), 0);
  QTest::mouseClick(window->findChild<SideBySide*>()->findChild<QCheckBox*>(), Qt::LeftButton, {},
                    QPoint(8, 8));

  // An edit of the part is compared at once.
  QTest::keySequence(window.get(), QKeySequence::Undo);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return idle() && comparison().comparison()->only[0].stretches.empty(); }, patience));
  EXPECT_EQ(comparison().comparison()->divided_otherwise, 0.0);

  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  EXPECT_FALSE(comparison().active());
  EXPECT_TRUE(QTest::qWaitFor([&] { return window->view().width() == width; }, patience));
  EXPECT_EQ(marked_pixels(window->view()), 0);
}

TEST_F(Versions, BothViewsLookAlikeWhicheverIsTurned) {
  open_sample();
  find_lines(30.0);
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  MeshView& view = window->view();
  MeshView& other = *comparison().other_view();
  const auto drag = [](MeshView& in, const QPoint& by) {
    const QPoint from(in.width() / 2, in.height() / 2);
    QTest::mousePress(&in, Qt::LeftButton, {}, from);
    QTest::mouseMove(&in, from + by / 2);
    QTest::mouseMove(&in, from + by);
    QTest::mouseRelease(&in, Qt::LeftButton, {}, from + by);
  };
  const auto alike = [&] {
    return (view.towards_viewer() - other.towards_viewer()).norm() < 1e-12;
  };
  EXPECT_TRUE(alike());
  const Point before = view.towards_viewer();
  drag(view, {60, 20});
  EXPECT_GT((view.towards_viewer() - before).norm(), 0.05);
  EXPECT_TRUE(QTest::qWaitFor(alike, patience));
  const Point turned = view.towards_viewer();
  drag(other, {-50, 40});
  EXPECT_TRUE(QTest::qWaitFor(alike, patience));
  EXPECT_GT((view.towards_viewer() - turned).norm(), 0.05);
  QTest::keyClick(&view, Qt::Key_5);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return (other.towards_viewer() - Point::UnitZ()).norm() < 1e-9; }, patience));
  QTest::keySequence(window.get(), QKeySequence("Shift+X"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return view.section() && other.section() == view.section(); },
                              patience));
}

TEST_F(Versions, DifferencesFollowWhileAThresholdIsTuned) {
  open_sample();
  find_lines(20.0);
  name_version("20");
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  QComboBox* choice = window->findChild<SideBySide*>()->findChild<QComboBox*>();
  EXPECT_EQ(choice->findText("20"), 0);
  comparison().compare_with(2);
  ASSERT_NO_FATAL_FAILURE(settle());
  EXPECT_TRUE(comparison().comparison()->only[0].stretches.empty());
  window->session().preview({"find_sharp_lines", {{"angle", 70.0}}});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return window->session().is_previewing() &&
               comparison().comparison()->only[0].sharp_length > 0.0;
      },
      patience));
  window->session().cancel_preview();
  ASSERT_TRUE(QTest::qWaitFor([&] { return comparison().comparison()->only[0].stretches.empty(); },
                              patience));
}

TEST_F(Versions, SwapGoesThereAndShowsWhatWasLeft) {
  open_sample();
  find_lines(20.0);
  const std::string low = hash_of(document());
  find_lines(60.0);
  const std::string high = hash_of(document());
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());  // with the state before
  const double only_low = comparison().comparison()->only[0].sharp_length;
  ASSERT_GT(only_low, 0.0);
  QTest::mouseClick(button("Swap"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && history().head() == 2; }, patience));
  ASSERT_NO_FATAL_FAILURE(settle());
  EXPECT_EQ(hash_of(document()), low);
  EXPECT_DOUBLE_EQ(comparison().comparison()->only[1].sharp_length, only_low);
  QTest::mouseClick(button("Swap"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && history().head() == 3; }, patience));
  EXPECT_EQ(hash_of(document()), high);
}

TEST_F(Versions, LineOfAnotherVersionIsTakenOver) {
  open_sample();
  find_lines(30.0);
  name_version("as found");
  const std::vector<VertexId> path = document().lines.find(longest_line())->vertices;
  run({"delete_lines", {{"lines", {longest_line()}}}});
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  const auto is_sharp = [&] {
    std::size_t sharp = 0;
    for (std::size_t k = 1; k < path.size(); ++k)
      sharp += document().lines.is_sharp(*document().mesh->find_edge(path[k - 1], path[k]));
    return sharp;
  };
  ASSERT_EQ(is_sharp(), 0u);
  EXPECT_TRUE(button("Take line over")->isHidden()) << "nothing is selected there yet";
  MeshView& other = *comparison().other_view();
  std::optional<QPoint> at;
  for (int y = 4; y < other.height() && !at; y += 4)
    for (int x = 4; x < other.width() && !at; x += 4)
      if (const auto pick = other.pick({x, y});
          pick && pick->line != 0 && !document().lines.find(pick->line))
        at = QPoint(x, y);
  ASSERT_TRUE(at) << "the deleted line is seen in the other view";
  // One selection for both: a key would not mean another line than the eye sees chosen.
  window->elements().select({document().lines.lines.front()->id}, {});
  QTest::mouseClick(&other, Qt::LeftButton, {}, *at);
  EXPECT_TRUE(window->elements().selected_lines().empty());
  ASSERT_FALSE(button("Take line over")->isHidden());
  QTest::mouseClick(button("Take line over"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && is_sharp() == path.size() - 1; }, patience));
  EXPECT_TRUE(button("Take line over")->isHidden()) << "it is taken";
  ASSERT_TRUE(QTest::qWaitFor([&] { return comparison().comparison()->only[0].stretches.empty(); },
                              patience));
}

TEST_F(Versions, ChangingTheVersionQuicklyShowsTheLastOneChosen) {
  open_sample();
  find_lines(60.0);
  run_both();
  find_lines(15.0);
  run({"find_partitions", nlohmann::json::object()});
  const std::uint32_t last = rows();
  window->show_partitions(true);
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  for (int round = 0; round < 4; ++round)
    for (std::uint32_t row = last - 1; row >= 1; --row) {
      comparison().compare_with(row);
      QTest::qWait(static_cast<int>(row % 3) * 8);  // at once, or in the middle of the work
    }
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  comparison().compare_with(2);
  ASSERT_NO_FATAL_FAILURE(settle());
  const Comparison expected = *compare(*history().document_at(2), document());
  EXPECT_EQ(comparison().comparison()->only[0].stretches, expected.only[0].stretches);
  EXPECT_EQ(comparison().comparison()->only[1].stretches, expected.only[1].stretches);
}

TEST_F(Versions, WhatIsHiddenIsHiddenInBothViews) {
  open_sample();
  run_both();
  run({"smooth_curvature", {{"passes", 1}}});
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());  // the partitions are the same in both
  MeshView& other = *comparison().other_view();
  const auto part_pixels = [&] {
    PictureOptions options;
    options.size = other.size();
    options.scale_bar = options.orientation_marker = false;
    const QImage image = other.picture(options);
    qint64 count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y) != QColor(Qt::white);
    return count;
  };
  const qint64 whole = part_pixels();
  const auto largest = std::ranges::max_element(document().partitions.partitions, {},
                                                [](const PartitionPtr& p) { return p->area; });
  window->elements().select({}, {(*largest)->id});
  QTest::keyClick(window.get(), Qt::Key_H);
  EXPECT_LT(part_pixels(), whole * 3 / 4);
  QTest::keyClick(window.get(), Qt::Key_H, Qt::ShiftModifier);
  EXPECT_EQ(part_pixels(), whole);
}

TEST_F(Versions, AFittedPartIsFittedInTheRoomThereIs) {
  open_sample();
  find_lines(30.0);
  MeshView& view = window->view();
  view.fit();
  ASSERT_TRUE(comes_to_rest());
  ASSERT_TRUE(view.is_fitted());
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  EXPECT_TRUE(view.is_fitted());
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  EXPECT_TRUE(view.is_fitted());
  QTest::keyClick(&view, Qt::Key_5);
  EXPECT_TRUE(view.is_fitted());
}

TEST_F(Versions, PictureHoldsBothAtTheSizeAsked) {
  open_sample();
  find_lines(20.0);
  find_lines(60.0);
  ASSERT_NO_FATAL_FAILURE(toggle_comparison());
  const QTemporaryDir folder;
  PictureOptions options;
  options.size = {1000, 600};
  const QString path = folder.filePath("both.png");
  ASSERT_TRUE(window->save_picture(path, options));
  const QImage image(path);
  ASSERT_EQ(image.size(), QSize(1000, 600));
  // The part is in both halves, and something is written above each.
  for (const int left : {0, 502}) {
    int part = 0, caption = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = left; x < left + 498; ++x)
        (y < 60 ? caption : part) += image.pixelColor(x, y).lightness() < 200;
    EXPECT_GT(part, 5000) << left;  // beside scalar bar and legend
    EXPECT_GT(caption, 100) << left;
  }
}

TEST_F(Versions, AnotherPartEndsTheComparison) {
  const auto compare = [&] {
    for (QAction* action : window->findChildren<QAction*>())
      if (action->shortcut() == QKeySequence("Ctrl+K")) return action;
    return static_cast<QAction*>(nullptr);
  };
  EXPECT_FALSE(compare()->isEnabled());
  EXPECT_TRUE(compare()->toolTip().contains("Open a part first"));
  open_sample();
  EXPECT_FALSE(compare()->isEnabled());
  EXPECT_TRUE(compare()->toolTip().contains("only one state"));
  for (const double angle : {20.0, 30.0, 40.0}) find_lines(angle);
  EXPECT_TRUE(compare()->isEnabled());
  comparison().compare_with(3);  // a row that the next part's history has not got
  ASSERT_NO_FATAL_FAILURE(settle());
  EXPECT_TRUE(compare()->isChecked());
  window->session().mark_saved();
  window->open_sample();
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && rows() == 1; }, patience));
  EXPECT_FALSE(comparison().active());
  EXPECT_FALSE(compare()->isChecked());
}

}  // namespace
}  // namespace arris::ui
