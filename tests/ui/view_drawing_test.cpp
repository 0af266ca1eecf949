// What the view draws: fields, labels, lines, and that it fits its window.

#include <QMainWindow>
#include <QOpenGLDebugLogger>
#include <QProcess>

#include "tests/ui/view_fixture.h"

namespace arris::ui {
namespace {

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
    ASSERT_TRUE(resize(size));
    view_.zoom_to({0, static_cast<VertexId>(plane(10.0, 1.0)->vertex_count() - 1)});
    QCoreApplication::processEvents();  // drawn once as it is
    // Closer, so that the plane covers every pixel.
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

/// Pixels well inside what `image` shows of the wanted part of the mesh.
std::vector<QRgb> inner_pixels(MeshView& view, const QImage& image,
                               const std::function<bool(const Pick&)>& wanted) {
  std::vector<QRgb> pixels;
  const double ratio = view.devicePixelRatio();
  const auto is_wanted = [&](int x, int y) {
    const auto pick = view.pick({x, y});
    return pick && wanted(*pick);
  };
  constexpr int margin = 3;
  for (int y = margin; y < view.height() - margin; y += 5)
    for (int x = margin; x < view.width() - margin; x += 5)
      if (is_wanted(x, y) && is_wanted(x - margin, y) && is_wanted(x + margin, y) &&
          is_wanted(x, y - margin) && is_wanted(x, y + margin))
        pixels.push_back(image.pixel(QPoint(qRound(x * ratio), qRound(y * ratio))));
  return pixels;
}

int spread(const std::vector<QRgb>& pixels) {
  int most = 0;
  for (const QRgb pixel : pixels) most = std::max(most, difference(pixel, pixels.front()));
  return most;
}

TEST_F(MeshViewTest, ColoursOfAFieldAreThoseOfTheScaleWhateverWayTheSurfaceFaces) {
  const MeshPtr mesh = mesh_of(testing::icosphere(10.0, 4));
  view_.set_mesh(mesh, true);
  view_.set_scalar_bar_visible(false);
  ViewField field = field_of(*mesh, [](const Point&) { return 0.4; });
  field.scale.map = ColourMap::viridis;
  view_.set_field(field);
  const auto inside = [](const Pick& pick) { return pick.face != no_id; };
  const QRgb colour = rgb(field.scale.colour(0.4));
  std::size_t count = 0;
  for (const QRgb pixel : inner_pixels(view_, grab(), inside)) {
    EXPECT_LE(difference(pixel, colour), 3);
    ++count;
  }
  EXPECT_GT(count, 500u);
  view_.set_fields_lit(true);
  EXPECT_GT(spread(inner_pixels(view_, grab(), inside)), 40) << "light shows the shape";
}

TEST_F(MeshViewTest, UndefinedIsHatchedSoThatNoColourUnderAnyLightLooksLikeIt) {
  const MeshPtr mesh = mesh_of(testing::icosphere(10.0, 4));
  view_.set_mesh(mesh, true);
  view_.set_scalar_bar_visible(false);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ViewField field = field_of(*mesh, [&](const Point&) { return nan; });
  field.scale.undefined = QColor(120, 130, 140);
  for (const bool lit : {false, true}) {
    view_.set_fields_lit(lit);
    view_.set_field(field);
    const QImage image = grab();
    // Two tones, side by side wherever one looks.
    for (const QPoint at : {middle(), middle() + QPoint(80, 0), middle() - QPoint(50, 60)}) {
      int dark = 0, light = 0;
      for (int k = -12; k <= 12; ++k) {
        const QRgb pixel = image.pixel(at + QPoint(k, 0));
        dark += difference(pixel, qRgb(120, 130, 140)) <= 4;
        light += qRed(pixel) > 180;
      }
      EXPECT_GE(dark, 8) << lit;
      EXPECT_GE(light, 8) << lit;
    }
  }
}

TEST_F(MeshViewTest, FlatSidesOfAWeldedCubeLookFlat) {
  for (const int divisions : {1, 4}) {
    const MeshPtr mesh = divisions == 1 ? mesh_of(testing::cube(10.0))
                                        : mesh_of(testing::divided_cube(10.0, divisions));
    view_.set_mesh(mesh, false);
    view_.look_from(MeshView::StandardView::isometric);
    const QImage image = grab();
    std::vector<QRgb> sides;
    for (int axis = 0; axis < 3; ++axis)
      for (const double end : {0.0, 10.0}) {
        const std::vector<QRgb> pixels = inner_pixels(view_, image, [&](const Pick& pick) {
          const Point p = pick.point - mesh->box_min();
          if (pick.face == no_id || std::abs(p[axis] - end) > 1e-6) return false;
          const double margin = 0.3;
          const int u = (axis + 1) % 3, v = (axis + 2) % 3;
          return p[u] > margin && p[u] < 10.0 - margin && p[v] > margin && p[v] < 10.0 - margin;
        });
        if (pixels.size() < 50) continue;
        sides.push_back(pixels.front());
        if (divisions == 1) {
          EXPECT_LE(spread(pixels), 4) << axis << ' ' << end;  // under 2 %
        }
      }
    ASSERT_EQ(sides.size(), 3u);
    EXPECT_GT(difference(sides[0], sides[1]), 8);
    EXPECT_GT(difference(sides[1], sides[2]), 8);
  }
}

TEST_F(MeshViewTest, FlatShadingShowsEachFaceByItself) {
  const MeshPtr mesh = mesh_of(testing::icosphere(10.0, 2));
  view_.set_mesh(mesh, true);
  const FaceId face = view_.pick(middle())->face;
  const auto on_face = [&](const Pick& pick) { return pick.face == face; };
  EXPECT_GT(spread(inner_pixels(view_, grab(), on_face)), 2) << "a sphere is smooth";
  view_.set_flat_shading(true);
  EXPECT_LE(spread(inner_pixels(view_, grab(), on_face)), 1);
  view_.set_flat_shading(false);
  EXPECT_GT(spread(inner_pixels(view_, grab(), on_face)), 2);
}

TEST_F(MeshViewTest, AFittedPartStaysClearOfABarOrLegendThatComesLater) {
  const auto covered = [&](const QRect& corner) {
    int hits = 0;
    for (int y = corner.top(); y < corner.bottom(); y += 4)
      for (int x = corner.left(); x < corner.right(); x += 4)
        hits += view_.pick({x, y}).has_value();
    return hits;
  };
  // A square reaches under the legend of lines, a wide part under the scalar bar.
  const MeshPtr square = plane(10.0, 1.0);
  view_.set_mesh(square, false);
  view_.look_from(MeshView::StandardView::top);
  const QRect left(80, 30, 30, 12), right(view_.width() - 70, 140, 50, 100);
  ASSERT_GT(covered(left), 5);
  ViewLine line;
  line.id = 1;
  line.vertices = row(*square, square->box_min().y() + 5.0);
  view_.set_lines({line});
  EXPECT_EQ(covered(left), 0) << "the legend is there now";
  EXPECT_TRUE(view_.is_fitted());

  testing::Triangles stretched = testing::noisy_plane(10.0, 1.0, 0.0, 0.0, 1);
  for (Point& p : stretched.points) p.x() *= 3.0;
  const MeshPtr wide = mesh_of(stretched);
  view_.set_mesh(wide, false);
  view_.look_from(MeshView::StandardView::top);
  ASSERT_GT(covered(right), 20);
  const ViewField field = field_of(*wide, [](const Point& p) { return p.x(); });
  view_.set_field(field);
  EXPECT_EQ(covered(right), 0) << "the scalar bar is there now";
  EXPECT_TRUE(view_.is_fitted());
  // Not once the camera is the user's.
  view_.set_field(std::nullopt);
  view_.fit();
  view_.zoom_by(1.1);
  const auto before = view_.pick(middle());
  view_.set_field(field);
  EXPECT_EQ(view_.pick(middle())->point, before->point);
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

TEST_F(MeshViewTest, LinesThatWereThereBeforeLookAsIfTheyWereNew) {
  const MeshPtr mesh = plane(10.0, 1.0);
  const auto line = [&](std::uint32_t id, double y, LineType type) {
    ViewLine made;
    made.id = id;
    made.type = type;
    made.vertices = row(*mesh, mesh->box_min().y() + y);
    return made;
  };
  view_.set_legend_visible(false);  // beside which the part would be fitted
  view_.set_mesh(mesh, true);
  view_.set_lines({line(1, 2.0, LineType::c0_convex), line(2, 5.0, LineType::c0_concave),
                   line(3, 8.0, LineType::gn)});
  grab();
  // One is gone, one is of another type and one is new; the order is another.
  const std::vector<ViewLine> lines{line(2, 5.0, LineType::border), line(4, 7.0, LineType::gn),
                                    line(3, 8.0, LineType::gn)};
  view_.set_lines(lines);
  const QImage again = grab();
  view_.set_mesh(mesh, true);
  view_.set_lines(lines);
  EXPECT_EQ(grab(), again);
}

TEST_F(MeshViewTest, LabelsAsTheyWereLeaveTheSurfaceAsItIs) {
  const MeshPtr mesh = plane(10.0, 2.0);
  view_.set_mesh(mesh, true);
  const std::vector<QColor> colours{QColor(), QColor(200, 60, 60)};
  const std::vector<std::uint32_t> labels(mesh->face_count(), 1);
  view_.set_face_labels(labels, colours);
  const QImage red = grab();
  view_.set_face_labels(labels, colours);
  EXPECT_EQ(grab(), red);
  // One of the two alone is a change.
  view_.set_face_labels(labels, {QColor(), QColor(60, 60, 200)});
  const QImage blue = grab();
  EXPECT_GT(unlike(blue, red, 40), 0.1);
  view_.set_face_labels({}, {});
  EXPECT_GT(unlike(grab(), blue, 40), 0.1);
}

/// A view whose OpenGL tells of each fault, also those that VTK asks for and passes over.
TEST(MeshViewDebugTest, NothingThatIsDrawnIsAFaultToOpenGl) {
  MeshView view;
  QSurfaceFormat debugged = view.format();
  debugged.setOption(QSurfaceFormat::DebugContext);
  view.setFormat(debugged);
  view.resize(500, 400);
  view.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
  QOpenGLDebugLogger logger;
  QStringList faults;
  QObject::connect(&logger, &QOpenGLDebugLogger::messageLogged,
                   [&](const QOpenGLDebugMessage& message) {
                     if (message.type() == QOpenGLDebugMessage::ErrorType)
                       faults << message.message();
                   });
  view.makeCurrent();
  if (!view.context()->hasExtension("GL_KHR_debug")) GTEST_SKIP() << "this OpenGL does not tell";
  ASSERT_TRUE(logger.initialize());
  logger.startLogging(QOpenGLDebugLogger::SynchronousLogging);
  view.doneCurrent();

  const MeshPtr mesh = mesh_of(testing::torus(10.0, 3.0, 60, 30));
  view.set_mesh(mesh, true);
  ViewField field = field_of(*mesh, [](const Point& p) { return p.x(); });
  view.set_field(field);
  view.grabFramebuffer();
  view.set_edges_visible(true);
  view.grabFramebuffer();
  field.element = Element::edge;
  field.values = std::make_shared<std::vector<double>>(mesh->edge_count(), 1.0);
  view.set_field(field);
  view.grabFramebuffer();
  view.set_face_labels(std::vector<std::uint32_t>(mesh->face_count(), 1), {QColor(), Qt::red});
  ViewLine line;
  line.id = 1;
  line.vertices = {mesh->triangle(0)[0], mesh->triangle(0)[1], mesh->triangle(0)[2]};
  view.set_lines({line});
  view.set_selected_lines({1});
  view.set_ghost_paths({line.vertices});
  view.set_section(Section{Point::UnitX(), 0.0});
  view.grabFramebuffer();
  PictureOptions options;
  options.size = {700, 300};
  EXPECT_FALSE(view.picture(options).isNull());
  view.makeCurrent();
  logger.stopLogging();
  EXPECT_TRUE(faults.isEmpty()) << faults.join('\n').toStdString();
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

/// Run by ScaleFactors in a process of its own.
TEST_F(MeshViewTest, FitsItsScaleFactor) {
  const MeshPtr mesh = plane(10.0, 1.0);
  ASSERT_TRUE(resize({333, 251}));
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

}  // namespace
}  // namespace arris::ui
