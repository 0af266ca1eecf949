// The tools of the view by real mouse and keyboard, sections, hidden faces, and the scan beside the
// working mesh.

#include "core/base/number_text.h"
#include "core/mesh/brush.h"
#include "tests/ui/view_fixture.h"

namespace arris::ui {
namespace {

class ViewToolsTest : public MeshViewTest {
 protected:
  /// A plane of 10 x 10 seen from above.
  void show_plane(double step = 1.0) {
    mesh_ = plane(10.0, step);
    view_.set_mesh(mesh_, false);
    view_.look_from(MeshView::StandardView::top);
    view_.set_scalar_bar_visible(false);  // the part stays where it is, whatever is shown on it
    view_.set_legend_visible(false);
    view_.pick(middle());  // from here on the search tree is there
  }
  /// Where a point of the plane is on the widget.
  QPoint place(double x, double y) {
    const Point origin = view_.pick(middle())->point;
    const double unit = (view_.pick(middle() + QPoint(50, 0))->point - origin).norm() / 50.0;
    const Point by = (mesh_->box_min() + Point(x, y, 0.0) - origin) / unit;
    return middle() + QPoint(qRound(by.x()), qRound(-by.y()));
  }
  void move(const QPoint& at, Qt::MouseButtons buttons = {}, Qt::KeyboardModifiers modifiers = {}) {
    QMouseEvent event(QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, buttons,
                      modifiers);
    QApplication::sendEvent(&view_, &event);
  }
  void press(const QPoint& at, Qt::KeyboardModifiers modifiers = {},
             Qt::MouseButton button = Qt::LeftButton) {
    QTest::mousePress(&view_, button, modifiers, at);
  }
  void release(const QPoint& at, Qt::KeyboardModifiers modifiers = {},
               Qt::MouseButton button = Qt::LeftButton) {
    QTest::mouseRelease(&view_, button, modifiers, at);
  }
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = {},
            Qt::MouseButton button = Qt::LeftButton) {
    press(from, modifiers, button);
    for (int k = 1; k <= 8; ++k) move(from + (to - from) * k / 8, button, modifiers);
    release(to, modifiers, button);
  }
  /// A line along y = `y` from x = 1 to 9.
  ViewLine line(std::uint32_t id, double y) {
    ViewLine result;
    result.id = id;
    for (const VertexId v : row(*mesh_, mesh_->box_min().y() + y)) {
      const double x = mesh_->point(v).x() - mesh_->box_min().x();
      if (x > 0.5 && x < 9.5) result.vertices.push_back(v);
    }
    return result;
  }
  static QColor pixel(const QImage& image, const QPoint& at) { return image.pixelColor(at); }

