// What lengths are in: asked for once, beside the part and not before it, and told everywhere.

#include <gtest/gtest.h>
#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include "core/document/journal.h"
#include "tests/support/documents.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/unit_bar.h"

namespace arris::ui {
namespace {

class UnitOfLengths : public MainWindowTest {
 protected:
  /// Writes a part a hand large, `scale` of its millimetres to a unit, and opens it.
  QString open_part(double scale, const QString& name = "part.ply") {
    arris::testing::Triangles part = arris::testing::sample_mould(3.0);
    for (Point& p : part.points) p *= scale;
    const QString path = folder.filePath(name);
    EXPECT_TRUE(write_ply(path.toStdString(), *arris::testing::mesh_of(part), {}));
    open(path);
    return path;
  }
  void open(const QString& path) {
    const ScanPtr before = document().scan;
    window->session().mark_saved();  // nobody is there to answer
    window->open(path);
    ASSERT_TRUE(QTest::qWaitFor([&] { return document().scan != before && idle(); }, patience));
    ASSERT_TRUE(comes_to_rest());
  }
  UnitBar& bar() { return *window->findChild<UnitBar*>(); }
  QString question() { return bar().findChild<QLabel*>()->text(); }
  QAbstractButton* answer(const QString& text) {
    for (QAbstractButton* button : bar().findChildren<QAbstractButton*>())
      if (button->text() == text) return button;
    return nullptr;
  }
  void press(const QString& text) {
    QAbstractButton* button = answer(text);
    ASSERT_NE(button, nullptr) << qPrintable(text);
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
    ASSERT_TRUE(comes_to_rest());
  }
  QAction* in_menu(const QString& text) {
    for (QAction* a : window->findChildren<QAction*>())
      if (a->text().remove('&') == text && a->isCheckable()) return a;
    return nullptr;
  }
  /// All that the window says that could be a length.
  QStringList texts() {
    QStringList all;
    for (const QLabel* label : window->findChildren<QLabel*>()) all << label->text();
    for (const QAbstractButton* button : window->findChildren<QAbstractButton*>())
      if (!bar().isAncestorOf(button)) all << button->text();
    for (const QComboBox* combo : window->findChildren<QComboBox*>())
      for (int k = 0; k < combo->count(); ++k) all << combo->itemText(k);
    for (const QDoubleSpinBox* box : window->findChildren<QDoubleSpinBox*>()) all << box->text();
    for (const QAction* a : window->findChildren<QAction*>()) all << a->text();
    for (const QTableView* table : window->findChildren<QTableView*>()) {
      const QAbstractItemModel& model = *table->model();
      for (int c = 0; c < model.columnCount(); ++c) {
        all << model.headerData(c, Qt::Horizontal).toString();
        for (int r = 0; r < model.rowCount(); ++r) all << model.index(r, c).data().toString();
      }
    }
    for (const ThresholdHandle& handle : window->histogram().handles())
      if (handle.reading) all << handle.reading(handle.value);
    return all;
  }
  QStringList that_say(const QString& unit) {
    return texts().filter(QRegularExpression("(^|[ /(])" + unit + "²?([ ,;.)]|$)"));
  }
  QStringList header(const char* dock) {
    const QAbstractItemModel& model =
        *window->findChild<QDockWidget*>(dock)->findChild<QTableView*>()->model();
    QStringList titles;
    for (int c = 0; c < model.columnCount(); ++c)
      titles << model.headerData(c, Qt::Horizontal).toString();
    return titles;
  }
  const QTemporaryDir folder;
};

TEST_F(UnitOfLengths, IsAskedForOnceBesideThePartAndToldEverywhere) {
  open_part(0.001);
  ASSERT_TRUE(bar().isVisible());
  EXPECT_TRUE(question().contains("metres")) << qPrintable(question());
  EXPECT_TRUE(question().contains(" × ") && question().endsWith("?")) << qPrintable(question());
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  EXPECT_LT(bar().height(), 60) << "the room is the part's";
  EXPECT_GT(window->view().height(), 6 * bar().height());
  // The part is there to be worked on, and nothing says a unit that nobody said.
  run_both();
  ASSERT_GT(document().lines.lines.size(), 0u);
  EXPECT_TRUE(bar().isVisible()) << "the answer can wait";
  EXPECT_EQ(that_say("mm"), QStringList());
  EXPECT_EQ(that_say("m"), QStringList());
  EXPECT_TRUE(header("lines").contains("Length"));

  const QSize view = window->view().size();
  press("Metres");
  EXPECT_EQ(length_unit_of(document()), LengthUnit::metre);
  EXPECT_EQ(rows(), 4u) << "one row of the history";
  EXPECT_FALSE(bar().isVisible());
  EXPECT_GE(window->view().height(), view.height());
  EXPECT_TRUE(header("lines").contains("Length m"));
  EXPECT_TRUE(header("partitions").contains("Area m²"));
  EXPECT_TRUE(header("boundaries").contains("Radius m"));
  EXPECT_FALSE(that_say("m").isEmpty());
  EXPECT_TRUE(texts().contains("Kabs (1/m²)")) << "the list of fields";
  EXPECT_EQ(that_say("mm"), QStringList());

  // Taken back it is unknown again, and nobody is asked again.
  QTest::keySequence(window.get(), QKeySequence::Undo);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return length_unit_of(document()) == LengthUnit::unknown && idle(); }, patience));
  ASSERT_TRUE(comes_to_rest());
  EXPECT_FALSE(bar().isVisible());
  EXPECT_TRUE(header("lines").contains("Length"));
  EXPECT_TRUE(in_menu("Not known")->isChecked());
  QTest::keySequence(window.get(), QKeySequence::Redo);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return length_unit_of(document()) == LengthUnit::metre && idle(); }, patience));
  EXPECT_TRUE(in_menu("Metres")->isChecked());

  // It is kept in the session.
  const QString session = folder.filePath("part.arris");
  window->session().save(session, {}, [](const Result<void>& written) { EXPECT_TRUE(written); });
  window->session().wait_until_saved();
  open(session);
  EXPECT_EQ(length_unit_of(document()), LengthUnit::metre);
  EXPECT_FALSE(bar().isVisible());
  EXPECT_TRUE(header("lines").contains("Length m"));
}

