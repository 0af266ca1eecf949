// What is picked under the pointer, and how the camera follows the mouse.

#include "tests/ui/view_fixture.h"
#include "ui/view/ray_tree.h"

namespace arris::ui {
namespace {

TEST_F(MeshViewTest, PicksTheFaceUnderThePointer) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  const auto pick = view_.pick(middle());
  ASSERT_TRUE(pick);
  EXPECT_LT((pick->point - centre(*mesh)).norm(), 0.05);
  ASSERT_LT(pick->face, mesh->face_count());
  const Triangle& corners = mesh->triangle(pick->face);
  EXPECT_NE(std::find(corners.begin(), corners.end(), pick->vertex), corners.end());
  for (const VertexId corner : corners) {
    EXPECT_LE((mesh->point(pick->vertex) - pick->point).norm(),
              (mesh->point(corner) - pick->point).norm() + 1e-6);
  }
  const auto faces = mesh->edge_faces(pick->edge);
  EXPECT_TRUE(faces[0] == pick->face || faces[1] == pick->face);
  EXPECT_EQ(pick->line, 0u);
  EXPECT_FALSE(view_.pick({1, 1}));
}

TEST_F(MeshViewTest, NeverPicksTheBack) {
  view_.set_mesh(plane(10.0, 1.0), false);
  view_.look_from(MeshView::StandardView::bottom);
  EXPECT_FALSE(view_.pick(middle()));
}

TEST_F(MeshViewTest, PicksTheNearerOfTwoSides) {
  const MeshPtr mesh = mesh_of(testing::divided_cube(10.0, 4));
  view_.set_mesh(mesh, false);
  const std::array<std::pair<MeshView::StandardView, Point>, 6> views{
      {{MeshView::StandardView::front, {5, 0, 5}},
       {MeshView::StandardView::back, {5, 10, 5}},
       {MeshView::StandardView::left, {0, 5, 5}},
       {MeshView::StandardView::right, {10, 5, 5}},
       {MeshView::StandardView::top, {5, 5, 10}},
       {MeshView::StandardView::bottom, {5, 5, 0}}}};
  for (const auto& [side, expected] : views) {
    view_.look_from(side);
    const auto pick = view_.pick(middle());
    ASSERT_TRUE(pick);
    EXPECT_LT((pick->point - expected).norm(), 0.1);
  }
}

TEST_F(MeshViewTest, PicksLinesThatAreShown) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  ViewLine line;
  line.id = 7;
  line.vertices = row(*mesh, mesh->point(nearest_vertex(*mesh, centre(*mesh))).y());
  ASSERT_GT(line.vertices.size(), 5u);
  view_.set_lines({line});
  // The line runs through the middle of the view, or half a step beside it.
  QPoint on_line;
  for (int y = 0; y < view_.height(); ++y) {
    const auto pick = view_.pick({middle().x(), y});
    if (!pick || pick->line != 7u) continue;
    on_line = QPoint(middle().x(), y);
    for (const VertexId v : mesh->edge(pick->edge))  // the edge is the line's, too
      EXPECT_NE(std::find(line.vertices.begin(), line.vertices.end(), v), line.vertices.end());
  }
  ASSERT_FALSE(on_line.isNull());
  EXPECT_FALSE(view_.pick(on_line + QPoint(0, 30))->line);
  view_.set_lines_visible(false);
  EXPECT_EQ(view_.pick(on_line)->line, 0u);
  view_.set_lines_visible(true);
  EXPECT_EQ(view_.pick(on_line)->line, 7u);
  line.id = 0;
  view_.set_lines({line});
  EXPECT_EQ(view_.pick(on_line)->line, 0u);
}

TEST_F(MeshViewTest, LinesBehindThePartAreNeitherPickedNorSeen) {
  const MeshPtr mesh = mesh_of(testing::divided_cube(10.0, 10));
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::bottom);
  // A line on the top, z = 10, that does not reach the rim, where its end would be seen.
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    const Point& point = mesh->point(v);
    const bool inner = point.x() > 0.5 && point.x() < 9.5;
    if (point.z() == 10.0 && point.y() == 5.0 && inner) vertices.push_back(v);
  }
  std::sort(vertices.begin(), vertices.end(),
            [&](VertexId a, VertexId b) { return mesh->point(a).x() < mesh->point(b).x(); });
  ViewLine line;
  line.id = 3;
  line.vertices = vertices;
  view_.set_legend_visible(false);  // the part would make room for it
  const QImage before = view_.picture(bare({500, 400}));
  view_.set_lines({line});
  PictureOptions options = bare({500, 400});
  const QImage behind = view_.picture(options);
  EXPECT_EQ(unlike(before, behind, 0), 0.0);
  const auto pick = view_.pick(middle());
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->line, 0u);
  view_.look_from(MeshView::StandardView::top);
  EXPECT_EQ(view_.pick(middle())->line, 3u);
  EXPECT_GT(share_of(view_.picture(options), qRgb(222, 66, 12), 30), 0.001);
}

