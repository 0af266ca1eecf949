// Drives the whole window by mouse and keyboard, as a user would. Needs a display (Xvfb will do).

#include <filesystem>

#include <gtest/gtest.h>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QFile>
#include <QImage>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QSlider>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include "core/mesh/write_ply.h"
#include "tests/support/meshes.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/element_table.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/steps_panel.h"
#include "ui/window/hover_text.h"

namespace arris::ui {
namespace {

TEST_F(MainWindowTest, OpensTheSampleAndDrawsIt) {
  open_sample();
  EXPECT_GT(document().mesh->face_count(), 20000u);
  EXPECT_EQ(rows(), 1u);
  const QImage image = window->view().grabFramebuffer();
  ASSERT_FALSE(image.isNull());
  // The part is there: the middle of the view differs from its corner.
  const QColor corner = image.pixelColor(image.width() - 3, image.height() / 2);
  int different = 0;
  for (int k = -40; k <= 40; k += 4) {
    const QColor middle = image.pixelColor(image.width() / 2 + k, image.height() / 2 + k);
    EXPECT_EQ(middle.alpha(), 255);
    different += std::abs(middle.lightness() - corner.lightness()) > 20;
  }
  EXPECT_GT(different, 10);
}

TEST_F(MainWindowTest, AWrongFileIsToldInASentenceAndTheOpenPartStays) {
  open_sample();
  const MeshPtr before = document().mesh;
  QString message;
  QTimer::singleShot(500, [&] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
      message = box->text();
      box->accept();
    }
  });
  window->open("/no/such/file.stl");
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && !message.isEmpty(); }, patience));
  EXPECT_TRUE(message.contains("/no/such/file.stl")) << message.toStdString();
  EXPECT_EQ(document().mesh, before);
}

TEST_F(MainWindowTest, TheNormalJumpIsWorkedOutBesideTheWindowAndShown) {
  open_sample();
  EXPECT_EQ(document().evidence->known(), nullptr);
  QTest::keyClick(window.get(), Qt::Key_J, Qt::AltModifier);
  ASSERT_EQ(window->fields().field(), Field::normal_jump);
  EXPECT_TRUE(window->fields().working()) << "the window does not wait";
  EXPECT_TRUE(window->fields().distribution().empty());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window->fields().working(); }, patience));
  const LineEvidencePtr evidence = document().evidence->known();
  ASSERT_NE(evidence, nullptr);
  EXPECT_FALSE(window->fields().distribution().empty());
  EXPECT_GT(window->fields().distribution().max(), 45.0);
  EXPECT_LT(window->fields().distribution().min(), -45.0) << "concave ones are negative";
  // Beside IHe in the status bar.
  Pick pick;
  pick.vertex = document().mesh->edge(0)[0];
  pick.edge = 0;
  EXPECT_TRUE(hover_text(document(), pick).contains("jump ")) << "known by now";
  // Another field before it is there: nothing of it comes later.
  run({"flip_orientation", nlohmann::json::object()});
  EXPECT_EQ(window->fields().field(), Field::normal_jump);
  window->set_field(Field::kabs);
  EXPECT_FALSE(window->fields().working());
  EXPECT_GE(window->fields().distribution().min(), 0.0);
}

TEST_F(MainWindowTest, TheThresholdIsOnTheFieldThatLinesAreFoundBy) {
  open_sample();
  const auto handles_on = [&](Field field) {
    window->set_field(field);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !window->fields().working(); }, patience));
    QStringList names;
    for (const ThresholdHandle& handle : window->histogram().handles())
      if (handle.name.startsWith("TV_")) names << handle.name;
    return names.join(' ').toStdString();
  };
  EXPECT_EQ(handles_on(Field::normal_jump), "TV_IH");
  EXPECT_EQ(handles_on(Field::ihe), "");
  EXPECT_EQ(handles_on(Field::ikabs), "") << "TV_IK is of the walk";
  run({"find_sharp_lines", {{"method", "walk"}}});
  EXPECT_EQ(handles_on(Field::normal_jump), "");
  EXPECT_EQ(handles_on(Field::ihe), "TV_IH");
  EXPECT_EQ(handles_on(Field::ikabs), "TV_IK");
}

