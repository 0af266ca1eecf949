#include "ui/view/mesh_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <QApplication>
#include <QMainWindow>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QProcess>
#include <QSignalSpy>
#include <QTest>

#include "tests/support/meshes.h"
#include "ui/view/coarse_mesh.h"
#include "ui/view/overlay.h"
#include "ui/view/ray_tree.h"

namespace arris::ui {
namespace {

using testing::mesh_of;

int difference(QRgb a, QRgb b) {
  return std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                   std::abs(qBlue(a) - qBlue(b))});
}

QRgb rgb(const std::array<std::uint8_t, 3>& colour) {
  return qRgb(colour[0], colour[1], colour[2]);
}

/// Share of pixels that differ by more than `tolerance`.
double unlike(const QImage& a, const QImage& b, int tolerance) {
  if (a.size() != b.size()) return 1.0;
  qint64 count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (difference(a.pixel(x, y), b.pixel(x, y)) > tolerance) ++count;
    }
  }
  return static_cast<double>(count) / (static_cast<double>(a.width()) * a.height());
}

bool is_opaque(const QImage& image) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (qAlpha(image.pixel(x, y)) != 255) return false;
    }
  }
  return !image.isNull();
}

/// Share of pixels near to a colour.
double share_of(const QImage& image, QRgb colour, int tolerance) {
  qint64 count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (difference(image.pixel(x, y), colour) <= tolerance) ++count;
    }
  }
  return static_cast<double>(count) / (static_cast<double>(image.width()) * image.height());
}

GLenum gl_error(MeshView& view) {
  view.makeCurrent();
  const GLenum error = view.context()->functions()->glGetError();
  view.doneCurrent();
  return error;
}

/// A grid in the plane z = 0 from (0, 0) to (size, size), seen from above as its front.
MeshPtr plane(double size, double step) {
  return mesh_of(testing::noisy_plane(size, step, 0.0, 0.0, 1));
}

Point centre(const Mesh& mesh) { return (mesh.box_min() + mesh.box_max()) / 2; }

VertexId nearest_vertex(const Mesh& mesh, const Point& point) {
  VertexId best = 0;
  for (VertexId v = 1; v < mesh.vertex_count(); ++v) {
    if ((mesh.point(v) - point).norm() < (mesh.point(best) - point).norm()) best = v;
  }
  return best;
}

/// The vertices on y = `y`, from left to right.
std::vector<VertexId> row(const Mesh& mesh, double y) {
  std::vector<VertexId> result;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (std::abs(mesh.point(v).y() - y) < 1e-9) result.push_back(v);
  }
  std::sort(result.begin(), result.end(),
            [&](VertexId a, VertexId b) { return mesh.point(a).x() < mesh.point(b).x(); });
  return result;
}

ViewField field_of(const Mesh& mesh, const std::function<double(const Point&)>& value) {
  auto values = std::make_shared<std::vector<double>>();
  for (const Point& point : mesh.points()) values->push_back(value(point));
  ViewField field;
  field.title = "value";
  field.values = values;
  return field;
}

class MeshViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    view_.resize(500, 400);
    view_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view_));
  }
  void TearDown() override { EXPECT_EQ(gl_error(view_), GLenum{GL_NO_ERROR}); }

  QImage grab() { return view_.grabFramebuffer(); }
  QPoint middle() const { return {view_.width() / 2, view_.height() / 2}; }
  QRgb middle_colour() {
    const QImage image = grab();
    return image.pixel(image.width() / 2, image.height() / 2);
  }
  PictureOptions bare(QSize size) {
    PictureOptions options;
    options.size = size;
    options.scalar_bar = options.scale_bar = options.orientation_marker = false;
    return options;
  }

  MeshView view_;
};

TEST_F(MeshViewTest, ShowsThePartOpaquely) {
  const QImage empty = grab();
  EXPECT_TRUE(is_opaque(empty));
  view_.set_mesh(mesh_of(testing::icosphere(10.0, 3)), true);
  const QImage image = grab();
  EXPECT_TRUE(is_opaque(image));
  const double changed = unlike(image, empty, 20);
  EXPECT_GT(changed, 0.3);  // the sphere fills most of the height
  EXPECT_LT(changed, 0.8);
}

