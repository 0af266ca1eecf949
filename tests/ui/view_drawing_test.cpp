// What the view draws: fields, labels, lines, and that it fits its window.

#include <QMainWindow>
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

}  // namespace
}  // namespace arris::ui
