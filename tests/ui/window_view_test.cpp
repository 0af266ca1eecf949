// What of the part is shown, and the tools of the view, from the menus and keys of the window.

#include <QAction>
#include <QClipboard>
#include <QDockWidget>
#include <QLabel>
#include <QTableView>

#include "core/simplification/occupancy.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/element_table.h"
#include "ui/panels/section_bar.h"
#include "ui/panels/steps_panel.h"
#include "ui/window/tab_order.h"

namespace arris::ui {
namespace {

class WindowViewTest : public MainWindowTest {
 protected:
  QAction* named(const QString& start) {
    for (QAction* action : window->findChildren<QAction*>())
      if (QString(action->text()).remove('&').startsWith(start)) return action;
    ADD_FAILURE() << "no action " << start.toStdString();
    return nullptr;
  }
  void run(const std::string& step) {
    const std::uint32_t before = rows();
    window->session().run({Operation{step, nlohmann::json::object()}});
    ASSERT_TRUE(QTest::qWaitFor([&] { return rows() == before + 1 && idle(); }, patience));
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    QTest::keyClick(window.get(), key, modifiers);
  }
  MeshView& view() { return window->view(); }
};

TEST_F(WindowViewTest, DeviationComesWithTheErrorZones) {
  open_sample();
  QAction* deviation = named("Deviation");
  ASSERT_NE(deviation, nullptr);
  EXPECT_FALSE(deviation->isEnabled());
  EXPECT_TRUE(deviation->toolTip().contains("Simplify"));
  window->set_field(Field::deviation);
  EXPECT_NE(window->fields().field(), Field::deviation);
  run("simplify");
  EXPECT_TRUE(deviation->isEnabled());
  deviation->trigger();
  ASSERT_EQ(window->fields().field(), Field::deviation);
  const Occupancy occupancy = occupancy_of(*document().mesh, *document().zones);
  EXPECT_NEAR(window->fields().distribution().max(), 100.0 * occupancy.worst.share, 1e-9);
  EXPECT_EQ(window->fields().scale().max, 100.0);
  key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !document().zones && idle(); }, patience));
  EXPECT_EQ(window->fields().field(), Field::kabs) << "without zones there is nothing to show";
  EXPECT_FALSE(deviation->isEnabled());
  window->set_field(Field::face_quality);
  EXPECT_EQ(window->fields().field(), Field::face_quality);
  EXPECT_LE(window->fields().distribution().max(), 1.0);
}

TEST_F(WindowViewTest, ScanAndWorkingMeshSwitchByAKeyWhereTheyDiffer) {
  open_sample();
  QAction* change = named("Switch between");
  QAction* both = named("Both, blended");
  ASSERT_TRUE(change && both);
  EXPECT_FALSE(change->isEnabled());
  EXPECT_TRUE(change->toolTip().contains("nothing was simplified"));
  run("simplify");
  EXPECT_TRUE(change->isEnabled());
  const QImage mesh = view().grabFramebuffer();
  key(Qt::Key_W);
  EXPECT_EQ(view().surface(), ShownSurface::reference);
  EXPECT_NE(view().grabFramebuffer(), mesh);
  key(Qt::Key_W);
  EXPECT_EQ(view().surface(), ShownSurface::mesh);
  both->trigger();
  EXPECT_EQ(view().surface(), ShownSurface::both);
  EXPECT_TRUE(both->isChecked());
  // Finding lines changes no mesh: what is shown stays.
  run("find_sharp_lines");
  EXPECT_EQ(view().surface(), ShownSurface::both);
  window->session().travel(1);
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle() && !document().step("simplify"); }, patience));
  EXPECT_EQ(view().surface(), ShownSurface::mesh);
  EXPECT_FALSE(both->isEnabled());
}