TEST_F(MeshViewTest, EmptiesAgain) {
  const QImage empty = grab();
  view_.set_mesh(mesh_of(testing::cube(1.0)), true);
  grab();
  view_.set_mesh(nullptr, true);
  EXPECT_EQ(unlike(grab(), empty, 0), 0.0);
  EXPECT_FALSE(view_.pick(middle()));
}

TEST_F(MeshViewTest, FillsTheWidgetAfterEachResize) {
  view_.set_mesh(plane(10.0, 1.0), true);
  ViewField field = field_of(*plane(10.0, 1.0), [](const Point&) { return 1.0; });
  field.scale.undefined = Qt::blue;
  view_.set_field(field);
  for (const QSize size : {QSize(700, 300), QSize(301, 449), QSize(500, 400)}) {
    view_.resize(size);
    QTest::qWait(30);
    view_.zoom_to({0, static_cast<VertexId>(plane(10.0, 1.0)->vertex_count() - 1)});
    // Closer, so that the plane covers every pixel.
    QTest::qWait(10);
    QWheelEvent wheel(QPointF(middle()), view_.mapToGlobal(QPointF(middle())), {}, {0, 1800},
                      Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view_, &wheel);
    view_.set_scalar_bar_visible(false);
    const QImage image = grab();
    EXPECT_EQ(image.size(), size * view_.devicePixelRatio());
    const QRgb inside = image.pixel(image.width() / 3, image.height() / 3);
    for (const QPoint corner : {QPoint(0, 0), QPoint(image.width() - 1, 0)}) {
      EXPECT_LE(difference(image.pixel(corner), inside), 2);
    }
    view_.fit();
  }
}

TEST_F(MeshViewTest, DrawsTheSameTwice) {
  view_.set_mesh(mesh_of(testing::torus(10.0, 3.0, 60, 30)), true);
  view_.look_from(MeshView::StandardView::isometric);
  const QImage first = view_.picture({});
  const QImage second = view_.picture({});
  EXPECT_FALSE(first.isNull());
  EXPECT_EQ(first, second);
  EXPECT_EQ(grab(), grab());
}

TEST_F(MeshViewTest, PictureHasTheWantedSizeAndLeavesTheScreenAlone) {
  view_.set_mesh(mesh_of(testing::torus(10.0, 3.0, 60, 30)), true);
  const QImage before = grab();
  PictureOptions options;
  options.size = {1234, 567};
  const QImage image = view_.picture(options);
  EXPECT_EQ(image.size(), options.size);
  EXPECT_TRUE(is_opaque(image));
  EXPECT_EQ(image.pixel(600, 2), qRgb(255, 255, 255));
  EXPECT_EQ(grab(), before);
  options.size = {1'000'000, 10};
  EXPECT_TRUE(view_.picture(options).isNull());
  options.size = {0, 10};
  EXPECT_TRUE(view_.picture(options).isNull());
}

TEST_F(MeshViewTest, PictureIsTheScreenButForItsGround) {
  const MeshPtr mesh = mesh_of(testing::torus(10.0, 3.0, 60, 30));
  view_.set_mesh(mesh, true);
  view_.look_from(MeshView::StandardView::isometric);
  view_.set_field(field_of(*mesh, [](const Point& p) { return 0.5 + p.x() / 30.0; }));
  PictureOptions options;
  options.size = grab().size();
  const QImage white = view_.picture(options);
  options.background = QColor(190, 210, 170);
  const QImage green = view_.picture(options);
  const QImage screen = grab();
  qint64 part = 0;
  qint64 wrong = 0;
  for (int y = 0; y < screen.height(); ++y) {
    for (int x = 0; x < screen.width(); ++x) {
      if (white.pixel(x, y) != green.pixel(x, y))
        continue;  // the ground shows, or shimmers through
      ++part;
      if (difference(white.pixel(x, y), screen.pixel(x, y)) > 3) ++wrong;
    }
  }
  EXPECT_GT(part, screen.width() * screen.height() / 5);
  EXPECT_EQ(wrong, 0);
}