TEST_F(MeshViewTest, LinesDoNotShowThroughAThinWall) {
  // 10 x 10 x 0.2, about 6 pixels thick, with a line on the far side.
  testing::Triangles box = testing::divided_cube(10.0, 10);
  for (Point& point : box.points) point.z() *= 0.02;
  const MeshPtr mesh = mesh_of(box);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  ViewLine line;
  line.id = 3;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    if (mesh->point(v).z() == 0.0 && mesh->point(v).y() == 5.0) line.vertices.push_back(v);
  }
  std::sort(line.vertices.begin(), line.vertices.end(),
            [&](VertexId a, VertexId b) { return mesh->point(a).x() < mesh->point(b).x(); });
  view_.set_lines({line});
  EXPECT_EQ(view_.pick(middle())->line, 0u);
  EXPECT_LT(share_of(view_.picture(bare({500, 400})).copy(180, 0, 320, 400), qRgb(222, 66, 12), 30),
            0.0001);
}

TEST_F(MeshViewTest, ClicksAndHoversTellWhatIsThere) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  view_.pick(middle());  // from here on the search tree is there
  QSignalSpy clicked(&view_, &MeshView::clicked);
  QSignalSpy hovered(&view_, &MeshView::hovered);
  QSignalSpy menu(&view_, &MeshView::context_menu_wanted);
  QTest::mouseClick(&view_, Qt::LeftButton, Qt::ControlModifier, middle());
  ASSERT_EQ(clicked.count(), 1);
  EXPECT_TRUE(clicked[0][0].value<std::optional<Pick>>().has_value());
  EXPECT_TRUE(clicked[0][1].toBool());
  QTest::mouseClick(&view_, Qt::LeftButton, {}, {1, 1});
  ASSERT_EQ(clicked.count(), 2);
  EXPECT_FALSE(clicked[1][0].value<std::optional<Pick>>().has_value());
  EXPECT_FALSE(clicked[1][1].toBool());
  QTest::mouseClick(&view_, Qt::RightButton, {}, middle());
  ASSERT_EQ(menu.count(), 1);
  EXPECT_TRUE(menu[0][1].value<std::optional<Pick>>().has_value());
  hovered.clear();
  for (int x = 0; x < 20; ++x) {
    QMouseEvent move(QEvent::MouseMove, middle() + QPoint(x, 0),
                     view_.mapToGlobal(middle() + QPoint(x, 0)), Qt::NoButton, Qt::NoButton, {});
    QApplication::sendEvent(&view_, &move);
  }
  EXPECT_TRUE(QTest::qWaitFor([&] { return hovered.count() > 0; }, 5000));
  ASSERT_EQ(hovered.count(), 1);  // twenty moves at once
  EXPECT_TRUE(hovered[0][0].value<std::optional<Pick>>().has_value());
}

TEST_F(MeshViewTest, OrbitsAboutThePointUnderThePointer) {
  const MeshPtr mesh = mesh_of(testing::divided_cube(10.0, 8));
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::front);
  const QPoint at = middle() + QPoint(60, 40);
  const auto before = view_.pick(at);
  ASSERT_TRUE(before);
  QSignalSpy clicked(&view_, &MeshView::clicked);
  QTest::mousePress(&view_, Qt::LeftButton, {}, at);
  for (const QPoint by : {QPoint(20, 0), QPoint(40, 10)}) {
    QMouseEvent move(QEvent::MouseMove, at + by, view_.mapToGlobal(at + by), Qt::NoButton,
                     Qt::LeftButton, {});
    QApplication::sendEvent(&view_, &move);
  }
  QTest::mouseRelease(&view_, Qt::LeftButton, {}, at + QPoint(40, 10));
  EXPECT_EQ(clicked.count(), 0);
  const auto after = view_.pick(at);
  ASSERT_TRUE(after);
  EXPECT_LT((after->point - before->point).norm(), 1e-6);
}

TEST_F(MeshViewTest, WheelZoomsToThePointer) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  const QPoint at = middle() + QPoint(80, -50);
  const auto before = view_.pick(at);
  const auto beside = view_.pick(at + QPoint(30, 0));
  QWheelEvent wheel(at, view_.mapToGlobal(at), {}, {0, 360}, Qt::NoButton, {}, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(&view_, &wheel);
  const auto after = view_.pick(at);
  const auto nearer = view_.pick(at + QPoint(30, 0));
  ASSERT_TRUE(before && after && beside && nearer);
  EXPECT_LT((after->point - before->point).norm(), 1e-6);
  EXPECT_LT((nearer->point - after->point).norm(), 0.8 * (beside->point - before->point).norm());
}

