// The manual, opened as a user would.

#include <QAction>
#include <QCursor>
#include <QDockWidget>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QRegularExpression>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>

#include "core/document/chain.h"
#include "tests/ui/window_fixture.h"
#include "ui/view/mesh_view.h"
#include "ui/window/help_pages.h"
#include "ui/window/help_window.h"

namespace arris::ui {
namespace {

class Help : public MainWindowTest {
 protected:
  HelpWindow* manual() { return window->findChild<HelpWindow*>("manual"); }
  void press_f1() { QTest::keyClick(window.get(), Qt::Key_F1); }
  void point_at(QWidget* widget) {
    QCursor::setPos(widget->mapToGlobal(widget->rect().center()));
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return widget->rect().contains(widget->mapFromGlobal(QCursor::pos())); }));
  }
  QString text(const QString& page) { return help_text(page, *window->menuBar()); }
  /// What stands at the top of what is seen of the page.
  QString top() {
    auto* browser = manual()->findChild<QTextBrowser*>();
    return browser->textCursor().block().text();
  }
};

TEST_F(Help, EveryPageIsThereAndLinksToPages) {
  QStringList names;
  for (const HelpPage& page : help_pages()) names << page.name;
  static const QRegularExpression link(R"(\]\(([^)]+)\))");
  int links = 0;
  for (const QString& name : names) {
    EXPECT_GT(text(name).size(), 200) << name.toStdString();
    EXPECT_FALSE(text(name).contains("{{")) << name.toStdString();
    for (auto found = link.globalMatch(text(name)); found.hasNext(); ++links)
      EXPECT_TRUE(names.contains(found.next().captured(1))) << name.toStdString();
  }
  EXPECT_GT(links, 10);
}

TEST_F(Help, TellsOfEveryTreatmentAndStep) {
  QStringList told;
  for (const HelpPage& page : help_pages()) told << help_operations(page.name);
  for (const QString& name : told)
    EXPECT_NE(find_operation(name.toStdString()), nullptr) << name.toStdString();
  for (const OperationKind& kind : operation_table())
    if (kind.is_treatment() || place_in_chain(kind.name) < chain_steps.size()) {
      EXPECT_TRUE(told.contains(QString::fromStdString(std::string(kind.name)))) << kind.name;
    }
}

TEST_F(Help, NamesKeysThatCommandsHave) {
  QList<QKeySequence> keys;
  for (const QAction* action : window->findChildren<QAction*>())
    for (const QKeySequence& key : action->shortcuts()) keys << key;
  static const QRegularExpression named(
      R"((?<![\w+])((?:Ctrl|Shift|Alt)\+(?:Shift\+)?\w+|F\d+)\b)");
  int checked = 0;
  for (const HelpPage& page : help_pages()) {
    const QString content = text(page.name);
    for (auto found = named.globalMatch(content); found.hasNext();) {
      const QString key = found.next().captured(1);
      if (key == "Ctrl+1") continue;  // of named views, once there are some
      EXPECT_TRUE(keys.contains(QKeySequence(key))) << page.name << " names " << key.toStdString();
      ++checked;
    }
  }
  EXPECT_GT(checked, 40);
}

TEST_F(Help, TheSheetListsEveryCommandOfTheMenusThatHasAKey) {
  const QString sheet = text("shortcuts");
  int listed = 0;
  const std::function<void(const QMenu*)> check = [&](const QMenu* menu) {
    for (const QAction* action : menu->actions()) {
      if (action->menu()) check(action->menu());
      if (action->menu() || action->shortcut().isEmpty()) continue;
      EXPECT_TRUE(sheet.contains("| " + action->shortcut().toString() + " |"))
          << action->text().toStdString();
      ++listed;
    }
  };
  for (const QAction* action : window->menuBar()->actions())
    if (action->menu()) check(action->menu());
  EXPECT_GT(listed, 60);
}

TEST_F(Help, F1OpensThePageOfWhatIsUnderThePointer) {
  open_sample();
  for (const auto& [dock, page] :
       {std::pair{"histogram", "histogram"}, {"lines", "tables"}, {"colour_map", "colour_map"}}) {
    auto* panel = window->findChild<QDockWidget*>(dock);
    panel->raise();
    point_at(panel->widget());
    press_f1();
    ASSERT_NE(manual(), nullptr);
    EXPECT_EQ(manual()->page(), page) << dock;
    manual()->hide();
  }
  point_at(&window->view());
  press_f1();
  EXPECT_EQ(manual()->page(), "view");
}

TEST_F(Help, F1DuringATreatmentOpensItsTool) {
  open_sample();
  run({"find_sharp_lines"});
  std::uint32_t open_line = 0;
  for (const LinePtr& line : document().lines.lines)
    if (!line->closed) open_line = line->id;
  window->elements().select({open_line}, {});
  QTest::keyClick(window.get(), Qt::Key_X);
  press_f1();
  ASSERT_NE(manual(), nullptr);
  EXPECT_EQ(manual()->page(), "lines");
  EXPECT_EQ(top(), "Extend line");
  manual()->hide();
  QTest::keyClick(window.get(), Qt::Key_Escape);
  QTest::keyClick(window.get(), Qt::Key_D);
  press_f1();
  EXPECT_EQ(top(), "Draw line");
}

TEST_F(Help, FindGoesFromPageToPage) {
  ASSERT_TRUE(QTest::qWaitForWindowActive(window.get()));
  press_f1();
  ASSERT_NE(manual(), nullptr);
  auto* find = manual()->findChild<QLineEdit*>();
  find->setText("candidates");
  QSet<QString> seen;
  for (int k = 0; k < 12; ++k) {
    QTest::keyClick(find, Qt::Key_Return);
    seen << manual()->page();
    EXPECT_EQ(manual()->findChild<QTextBrowser*>()->textCursor().selectedText().toLower(),
              "candidates");
  }
  EXPECT_TRUE(seen.contains("glossary") && seen.contains("steps"));
}

}  // namespace
}  // namespace arris::ui