TEST_F(MeshViewTest, PictureAtTwiceTheSizeShowsTheSame) {
  view_.set_mesh(mesh_of(testing::icosphere(10.0, 4)), true);
  const QSize size = view_.size();
  const QImage once = view_.picture(bare(size));
  const QImage twice =
      view_.picture(bare(2 * size)).scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  EXPECT_LT(unlike(once, twice, 12), 0.01);
}

TEST_F(MeshViewTest, TransparentPictures) {
  view_.set_mesh(mesh_of(testing::icosphere(10.0, 3)), true);
  PictureOptions options = bare({300, 300});
  options.background = QColor(0, 0, 0, 0);
  const QImage image = view_.picture(options);
  EXPECT_EQ(qAlpha(image.pixel(2, 2)), 0);
  EXPECT_EQ(qAlpha(image.pixel(150, 150)), 255);
}

TEST_F(MeshViewTest, ColoursAreThoseOfTheScale) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  for (const ColourMap map :
       {ColourMap::paper, ColourMap::viridis, ColourMap::cividis, ColourMap::diverging}) {
    for (const double value : {-1.0, 0.0, 0.02, 0.3, 0.77, 1.0, 5.0}) {
      for (const int bands : {0, 4}) {
        ViewField field = field_of(*mesh, [&](const Point&) { return value; });
        field.scale.map = map;
        field.scale.bands = bands;
        field.scale.below = QColor(10, 20, 250);
        field.scale.above = QColor(250, 0, 250);
        view_.set_field(field);
        EXPECT_LE(difference(middle_colour(), rgb(field.scale.colour(value))), 3)
            << static_cast<int>(map) << ' ' << value << ' ' << bands;
      }
    }
  }
  ViewField field = field_of(*mesh, [](const Point&) { return 0.02; });
  field.scale.min = 0.001;
  field.scale.max = 1.0;
  field.scale.logarithmic = true;
  field.scale.reversed = true;
  view_.set_field(field);
  EXPECT_LE(difference(middle_colour(), rgb(field.scale.colour(0.02))), 3);
}

TEST_F(MeshViewTest, ColoursBetweenVerticesFollowTheScaleToo) {
  const MeshPtr mesh = plane(10.0, 10.0);  // two triangles
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  const double low = mesh->box_min().x();
  ViewField field = field_of(*mesh, [&](const Point& p) { return (p.x() - low) / 10.0; });
  view_.set_field(field);
  view_.set_scalar_bar_visible(false);
  const QImage image = view_.picture(bare({1000, 800}));
  int left = 0;
  int right = image.width() - 1;
  while (image.pixel(left, 400) == qRgb(255, 255, 255)) ++left;
  while (image.pixel(right, 400) == qRgb(255, 255, 255)) --right;
  for (const double x : {0.1, 0.25, 0.5, 0.75, 0.9}) {
    const int at = static_cast<int>(left + x * (right - left));
    EXPECT_LE(difference(image.pixel(at, 400), rgb(field.scale.colour(x))), 5) << x;
  }
}

TEST_F(MeshViewTest, UndefinedIsGrey) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ViewField field = field_of(*mesh, [&](const Point&) { return nan; });
  field.scale.undefined = QColor(120, 130, 140);
  view_.set_field(field);
  EXPECT_LE(difference(middle_colour(), qRgb(120, 130, 140)), 3);
}

TEST_F(MeshViewTest, ClassesHaveTheirColours) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  ViewField field = field_of(*mesh, [](const Point&) { return 1.0; });
  field.class_names = {"flat", "ridge"};
  field.class_colours = {Qt::red, QColor(20, 180, 90)};
  view_.set_field(field);
  EXPECT_LE(difference(middle_colour(), qRgb(20, 180, 90)), 3);
}

TEST_F(MeshViewTest, FieldsThatDoNotFitAreNotDrawn) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, true);
  const QImage bare_part = grab();
  ViewField field;
  field.values = std::make_shared<std::vector<double>>(3, 0.5);
  view_.set_field(field);
  EXPECT_EQ(grab(), bare_part);
  view_.set_face_labels({1, 2, 3}, {Qt::red});
  EXPECT_EQ(grab(), bare_part);
  ViewLine line;
  line.vertices = {0, 4'000'000};
  view_.set_lines({line});
  EXPECT_EQ(grab(), bare_part);
}