TEST_F(MainWindowTest, F5FindsLinesAndPartitionsOnTheScanItself) {
  open_sample();
  run_both();
  EXPECT_EQ(rows(), 3u);
  EXPECT_FALSE(document().step("simplify") || document().step("equilateralize"));
  EXPECT_EQ(document().mesh, document().opened.mesh);
  EXPECT_EQ(document().line_method(), LineMethod::normal_jump);
  EXPECT_FALSE(window->findChild<StepsPanel*>()->values("find_sharp_lines").contains("candidates"));
}

TEST_F(MainWindowTest, ThePapersFlowIsOneClickAndEachStepIsUndone) {
  open_sample();
  run_both();
  const std::string before = hash_of(document());
  const std::uint32_t ran = rows();
  QAction* paper = nullptr;
  for (QAction* action : window->findChildren<QAction*>())
    if (action->text().remove('&').startsWith("Run the paper's flow")) paper = action;
  ASSERT_NE(paper, nullptr);
  ASSERT_TRUE(paper->isEnabled());
  EXPECT_TRUE(paper->toolTip().contains("simplify"));
  paper->trigger();
  EXPECT_FALSE(paper->isEnabled()) << "while it runs";
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == ran + 4 && idle(); }, patience));
  EXPECT_TRUE(document().step("simplify") && document().step("equilateralize") &&
              document().step("find_partitions"));
  for (const std::string name :
       {"simplify", "find_sharp_lines", "equilateralize", "find_partitions"})
    EXPECT_FALSE(document().step(name)->out_of_date) << name;
  EXPECT_EQ(document().line_method(), LineMethod::walk);
  EXPECT_LT(document().mesh->face_count(), document().opened.mesh->face_count());
  for (std::uint32_t head = ran + 4; head > ran; --head) {
    QTest::keySequence(window.get(), QKeySequence::Undo);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return idle() && window->session().history().head() == head - 1; }, patience));
  }
  EXPECT_EQ(hash_of(document()), before);
}

TEST_F(MainWindowTest, TheMethodOnTheCardChangesHowLinesAreFound) {
  open_sample();
  auto* panel = window->findChild<StepsPanel*>();
  const QVariantMap jump = panel->values("find_sharp_lines");
  EXPECT_EQ(jump["method"], "normal_jump");
  EXPECT_FALSE(jump.contains("candidates"));
  QComboBox* method = nullptr;
  for (QComboBox* box : panel->findChildren<QComboBox*>())
    if (box->accessibleName() == "Method" && box->findData("walk") >= 0) method = box;
  ASSERT_NE(method, nullptr);
  const auto choose = [&](const char* key) {
    method->setFocus();
    const int to = method->findData(key);
    while (method->currentIndex() != to)
      QTest::keyClick(method, method->currentIndex() < to ? Qt::Key_Down : Qt::Key_Up);
  };
  choose("walk");
  const QVariantMap walk = panel->values("find_sharp_lines");
  EXPECT_EQ(walk["method"], "walk");
  EXPECT_EQ(walk["candidates"], 3);
  EXPECT_EQ(walk["bridge_gap"], 0.0);
  EXPECT_NE(walk["angle"], jump["angle"]) << "another measure, another default";
  EXPECT_NE(walk["min_length"], jump["min_length"]);
  QTest::keyClick(window.get(), Qt::Key_L, Qt::ControlModifier);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return document().step("find_sharp_lines") && idle(); }, patience));
  EXPECT_EQ(document().line_method(), LineMethod::walk);
  const std::size_t by_walk = document().lines.lines.size();
  choose("normal_jump");
  EXPECT_EQ(panel->values("find_sharp_lines")["angle"], jump["angle"]);
  QTest::keyClick(window.get(), Qt::Key_L, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == 3u && idle(); }, patience));
  EXPECT_EQ(document().line_method(), LineMethod::normal_jump);
  EXPECT_LT(document().lines.lines.size(), by_walk);
}