TEST_F(MeshViewTest, ZoomsToVertices) {
  const MeshPtr mesh = plane(40.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  const VertexId corner = nearest_vertex(*mesh, mesh->box_min() + Point(8.0, 8.0, 0.0));
  view_.zoom_to({corner});
  const auto pick = view_.pick(middle());
  ASSERT_TRUE(pick);
  EXPECT_LT((pick->point - mesh->point(corner)).norm(), 0.1);
}

TEST(RayTreeTest, FindsWhatTryingEveryFaceFinds) {
  const MeshPtr mesh = mesh_of(testing::random_terrain(30, 5));
  const RayTree tree(mesh);
  const Point low = mesh->box_min() - Point::Constant(1.0);
  const Point size = mesh->box_max() - mesh->box_min() + Point::Constant(2.0);
  std::uint32_t seed = 1;
  const auto random = [&] {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<double>(seed >> 8) / (1 << 24);
  };
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Point origin = low + size.cwiseProduct(Point(random(), random(), random()));
    Point direction(random() - 0.5, random() - 0.5, random() - 0.5);
    if (i % 5 == 0) direction = Point(0.0, 0.0, i % 2 == 0 ? 1.0 : -1.0);
    double nearest = 1000.0;
    bool found = false;
    for (const Triangle& t : mesh->triangles()) {
      const Point a = mesh->point(t[0]);
      const Point b = mesh->point(t[1]);
      const Point c = mesh->point(t[2]);
      const Point normal = (b - a).cross(c - a);
      const double distance = (a - origin).dot(normal) / direction.dot(normal);
      if (!(distance >= 0.0) || distance > nearest) continue;
      const Point at = origin + distance * direction;
      if ((b - a).cross(at - a).dot(normal) < 0.0 || (c - b).cross(at - b).dot(normal) < 0.0 ||
          (a - c).cross(at - c).dot(normal) < 0.0) {
        continue;
      }
      nearest = distance;
      found = true;
    }
    const auto hit = tree.first(origin, direction, 1000.0);
    ASSERT_EQ(hit.has_value(), found) << i;
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(hit->distance, nearest, 1e-9 * (1.0 + nearest));
  }
  EXPECT_GT(hits, 50);
}

TEST(RayTreeTest, RaysThroughVerticesAndEdgesHit) {
  const MeshPtr mesh = mesh_of(testing::icosphere(1.0, 3));
  const RayTree tree(mesh);
  for (const Point& point : mesh->points()) {
    const auto hit = tree.first(3.0 * point, -point, 10.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 2.0, 1e-6);
    EXPECT_TRUE(hit->front);
  }
  for (const EdgeVertices& edge : mesh->edges()) {
    const Point middle = (mesh->point(edge[0]) + mesh->point(edge[1])) / 2;
    EXPECT_TRUE(tree.first(3.0 * middle, -middle, 10.0));
  }
  EXPECT_FALSE(tree.first(Point::Zero(), Point::UnitX(), 10.0)->front);
}

/// Two meshes as one.
MeshPtr both(testing::Triangles a, const testing::Triangles& b) {
  const auto first = static_cast<VertexId>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh_of(a);
}

TEST_F(MeshViewTest, APlaceUnderARoofIsLookedAtFromTheFreeSide) {
  testing::Triangles roof = testing::noisy_plane(10.0, 1.0, 0.0, 0.0, 1);
  for (Point& p : roof.points) p.z() += 3.0;
  const MeshPtr mesh = both(testing::noisy_plane(10.0, 1.0, 0.0, 0.0, 1), roof);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  const VertexId below =
      nearest_vertex(*mesh, Point(centre(*mesh).x(), centre(*mesh).y(), mesh->box_min().z()));
  ASSERT_FALSE(view_.sees({below}));
  view_.show_place({below});
  EXPECT_TRUE(view_.sees({below}));
  EXPECT_FALSE(view_.section()) << "it can be seen as it is";
  EXPECT_GT(view_.towards_viewer().z(), -1e-9) << "not from under the floor";
  // What is seen well is not turned.
  view_.look_from(MeshView::StandardView::top);
  const VertexId above =
      nearest_vertex(*mesh, Point(centre(*mesh).x(), centre(*mesh).y(), mesh->box_max().z()));
  view_.show_place({above});
  EXPECT_LT((view_.towards_viewer() - Point::UnitZ()).norm(), 1e-9);
  EXPECT_TRUE(view_.sees({above}));
}

TEST_F(MeshViewTest, WhatHidesAPlaceInsideIsCutAwayUntilThePartIsTurned) {
  const testing::Triangles shell = testing::icosphere(10.0, 3), core = testing::icosphere(3.0, 3);
  const MeshPtr mesh = both(shell, core);
  view_.set_mesh(mesh, true);
  const VertexId inside = nearest_vertex(*mesh, Point(0.0, 3.0, 0.0));
  ASSERT_FALSE(view_.sees({inside}));
  view_.show_place({inside});
  EXPECT_TRUE(view_.section());
  EXPECT_TRUE(view_.sees({inside}));
  QTest::mousePress(&view_, Qt::LeftButton, {}, middle());
  for (int k = 1; k <= 6; ++k) {
    const QPoint at = middle() + QPoint(6 * k, 0);
    QMouseEvent move(QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                     {});
    QApplication::sendEvent(&view_, &move);
  }
  QTest::mouseRelease(&view_, Qt::LeftButton, {}, middle() + QPoint(36, 0));
  EXPECT_FALSE(view_.section());
}

}  // namespace
}  // namespace arris::ui