TEST_F(MeshViewTest, FaceLabelsColourTheirFaces) {
  const MeshPtr mesh = plane(10.0, 10.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  ASSERT_EQ(mesh->face_count(), 2u);
  view_.set_face_labels({1, 2}, {QColor(), QColor(200, 60, 60), QColor(60, 60, 200)});
  const QImage image = view_.picture(bare({500, 400}));
  EXPECT_GT(share_of(image, qRgb(200, 60, 60), 4), 0.15);
  EXPECT_GT(share_of(image, qRgb(60, 60, 200), 4), 0.15);
  view_.set_selected_labels({1});
  const QImage selected = view_.picture(bare({500, 400}));
  EXPECT_LT(share_of(selected, qRgb(200, 60, 60), 4), 0.01);
  EXPECT_GT(share_of(selected, qRgb(60, 60, 200), 4), 0.15);
  view_.set_selected_labels({});
  EXPECT_EQ(view_.picture(bare({500, 400})), image);
}

TEST_F(MeshViewTest, LabelsStayOnTheirFacesBesideOnesWithoutArea) {
  // Face 1 has two corners in one place; drawing must not shift the labels that follow.
  auto made = Mesh::create({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {10, 0, 0}},
                           {{0, 1, 3}, {1, 4, 3}, {4, 2, 3}});
  ASSERT_TRUE(made);
  view_.set_mesh(*made, false);
  view_.look_from(MeshView::StandardView::top);
  view_.set_face_labels({1, 2, 3},
                        {QColor(), QColor(200, 60, 60), QColor(60, 200, 60), QColor(60, 60, 200)});
  const QImage image = view_.picture(bare({500, 400}));
  EXPECT_GT(share_of(image, qRgb(200, 60, 60), 4), 0.15);
  EXPECT_GT(share_of(image, qRgb(60, 60, 200), 4), 0.15);
}

TEST_F(MeshViewTest, EdgeFieldColoursEdges) {
  const MeshPtr mesh = plane(10.0, 2.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  ViewField field;
  field.title = "|IHe|";
  field.element = Element::edge;
  field.values = std::make_shared<std::vector<double>>(mesh->edge_count(), 1.0);
  view_.set_field(field);
  view_.set_scalar_bar_visible(false);
  const QImage image = view_.picture(bare({500, 400}));
  EXPECT_GT(share_of(image, rgb(field.scale.colour(1.0)), 40), 0.005);
  EXPECT_LT(share_of(image, rgb(field.scale.colour(1.0)), 40), 0.2);
}

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
    if (pick && pick->line == 7u) on_line = QPoint(middle().x(), y);
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
  const QImage before = view_.picture(bare({500, 400}));
  view_.set_lines({line});
  PictureOptions options = bare({500, 400});
  const QImage behind = view_.picture(options);
  // The legend of the lines comes in, nothing else.
  EXPECT_EQ(unlike(before.copy(180, 0, 320, 400), behind.copy(180, 0, 320, 400), 0), 0.0);
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

TEST_F(MeshViewTest, LineTypesLookDifferent) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  std::vector<QImage> images;
  for (int type = 0; type < 5; ++type) {
    ViewLine line;
    line.id = 1;
    line.type = static_cast<LineType>(type);
    line.vertices = row(*mesh, mesh->point(nearest_vertex(*mesh, centre(*mesh))).y());
    view_.set_lines({line});
    // In grey: what is left of colour for nobody.
    images.push_back(view_.picture(bare({500, 400}))
                         .copy(180, 120, 200, 160)
                         .convertToFormat(QImage::Format_Grayscale8)
                         .convertToFormat(QImage::Format_RGB32));
    for (int other = 0; other < type; ++other) {
      EXPECT_GT(unlike(images[static_cast<std::size_t>(other)], images.back(), 40), 0.001)
          << other << ' ' << type;
    }
  }
  view_.set_selected_lines({1});
  const QImage selected = view_.picture(bare({500, 400}));
  EXPECT_GT(share_of(selected, qRgb(255, 214, 0), 20), 0.003);
}

TEST_F(MeshViewTest, ChangedLinesLeaveTheSurfaceAsItIs) {
  const MeshPtr mesh = mesh_of(testing::torus(10.0, 3.0, 60, 30));
  view_.set_mesh(mesh, true);
  view_.set_lines({});
  const QImage before = grab();
  ViewLine line;
  line.id = 1;
  line.vertices = {mesh->triangle(0)[0], mesh->triangle(0)[1], mesh->triangle(0)[2]};
  view_.set_lines({line});
  EXPECT_NE(grab(), before);
  view_.set_lines({});
  EXPECT_EQ(grab(), before);
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
  QTest::qWait(100);
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

TEST_F(MeshViewTest, SurvivesMovingToAnotherWindow) {
  const MeshPtr mesh = mesh_of(testing::torus(10.0, 3.0, 60, 30));
  auto* view = new MeshView;
  QMainWindow first;
  first.setCentralWidget(view);
  first.resize(400, 300);
  view->set_mesh(mesh, true);
  first.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&first));
  view->fit();
  const QImage before = view->grabFramebuffer();
  EXPECT_GT(unlike(before, QImage(before.size(), before.format()), 5), 0.5);

  first.takeCentralWidget();
  view->setParent(nullptr);
  view->resize(before.size() / view->devicePixelRatio());
  view->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(view));
  view->fit();
  const QImage floating = view->grabFramebuffer();
  EXPECT_EQ(gl_error(*view), GLenum{GL_NO_ERROR});
  EXPECT_EQ(unlike(floating, before, 2), 0.0);

  QMainWindow second;
  second.resize(400, 300);
  second.setCentralWidget(view);
  second.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&second));
  view->fit();
  EXPECT_EQ(unlike(view->grabFramebuffer(), before, 2), 0.0);
  EXPECT_EQ(gl_error(*view), GLenum{GL_NO_ERROR});
}

