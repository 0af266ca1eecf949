// Finding what is left, in the whole window. Needs a display (Xvfb will do).

#include <gtest/gtest.h>
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QTreeWidget>

#include "core/mesh/write_ply.h"
#include "core/partitions/interactive_treatments.h"
#include "tests/support/meshes.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/controls.h"
#include "ui/panels/corrections_panel.h"
#include "ui/panels/explanation_panel.h"
#include "ui/panels/profile_chart.h"
#include "ui/panels/worklist_panel.h"

namespace arris::ui {
namespace {

/// A box of 10 mm with its twelve lines found.
class GuidanceTest : public MainWindowTest {
 protected:
  void SetUp() override {
    MainWindowTest::SetUp();
    const MeshPtr mesh = testing::mesh_of(testing::divided_cube(10.0, 10));
    const QString path = folder.filePath("box.ply");
    ASSERT_TRUE(write_ply(path.toStdString(), *mesh, {}));
    window->open(path);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !document().empty() && idle(); }, patience));
    run({{"find_sharp_lines", nlohmann::json::object()},
         {"find_partitions", nlohmann::json::object()}});
    ASSERT_EQ(document().lines.lines.size(), 12u);
  }
  void run(std::vector<Operation> operations) {
    window->session().run(std::move(operations));
    ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  }
  /// Half of a line is taken away: a loose end in the middle of an edge of the box.
  void make_loose_end() {
    const Line& line = *document().lines.lines.front();
    end = line.vertices[line.vertices.size() / 2];
    run({{"trim_line", {{"line", line.id}, {"vertex", end}, {"side", "last"}}}});
  }
  void bring_up(const char* dock) {
    window->findChild<QDockWidget*>(dock)->raise();
    ASSERT_TRUE(comes_to_rest());
  }
  double sharp_length() const {
    double length = 0.0;
    for (const LinePtr& line : document().lines.lines) length += line->length;
    return length;
  }

  QTemporaryDir folder;
  VertexId end = no_id;
};

TEST_F(GuidanceTest, ALooseEndIsListedZoomedToAndClosedByOneKey) {
  make_loose_end();
  EXPECT_LT(sharp_length(), 119.0);
  const Point towards = window->view().towards_viewer();
  const QImage before = window->view().grabFramebuffer();
  QTest::keyClick(window.get(), Qt::Key_F7);  // brings the list up and goes to its first row
  auto* panel = window->findChild<WorklistPanel*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->current_row() >= 0; }, patience));
  EXPECT_TRUE(panel->isVisible());
  const auto& items = window->worklist().items();
  const auto loose = std::find_if(items.begin(), items.end(), [](const WorkItem& item) {
    return item.kind == WorkKind::loose_end;
  });
  ASSERT_NE(loose, items.end());
  EXPECT_EQ(loose->vertices.front(), end);
  while (items[static_cast<std::size_t>(panel->current_row())].kind != WorkKind::loose_end)
    QTest::keyClick(window.get(), Qt::Key_F7);
  ASSERT_TRUE(comes_to_rest());
  EXPECT_NE(window->view().grabFramebuffer(), before);
  // What is in the middle of the view is near the loose end now, whatever side it was on.
  const auto pick = window->view().pick(window->view().rect().center());
  ASSERT_TRUE(pick);
  EXPECT_LT((pick->point - document().mesh->point(end)).norm(), 5.0) << towards;

  const std::size_t ran = rows();
  QTest::keyClick(window.get(), Qt::Key_A);
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == ran + 1 && idle(); }, patience));
  EXPECT_EQ(window->session().history().entries().back().operation.name, "draw_line");
  EXPECT_NEAR(sharp_length(), 120.0, 1e-9);
  // With the gap closed nothing is left of the loose end.
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->worklist().is_current(); }, patience));
  for (const WorkItem& item : window->worklist().items())
    EXPECT_NE(item.kind, WorkKind::loose_end) << item.sentence;
}