  MeshPtr mesh_;
};

using Ids = std::vector<std::uint32_t>;

TEST_F(ViewToolsTest, ARectangleTakesLinesThatAreAtLeastHalfInIt) {
  show_plane();
  view_.set_lines({line(1, 2), line(2, 4), line(3, 8)});
  QSignalSpy banded(&view_, &MeshView::banded);
  QSignalSpy clicked(&view_, &MeshView::clicked);
  // The whole of line 1, five eighths of line 2 and nothing of line 3: with Shift at any time.
  drag(place(0.2, 1.0), place(9.8, 5.0), Qt::ShiftModifier);
  ASSERT_EQ(banded.count(), 1);
  EXPECT_EQ(banded[0][0].value<Ids>(), (Ids{1, 2}));
  EXPECT_FALSE(banded[0][1].toBool());
  view_.set_tool(Tool::band);
  drag(place(0.2, 1.0), place(6.2, 9.5), Qt::ControlModifier);
  ASSERT_EQ(banded.count(), 2);
  EXPECT_EQ(banded[1][0].value<Ids>(), (Ids{1, 2, 3}));
  EXPECT_TRUE(banded[1][1].toBool());
  drag(place(0.2, 1.0), place(4.2, 9.5));
  ASSERT_EQ(banded.count(), 3);
  EXPECT_TRUE(banded[2][0].value<Ids>().empty()) << "less than half";
  // From right to left, and upwards.
  drag(place(9.8, 0.5), place(0.2, 3.0));
  EXPECT_EQ(banded[3][0].value<Ids>(), Ids{1});
  EXPECT_EQ(clicked.count(), 0);
  view_.set_lines_visible(false);
  drag(place(0.2, 0.5), place(9.8, 9.5));
  EXPECT_TRUE(banded[4][0].value<Ids>().empty()) << "lines that are not shown";
}

TEST_F(ViewToolsTest, ARectangleLeavesLinesBehindThePartAlone) {
  mesh_ = mesh_of(testing::divided_cube(10.0, 10));
  view_.set_mesh(mesh_, false);
  std::vector<ViewLine> lines(2);
  for (VertexId v = 0; v < mesh_->vertex_count(); ++v) {
    const Point& p = mesh_->point(v);
    if (p.y() != 5.0 || p.x() < 0.5 || p.x() > 9.5) continue;
    if (p.z() == 10.0) lines[0].vertices.push_back(v);
    if (p.z() == 0.0) lines[1].vertices.push_back(v);
  }
  for (ViewLine& l : lines) {
    std::sort(l.vertices.begin(), l.vertices.end(),
              [&](VertexId a, VertexId b) { return mesh_->point(a).x() < mesh_->point(b).x(); });
    l.id = static_cast<std::uint32_t>(&l - lines.data()) + 1;
  }
  view_.set_lines(lines);
  QSignalSpy banded(&view_, &MeshView::banded);
  for (const auto& [side, expected] : {std::pair{MeshView::StandardView::top, 1u},
                                       std::pair{MeshView::StandardView::bottom, 2u}}) {
    view_.look_from(side);
    banded.clear();
    drag({2, 2}, {view_.width() - 3, view_.height() - 3}, Qt::ShiftModifier);
    ASSERT_EQ(banded.count(), 1);
    EXPECT_EQ(banded[0][0].value<Ids>(), Ids{expected});
  }
}

TEST_F(ViewToolsTest, TheBrushTellsVerticesAlongItsWay) {
  show_plane(0.1);
  view_.set_tool(Tool::brush);
  view_.set_brush_radius(0.8);
  QSignalSpy brushed(&view_, &MeshView::brushed);
  const QImage before = view_.picture(bare({500, 400}));
  const QPoint from = place(2, 5), to = place(8, 5);
  press(from);
  // As fast as it may come: one event for the whole way.
  move(to, Qt::LeftButton);
  EXPECT_GT(unlike(view_.picture(bare({500, 400})), before, 20), 0.02) << "touched faces show";
  release(to);
  ASSERT_EQ(brushed.count(), 1);
  const auto stroke = brushed[0][0].value<std::vector<VertexId>>();
  EXPECT_DOUBLE_EQ(brushed[0][1].toDouble(), 0.8);
  ASSERT_GT(stroke.size(), 8u);
  for (std::size_t k = 0; k < stroke.size(); ++k) {
    const Point p = mesh_->point(stroke[k]) - mesh_->box_min();
    EXPECT_NEAR(p.y(), 5.0, 0.2);
    EXPECT_GT(p.x(), 1.8);
    EXPECT_LT(p.x(), 8.2);
    if (k == 0) continue;
    const double step = (mesh_->point(stroke[k]) - mesh_->point(stroke[k - 1])).norm();
    EXPECT_GE(step, 0.4 - 1e-9);
    EXPECT_LE(step, 0.9);
  }
  EXPECT_NEAR((mesh_->point(stroke.back()) - mesh_->box_min()).x(), 8.0, 0.5);
  EXPECT_EQ(view_.picture(bare({500, 400})), before) << "and are let go";
}

TEST_F(ViewToolsTest, ABrushClickIsAStrokeOfOneVertexAndBesideThePartItOrbits) {
  show_plane();
  view_.set_tool(Tool::brush);
  QSignalSpy brushed(&view_, &MeshView::brushed);
  QTest::mouseClick(&view_, Qt::LeftButton, {}, middle());
  ASSERT_EQ(brushed.count(), 1);
  EXPECT_EQ(brushed[0][0].value<std::vector<VertexId>>().size(), 1u);
  const Point before = view_.towards_viewer();
  drag({3, 3}, {40, 30});
  EXPECT_EQ(brushed.count(), 1);
  EXPECT_GT((view_.towards_viewer() - before).norm(), 0.05);
}

TEST_F(ViewToolsTest, EscapeWhilePaintingDropsTheStrokeThenLeavesTheTool) {
  show_plane();
  view_.set_tool(Tool::brush);
  QSignalSpy brushed(&view_, &MeshView::brushed);
  QSignalSpy left(&view_, &MeshView::tool_left);
  press(middle());
  move(middle() + QPoint(40, 0), Qt::LeftButton);
  QTest::keyClick(&view_, Qt::Key_Escape);
  release(middle() + QPoint(40, 0));
  EXPECT_EQ(brushed.count(), 0);
  EXPECT_EQ(left.count(), 0);
  EXPECT_EQ(view_.tool(), Tool::brush);
  QTest::keyClick(&view_, Qt::Key_Escape);
  EXPECT_EQ(left.count(), 1);
  EXPECT_EQ(view_.tool(), Tool::select);
}

TEST_F(ViewToolsTest, TheBrushRadiusFollowsKeysAndWheelWithinTheSizeOfThePart) {
  show_plane();
  view_.set_tool(Tool::brush);
  const double start = view_.brush_radius();
  EXPECT_GT(start, 0.0);
  QSignalSpy changed(&view_, &MeshView::brush_radius_changed);
  QTest::keyClick(&view_, Qt::Key_BracketRight);
  EXPECT_GT(view_.brush_radius(), start);
  QTest::keyClick(&view_, Qt::Key_BracketLeft);
  EXPECT_NEAR(view_.brush_radius(), start, 1e-9);
  const auto before = view_.pick(middle() + QPoint(60, 0));
  QWheelEvent wheel(QPointF(middle()), view_.mapToGlobal(QPointF(middle())), {}, {0, 240},
                    Qt::NoButton, Qt::ControlModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view_, &wheel);
  EXPECT_GT(view_.brush_radius(), start);
  EXPECT_EQ(view_.pick(middle() + QPoint(60, 0))->point, before->point) << "no zoom";
  EXPECT_EQ(changed.count(), 3);
  view_.set_brush_radius(1e9);
  EXPECT_LE(view_.brush_radius(), mesh_->diagonal());
  view_.set_brush_radius(0.0);
  EXPECT_GT(view_.brush_radius(), 0.0);
}

TEST_F(ViewToolsTest, TheRingLiesUnderThePointer) {
  show_plane(0.5);
  const QImage before = grab();
  view_.set_tool(Tool::brush, " ");  // no text at the bottom that would change the picture
  view_.set_brush_radius(2.0);
  move(middle());
  const QImage ring = grab();
  const double unit =
      (view_.pick(middle() + QPoint(50, 0))->point - view_.pick(middle())->point).norm() / 50.0;
  const int radius = qRound(2.0 / unit);
  for (const QPoint by : {QPoint(radius, 0), QPoint(-radius, 0), QPoint(0, radius)})
    EXPECT_GT(unlike(ring.copy(QRect(middle() + by - QPoint(3, 3), QSize(7, 7))),
                     before.copy(QRect(middle() + by - QPoint(3, 3), QSize(7, 7))), 30),
              0.1);
  EXPECT_EQ(pixel(ring, middle()), pixel(before, middle()));
}

TEST_F(ViewToolsTest, APathIsClickedPointByPoint) {
  show_plane();
  view_.set_tool(Tool::path);
  QSignalSpy points(&view_, &MeshView::path_point);
  QSignalSpy hovers(&view_, &MeshView::path_hover);
  QSignalSpy done(&view_, &MeshView::path_done);
  QSignalSpy back(&view_, &MeshView::path_back);
  QSignalSpy clicked(&view_, &MeshView::clicked);
  QTest::mouseClick(&view_, Qt::LeftButton, {}, place(3, 3));
  ASSERT_EQ(points.count(), 1);
  EXPECT_LT((points[0][0].value<Pick>().point - mesh_->box_min() - Point(3, 3, 0)).norm(), 0.1);
  QTest::mouseClick(&view_, Qt::LeftButton, {}, {1, 1});
  EXPECT_EQ(points.count(), 1) << "the ground is no point of a path";
  drag(place(5, 5), place(5, 5) + QPoint(30, 0));
  EXPECT_EQ(points.count(), 1) << "a drag turns the part";
  view_.look_from(MeshView::StandardView::top);
  for (int k = 0; k < 30; ++k) move(middle() + QPoint(k, 0));
  EXPECT_TRUE(QTest::qWaitFor([&] { return hovers.count() > 0; }, 5000));
  EXPECT_EQ(hovers.count(), 1) << "thirty moves at once";
  QTest::keyClick(&view_, Qt::Key_Backspace);
  EXPECT_EQ(back.count(), 1);
  QTest::keyClick(&view_, Qt::Key_Return);
  EXPECT_EQ(done.count(), 1);
  QTest::mouseClick(&view_, Qt::LeftButton, {}, place(6, 6));
  QTest::mouseDClick(&view_, Qt::LeftButton, {}, place(6, 6));
  EXPECT_EQ(done.count(), 2);
  EXPECT_EQ(clicked.count(), 0);
  // What QTest sends before its double click are a click of their own, as with a real mouse.
  EXPECT_LE(points.count(), 3);
  for (const auto& call : points) EXPECT_NE(call[0].value<Pick>().face, no_id);
}

TEST_F(ViewToolsTest, GhostPathsAndPickedPointsShowAndGo) {
  show_plane();
  const QImage before = view_.picture(bare({500, 400}));
  view_.set_ghost_paths({line(0, 3).vertices, line(0, 6).vertices, {0, 4'000'000}, {1}});
  EXPECT_GT(share_of(view_.picture(bare({500, 400})), qRgb(0, 214, 236), 30), 0.002);
  view_.set_ghost_paths({});
  EXPECT_EQ(view_.picture(bare({500, 400})), before);
  view_.set_picked_points({mesh_->point(0), centre(*mesh_)});
  EXPECT_GT(unlike(view_.picture(bare({500, 400})), before, 30), 1e-4);
  view_.set_picked_points({});
  EXPECT_EQ(view_.picture(bare({500, 400})), before);
}

TEST_F(ViewToolsTest, TwoClicksMeasure) {
  show_plane();
  view_.set_tool(Tool::measure);
  const QImage before = view_.picture(bare({500, 400}));
  QSignalSpy measured(&view_, &MeshView::measured);
  const QPoint a = place(2, 3), b = place(8, 7);
  const Point from = view_.pick(a)->point, to = view_.pick(b)->point;
  QTest::mouseClick(&view_, Qt::LeftButton, {}, a);
  EXPECT_EQ(measured.count(), 0);
  QTest::mouseClick(&view_, Qt::LeftButton, {}, b);
  ASSERT_EQ(measured.count(), 1);
  const QString text = measured[0][0].toString();
  const auto has = [&](double value) {
    return text.contains(QString::fromStdString(fixed_text(value, 4)));
  };
  EXPECT_TRUE(has((to - from).norm())) << text.toStdString();
  EXPECT_TRUE(has(to.x() - from.x()) && has(to.y() - from.y())) << text.toStdString();
  EXPECT_TRUE(text.contains("0.0°")) << text.toStdString();
  EXPECT_GT(unlike(view_.picture(bare({500, 400})), before, 30), 0.005);
  // Stays while one turns and zooms, and in the tool to select with; Esc takes it away.
  view_.set_tool(Tool::select);
  EXPECT_GT(unlike(view_.picture(bare({500, 400})), before, 30), 0.005);
  QTest::keyClick(&view_, Qt::Key_Escape);
  EXPECT_EQ(view_.picture(bare({500, 400})), before);
}

TEST_F(ViewToolsTest, AMeasurementTellsTheAngleBetweenTheFaces) {
  mesh_ = mesh_of(testing::roof(0.5, 5.0, 10.0, 1.0));
  view_.set_mesh(mesh_, false);
  view_.look_from(MeshView::StandardView::top);
  view_.set_tool(Tool::measure);
  QSignalSpy measured(&view_, &MeshView::measured);
  QTest::mouseClick(&view_, Qt::LeftButton, {}, middle() - QPoint(60, 0));
  QTest::mouseClick(&view_, Qt::LeftButton, {}, middle() + QPoint(60, 0));
  ASSERT_EQ(measured.count(), 1);
  const QString angle = QString::fromStdString(fixed_text(0.5 * 180.0 / M_PI, 1)) + "°";
  EXPECT_TRUE(measured[0][0].toString().contains(angle)) << measured[0][0].toString().toStdString();
}

TEST_F(ViewToolsTest, APointOfALineIsGrabbedDraggedAndDropped) {
  show_plane();
  view_.set_lines({line(7, 5)});
  view_.set_tool(Tool::move_point);
  QSignalSpy grabbed(&view_, &MeshView::line_grabbed);
  QSignalSpy dragged(&view_, &MeshView::line_dragged);
  QSignalSpy dropped(&view_, &MeshView::line_dropped);
  const Point low = mesh_->box_min();
  const auto vertex = [&](double x, double y) {
    return nearest_vertex(*mesh_, low + Point(x, y, 0));
  };
  drag(place(3, 5), place(3, 8));
  ASSERT_EQ(grabbed.count(), 1);
  EXPECT_EQ(grabbed[0][0].toUInt(), 7u);
  EXPECT_EQ(grabbed[0][1].value<VertexId>(), vertex(3, 5));
  ASSERT_EQ(dragged.count(), 3) << "once for each vertex that is new";
  EXPECT_EQ(dragged.back()[0].value<VertexId>(), vertex(3, 8));
  ASSERT_EQ(dropped.count(), 1);
  EXPECT_EQ(dropped[0][0].value<VertexId>(), vertex(3, 8));
  // Esc puts it back where it was.
  press(place(4, 5));
  move(place(4, 7), Qt::LeftButton);
  QTest::keyClick(&view_, Qt::Key_Escape);
  release(place(4, 7));
  ASSERT_EQ(dropped.count(), 2);
  EXPECT_EQ(dropped[1][0].value<VertexId>(), vertex(4, 5));
  // Beside lines a drag turns the part.
  const Point before = view_.towards_viewer();
  drag(place(2, 8), place(2, 8) + QPoint(40, 0));
  EXPECT_EQ(grabbed.count(), 2);
  EXPECT_GT((view_.towards_viewer() - before).norm(), 0.05);
}

TEST_F(ViewToolsTest, EscapeGoesBackToSelecting) {
  show_plane();
  QSignalSpy left(&view_, &MeshView::tool_left);
  QSignalSpy changed(&view_, &MeshView::tool_changed);
  for (const Tool tool : {Tool::band, Tool::brush, Tool::path, Tool::measure, Tool::move_point}) {
    left.clear();
    changed.clear();
    const QImage plain = view_.picture(bare({500, 400}));
    const QImage screen = grab();
    view_.set_tool(tool);
    EXPECT_EQ(view_.tool(), tool);
    EXPECT_NE(grab(), screen) << "the hint tells the tool";
    EXPECT_EQ(view_.picture(bare({500, 400})), plain) << "but not in pictures";
    if (tool != Tool::move_point) {
      EXPECT_NE(view_.cursor().shape(), Qt::ArrowCursor);
    }
    EXPECT_TRUE(view_.hasFocus() || !view_.isActiveWindow());
    QTest::keyClick(&view_, Qt::Key_Escape);
    EXPECT_EQ(view_.tool(), Tool::select);
    EXPECT_EQ(view_.cursor().shape(), Qt::ArrowCursor);
    EXPECT_EQ(left.count(), 1);
    EXPECT_EQ(changed.count(), 2);
    EXPECT_EQ(grab(), screen);
  }
}

TEST_F(ViewToolsTest, EveryToolLeavesTheMiddleAndRightButtonToTheCamera) {
  show_plane();
  for (const Tool tool : {Tool::select, Tool::band, Tool::brush, Tool::path, Tool::measure}) {
    view_.look_from(MeshView::StandardView::top);
    view_.set_tool(tool);
    const Point there = view_.pick(middle())->point;
    drag(middle(), middle() + QPoint(40, 0), {}, Qt::MiddleButton);
    EXPECT_LT((view_.pick(middle() + QPoint(40, 0))->point - there).norm(), 1e-6) << "pans";
    drag(middle(), middle() + QPoint(40, 0), Qt::ShiftModifier, Qt::MiddleButton);
    EXPECT_GT((view_.towards_viewer() - Point::UnitZ()).norm(), 0.05) << "orbits";
  }
  view_.set_tool(Tool::select);
  view_.look_from(MeshView::StandardView::top);
  const Point there = view_.pick(middle())->point;
  drag(middle(), middle() + QPoint(0, 30), Qt::ControlModifier);
  EXPECT_LT((view_.pick(middle() + QPoint(0, 30))->point - there).norm(), 1e-6) << "Ctrl pans";
}

/// What a drag did with the camera.
std::optional<Motion> motion_between(const ViewCamera& before, const ViewCamera& after) {
  if ((before.towards_viewer() - after.towards_viewer()).norm() > 0.02) return Motion::orbit;
  if (std::abs(before.height() / after.height() - 1.0) > 0.02) return Motion::zoom;
  if ((before.focus() - after.focus()).norm() > 1e-3 * before.height()) return Motion::pan;
  return std::nullopt;
}

TEST_F(ViewToolsTest, EachStyleOfNavigationMovesTheCameraAsItsTableSays) {
  show_plane();
  for (const NavigationInfo& info : navigation_table()) {
    view_.set_navigation(info.style);
    EXPECT_EQ(view_.navigation(), info.style);
    EXPECT_EQ(navigation_style(info.key), info.style);
    for (const Motion motion : {Motion::orbit, Motion::pan, Motion::zoom})
      EXPECT_FALSE(how_to(info, motion).isEmpty()) << info.name;
    for (const NavigationRule& rule : info.rules) {
      view_.look_from(MeshView::StandardView::top);
      const ViewCamera before = view_.camera();
      // The first button is the middle one where that is held at all.
      std::vector<Qt::MouseButton> order;
      for (const Qt::MouseButton button : {Qt::MiddleButton, Qt::LeftButton, Qt::RightButton})
        if (rule.buttons.testFlag(button)) order.push_back(button);
      const auto event = [&](QEvent::Type type, const QPoint& at, Qt::MouseButton button,
                             Qt::MouseButtons held) {
        QMouseEvent e(type, at, view_.mapToGlobal(at), button, held, rule.modifiers);
        QApplication::sendEvent(&view_, &e);
      };
      Qt::MouseButtons held;
      if (rule.after_second) {
        event(QEvent::MouseButtonPress, middle(), Qt::MiddleButton, Qt::MiddleButton);
        event(QEvent::MouseButtonPress, middle(), Qt::LeftButton,
              Qt::MiddleButton | Qt::LeftButton);
        event(QEvent::MouseButtonRelease, middle(), Qt::LeftButton, Qt::MiddleButton);
        held = Qt::MiddleButton;
      } else {
        for (const Qt::MouseButton button : order)
          event(QEvent::MouseButtonPress, middle(), button, held |= button);
      }
      for (int k = 1; k <= 8; ++k)
        event(QEvent::MouseMove, middle() + QPoint(5 * k, 6 * k), Qt::NoButton, held);
      for (auto button = order.rbegin(); button != order.rend(); ++button)
        event(QEvent::MouseButtonRelease, middle() + QPoint(40, 48), *button, held &= ~*button);
      const auto done = motion_between(before, view_.camera());
      ASSERT_TRUE(done.has_value()) << info.name << " " << int(rule.buttons);
      EXPECT_EQ(*done, rule.motion) << info.name << " " << int(rule.buttons);
    }
  }
}

TEST_F(ViewToolsTest, WhereTheLeftButtonMovesNothingItDrawsARectangleAndClicks) {
  show_plane();
  view_.set_lines({line(7, 5.0)});
  QSignalSpy banded(&view_, &MeshView::banded), clicked(&view_, &MeshView::clicked);
  for (const NavigationInfo& info : navigation_table()) {
    if (info.left_moves()) continue;
    view_.set_navigation(info.style);
    view_.look_from(MeshView::StandardView::top);
    const ViewCamera before = view_.camera();
    banded.clear();
    clicked.clear();
    drag(place(0.2, 3.0), place(9.8, 7.0));
    ASSERT_EQ(banded.count(), 1) << info.name;
    EXPECT_EQ(banded[0][0].value<std::vector<std::uint32_t>>(), Ids{7});
    EXPECT_TRUE(view_.camera() == before) << info.name;
    QTest::mouseClick(&view_, Qt::LeftButton, {}, middle());
    EXPECT_EQ(clicked.count(), 1) << info.name;
    // Tools that only click do not move anything by a drag either.
    view_.set_tool(Tool::measure);
    drag(middle(), middle() + QPoint(60, 20));
    EXPECT_TRUE(view_.camera() == before) << info.name;
    view_.set_tool(Tool::select);
  }
}

TEST_F(ViewToolsTest, ACapMovesThePartAndNothingDuringADrag) {
  show_plane();
  const ViewCamera before = view_.camera();
  view_.fly(0.0, 0.0, 0.0, 0.0, 0.0, 0.03);
  EXPECT_FALSE(motion_between(before, view_.camera()));
  view_.fly(0.0, 0.0, 0.0, 0.0, 1.0, 0.1);
  EXPECT_EQ(motion_between(before, view_.camera()), Motion::orbit);
  view_.set_camera(before);
  view_.fly(1.0, 0.0, 0.0, 0.0, 0.0, 0.1);
  EXPECT_EQ(motion_between(before, view_.camera()), Motion::pan);
  EXPECT_LT((view_.camera().focus() - before.focus()).dot(before.right()), 0.0) << "with the part";
  view_.set_camera(before);
  view_.fly(0.0, 0.0, 1.0, 0.0, 0.0, 0.1);
  EXPECT_LT(view_.camera().height(), before.height()) << "towards the user it is larger";
  view_.set_camera(before);
  press(middle());
  view_.fly(1.0, 1.0, 1.0, 1.0, 1.0, 0.1);
  EXPECT_FALSE(motion_between(before, view_.camera()));
  release(middle());
}

TEST_F(ViewToolsTest, TheWheelGoesTheWayOfTheStyle) {
  show_plane();
  for (const NavigationInfo& info : navigation_table()) {
    view_.set_navigation(info.style);
    view_.fit();
    const double before = view_.camera().height();
    QWheelEvent up(middle(), view_.mapToGlobal(middle()), {}, QPoint(0, 120), Qt::NoButton, {},
                   Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view_, &up);
    EXPECT_EQ(view_.camera().height() > before, info.wheel_up_is_away) << info.name;
  }
}

TEST_F(ViewToolsTest, ASectionCutsAwayWhatIsSeenAndPicked) {
  mesh_ = mesh_of(testing::divided_cube(10.0, 10));
  view_.set_mesh(mesh_, false);
  view_.look_from(MeshView::StandardView::front);  // x to the right, z up
  const QImage whole = view_.picture(bare({500, 400}));
  const auto left = view_.pick(middle() - QPoint(60, 0));
  const auto right = view_.pick(middle() + QPoint(60, 0));
  ASSERT_TRUE(left && right);
  view_.set_section(Section{Point::UnitX(), 5.0});
  const QImage half = view_.picture(bare({500, 400}));
  EXPECT_EQ(half.pixel(250 + 60, 200), qRgb(255, 255, 255)) << "the ground is seen";
  EXPECT_EQ(half.pixel(250 - 60, 200), whole.pixel(250 - 60, 200));
  EXPECT_FALSE(view_.pick(middle() + QPoint(60, 0)));
  ASSERT_TRUE(view_.pick(middle() - QPoint(60, 0)));
  EXPECT_EQ(view_.pick(middle() - QPoint(60, 0))->face, left->face);
  // The other half of it.
  view_.set_section(Section{-Point::UnitX(), -5.0});
  EXPECT_FALSE(view_.pick(middle() - QPoint(60, 0)));
  EXPECT_EQ(view_.pick(middle() + QPoint(60, 0))->face, right->face);
  // A cut across the view opens the cube: its inside is seen, whose back faces are never picked.
  view_.set_section(Section{-Point::UnitY(), -5.0});
  const QImage open = view_.picture(bare({500, 400}));
  EXPECT_NE(open.pixel(250, 200), qRgb(255, 255, 255));
  EXPECT_NE(open.pixel(250, 200), whole.pixel(250, 200));
  EXPECT_FALSE(view_.pick(middle()));
  view_.set_section(std::nullopt);
  EXPECT_EQ(view_.picture(bare({500, 400})), whole);
  EXPECT_TRUE(view_.pick(middle() + QPoint(60, 0)));
}

TEST_F(ViewToolsTest, ASectionCutsLinesAndStaysWithAnotherMesh) {
  show_plane();
  view_.set_lines({line(3, 5)});
  const QPoint low = place(2, 5), high = place(8, 5);
  ASSERT_EQ(view_.pick(low)->line, 3u);
  ASSERT_EQ(view_.pick(high)->line, 3u);
  const Section section{Point::UnitX(), mesh_->box_min().x() + 5.0};
  view_.set_section(section);
  EXPECT_EQ(view_.pick(low)->line, 3u);
  EXPECT_FALSE(view_.pick(high));
  QSignalSpy banded(&view_, &MeshView::banded);
  drag(low - QPoint(40, 30), high + QPoint(40, 30), Qt::ShiftModifier);
  EXPECT_EQ(banded[0][0].value<Ids>(), Ids{3}) << "the part of it that is seen";
  const MeshPtr other = plane(10.0, 2.0);
  view_.set_mesh(other, false);
  view_.pick(middle());
  EXPECT_EQ(view_.section(), section);
  EXPECT_FALSE(view_.pick(high));
}

TEST_F(ViewToolsTest, HiddenFacesAreNeitherSeenNorPicked) {
  show_plane();
  view_.set_lines({line(1, 3), line(2, 5), line(3, 8)});
  const QImage whole = view_.picture(bare({500, 400}));
  const QPoint upper = place(5.5, 7.4), lower = place(5.5, 2.4);
  std::vector<bool> hidden(mesh_->face_count());
  for (FaceId f = 0; f < hidden.size(); ++f) {
    double y = 0.0;
    for (const VertexId v : mesh_->triangle(f)) y += mesh_->point(v).y() / 3.0;
    hidden[f] = y > mesh_->box_min().y() + 5.0;
  }
  view_.set_hidden_faces(hidden);
  const QImage half = view_.picture(bare({500, 400}));
  EXPECT_EQ(half.pixel(upper), qRgb(255, 255, 255));
  EXPECT_EQ(half.pixel(lower), whole.pixel(lower));
  EXPECT_FALSE(view_.pick(upper));
  EXPECT_TRUE(view_.pick(lower));
  // The line between shown and hidden faces stays; one among hidden faces goes.
  EXPECT_EQ(view_.pick(place(4.5, 3))->line, 1u);
  EXPECT_EQ(view_.pick(place(4.5, 5))->line, 2u);
  EXPECT_FALSE(view_.pick(place(4.5, 8)));
  view_.set_edges_visible(true);
  EXPECT_EQ(view_.picture(bare({500, 400})).pixel(upper), qRgb(255, 255, 255));
  view_.set_edges_visible(false);
  // Colours stay with their faces.
  std::vector<std::uint32_t> labels(mesh_->face_count());
  for (FaceId f = 0; f < labels.size(); ++f) labels[f] = hidden[f] ? 1 : 2;
  view_.set_face_labels(labels, {QColor(), QColor(200, 60, 60), QColor(60, 60, 200)});
  EXPECT_EQ(share_of(view_.picture(bare({500, 400})), qRgb(200, 60, 60), 4), 0.0);
  EXPECT_GT(share_of(view_.picture(bare({500, 400})), qRgb(60, 60, 200), 4), 0.1);
  view_.set_face_labels({}, {});
  view_.set_hidden_faces({});
  EXPECT_EQ(view_.picture(bare({500, 400})), whole);
  view_.set_hidden_faces({true});  // does not fit the mesh
  EXPECT_EQ(view_.picture(bare({500, 400})), whole);
}

TEST_F(ViewToolsTest, TheReferenceIsShownPlainAndPicksStayWithTheMesh) {
  show_plane(2.0);
  view_.set_field(field_of(*mesh_, [](const Point&) { return 1.0; }));
  view_.set_scalar_bar_visible(true);
  const QImage coloured = view_.picture({});
  view_.set_reference(plane(10.0, 0.5), 0.01);
  EXPECT_EQ(view_.surface(), ShownSurface::mesh);
  EXPECT_EQ(view_.picture({}), coloured);
  const auto pick = view_.pick(middle());
  const QColor mesh_colour = pixel(grab(), middle());

  view_.set_surface(ShownSurface::reference);
  const QImage screen = grab();
  const QColor plain = pixel(screen, middle());
  EXPECT_LT(plain.saturation(), 30) << "neutral";
  EXPECT_GT(mesh_colour.saturation(), 200);
  EXPECT_EQ(view_.pick(middle())->face, pick->face);

  view_.set_surface(ShownSurface::both);
  const QColor blended = pixel(grab(), middle());
  EXPECT_GT(blended.saturation(), plain.saturation() + 30);
  EXPECT_LT(blended.saturation(), mesh_colour.saturation() - 30);

  // Lines lie over both.
  view_.set_lines({line(1, 6)});
  for (const ShownSurface surface : {ShownSurface::reference, ShownSurface::both}) {
    view_.set_surface(surface);
    EXPECT_GT(share_of(view_.picture(bare({500, 400})), qRgb(222, 66, 12), 30), 0.001);
  }
  // Edges: those of what is shown.
  view_.set_lines({});
  view_.set_surface(ShownSurface::mesh);
  const QImage no_edges = view_.picture(bare({500, 400}));
  view_.set_edges_visible(true);
  const double of_mesh = unlike(view_.picture(bare({500, 400})), no_edges, 4);
  view_.set_surface(ShownSurface::reference);
  view_.set_edges_visible(false);
  const QImage no_scan_edges = view_.picture(bare({500, 400}));
  view_.set_edges_visible(true);
  EXPECT_GT(unlike(view_.picture(bare({500, 400})), no_scan_edges, 4), 2.0 * of_mesh);
  view_.set_edges_visible(false);

  view_.set_reference(nullptr, 0.0);
  EXPECT_EQ(view_.surface(), ShownSurface::mesh);
  EXPECT_EQ(view_.picture({}), coloured);
}

TEST_F(ViewToolsTest, FieldsOnFacesAreFlatAndMarkedAtTheirPoint) {
  mesh_ = plane(10.0, 10.0);
  ASSERT_EQ(mesh_->face_count(), 2u);
  view_.set_mesh(mesh_, false);
  view_.look_from(MeshView::StandardView::top);
  view_.set_scalar_bar_visible(false);
  ViewField field;
  field.element = Element::face;
  field.scale.map = ColourMap::viridis;
  field.values = std::make_shared<std::vector<double>>(std::vector<double>{0.25, 0.75});
  view_.set_field(field);
  const QImage image = view_.picture(bare({500, 400}));
  EXPECT_GT(share_of(image, rgb(field.scale.colour(0.25)), 4), 0.15);
  EXPECT_GT(share_of(image, rgb(field.scale.colour(0.75)), 4), 0.15);
  field.mark = ViewMark{centre(*mesh_), "worst: 0.048 mm"};
  view_.set_field(field);
  const QImage marked = view_.picture(bare({500, 400}));
  EXPECT_GT(unlike(marked.copy(235, 185, 30, 30), image.copy(235, 185, 30, 30), 30), 0.1);
  // Labels are drawn instead of the field: nothing to mark then.
  view_.set_face_labels({1, 1}, {QColor(), QColor(90, 90, 90)});
  const QImage labelled = view_.picture(bare({500, 400}));
  EXPECT_EQ(labelled.pixel(250, 193), labelled.pixel(230, 150));
}

TEST(FacesWithinTest, ABrushTouchesWhatItReachesOnItsSheet) {
  // Two sheets, 0.1 apart.
  testing::Triangles sheets = testing::noisy_plane(10.0, 1.0, 0.0, 0.0, 1);
  const auto points = static_cast<VertexId>(sheets.points.size());
  const std::size_t faces = sheets.triangles.size();
  for (VertexId v = 0; v < points; ++v)
    sheets.points.push_back(sheets.points[v] + Point(0, 0, 0.1));
  for (std::size_t f = 0; f < faces; ++f) {
    Triangle t = sheets.triangles[f];
    for (VertexId& v : t) v += points;
    sheets.triangles.push_back(t);
  }
  const MeshPtr mesh = mesh_of(sheets);
  const Point at = mesh->point(mesh->triangle(20)[0]);
  for (const double radius : {0.4, 1.0, 2.5}) {
    const auto touched = faces_within(*mesh, 20, at, radius);
    ASSERT_FALSE(touched.empty());
    EXPECT_TRUE(std::is_sorted(touched.begin(), touched.end()));
    for (const FaceId f : touched) EXPECT_LT(f, faces) << "the other sheet";
    // Every face of the sheet with a corner within reach is among them.
    for (FaceId f = 0; f < faces; ++f) {
      const bool near = std::any_of(
          mesh->triangle(f).begin(), mesh->triangle(f).end(),
          [&](VertexId v) { return (mesh->point(v) - at).norm() <= radius * (1 - 1e-9); });
      EXPECT_TRUE(!near || std::binary_search(touched.begin(), touched.end(), f)) << f;
    }
  }
  EXPECT_TRUE(faces_within(*mesh, 20, at + Point(0, 0, 50), 1.0).empty());
}

}  // namespace
}  // namespace arris::ui