TEST_F(MeshViewTest, FarFromTheOriginLooksTheSame) {
  const testing::Triangles near = testing::torus(10.0, 3.0, 60, 30);
  view_.set_mesh(mesh_of(near), true);
  const QImage expected = view_.picture(bare({400, 300}));
  testing::Triangles far = near;
  for (Point& point : far.points) point += Point(1e6, -2e6, 5e5);
  view_.set_mesh(mesh_of(far), true);
  EXPECT_LT(unlike(view_.picture(bare({400, 300})), expected, 8), 0.002);
}

/// Run by ScaleFactors in a process of its own.
TEST_F(MeshViewTest, FitsItsScaleFactor) {
  const MeshPtr mesh = plane(10.0, 1.0);
  view_.resize(333, 251);
  QTest::qWait(50);
  view_.set_mesh(mesh, false);
  view_.look_from(MeshView::StandardView::top);
  if (qEnvironmentVariableIsSet("ARRIS_EXPECTED_RATIO")) {
    EXPECT_EQ(view_.devicePixelRatio(), qEnvironmentVariable("ARRIS_EXPECTED_RATIO").toDouble());
  }
  const QImage image = grab();
  EXPECT_EQ(image.size(), view_.size() * view_.devicePixelRatio());
  EXPECT_TRUE(is_opaque(image));
  // The square plane is drawn in the middle, upright and as wide as high.
  const QRgb inside = image.pixel(image.width() / 2, image.height() / 2);
  const auto run = [&](QPoint step) {
    QPoint at(image.width() / 2, image.height() / 2);
    int length = 0;
    while (image.valid(at) && difference(image.pixel(at), inside) < 6) {
      at += step;
      ++length;
    }
    return length;
  };
  const int left = run({-1, 0});
  const int up = run({0, -1});
  EXPECT_NEAR(left, run({1, 0}), 2);
  EXPECT_NEAR(up, run({0, 1}), 2);
  EXPECT_NEAR(left, up, 2);
  const auto pick = view_.pick(middle());
  ASSERT_TRUE(pick);
  EXPECT_LT((pick->point - centre(*mesh)).norm(), 0.1);
  // Picking and drawing agree on where the plane ends.
  const double ratio = view_.devicePixelRatio();
  const int logical = static_cast<int>(left / ratio);
  EXPECT_TRUE(view_.pick(middle() - QPoint(logical - 2, 0)));
  EXPECT_FALSE(view_.pick(middle() - QPoint(logical + 3, 0)));
}