TEST_F(GuidanceTest, AcceptingALeakIsOneUndoAndPartsWhatItTouches) {
  // Two gaps in one edge of the box, through both of which two sides run into one.
  const Line& line = *document().lines.lines.front();
  const std::vector<VertexId> path = line.vertices;
  ASSERT_EQ(path.size(), 11u);
  const auto stretch = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    return std::vector<VertexId>(path.begin() + from, path.begin() + to + 1);
  };
  run({{"delete_lines", {{"lines", {line.id}}}},
       {"draw_line", {{"paths", {stretch(0, 2), stretch(4, 6), stretch(8, 10)}}}},
       {"find_partitions", {{"method", "fronts"}, {"intervals", {{0.0, 1e9}}}, {"min_faces", 1}}}});
  ASSERT_EQ(document().partitions.partitions.size(), 5u);
  const std::string before = hash_of(document());
  const std::uint32_t ran = rows();
  QTest::keyClick(window.get(), Qt::Key_F7);
  auto* panel = window->findChild<WorklistPanel*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->current_row() >= 0; }, patience));
  const WorkItem& leak = window->worklist().items()[0];
  ASSERT_EQ(leak.kind, WorkKind::leak) << leak.sentence;
  ASSERT_EQ(leak.paths.size(), 2u);
  QTest::keyClick(window.get(), Qt::Key_A);
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() > ran && idle(); }, patience));
  EXPECT_EQ(rows(), ran + 1) << "one entry of the history for both gaps";
  EXPECT_EQ(document().partitions.partitions.size(), 6u) << "without F5";
  EXPECT_FALSE(document().step("find_partitions")->out_of_date);
  EXPECT_NEAR(sharp_length(), 120.0, 1e-9);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->worklist().is_current(); }, patience));
  EXPECT_TRUE(std::ranges::none_of(window->worklist().items(), is_left));
  QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && hash_of(document()) == before; }, patience));
}

TEST_F(GuidanceTest, SevenAcceptsInARowLeaveNoDoubledLine) {
  // Every edge of the box with a gap in its middle.
  std::vector<Operation> operations;
  std::vector<std::vector<VertexId>> stubs;
  std::vector<std::uint32_t> ids;
  for (const LinePtr& line : document().lines.lines) {
    const std::vector<VertexId>& path = line->vertices;
    stubs.emplace_back(path.begin(), path.begin() + 5);
    stubs.emplace_back(path.begin() + 7, path.end());
    ids.push_back(line->id);
  }
  run({{"delete_lines", {{"lines", ids}}},
       {"draw_line", {{"paths", stubs}}},
       {"find_partitions", {{"method", "fronts"}, {"intervals", {{0.0, 1e9}}}, {"min_faces", 1}}}});
  QTest::keyClick(window.get(), Qt::Key_F7);
  auto* panel = window->findChild<WorklistPanel*>();
  for (int k = 0; k < 7; ++k) {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return idle() && window->worklist().is_current() && panel->current_row() >= 0; },
        patience));
    if (!is_left(window->worklist().items()[static_cast<std::size_t>(panel->current_row())])) break;
    QTest::keyClick(window.get(), Qt::Key_A);
    ASSERT_TRUE(QTest::qWaitFor([&] { return idle(); }, patience));
  }
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->worklist().is_current(); }, patience));
  EXPECT_GT(sharp_length(), 96.0 + 12.0);
  // Lines run along the edges of the box alone: nowhere twice, nowhere across a side.
  const Mesh& mesh = *document().mesh;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (!document().lines.is_sharp(e)) continue;
    const Point middle = (mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0;
    int on_sides = 0;
    for (int axis = 0; axis < 3; ++axis)
      on_sides += middle[axis] == mesh.box_min()[axis] || middle[axis] == mesh.box_max()[axis];
    EXPECT_GE(on_sides, 2) << middle.transpose();
  }
}