TEST_F(WindowViewTest, PartitionsHideIsolateAndComeBack) {
  open_sample();
  run_both();
  QAction* hide = named("Hide selected");
  QAction* all = named("Show all partitions");
  EXPECT_FALSE(hide->isEnabled());
  EXPECT_TRUE(hide->toolTip().contains("Select partitions first"));
  const auto at =
      find([&](const Pick& p) { return p.line == 0 && document().partitions.label(p.face) != 0; });
  ASSERT_TRUE(at);
  const std::uint32_t id = document().partitions.label(view().pick(*at)->face);
  const Point there = view().pick(*at)->point;
  const auto id_there = [&] {
    const auto pick = view().pick(*at);
    return pick && pick->face != no_id ? document().partitions.label(pick->face) : 0;
  };
  QTest::mouseClick(&view(), Qt::LeftButton, {}, *at);
  EXPECT_TRUE(hide->isEnabled());
  key(Qt::Key_H);
  EXPECT_NE(id_there(), id);
  EXPECT_TRUE(window->elements().selected_partitions().empty());
  EXPECT_TRUE(all->isEnabled());
  key(Qt::Key_H, Qt::ShiftModifier);
  EXPECT_EQ(id_there(), id);
  EXPECT_FALSE(all->isEnabled());

  QTest::mouseClick(&view(), Qt::LeftButton, {}, *at);
  key(Qt::Key_I);
  for (int y = 4; y < view().height(); y += 12)
    for (int x = 4; x < view().width(); x += 12)
      if (const auto pick = view().pick({x, y}); pick && pick->face != no_id) {
        EXPECT_EQ(document().partitions.label(pick->face), id);
      }
  // Its partitions gone, nothing is hidden.
  window->session().travel(1);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return idle() && !document().step("find_partitions"); }, patience));
  EXPECT_FALSE(window->elements().hides_any());
  // The fitted part may have made room for the scalar bar, which is there again.
  EXPECT_TRUE(
      find([&](const Pick& p) { return p.face != no_id && (p.point - there).norm() < 2.0; }));
}

TEST_F(WindowViewTest, WhatIsHiddenIsHiddenOnTheScanToo) {
  open_sample();
  run_paper_flow();  // the working mesh is another one than the scan
  const auto at = find([&](const Pick& p) {
    return p.line == 0 && p.face != no_id && document().partitions.label(p.face) != 0;
  });
  ASSERT_TRUE(at);
  PictureOptions options;
  options.size = view().size();
  options.scalar_bar = options.scale_bar = options.orientation_marker = false;
  key(Qt::Key_W);
  ASSERT_EQ(view().surface(), ShownSurface::reference);
  const auto part_pixels = [&] {
    const QImage image = view().picture(options);
    qint64 count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y) != QColor(Qt::white);
    return count;
  };
  const qint64 whole = part_pixels();
  window->elements().select({}, {document().partitions.label(view().pick(*at)->face)});
  key(Qt::Key_H);
  EXPECT_TRUE(QTest::qWaitFor([&] { return part_pixels() < whole - 2000; }, patience));
  key(Qt::Key_H, Qt::ShiftModifier);
  EXPECT_EQ(part_pixels(), whole);
}

TEST_F(WindowViewTest, ARectangleSelectsLinesInTheirTable) {
  open_sample();
  run("find_sharp_lines");
  QTest::keyClick(window.get(), Qt::Key_R);
  ASSERT_EQ(view().tool(), Tool::band);
  EXPECT_TRUE(named("Select by rectangle")->isChecked());
  const auto drag = [&](Qt::KeyboardModifiers modifiers) {
    const QPoint to(view().width() - 3, view().height() - 3);
    QTest::mousePress(&view(), Qt::LeftButton, modifiers, {2, 2});
    for (int k = 1; k <= 4; ++k) QTest::mouseMove(&view(), to * k / 4);
    QTest::mouseRelease(&view(), Qt::LeftButton, modifiers, to);
  };
  drag({});
  const auto selected = window->elements().selected_lines();
  EXPECT_GT(selected.size(), 3u);
  for (const std::uint32_t id : selected) EXPECT_TRUE(document().lines.find(id));
  drag(Qt::ControlModifier);
  EXPECT_TRUE(window->elements().selected_lines().empty()) << "Ctrl takes them out again";
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(view().tool(), Tool::select);
  EXPECT_FALSE(named("Select by rectangle")->isChecked());
}

TEST_F(WindowViewTest, TheSectionMovesFlipsAndGoes) {
  open_sample();
  auto* bar = window->findChild<SectionBar*>();
  ASSERT_NE(bar, nullptr);
  EXPECT_FALSE(bar->isVisible());
  EXPECT_FALSE(named("Flip")->isEnabled() && named("Flip")->shortcut() == QKeySequence("Shift+F"));
  key(Qt::Key_X, Qt::ShiftModifier);
  ASSERT_TRUE(view().section());
  EXPECT_TRUE(bar->isVisible());
  EXPECT_NEAR(std::abs(view().section()->normal.x()), 1.0, 1e-12);
  const Mesh& mesh = *document().mesh;
  EXPECT_NEAR(bar->position(), (mesh.box_min().x() + mesh.box_max().x()) / 2,
              1e-3 * mesh.diagonal());
  // The side towards the viewer is cut away, so that the cut is seen.
  EXPECT_GE(view().section()->normal.dot(view().towards_viewer()), 0.0);
  const Section before = *view().section();
  key(Qt::Key_F, Qt::ShiftModifier);
  EXPECT_EQ(view().section()->normal, Point(-before.normal));
  emit bar->moved(mesh.box_min().x() + 1.0);
  EXPECT_NEAR(std::abs(view().section()->offset), std::abs(mesh.box_min().x() + 1.0), 1e-9);
  key(Qt::Key_O, Qt::ShiftModifier);
  EXPECT_FALSE(view().section());
  EXPECT_FALSE(bar->isVisible());
}

