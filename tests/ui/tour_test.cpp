// The tour for those who are new, taken by mouse and keyboard as they would.

#include <gtest/gtest.h>
#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTest>
#include <QToolBar>
#include <QWindow>

#include "core/mesh/write_ply.h"
#include "tests/support/meshes.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/start_page.h"
#include "ui/panels/tour_card.h"

namespace arris::ui {
namespace {

enum Step : std::size_t { look, find_lines, tune, correct, take_away };

class Tour : public MainWindowTest {
 protected:
  TourPresenter& tour() { return window->tour(); }
  TourCard& card() { return *window->findChild<TourCard*>(); }
  QPushButton* button(const QString& text, QWidget* in = nullptr) {
    for (auto* b : (in ? in : &card())->findChildren<QPushButton*>())
      if (b->text() == text && b->isVisible()) return b;
    return nullptr;
  }
  void click(const QString& text) {
    QPushButton* wanted = button(text);
    ASSERT_NE(wanted, nullptr) << text.toStdString();
    QTest::mouseClick(wanted, Qt::LeftButton);
    ASSERT_TRUE(comes_to_rest());
  }
  QAction* named(const QString& text) {
    for (QAction* a : window->findChildren<QAction*>())
      if (a->text() == text) return a;
    return nullptr;
  }
  void start() {
    ASSERT_NE(named("Take the &tour"), nullptr);
    named("Take the &tour")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return tour().is_running() && idle(); }, patience));
    ASSERT_TRUE(comes_to_rest());
  }
  bool comes_to(std::size_t step) {
    return QTest::qWaitFor([&] { return tour().is_running() && tour().step() == step; }, patience);
  }
  QRect in_window(QWidget* widget) {
    return {widget->mapTo(window.get(), QPoint(0, 0)), widget->size()};
  }
  QDockWidget* dock(const char* name) { return window->findChild<QDockWidget*>(name); }
  /// What the step shown is about; the card must leave it free.
  QRect target() {
    switch (tour().step()) {
      case look:
        return in_window(dock("colour_map"));
      case find_lines:
        return in_window(dock("steps"));
      case tune:
        return in_window(dock("histogram"));
      case correct:
        return in_window(&window->view());
      default:
        return in_window(
            window->findChild<QToolBar*>("tools")->widgetForAction(named("Save &picture…")));
    }
  }
  /// The card is in the window, beside its target, and points at it.
  void expect_beside_target() {
    ASSERT_TRUE(comes_to_rest());
    ASSERT_TRUE(card().isVisible());
    EXPECT_TRUE(window->rect().contains(card().body()));
    EXPECT_FALSE(card().body().intersects(target())) << "step " << tour().step();
    ASSERT_TRUE(card().ring()->isVisible()) << "step " << tour().step();
    EXPECT_TRUE(card().ring()->geometry().contains(target() & window->rect()));
    EXPECT_TRUE(card().ring()->geometry().adjusted(-1, -1, 1, 1).contains(card().tip()));
    for (QLabel* label : card().findChildren<QLabel*>())
      if (label->isVisible() && label->wordWrap()) {
        EXPECT_GE(label->height(), label->heightForWidth(label->width()))
            << "cut: " << label->text().toStdString();
      }
  }
  void drag_threshold(int by, bool let_go = true) {
    HistogramPanel& histogram = window->histogram();
    ASSERT_EQ(histogram.handles().size(), 1u);
    ASSERT_EQ(histogram.handles()[0].name, "TV_IH");
    const QPoint handle = histogram.handle_position(0);
    QTest::mousePress(&histogram, Qt::LeftButton, {}, handle);
    for (int k = 1; k <= 4; ++k) {
      QTest::mouseMove(&histogram, handle + QPoint(by * k / 4, 0));
      QTest::qWait(40);  // as fast as a hand
    }
    if (!let_go) QTest::keyClick(&histogram, Qt::Key_Escape);
    QTest::mouseRelease(&histogram, Qt::LeftButton, {}, handle + QPoint(by, 0));
  }
};