TEST_F(GuidanceTest, TheWorklistIsDismissedByKeyAndBySizeAndCountsAgree) {
  make_loose_end();
  QTest::keyClick(window.get(), Qt::Key_F7);
  auto* panel = window->findChild<WorklistPanel*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->current_row() >= 0; }, patience));
  const auto left = [&] { return std::ranges::count_if(window->worklist().items(), is_left); };
  const auto said = [&](const QString& text) {
    for (const auto* label : panel->findChildren<QLabel*>())
      if (label->text().contains(text)) return true;
    return false;
  };
  const auto count = left();
  ASSERT_GE(count, 1);
  QAction* dismiss = nullptr;
  for (QAction* a : window->findChildren<QAction*>())
    if (a->text() == "&Dismiss") dismiss = a;
  ASSERT_TRUE(dismiss);
  EXPECT_TRUE(dismiss->isEnabled());
  QTest::keyClick(window.get(), Qt::Key_A, Qt::ShiftModifier);
  EXPECT_EQ(left(), count - 1);
  EXPECT_TRUE(said("(1 dismissed)"));
  window->worklist().bring_back();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->worklist().is_current(); }, patience));
  EXPECT_EQ(left(), count);
  EXPECT_FALSE(said("dismissed)"));
  // All under a size at once: larger than the box, so that nothing stays.
  auto* under = panel->findChild<NumberBox*>();
  under->setFocus();
  under->selectAll();
  QTest::keyClicks(under, "1000");
  for (auto* button : panel->findChildren<QPushButton*>())
    if (button->text() == "Dismiss all under") QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(left(), 0);
  EXPECT_TRUE(said(QString("(%1 dismissed)").arg(count)));
  EXPECT_TRUE(said("nothing left"));
}

TEST_F(GuidanceTest, NumberKeysTurnTheViewUnlessThereIsAChoice) {
  make_loose_end();
  QTest::keyClick(window.get(), Qt::Key_F7);
  auto* panel = window->findChild<WorklistPanel*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->current_row() >= 0; }, patience));
  auto* list = panel->findChild<QTreeWidget*>();
  list->setFocus();
  const auto& items = window->worklist().items();
  const auto alone = std::ranges::find_if(
      items, [](const WorkItem& item) { return item.continuations.size() <= 1; });
  ASSERT_NE(alone, items.end());
  while (panel->current_row() != alone - items.begin()) QTest::keyClick(window.get(), Qt::Key_F7);
  list->setFocus();
  QTest::keyClick(list, Qt::Key_5);
  EXPECT_LT((window->view().towards_viewer() - Point::UnitZ()).norm(), 1e-9);
  QTest::keyClick(list, Qt::Key_1);
  EXPECT_LT((window->view().towards_viewer() + Point::UnitY()).norm(), 1e-9);
}

TEST_F(GuidanceTest, NumberKeysChooseAmongTheWaysOfTheCurrentRow) {
  WorklistPanel panel;
  panel.set_rows({{"Loose ends", "one", {"to line 1", "to line 2"}}, {"Loose ends", "other", {}}});
  panel.show();
  auto* list = panel.findChild<QTreeWidget*>();
  std::vector<std::pair<int, int>> chosen;
  QObject::connect(&panel, &WorklistPanel::current_changed, &panel,
                   [&](int row, int choice) { chosen.emplace_back(row, choice); });
  panel.set_current(0);
  QTest::keyClick(list, Qt::Key_2);
  QTest::keyClick(list, Qt::Key_3);  // there is no third
  EXPECT_EQ(chosen, (std::vector<std::pair<int, int>>{{0, 1}}));
  EXPECT_EQ(panel.current_choice(), 1);
  panel.set_current(1);
  QTest::keyClick(list, Qt::Key_1);
  EXPECT_EQ(chosen.size(), 1u);
}

TEST_F(GuidanceTest, WhatIsChosenInATableComesIntoSight) {
  window->view().look_from(MeshView::StandardView::front);
  auto* table = window->findChild<QDockWidget*>("lines")->findChild<QTableView*>();
  window->findChild<QDockWidget*>("lines")->raise();
  ASSERT_TRUE(comes_to_rest());
  for (int row = 0; row < table->model()->rowCount(); ++row) {
    const QRect cell = table->visualRect(table->model()->index(row, 0));
    table->scrollTo(table->model()->index(row, 0));
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                      table->visualRect(table->model()->index(row, 0)).center());
    ASSERT_EQ(window->elements().selected_lines().size(), 1u) << cell.x();
    const Line* line = document().lines.find(*window->elements().selected_lines().begin());
    EXPECT_TRUE(window->view().sees(line->vertices)) << row;
  }
}