TEST_F(MainWindowTest, TheSliderOfDetailIsFollowedAndLeavesOneHistoryEntry) {
  open_sample();
  QTest::keyClick(window.get(), Qt::Key_F5);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return document().step("find_partitions") && idle(); }, patience));
  EXPECT_EQ(document().partition_method(), PartitionMethod::surfaces);
  QSlider* slider = nullptr;
  for (QSlider* one : window->findChild<StepsPanel*>()->findChildren<QSlider*>())
    if (one->accessibleName() == "Detail") slider = one;
  ASSERT_NE(slider, nullptr);
  const std::size_t found = document().partitions.partitions.size();
  const std::uint32_t before = rows();
  // To the left: fewer and larger ones, as one step of the history.
  slider->setFocus();
  slider->setSliderDown(true);
  slider->setValue(slider->value() / 2);
  slider->setValue(slider->value() / 4);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->session().is_previewing(); }, patience));
  slider->setSliderDown(false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == before + 1 && idle(); }, patience));
  EXPECT_LE(document().partitions.partitions.size(), found);
  EXPECT_LT(document().step("find_partitions")->parameters["detail"].get<double>(), 0.5);
  QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  EXPECT_EQ(document().partitions.partitions.size(), found);
}

TEST_F(MainWindowTest, AllPartitionsAreCutIntoFourSidesAtOnce) {
  open_sample();
  run_both();
  const std::size_t found = document().partitions.partitions.size();
  const std::uint32_t before = rows();
  QTest::keyClick(window.get(), Qt::Key_W, Qt::ShiftModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == before + 1 && idle(); }, patience));
  EXPECT_EQ(window->session().history().entries().back().operation.name, "split_to_four_sides");
  EXPECT_GT(document().partitions.partitions.size(), found);
  QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  EXPECT_EQ(document().partitions.partitions.size(), found);
}

TEST_F(MainWindowTest, DraggingTheSharpAngleFollowsAndLeavesOneHistoryEntry) {
  open_sample();
  window->set_field(Field::normal_jump);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window->fields().working(); }, patience));
  HistogramPanel& histogram = window->histogram();
  ASSERT_EQ(histogram.handles().size(), 1u);
  EXPECT_EQ(histogram.handles()[0].name, "TV_IH");

  const QPoint start = histogram.handle_position(0);
  QTest::mousePress(&histogram, Qt::LeftButton, {}, start);
  int previews = 0;
  QObject::connect(&window->session(), &Session::changed, window.get(),
                   [&] { previews += window->session().is_previewing(); });
  for (int k = 1; k <= 12; ++k) {
    QTest::mouseMove(&histogram, start + QPoint(4 * k, 0));
    QTest::qWait(30);  // as fast as a hand
    // Where the machine is slow, too, no more than three moves go by unseen.
    if (k % 3 == 0) {
      ASSERT_TRUE(QTest::qWaitFor([&] { return previews >= k / 3; }, patience));
    }
  }
  ASSERT_TRUE(QTest::qWaitFor([&] { return previews > 3; }, patience));
  EXPECT_EQ(rows(), 1u) << "nothing is journalled while the mouse moves";
  EXPECT_FALSE(document().step("find_sharp_lines"));
  EXPECT_TRUE(shown().step("find_sharp_lines"));
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, start + QPoint(48, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == 2 && idle(); }, patience));
  EXPECT_GT(document().lines.lines.size(), 0u);
  EXPECT_NEAR(document().step("find_sharp_lines")->parameters["angle"].get<double>(),
              histogram.handles()[0].value, 0.05);
}

TEST_F(MainWindowTest, DraggingTheAngleOfTheWalkLeavesOneHistoryEntry) {
  open_sample();
  run({"find_sharp_lines", {{"method", "walk"}}});
  window->set_field(Field::ihe);
  HistogramPanel& histogram = window->histogram();
  ASSERT_EQ(histogram.handles().size(), 1u);
  EXPECT_TRUE(histogram.handles()[0].reading(30.0).startsWith("TV_IK"));
  const double before = histogram.handles()[0].value;
  const QPoint start = histogram.handle_position(0);
  QTest::mousePress(&histogram, Qt::LeftButton, {}, start);
  QTest::mouseMove(&histogram, start + QPoint(20, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->session().is_previewing(); }, patience));
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, start + QPoint(20, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == 3 && idle(); }, patience));
  EXPECT_GT(document().step("find_sharp_lines")->parameters["angle"].get<double>(), before);
  EXPECT_EQ(document().line_method(), LineMethod::walk);
}

