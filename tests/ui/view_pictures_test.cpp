// Pictures saved from the view.

#include "tests/ui/view_fixture.h"

namespace arris::ui {
namespace {

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

TEST_F(MeshViewTest, FitKeepsThePartClearOfScalarBarAndLegend) {
  const MeshPtr mesh = mesh_of(testing::torus(10.0, 3.0, 60, 30));
  PictureOptions options = bare(view_.size());
  for (const QSize& size : {QSize(400, 300), QSize(700, 420), QSize(420, 700)}) {
    view_.resize(size);
    options.size = size;
    for (const auto from : {MeshView::StandardView::top, MeshView::StandardView::front,
                            MeshView::StandardView::isometric}) {
      view_.set_mesh(mesh, false);
      view_.set_field(field_of(*mesh, [](const Point& p) { return 0.5 + p.x() / 30.0; }));
      view_.set_lines({{1, LineType::c0_convex, {0, 1}}, {2, LineType::gn, {2, 3}}});
      view_.look_from(from);
      view_.set_legend_visible(false);
      options.scalar_bar = false;
      const QImage part = view_.picture(options);
      view_.set_legend_visible(true);
      options.scalar_bar = true;
      const QImage with_panels = view_.picture(options);
      qint64 panels = 0, over_part = 0;
      for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x)
          if (part.pixel(x, y) != with_panels.pixel(x, y)) {
            ++panels;
            over_part += part.pixel(x, y) != qRgb(255, 255, 255);
          }
      EXPECT_GT(panels, 1000);
      EXPECT_EQ(over_part, 0) << size.width() << " x " << size.height();
    }
  }
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

TEST_F(MeshViewTest, FarFromTheOriginLooksTheSame) {
  const testing::Triangles near = testing::torus(10.0, 3.0, 60, 30);
  view_.set_mesh(mesh_of(near), true);
  const QImage expected = view_.picture(bare({400, 300}));
  testing::Triangles far = near;
  for (Point& point : far.points) point += Point(1e6, -2e6, 5e5);
  view_.set_mesh(mesh_of(far), true);
  EXPECT_LT(unlike(view_.picture(bare({400, 300})), expected, 8), 0.002);
}

}  // namespace
}  // namespace arris::ui