TEST_F(GuidanceTest, PartitionsFoundBeforeTheLinesChangedStayInViewGreyed) {
  window->view().set_lines_visible(false);
  QTest::keyClick(window.get(), Qt::Key_P);
  const auto saturation = [&] {
    const QImage image = window->view().grabFramebuffer();
    return image.pixelColor(image.width() / 2, image.height() / 2 + 20).hsvSaturationF();
  };
  window->view().look_from(MeshView::StandardView::front);
  const auto before = saturation();
  ASSERT_GT(before, 0.15F);
  const std::size_t count = document().partitions.partitions.size();
  run({{"find_sharp_lines", {{"angle", 40.0}}}});
  EXPECT_EQ(document().partitions.partitions.size(), count);
  EXPECT_LT(saturation(), 0.7F * before);
  EXPECT_GT(saturation(), 0.02F);
  run({{"find_partitions", document().step("find_partitions")->parameters}});
  EXPECT_GT(saturation(), 0.9F * before);
}

TEST_F(GuidanceTest, UnassignedAreasAreFilledFromTheMenuWithAPreview) {
  const Mesh& mesh = *document().mesh;
  const std::vector<FaceId> faces =
      faces_of(mesh, document().partitions, *document().partitions.partitions[0]);
  const VertexId inside = mesh.triangle(faces[faces.size() / 2])[0];
  run({{"paint_partition",
        {{"partition", 0u}, {"region", {{"vertices", {inside}}, {"radius", 1.2}}}}}});
  ASSERT_LT(assigned_share(document()), 1.0);
  const std::uint32_t before = rows();
  QTest::keyClick(window.get(), Qt::Key_I, Qt::ShiftModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->session().is_previewing(); }, patience));
  EXPECT_NEAR(assigned_share(shown()), 1.0, 1e-9);
  EXPECT_LT(assigned_share(document()), 1.0);
  QTest::keyClick(window.get(), Qt::Key_Return);
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == before + 1 && idle(); }, patience));
  EXPECT_NEAR(assigned_share(document()), 1.0, 1e-9);
}

TEST_F(GuidanceTest, WhatIsDismissedStaysOffTheList) {
  make_loose_end();
  QTest::keyClick(window.get(), Qt::Key_F7);
  auto* panel = window->findChild<WorklistPanel*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->current_row() >= 0; }, patience));
  const std::size_t count = window->worklist().items().size();
  const std::string sentence = window->worklist().items()[0].sentence;
  window->worklist().dismiss();
  EXPECT_EQ(window->worklist().items().size(), count - 1);
  // Another edit elsewhere: the list is made anew, without it.
  run({{"smooth_curvature", {{"passes", 1}}}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->worklist().is_current(); }, patience));
  for (const WorkItem& item : window->worklist().items()) EXPECT_NE(item.sentence, sentence);
  window->worklist().bring_back();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        return window->worklist().is_current() &&
               std::ranges::count(window->worklist().items(), sentence, &WorkItem::sentence) == 1;
      },
      patience));
}

TEST_F(MainWindowTest, CutsForFourSidesAreWorkedOutForWhatIsLookedAtAndAccepted) {
  open_sample();
  run_both();
  window->findChild<QDockWidget*>("worklist")->raise();
  auto* panel = window->findChild<WorklistPanel*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->worklist().is_current(); }, patience));
  const auto& items = window->worklist().items();
  EXPECT_LE(std::ranges::count_if(items, is_left), 5) << "the first picture a newcomer sees";
  const auto many =
      std::ranges::find_if(items, [](const WorkItem& item) { return !is_left(item); });
  ASSERT_NE(many, items.end());
  EXPECT_TRUE(many->paths.empty());
  const std::string sentence = many->sentence;
  const std::uint32_t partition = many->partitions.at(0);
  const std::size_t found = document().partitions.partitions.size();
  const auto row = static_cast<int>(many - items.begin());
  // Up from the first row to the one before it: the last ones are those to be cut.
  while (panel->current_row() != row) window->worklist().previous();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return items[static_cast<std::size_t>(row)].sentence != sentence; }, patience));
  EXPECT_FALSE(items[static_cast<std::size_t>(row)].paths.empty());
  const std::uint32_t before = rows();
  window->worklist().accept();
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == before + 1 && idle(); }, patience));
  EXPECT_GT(document().partitions.partitions.size(), found);
  const auto& operation = window->session().history().entries().back().operation;
  EXPECT_EQ(operation.name, "split_to_four_sides");
  EXPECT_EQ(operation.parameters.at("partitions"), nlohmann::json({partition}));
}