TEST_F(WindowViewTest, AThroughThreePointsSectionPassesThroughThem) {
  open_sample();
  key(Qt::Key_T, Qt::ShiftModifier);
  ASSERT_EQ(view().tool(), Tool::path);
  std::vector<Point> points;
  const QPoint middle = view().rect().center();
  for (const QPoint by : {QPoint(-60, 0), QPoint(50, 20), QPoint(0, -50)}) {
    const auto pick = view().pick(middle + by);
    ASSERT_TRUE(pick && pick->face != no_id);
    points.push_back(pick->point);
    QTest::mouseClick(&view(), Qt::LeftButton, {}, middle + by);
  }
  ASSERT_TRUE(view().section());
  EXPECT_EQ(view().tool(), Tool::select);
  for (const Point& point : points)
    EXPECT_NEAR(view().section()->normal.dot(point), view().section()->offset, 1e-9);
  // Esc while picking leaves what is there.
  const Section before = *view().section();
  key(Qt::Key_T, Qt::ShiftModifier);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, middle);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(view().section(), before);
}

TEST_F(WindowViewTest, AMeasurementCanBeCopied) {
  open_sample();
  QAction* copy = named("Copy measurement");
  EXPECT_FALSE(copy->isEnabled());
  key(Qt::Key_M);
  ASSERT_EQ(view().tool(), Tool::measure);
  const QPoint middle = view().rect().center();
  const auto a = view().pick(middle - QPoint(50, 0)), b = view().pick(middle + QPoint(50, 0));
  ASSERT_TRUE(a && b);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, middle - QPoint(50, 0));
  QTest::mouseClick(&view(), Qt::LeftButton, {}, middle + QPoint(50, 0));
  ASSERT_TRUE(copy->isEnabled());
  copy->trigger();
  const QString text = QApplication::clipboard()->text();
  EXPECT_NEAR(text.split(' ').first().toDouble(), (a->point - b->point).norm(), 0.001)
      << text.toStdString();
}

TEST_F(WindowViewTest, RimsOfFilletsAreSetOffAsTangentLines) {
  open_sample();
  run_both();
  key(Qt::Key_P);
  ElementTable* table = nullptr;
  for (ElementTable* candidate : window->findChildren<ElementTable*>())
    if (candidate->findChild<QTableView*>()->model()->columnCount() == 7) table = candidate;
  ASSERT_NE(table, nullptr);
  const QAbstractItemModel& rows = *table->findChild<QTableView*>()->model();
  const auto tangent = [&] {
    int count = 0;
    for (int k = 0; k < rows.rowCount(); ++k)
      if (rows.index(k, 1).data().toString() == "Gn, tangent") {
        ++count;
        EXPECT_GT(rows.index(k, 4).data().toDouble(), 0.0);
      }
    return count;
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return tangent() > 0; }, patience));
  const auto thin = [&] {  // pixels in the colour of tangent lines
    const QImage picture = view().grabFramebuffer();
    int count = 0;
    for (int y = 120; y < picture.height(); ++y)  // the legend is above
      for (int x = 0; x < picture.width(); ++x) {
        const QColor c = picture.pixelColor(x, y);
        count += c.red() < 60 && std::abs(c.green() - 132) < 40 && std::abs(c.blue() - 138) < 40;
      }
    return count;
  };
  const int before = thin();
  key(Qt::Key_T, Qt::ControlModifier);
  EXPECT_TRUE(QTest::qWaitFor([&] { return thin() > before + 100; }, 5000)) << thin();
  key(Qt::Key_T, Qt::ControlModifier);
  EXPECT_TRUE(QTest::qWaitFor([&] { return thin() == before; }, 5000)) << thin();
}

TEST_F(WindowViewTest, StepCardsTellWhatTheyDid) {
  open_sample();
  run("simplify");
  run("swap_edges");
  run("equilateralize");
  int reduced = 0, swapped = 0;
  for (const QLabel* label : window->findChild<StepsPanel*>()->findChildren<QLabel*>()) {
    reduced += label->text().contains("vertices, all within");
    swapped += label->text().contains("swapped") && label->text().contains("120°");
  }
  EXPECT_EQ(reduced, 1);
  EXPECT_EQ(swapped, 2);
}