TEST_F(Tour, LeadsThroughTheWorkAsEachThingIsDone) {
  open_sample();
  start();
  ASSERT_EQ(tour().step(), look);
  EXPECT_FALSE(card().page().done);
  EXPECT_FALSE(button("Back")->isEnabled());
  expect_beside_target();

  QTest::keyClick(window.get(), Qt::Key_7, Qt::AltModifier);
  EXPECT_EQ(window->fields().field(), Field::ihe);
  EXPECT_TRUE(card().page().done);
  EXPECT_EQ(tour().step(), look) << "it says so before it goes on";
  ASSERT_TRUE(comes_to(find_lines));
  expect_beside_target();

  QTest::keyClick(window.get(), Qt::Key_F5);
  ASSERT_TRUE(comes_to(tune));
  EXPECT_TRUE(document().step("find_partitions") &&
              !document().step("find_partitions")->out_of_date);
  expect_beside_target();

  const std::uint32_t before = rows();
  drag_threshold(12, false);
  QTest::qWait(100);  // nothing may happen in this time
  EXPECT_EQ(rows(), before);
  EXPECT_FALSE(card().page().done) << "Esc restored it";
  drag_threshold(12);
  ASSERT_TRUE(QTest::qWaitFor([&] { return card().page().done; }, patience));
  EXPECT_EQ(rows(), before + 1);
  ASSERT_TRUE(comes_to(correct));
  expect_beside_target();

  const auto on_line = find([&](const Pick& p) { return document().lines.find(p.line); });
  ASSERT_TRUE(on_line);
  const std::uint32_t line = window->view().pick(*on_line)->line;
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, *on_line);
  QTest::keyClick(window.get(), Qt::Key_Delete);
  ASSERT_TRUE(comes_to(take_away));
  EXPECT_EQ(document().lines.find(line), nullptr);
  expect_beside_target();

  const std::string made = hash_of(document());
  click("Finish");
  EXPECT_FALSE(tour().is_running());
  EXPECT_FALSE(card().isVisible());
  EXPECT_FALSE(card().ring()->isVisible());
  EXPECT_EQ(hash_of(document()), made);
}

TEST_F(Tour, CardLiesBesideItsTargetInSmallAndLargeWindows) {
  open_sample();
  start();
  for (const QSize size : {QSize(1440, 900), QSize(1200, 800), QSize(1000, 700)}) {
    // What the window system tells late of one size would undo the next.
    const QSignalSpy told(window->windowHandle(), &QWindow::heightChanged);
    window->resize(size);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !told.isEmpty(); }, patience));
    ASSERT_TRUE(comes_to_rest());
    ASSERT_EQ(window->size(), size);
    // Half of it is the view's, as far as panels can give way: their tabs stay legible.
    const double least = size.width() < 1024 ? 0.4 : 0.5;
    EXPECT_GE(window->centralWidget()->width(), least * size.width());
    for (const QTabBar* bar : window->findChildren<QTabBar*>(Qt::FindDirectChildrenOnly))
      if (bar->isVisible()) {
        EXPECT_GE(bar->width(), bar->sizeHint().width()) << bar->tabText(0).toStdString();
      }
    for (std::size_t step = look; step <= take_away; ++step) {
      ASSERT_EQ(tour().step(), step);
      expect_beside_target();
      if (step != take_away) click("Next");
    }
    for (std::size_t step = look; step < take_away; ++step) click("Back");
  }
}

TEST_F(Tour, FollowsWhatItPointsAt) {
  open_sample();
  start();
  dock("history")->raise();  // over the colour map
  ASSERT_TRUE(comes_to_rest());
  EXPECT_TRUE(card().tip().isNull());
  EXPECT_FALSE(card().ring()->isVisible());
  EXPECT_TRUE(in_window(&window->view()).contains(card().body()));
  dock("colour_map")->raise();
  expect_beside_target();
  dock("colour_map")->close();
  ASSERT_TRUE(comes_to_rest());
  EXPECT_FALSE(card().ring()->isVisible());
  EXPECT_TRUE(in_window(&window->view()).contains(card().body()));
  // The step begins anew: it brings up what it is about.
  click("Next");
  click("Back");
  EXPECT_TRUE(dock("colour_map")->isVisible());
  expect_beside_target();
  // Nothing that comes to the front hides it.
  dock("lines")->raise();
  ASSERT_TRUE(comes_to_rest());
  const QPoint middle = card().body().center();
  EXPECT_TRUE(card().isAncestorOf(window->childAt(middle)) || window->childAt(middle) == &card());
  // The start page is a detour.
  QTest::keyClick(window.get(), Qt::Key_Home, Qt::AltModifier);
  ASSERT_TRUE(comes_to_rest());
  EXPECT_FALSE(card().isVisible());
  QTest::keyClick(window.get(), Qt::Key_Home, Qt::AltModifier);
  expect_beside_target();
}

TEST_F(Tour, StaysOutOfTheWay) {
  open_sample();
  window->view().setFocus();
  start();
  EXPECT_TRUE(window->view().hasFocus());
  click("Next");
  EXPECT_TRUE(window->view().hasFocus()) << "a click on the card leaves the focus where it was";
  // Clicks go to what lies beside the card, and through the ring.
  EXPECT_FALSE(card().ring() == window->childAt(card().ring()->geometry().center()));
  EXPECT_NE(window->childAt(card().geometry().topLeft() + QPoint(2, 2)), &card());
  // By Tab alone.
  QTest::keyClick(&window->view(), Qt::Key_Tab);
  ASSERT_EQ(QApplication::focusWidget(), button("Next"));
  QTest::keyClick(button("Next"), Qt::Key_Return);
  EXPECT_EQ(tour().step(), tune);
  for (const char* text : {"Next", "Back", "End tour"})
    EXPECT_TRUE(button(text)->accessibleName().startsWith(text));
  const std::string before = hash_of(document());
  QTest::keyClick(button("Next"), Qt::Key_Escape);
  EXPECT_FALSE(tour().is_running());
  EXPECT_FALSE(card().isVisible());
  EXPECT_TRUE(window->view().hasFocus());
  EXPECT_EQ(hash_of(document()), before);
  EXPECT_EQ(rows(), 1u);
}