TEST_F(MainWindowTest, EscapeWhileDraggingRestores) {
  open_sample();
  window->set_field(Field::normal_jump);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window->fields().working(); }, patience));
  HistogramPanel& histogram = window->histogram();
  const double before = histogram.handles()[0].value;
  const QPoint start = histogram.handle_position(0);
  QTest::mousePress(&histogram, Qt::LeftButton, {}, start);
  for (int k = 1; k <= 5; ++k) {
    QTest::mouseMove(&histogram, start + QPoint(6 * k, 0));
    QTest::qWait(30);  // as fast as a hand
  }
  QTest::keyClick(&histogram, Qt::Key_Escape);
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, start + QPoint(30, 0));
  QTest::qWait(200);  // nothing may happen in this time: a preview under way is dropped
  EXPECT_EQ(rows(), 1u);
  EXPECT_FALSE(shown().step("find_sharp_lines"));
  EXPECT_DOUBLE_EQ(histogram.handles()[0].value, before);
}

TEST_F(MainWindowTest, DraggingTheCurvatureBoundMovesThePartitions) {
  open_sample();
  run_both();
  window->set_field(Field::kabs);
  HistogramPanel& histogram = window->histogram();
  EXPECT_TRUE(histogram.handles().empty()) << "surfaces know no intervals";
  run({"find_partitions", {{"method", "fronts"}}});
  const std::uint32_t ran = rows();
  ASSERT_GE(histogram.handles().size(), 1u);
  const auto before = document().step("find_partitions")->parameters["intervals"];
  const QPoint start = histogram.handle_position(0);
  QTest::mousePress(&histogram, Qt::LeftButton, {}, start);
  for (int k = 1; k <= 6; ++k) {
    QTest::mouseMove(&histogram, start - QPoint(5 * k, 0));
    QTest::qWait(30);  // as fast as a hand
  }
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, start - QPoint(30, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == ran + 1 && idle(); }, patience));
  EXPECT_NE(document().step("find_partitions")->parameters["intervals"], before);
  EXPECT_LT(document().step("find_partitions")->parameters["intervals"][0][1].get<double>(),
            before[0][1].get<double>());
}

TEST_F(MainWindowTest, LinesAndPartitionsSelectBothWays) {
  open_sample();
  run_both();
  const auto on_line = find([&](const Pick& p) { return document().lines.find(p.line); });
  ASSERT_TRUE(on_line);
  const std::uint32_t line = window->view().pick(*on_line)->line;
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, *on_line);
  EXPECT_EQ(window->elements().selected_lines(), ElementsPresenter::Ids{line});

  ASSERT_TRUE(window->elements().partitions_shown());
  const auto on_partition =
      find([&](const Pick& p) { return p.line == 0 && document().partitions.label(p.face) != 0; });
  ASSERT_TRUE(on_partition);
  const std::uint32_t partition =
      document().partitions.label(window->view().pick(*on_partition)->face);
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, *on_partition);
  EXPECT_EQ(window->elements().selected_partitions(), ElementsPresenter::Ids{partition});
  EXPECT_TRUE(window->elements().selected_lines().empty());

  // From the table: the first row by a click.
  QTableView* table = nullptr;
  for (ElementTable* candidate : window->findChildren<ElementTable*>())
    if (candidate->selected().contains(partition) && candidate->isVisible())
      table = candidate->findChild<QTableView*>();
  if (!table)  // its tab may be behind another one
    for (ElementTable* candidate : window->findChildren<ElementTable*>())
      if (candidate->selected().contains(partition)) {
        candidate->parentWidget()->raise();
        table = candidate->findChild<QTableView*>();
      }
  ASSERT_NE(table, nullptr);
  ASSERT_TRUE(comes_to_rest());
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                    table->visualRect(table->model()->index(0, 0)).center());
  ASSERT_EQ(window->elements().selected_partitions().size(), 1u);
}

