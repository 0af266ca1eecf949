// The parts of the view that need no window: scales, colours, texts, stand-ins.

#include "tests/ui/view_fixture.h"
#include "ui/view/coarse_mesh.h"
#include "ui/view/colour_scale.h"
#include "ui/view/overlay_layers.h"

namespace arris::ui {
namespace {

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

/// Layers one over the other, as the graphics card lays them.
QImage laid(const std::vector<GlCanvas::Layer>& layers, QSize pixels) {
  QImage image(pixels, QImage::Format_RGBA8888_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  for (const GlCanvas::Layer& layer : layers)
    if (!layer.image.isNull()) painter.drawImage(layer.at, layer.image);
  return image;
}

TEST(OverlayLayersTest, AreTheOverlayAndArePaintedOnlyWhereItChanged) {
  for (const double scale : {1.0, 1.5, 2.0}) {
    const QSize pixels(900, 600);
    Overlay overlay;
    overlay.field = ViewField();
    overlay.field->title = "Kabs";
    overlay.line_types = {LineType::c0_convex, LineType::gn};
    overlay.hint = "a hint";
    overlay.units_per_pixel = 0.1;
    OverlayLayers layers;
    const auto changes = [&] {
      const int before = layers.painted();
      const QImage image = laid(layers.layers_of(overlay, pixels, scale), pixels);
      QImage whole(pixels, QImage::Format_RGBA8888_Premultiplied);
      whole.fill(Qt::transparent);
      QPainter painter(&whole);
      painter.scale(scale, scale);
      paint_overlay(painter, QSizeF(pixels) / scale, overlay);
      painter.end();
      EXPECT_EQ(image, whole) << scale;
      return layers.painted() - before;
    };
    EXPECT_EQ(changes(), 4);
    EXPECT_EQ(changes(), 0);
    overlay.axes = Eigen::AngleAxisd(0.7, Point(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    EXPECT_EQ(changes(), 1) << "turned";
    overlay.units_per_pixel = 0.07;
    EXPECT_EQ(changes(), 1) << "zoomed";
    overlay.hint = "another";
    EXPECT_EQ(changes(), 1);
    overlay.line_types.insert(LineType::border);  // the marker may have to give way
    EXPECT_GE(changes(), 1);
    overlay.dark = true;
    EXPECT_EQ(changes(), 4);
    overlay.scale_bar = overlay.orientation_marker = false;
    EXPECT_GE(changes(), 2);
  }
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