TEST_F(Tour, EndTourLeavesEverythingAsItWas) {
  open_sample();
  run_both();
  const std::string before = hash_of(document());
  const std::uint32_t rows_before = rows(), head = window->session().history().head();
  start();
  click("Next");
  EXPECT_TRUE(card().page().done) << "lines and partitions were there before";
  QTest::qWait(1800);  // nothing may happen in this time: what is done now goes on after 1500
  EXPECT_EQ(tour().step(), find_lines) << "what was done before does not hurry anybody on";
  click("Next");
  click("Next");
  EXPECT_EQ(tour().step(), correct);
  click("End tour");
  EXPECT_FALSE(card().isVisible());
  EXPECT_EQ(hash_of(document()), before);
  EXPECT_EQ(rows(), rows_before);
  EXPECT_EQ(window->session().history().head(), head);
}

TEST_F(Tour, IsOfferedOnceOnTheFirstPart) {
  open_sample();
  EXPECT_FALSE(card().isVisible()) << "nobody asked for the offer";
  tour().offer();
  open_sample();
  ASSERT_TRUE(card().isVisible());
  EXPECT_FALSE(tour().is_running());
  EXPECT_FALSE(card().isAncestorOf(QApplication::focusWidget()));
  EXPECT_TRUE(in_window(&window->view()).contains(card().body()));
  EXPECT_FALSE(QSettings().contains("tour/offered"));
  click("Not now");
  EXPECT_FALSE(card().isVisible());
  EXPECT_FALSE(tour().is_running());
  EXPECT_TRUE(QSettings().value("tour/offered").toBool());
  tour().offer();
  open_sample();
  EXPECT_FALSE(card().isVisible());

  QSettings().remove("tour/offered");
  tour().offer();
  open_sample();
  click("Start the tour");
  EXPECT_TRUE(tour().is_running());
  EXPECT_EQ(tour().step(), look);
  EXPECT_TRUE(QSettings().value("tour/offered").toBool());
}

TEST_F(Tour, OfferGoesWhenTheWorkBegins) {
  tour().offer();
  open_sample();
  ASSERT_TRUE(card().isVisible());
  run_both();
  EXPECT_FALSE(card().isVisible());
  EXPECT_TRUE(QSettings().value("tour/offered").toBool());
}

TEST_F(Tour, WithoutAPartItOpensTheSample) {
  start();
  EXPECT_FALSE(document().empty());
  EXPECT_EQ(tour().step(), look);
  EXPECT_TRUE(card().isVisible());
}

TEST_F(Tour, StartPageListsTheStepsAndStartsIt) {
  auto* page = window->findChild<StartPage*>();
  for (const TourStep& step : TourPresenter::steps()) {
    int shown = 0;
    for (const QLabel* label : page->findChildren<QLabel*>())
      shown += label->text() == step.title || label->text() == step.gist;
    EXPECT_EQ(shown, 2) << step.title.toStdString();
  }
  QPushButton* wanted = button("Take the tour on the sample mould", page);
  ASSERT_NE(wanted, nullptr);
  QTest::mouseClick(wanted, Qt::LeftButton);
  ASSERT_TRUE(comes_to(look));
  EXPECT_FALSE(document().empty());
}

TEST_F(Tour, AnotherPartTakesItBackToWhatIsThere) {
  open_sample();
  run_both();
  start();
  for (int k = 0; k < 3; ++k) click("Next");
  ASSERT_EQ(tour().step(), correct);
  window->session().mark_saved();
  const QTemporaryDir folder;
  const QString path = folder.filePath("other.ply");
  ASSERT_TRUE(write_ply(path.toStdString(),
                        *arris::testing::mesh_of(arris::testing::random_terrain(40, 3)), {}));
  window->open(path);
  ASSERT_TRUE(comes_to(find_lines)) << "there are no lines to correct";
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  EXPECT_FALSE(card().page().done);
  expect_beside_target();
  // By Next it goes to Correct all the same, and says what is missing.
  click("Next");
  click("Next");
  EXPECT_TRUE(card().page().task.contains("F5"));
  click("Next");
  EXPECT_TRUE(card().page().task.contains("F5")) << "there are no partitions to take away";
}

}  // namespace
}  // namespace arris::ui