TEST(MeshViewProcessTest, ScaleFactors) {
  for (const char* factor : {"1", "1.5", "2"}) {
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("QT_SCALE_FACTOR", factor);
    environment.insert("ARRIS_EXPECTED_RATIO", factor);
    process.setProcessEnvironment(environment);
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(
        QCoreApplication::applicationFilePath(),
        {"--gtest_filter=MeshViewTest.FitsItsScaleFactor:MeshViewTest.ShowsThePartOpaquely:"
         "MeshViewTest.PictureIsTheScreenButForItsGround"});
    ASSERT_TRUE(process.waitForFinished(120'000)) << factor;
    EXPECT_EQ(process.exitCode(), 0) << factor << '\n' << process.readAll().toStdString();
  }
}

TEST(ColourScaleTest, PositionsRunFromMinToMax) {
  ColourScale scale;
  scale.min = 2.0;
  scale.max = 6.0;
  EXPECT_DOUBLE_EQ(scale.position(2.0), 0.0);
  EXPECT_DOUBLE_EQ(scale.position(3.0), 0.25);
  EXPECT_DOUBLE_EQ(scale.position(6.0), 1.0);
  EXPECT_TRUE(std::isnan(scale.position(std::numeric_limits<double>::quiet_NaN())));
  scale.min = 0.01;
  scale.max = 100.0;
  scale.logarithmic = true;
  EXPECT_NEAR(scale.position(1.0), 0.5, 1e-12);
  EXPECT_EQ(scale.position(0.0), 0.0);
  EXPECT_EQ(scale.position(-3.0), 0.0);
  scale.min = 0.0;
  EXPECT_NEAR(scale.position(100.0 / 1e6), 0.0, 1e-12);
  EXPECT_NEAR(scale.position(0.1), 0.5, 1e-12);
}

TEST(ColourScaleTest, PaperRunsFromBlackThroughGreenToRed) {
  const ColourScale scale;
  EXPECT_EQ(scale.colour(0.0), (std::array<std::uint8_t, 3>{0, 0, 0}));
  const auto middle = scale.colour(0.5);
  EXPECT_GT(middle[1], 150);
  EXPECT_LT(middle[0] + middle[2], 60);
  const auto high = scale.colour(1.0);
  EXPECT_GT(high[0], 150);
  EXPECT_LT(high[1] + high[2], 60);
}

TEST(ColourScaleTest, BandsReversalAndOwnColours) {
  ColourScale scale;
  scale.map = ColourMap::viridis;
  const auto low = scale.colour(0.0);
  const auto high = scale.colour(1.0);
  EXPECT_EQ(scale.colour(-5.0), low);
  EXPECT_EQ(scale.colour(5.0), high);
  scale.reversed = true;
  EXPECT_EQ(scale.colour(0.0), high);
  EXPECT_EQ(scale.colour(1.0), low);
  scale.reversed = false;
  scale.bands = 4;
  EXPECT_EQ(scale.colour(0.01), scale.colour(0.24));
  EXPECT_NE(scale.colour(0.24), scale.colour(0.26));
  EXPECT_EQ(scale.colour(0.0), low);
  EXPECT_EQ(scale.colour(1.0), high);
  scale.below = Qt::blue;
  scale.above = Qt::magenta;
  EXPECT_EQ(scale.colour(-0.001), (std::array<std::uint8_t, 3>{0, 0, 255}));
  EXPECT_EQ(scale.colour(1.001), (std::array<std::uint8_t, 3>{255, 0, 255}));
  scale.undefined = QColor(1, 2, 3);
  EXPECT_EQ(scale.colour(std::numeric_limits<double>::quiet_NaN()),
            (std::array<std::uint8_t, 3>{1, 2, 3}));
}

TEST(ColourScaleTest, ConstantAndEmptyRangesAreSafe) {
  ColourScale scale;
  scale.min = scale.max = 3.0;
  for (const bool logarithmic : {false, true}) {
    scale.logarithmic = logarithmic;
    for (const double value : {-1.0, 0.0, 3.0, 4.0, HUGE_VAL, -HUGE_VAL}) {
      EXPECT_FALSE(std::isnan(scale.position(value)));
      scale.colour(value);
    }
  }
}

TEST(PartitionColoursTest, NeighboursAreNeverAlike) {
  // A ring with chords, a star that needs more colours than there are soft ones, and a full graph.
  std::vector<std::vector<std::array<std::uint32_t, 2>>> graphs(3);
  for (std::uint32_t i = 0; i < 60; ++i) {
    graphs[0].push_back({i, (i + 1) % 60});
    graphs[0].push_back({i, (i + 7) % 60});
    if (i > 0) graphs[1].push_back({0, i});
  }
  for (std::uint32_t i = 0; i < 30; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) graphs[2].push_back({i, j});
  }
  for (const auto& neighbours : graphs) {
    const auto colours = partition_colours(60, neighbours);
    ASSERT_EQ(colours.size(), 60u);
    for (const auto& [a, b] : neighbours) {
      EXPECT_GT(difference(colours[a].rgb(), colours[b].rgb()), 8) << a << ' ' << b;
    }
    EXPECT_EQ(partition_colours(60, neighbours), colours);
  }
  EXPECT_TRUE(partition_colours(0, {}).empty());
  EXPECT_EQ(partition_colours(2, {{{5, 9}}}).size(), 2u);
}

TEST(OverlayTest, NumbersAreShortAndExact) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(1.0), "1");
  EXPECT_EQ(short_number(0.012345), "0.0123");
  EXPECT_EQ(short_number(-2.5), "−2.5");
  EXPECT_EQ(short_number(1234.5), "1230");
  EXPECT_EQ(short_number(0.00000451), "4.5·10⁻⁶");
  EXPECT_EQ(short_number(1e7), "10⁷");
  EXPECT_EQ(short_number(9.9999e-7), "10⁻⁶");
}