TEST_F(UnitOfLengths, MayStayUnknownAndIsNotAskedForAgain) {
  const QString path = open_part(1.0);
  ASSERT_TRUE(bar().isVisible());
  EXPECT_NE(answer("Millimetres"), nullptr);
  press("Not known");
  EXPECT_FALSE(bar().isVisible());
  EXPECT_EQ(rows(), 1u) << "nothing was done to the part";
  EXPECT_FALSE(window->isWindowModified());
  const QString other = open_part(1.1, "other.ply");
  EXPECT_TRUE(bar().isVisible()) << "of another scan it is another matter";
  open(path);
  EXPECT_FALSE(bar().isVisible());
  // It can be said all the same.
  ASSERT_NE(in_menu("Inches"), nullptr);
  in_menu("Inches")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && rows() == 2; }, patience));
  ASSERT_TRUE(comes_to_rest());
  EXPECT_EQ(length_unit_of(document()), LengthUnit::inch);
  EXPECT_TRUE(header("lines").contains("Length in"));
  EXPECT_TRUE(in_menu("Inches")->isChecked());
}

TEST_F(UnitOfLengths, IsNotAskedForWhereTheFileSaysIt) {
  open_sample();
  EXPECT_EQ(length_unit_of(document()), LengthUnit::millimetre);
  EXPECT_FALSE(bar().isVisible());
  EXPECT_TRUE(in_menu("Millimetres")->isChecked());
  EXPECT_TRUE(header("lines").contains("Length mm"));
}

TEST_F(UnitOfLengths, TheAnswersAreReachedByKeysAndLeftAloneWhileSomethingRuns) {
  open_part(0.001);
  window->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window.get()));
  QAbstractButton* metres = answer("Metres");
  ASSERT_NE(metres, nullptr);
  bool reached = false;
  for (int k = 0; k < 200 && !reached; ++k) {
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
    reached = QApplication::focusWidget() == metres;
  }
  ASSERT_TRUE(reached);
  window->session().run({Operation{"find_sharp_lines", nlohmann::json::object()}});
  EXPECT_FALSE(metres->isEnabled());
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  EXPECT_TRUE(metres->isEnabled());
  metres->setFocus();
  QTest::keyClick(metres, Qt::Key_Space);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && document().unit.has_value(); }, patience));
  EXPECT_EQ(length_unit_of(document()), LengthUnit::metre);
}

}  // namespace
}  // namespace arris::ui