TEST_F(MainWindowTest, ColoursOfAFieldAreUnlitAndFlatShadingCanBeChosenInTheMenu) {
  open_sample();
  const auto chosen = [&](const QString& text) -> QAction* {
    for (QAction* a : window->findChildren<QAction*>())
      if (a->text().remove('&') == text) return a;
    return nullptr;
  };
  QAction* light = chosen("Light on field colours");
  QAction* flat = chosen("Flat shading");
  ASSERT_TRUE(light && flat);
  EXPECT_FALSE(light->isChecked());
  EXPECT_FALSE(flat->isChecked());
  const QImage plain = window->view().grabFramebuffer();
  light->trigger();
  const QImage lit = window->view().grabFramebuffer();
  EXPECT_NE(lit, plain);
  light->trigger();
  EXPECT_EQ(window->view().grabFramebuffer(), plain);
  flat->trigger();
  EXPECT_EQ(window->view().grabFramebuffer(), plain) << "bare colours know no shading";
  light->trigger();
  EXPECT_NE(window->view().grabFramebuffer(), lit);
}

TEST_F(MainWindowTest, TheFittedPartIsClearOfBarAndLegendThroughoutAFirstRun) {
  window->resize(1024, 700);
  open_sample();
  const auto clear = [&](bool bar, bool legend) {
    MeshView& view = window->view();
    int hits = 0;
    for (int y = 20; y < 120; y += 5)
      for (int x = 20; x < 110; x += 5) {
        if (legend && y < 45) hits += view.pick({x, y}).has_value();
        if (bar) hits += view.pick({view.width() - x, y}).has_value();
      }
    return hits == 0;
  };
  EXPECT_TRUE(window->view().is_fitted());
  EXPECT_TRUE(clear(true, false));
  run_both();
  ASSERT_TRUE(comes_to_rest());
  EXPECT_TRUE(window->view().is_fitted());
  EXPECT_TRUE(clear(false, true));
  window->set_field(Field::kabs);
  ASSERT_TRUE(comes_to_rest());
  EXPECT_TRUE(clear(true, true)) << "a field was switched on";
  window->set_field(Field::shape);
  ASSERT_TRUE(comes_to_rest());
  EXPECT_TRUE(clear(true, true)) << "its legend is wider";
}

TEST_F(MainWindowTest, TabGoesThroughWhatIsOnTheScreenInItsOrder) {
  open_sample();
  run_both();
  window->view().setFocus();
  auto* ring = window->findChild<FocusRing*>();
  ASSERT_TRUE(ring);
  EXPECT_EQ(ring->widget(), nullptr) << "nobody has pressed Tab yet";
  std::vector<QWidget*> seen;
  const auto dock_of = [](QWidget* widget) -> QDockWidget* {
    for (QWidget* w = widget; w; w = w->parentWidget())
      if (auto* dock = qobject_cast<QDockWidget*>(w)) return dock;
    return nullptr;
  };
  for (int k = 0; k < 200; ++k) {
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
    QWidget* now = QApplication::focusWidget();
    ASSERT_TRUE(now);
    ASSERT_FALSE(now->visibleRegion().isEmpty()) << now->metaObject()->className();
    ASSERT_EQ(ring->widget(), now);
    ASSERT_TRUE(ring->isVisible());
    if (const QDockWidget* dock = dock_of(now)) {
      ASSERT_FALSE(dock->visibleRegion().isEmpty());
    }
    if (!seen.empty() && now == seen.front()) break;
    seen.push_back(now);
  }
  ASSERT_LT(seen.size(), 199u) << "it comes round";
  ASSERT_GT(seen.size(), 10u);
  EXPECT_NE(std::ranges::find(seen, static_cast<QWidget*>(&window->view())), seen.end());
  // From left to right, panel by panel: within the round each panel is one stretch.
  std::vector<QDockWidget*> docks;
  for (QWidget* widget : seen)
    if (QDockWidget* dock = dock_of(widget); dock && (docks.empty() || docks.back() != dock))
      docks.push_back(dock);
  std::vector<QDockWidget*> once = docks;
  std::ranges::sort(once);
  const auto twice = std::ranges::adjacent_find(once);
  EXPECT_TRUE(twice == once.end() || docks.front() == docks.back());
  // Backwards it is the same way.
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Backtab, Qt::ShiftModifier);
  EXPECT_EQ(QApplication::focusWidget(), seen.back());
  // A click takes the frame away.
  QTest::mouseClick(&window->view(), Qt::LeftButton, {}, QPoint(3, 3));
  window->view().setFocus();
  EXPECT_TRUE(ring->widget() == nullptr || ring->widget() == &window->view());
}

}  // namespace
}  // namespace arris::ui