TEST_F(MainWindowTest, HiddenLinesAreNotPicked) {
  open_sample();
  run_both();
  const auto on_line = find([&](const Pick& p) { return p.line != 0; });
  ASSERT_TRUE(on_line);
  QTest::keyClick(window.get(), Qt::Key_L);
  const auto pick = window->view().pick(*on_line);
  EXPECT_TRUE(!pick || pick->line == 0);
  QTest::keyClick(window.get(), Qt::Key_L);
  EXPECT_NE(window->view().pick(*on_line)->line, 0u);
}

TEST_F(MainWindowTest, UndoRedoAndTravel) {
  open_sample();
  const std::string opened = hash_of(document());
  run_both();
  const std::string done = hash_of(document());
  const auto press = [&](const QKeySequence& keys, std::uint32_t head) {
    QTest::keySequence(window.get(), keys);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return idle() && window->session().history().head() == head; }, patience));
  };
  const std::uint32_t last = rows();
  for (std::uint32_t head = last; head > 1; --head) press(QKeySequence::Undo, head - 1);
  EXPECT_EQ(hash_of(document()), opened);
  for (std::uint32_t head = 2; head <= last; ++head) press(QKeySequence::Redo, head);
  EXPECT_EQ(hash_of(document()), done);
  emit window->findChild<HistoryPanel*>()->travel(1);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return idle() && window->session().history().head() == 1; }, patience));
  EXPECT_EQ(hash_of(document()), opened);
  // The menu names what it would do.
  bool named = false;
  for (const QAction* action : window->findChildren<QAction*>())
    named = named || action->text().startsWith("Redo: Find sharp lines");
  EXPECT_TRUE(named);
}

TEST_F(MainWindowTest, DoesNothingWhileNothingHappens) {
  const auto work_at_rest = [this] {
    window->statusBar()->clearMessage();  // it would go by itself after some seconds
    Drawing drawing;
    QElapsedTimer quiet;
    quiet.start();
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          if (drawing.count() != 0 || window->fields().working()) quiet.restart();
          return quiet.hasExpired(500);
        },
        patience))
        << "what is under way comes to its end";
    QTest::qWait(1000);  // nothing may happen in this time
    return drawing.count();
  };
  EXPECT_EQ(work_at_rest(), 0) << "the start page";
  open_sample();
  run_both();
  EXPECT_EQ(work_at_rest(), 0) << "a part";
  run({"find_sharp_lines", {{"angle", 40.0}}});
  QTest::keySequence(window.get(), QKeySequence("Ctrl+K"));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return idle() && window->comparison().comparison().has_value(); }, patience));
  EXPECT_EQ(work_at_rest(), 0) << "two versions";
}

TEST_F(MainWindowTest, ACrashLosesNothing) {
  open_sample();
  run_both();
  const std::string before = hash_of(document());
  // What a crash leaves behind: the journal as it stands, and no owner.
  const QDir folder(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
                    "/sessions");
  const QStringList journals = folder.entryList({"*.arris"}, QDir::Files, QDir::Time);
  ASSERT_FALSE(journals.isEmpty());
  EXPECT_TRUE(Session::abandoned_sessions().isEmpty()) << "this window still works on it";
  const QString left = folder.filePath("00000000-000000000-1.arris");
  QFile::remove(left);
  ASSERT_TRUE(QFile::copy(folder.filePath(journals.first()), left));
  EXPECT_EQ(Session::abandoned_sessions(), QStringList{left});

  Session other;
  other.recover(left);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !other.busy(); }, patience));
  EXPECT_EQ(hash_of(other.current().document), before);
  EXPECT_EQ(other.history().entries().size(), rows());
  EXPECT_TRUE(Session::abandoned_sessions().isEmpty());
  other.close();
  EXPECT_FALSE(QFile::exists(left));
}

