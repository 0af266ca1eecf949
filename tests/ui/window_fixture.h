#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <gtest/gtest.h>
#include <QApplication>
#include <QDir>
#include <QSettings>
#include <QStandardPaths>
#include <QTest>

#include "ui/panels/histogram_panel.h"
#include "ui/window/comparison_presenter.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/explanation_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/main_window.h"
#include "ui/window/named_views_presenter.h"
#include "ui/window/report_presenter.h"
#include "ui/window/session.h"
#include "ui/window/tour_presenter.h"
#include "ui/window/worklist_presenter.h"

/// The whole window, opened as a user would.
namespace arris::ui {

inline constexpr int patience = 60000;  // ms

/// Counts what keeps a machine busy: layouts and drawing.
class Drawing : public QObject {
 public:
  Drawing() { qApp->installEventFilter(this); }
  /// Since it was last asked.
  int count() { return std::exchange(count_, 0); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    count_ += event->type() == QEvent::LayoutRequest || event->type() == QEvent::UpdateRequest ||
              event->type() == QEvent::Paint;
    return QObject::eventFilter(watched, event);
  }

 private:
  int count_ = 0;
};

/// Returns once all that was asked for is laid out and drawn: two rounds of events in a row had
/// nothing of that. One is not enough, as what a timer puts off comes in the next.
[[nodiscard]] inline bool comes_to_rest() {
  Drawing drawing;
  int quiet = -1;  // rounds; none has been yet
  return QTest::qWaitFor(
      [&] {
        quiet = drawing.count() == 0 ? quiet + 1 : 0;
        return quiet == 2;
      },
      patience);
}

class MainWindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QStandardPaths::setTestModeEnabled(true);
    QApplication::setOrganizationName("arris-test");
    QSettings().clear();
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)).removeRecursively();
    window = std::make_unique<MainWindow>();
    window->resize(1200, 800);
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    window->activateWindow();
  }

  void open_sample() {
    window->open_sample();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !document().empty() && idle(); }, patience));
    ASSERT_TRUE(comes_to_rest());
  }
  /// Shortcuts are those of the active window, which no window manager gives back after a dialog.
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers) {
    window->activateWindow();
    QApplication::setActiveWindow(window.get());
    ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), patience));
    QTest::keyClick(window.get(), key, modifiers);
  }
  void TearDown() override {
    window->session().mark_saved();  // nobody is there to answer
    window->close();
  }

  const Document& document() const { return window->session().current().document; }
  const Document& shown() const { return window->session().shown().document; }
  bool idle() const { return !window->session().busy(); }
  std::uint32_t rows() const {
    return static_cast<std::uint32_t>(window->session().history().entries().size());
  }
  void run_both() {
    QTest::keyClick(window.get(), Qt::Key_F5);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return document().step("find_partitions") && idle(); }, patience));
  }
  void run_paper_flow() {
    QTest::keyClick(window.get(), Qt::Key_F5, Qt::ShiftModifier);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return document().step("find_partitions") && idle(); }, patience));
  }
  void run(const Operation& operation) {
    window->session().run({operation});
    ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  }
  /// Widget position where `wanted` holds for the pick, searched over the view.
  std::optional<QPoint> find(const std::function<bool(const Pick&)>& wanted) {
    MeshView& view = window->view();
    for (int y = 4; y < view.height(); y += 6)
      for (int x = 4; x < view.width(); x += 6)
        if (const auto pick = view.pick({x, y}); pick && wanted(*pick)) return QPoint(x, y);
    return std::nullopt;
  }

  std::unique_ptr<MainWindow> window;
};

}  // namespace arris::ui