TEST_F(GuidanceTest, NothingIsWorkedOutWhileNobodyLooks) {
  make_loose_end();
  QTest::qWait(800);  // nothing may happen in this time: a list that is seen is begun after 400
  EXPECT_TRUE(window->worklist().items().empty());
}

TEST_F(GuidanceTest, AnEdgeOnALineAndOneOffItAreExplained) {
  auto* panel = window->findChild<ExplanationPanel*>();
  const Line& line = *document().lines.lines.front();
  Pick pick;
  pick.edge = *document().mesh->find_edge(line.vertices[3], line.vertices[4]);
  pick.face = document().mesh->edge_faces(pick.edge)[0];
  window->explanations().explain(pick);
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->text().contains("On line"); }, patience))
      << panel->text().toStdString();
  EXPECT_TRUE(panel->isVisible());
  EXPECT_TRUE(panel->text().contains("In partition"));
  EXPECT_TRUE(panel->text().contains("Exterior angle"));
  EXPECT_TRUE(panel->text().contains("90°"));
  run({{"find_sharp_lines", {{"method", "walk"}}}});
  ASSERT_EQ(document().lines.lines.size(), 12u);
  window->explanations().explain(pick);
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->text().contains("|IHe|"); }, patience));
  EXPECT_TRUE(panel->text().contains("90°"));
  EXPECT_FALSE(panel->findChild<ProfileChart*>()->isVisible()) << "the walk measures no profile";

  for (EdgeId e = 0; e < document().mesh->edge_count(); ++e)
    if (std::abs(document().curvatures->beta[e]) < 1e-9 && !document().lines.is_sharp(e)) {
      pick.edge = e;
      break;
    }
  window->explanations().explain(pick);
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->text().contains("Not on a line"); }, patience));
  EXPECT_TRUE(panel->text().contains("failed"));
}

TEST_F(MainWindowTest, TheProfileAcrossALineOfAScanIsShown) {
  open_sample();
  run_both();
  window->findChild<QDockWidget*>("explanation")->raise();
  auto* panel = window->findChild<ExplanationPanel*>();
  auto* chart = panel->findChild<ProfileChart*>();
  EXPECT_FALSE(chart->isVisible());
  const auto on_line = find([&](const Pick& p) {
    if (p.edge == no_id || !document().lines.is_sharp(p.edge)) return false;
    const BorderEdge* border = document().evidence->known()->candidates.find(p.edge);
    return border && std::abs(border->place.jump) > 50.0F;
  });
  ASSERT_TRUE(on_line);
  const Pick pick = *window->view().pick(*on_line);
  const BorderPlace place = document().evidence->known()->candidates.find(pick.edge)->place;
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, *on_line);
  panel->window()->findChild<QDockWidget*>("explanation")->raise();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel->text().contains("On line"); }, patience))
      << panel->text().toStdString();
  EXPECT_TRUE(panel->text().contains("Normal jump"));
  EXPECT_TRUE(panel->text().contains("Jump to turn"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return chart->isVisible(); }, patience));
  EXPECT_GE(chart->width(), 260);
  EXPECT_GE(chart->height(), 160);
  ASSERT_TRUE(chart->profile() && chart->profile()->fitted());
  EXPECT_GT(chart->profile()->dots.size(), 15u);
  EXPECT_NEAR(chart->profile()->jump(), place.jump, 0.01) << "one value per meaning";
  const QString folder = qEnvironmentVariable("ARRIS_SHOTS");
  if (!folder.isEmpty()) {
    ASSERT_TRUE(comes_to_rest());
    window->grab().save(QDir(folder).filePath("explain_profile.png"));
    QTest::keyClick(window.get(), Qt::Key_D, Qt::ControlModifier);
    ASSERT_TRUE(comes_to_rest());
    window->grab().save(QDir(folder).filePath("explain_profile_dark.png"));
    QTest::keyClick(window.get(), Qt::Key_D, Qt::ControlModifier);
  }
  // Where nothing is drawn any more nothing is shown.
  run({"find_sharp_lines", {{"method", "walk"}}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !chart->isVisible(); }, patience));
}