TEST_F(MainWindowTest, PicturesHaveTheAskedSizeAndAreOpaque) {
  open_sample();
  run_both();
  const QTemporaryDir folder;
  PictureOptions options;
  options.size = {800, 600};
  const QString path = folder.filePath("picture.png");
  QString error;
  ASSERT_TRUE(window->save_picture(path, options, &error)) << error.toStdString();
  const QImage image(path);
  EXPECT_EQ(image.size(), QSize(800, 600));
  EXPECT_EQ(image.pixelColor(0, 0), QColor(Qt::white));
  for (int y = 0; y < image.height(); y += 37)
    for (int x = 0; x < image.width(); x += 41) EXPECT_EQ(image.pixelColor(x, y).alpha(), 255);
  EXPECT_FALSE(window->save_picture(folder.filePath("no/such/folder.png"), options, &error));
  EXPECT_FALSE(error.isEmpty());
}

TEST_F(MainWindowTest, WhatIsDisabledSaysWhy) {
  const auto expect_reasons = [this](const char* when) {
    for (const QAction* action : window->findChildren<QAction*>()) {
      const bool counts = !action->isSeparator() && !action->menu() && !action->text().isEmpty() &&
                          !action->statusTip().isEmpty();
      if (!counts || action->isEnabled()) continue;
      EXPECT_GT(action->toolTip().size(), action->statusTip().size() + 10)
          << when << ": " << action->text().toStdString();
    }
  };
  expect_reasons("on the start page");
  open_sample();
  expect_reasons("with a part");
  run_both();
  expect_reasons("with lines and partitions");
}

TEST_F(MainWindowTest, EveryActionHasATooltipAndShortcutsAreUnique) {
  open_sample();
  QMap<QString, QString> seen;  // Alt and a letter opens a menu
  for (const QAction* menu : window->menuBar()->actions())
    if (const qsizetype at = menu->text().indexOf('&'); at >= 0)
      seen["Alt+" + menu->text().mid(at + 1, 1).toUpper()] = menu->text();
  for (const QAction* action : window->findChildren<QAction*>()) {
    if (action->text().isEmpty() || action->menu() || action->shortcut().isEmpty()) continue;
    EXPECT_FALSE(action->toolTip().isEmpty()) << action->text().toStdString();
    const QString keys = action->shortcut().toString();
    EXPECT_FALSE(seen.contains(keys)) << keys.toStdString() << ": " << action->text().toStdString()
                                      << " and " << seen.value(keys).toStdString();
    seen[keys] = action->text();
  }
  EXPECT_GT(seen.size(), 15);
}

TEST_F(MainWindowTest, EveryFieldIsShownByAKeyOfItsOwn) {
  open_sample();
  run_paper_flow();  // so that there are zones to deviate from
  for (const FieldInfo& info : field_table()) {
    SCOPED_TRACE(info.name);
    const int key = info.key;  // Qt's codes of letters and digits are their characters
    QTest::keyClick(window.get(), static_cast<Qt::Key>(key), Qt::AltModifier);
    EXPECT_EQ(window->fields().field(), info.field);
  }
}

TEST_F(MainWindowTest, FitsTheScreenItOpensOnAndItsLayoutCanBeReset) {
  const QSize screen = QGuiApplication::primaryScreen()->availableSize();
  // As it was closed on a larger screen.
  window->resize(screen.width() + 500, screen.height() + 400);
  auto* lines = window->findChild<QDockWidget*>("lines");
  ASSERT_NE(lines, nullptr);
  const Qt::DockWidgetArea area = window->dockWidgetArea(lines);
  lines->hide();
  window->close();
  window = std::make_unique<MainWindow>();
  window->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
  EXPECT_LE(window->width(), screen.width());
  EXPECT_LE(window->height(), screen.height());
  lines = window->findChild<QDockWidget*>("lines");
  EXPECT_TRUE(lines->isHidden()) << "the layout is remembered";
  window->addDockWidget(Qt::BottomDockWidgetArea, lines);
  QAction* reset = nullptr;
  for (QAction* a : window->findChildren<QAction*>())
    if (a->text() == "&Reset layout") reset = a;
  ASSERT_NE(reset, nullptr);
  reset->trigger();
  EXPECT_FALSE(lines->isHidden());
  EXPECT_EQ(window->dockWidgetArea(lines), area);
}

}  // namespace
}  // namespace arris::ui