TEST(OverlayTest, RoundLengths) {
  for (const double most : {0.013, 0.99, 1.0, 1.99, 2.0, 4.7, 5.0, 9.99, 10.0, 73.0, 4e5}) {
    const double length = round_length(most);
    EXPECT_LE(length, most * (1 + 1e-9));
    EXPECT_GT(length, most / 2.6);
    const double digit = length / std::pow(10.0, std::floor(std::log10(length * 1.0000001)));
    EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 ||
                std::abs(digit - 5) < 1e-6)
        << most << ' ' << length;
  }
}

TEST(OverlayTest, TicksLieOnTheScale) {
  ColourScale scale;
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-3.0, 7.0}, {1e-6, 3e-6}, {0.02, 500.0}}) {
    scale.min = low;
    scale.max = high;
    for (const bool logarithmic : {false, true}) {
      scale.logarithmic = logarithmic && low >= 0.0;
      const auto ticks = tick_values(scale, 6);
      EXPECT_LE(ticks.size(), 14u);
      for (const double tick : ticks) {
        EXPECT_GE(scale.position(tick), -1e-9);
        EXPECT_LE(scale.position(tick), 1.0 + 1e-9);
      }
    }
  }
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

TEST(CoarseMeshTest, IsLighterAndStaysNear) {
  const MeshPtr mesh = mesh_of(testing::icosphere(10.0, 6));
  const CoarseMesh coarse = make_coarse(*mesh, 2000);
  EXPECT_GT(coarse.triangles.size(), 500u);
  EXPECT_LT(coarse.triangles.size(), 8000u);
  ASSERT_EQ(coarse.triangles.size(), coarse.source_faces.size());
  for (std::size_t i = 0; i < coarse.triangles.size(); ++i) {
    const Triangle& source = mesh->triangle(coarse.source_faces[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE((mesh->point(coarse.triangles[i][k]) - mesh->point(source[k])).norm(),
                2.0 * coarse.cell);
    }
  }
}

}  // namespace
}  // namespace arris::ui