TEST_F(GuidanceTest, ALiftedDeletionBringsTheLineBack) {
  const std::string before = hash_of(document());
  const std::uint32_t line = document().lines.lines.front()->id;
  run({{"delete_lines", {{"lines", {line}}}}});
  ASSERT_LT(sharp_length(), 119.0);
  bring_up("corrections");
  auto* panel = window->findChild<CorrectionsPanel*>();
  auto* list = panel->findChild<QTreeWidget*>();
  ASSERT_EQ(list->topLevelItemCount(), 1);
  EXPECT_TRUE(list->topLevelItem(0)->text(0).startsWith("Delete line"));
  EXPECT_EQ(list->topLevelItem(0)->text(1), "applied");
  list->setCurrentItem(list->topLevelItem(0));
  const auto button = [&](const QString& text) {
    for (auto* b : panel->findChildren<QPushButton*>())
      if (b->text() == text) return b;
    return static_cast<QPushButton*>(nullptr);
  };
  QTest::mouseClick(button("Show"), Qt::LeftButton);
  QTest::mouseClick(button("Lift"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && document().corrections.empty(); }, patience));
  EXPECT_NEAR(sharp_length(), 120.0, 1e-9);
  EXPECT_EQ(list->topLevelItemCount(), 0);
}

TEST_F(GuidanceTest, CorrectionsCanBeLeftOutWhenFindingAgain) {
  run({{"delete_lines", {{"lines", {document().lines.lines.front()->id}}}}});
  bring_up("corrections");
  auto* panel = window->findChild<CorrectionsPanel*>();
  auto* list = panel->findChild<QTreeWidget*>();
  panel->findChild<QCheckBox*>()->setChecked(false);
  run({{"find_sharp_lines", nlohmann::json::object()}});
  EXPECT_NEAR(sharp_length(), 120.0, 1e-9);
  EXPECT_EQ(list->topLevelItem(0)->text(1), "off");
  panel->findChild<QCheckBox*>()->setChecked(true);
  run({{"find_sharp_lines", nlohmann::json::object()}});
  EXPECT_LT(sharp_length(), 119.0);
  EXPECT_EQ(list->topLevelItem(0)->text(1), "applied");
}

TEST_F(GuidanceTest, TheStabilityCurveTellsHowManyLinesAThresholdWouldGive) {
  window->set_field(Field::ihe);
  HistogramPanel& histogram = window->histogram();
  EXPECT_TRUE(histogram.curve().label.isEmpty()) << "lines are not found by IHe";
  window->set_field(Field::normal_jump);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !histogram.curve().points.empty(); }, patience));
  EXPECT_EQ(histogram.curve().label, "lines");
  // A box has its twelve lines at any threshold below a right angle.
  for (const QPointF& point : histogram.curve().points) {
    if (point.x() < 89.0) {
      EXPECT_EQ(point.y(), 12.0) << point.x();
    }
  }
  ASSERT_TRUE(histogram.curve().plateau);
  EXPECT_GT(histogram.curve().plateau->second, histogram.curve().plateau->first);

  // Another threshold changes nothing; the switch does.
  window->session().preview({"find_sharp_lines", {{"angle", 50.0}}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->session().is_previewing(); }, patience));
  EXPECT_FALSE(histogram.curve().points.empty());
  window->session().cancel_preview();
  for (QAction* action : histogram.actions()) action->trigger();
  EXPECT_TRUE(histogram.curve().points.empty());
}

}  // namespace
}  // namespace arris::ui
