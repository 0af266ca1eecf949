// Boundaries along which two surfaces touch: both rims of a fillet, with its radius, and nothing
// that has a kink.

#include "core/partitions/tangent_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/documents.h"
#include "tests/support/meshes.h"

namespace arris {
namespace {

using namespace arris::testing;

Document divided(const Triangles& part) {
  return applied(applied(document_of(part), {"find_sharp_lines"}), {"find_partitions"});
}

std::vector<TangentLine> tangent_lines_of(const Document& document) {
  const std::vector<PartitionSurface> surfaces =
      value_of(fit_partition_surfaces(*document.mesh, document.lines, document.partitions));
  const std::vector<TangentLine> lines = value_of(
      find_tangent_lines(*document.mesh, document.partitions, *document.boundaries, surfaces));
  // Without what was fitted they are the same, their radius less exact.
  const std::vector<TangentLine> alone =
      value_of(find_tangent_lines(*document.mesh, document.partitions, *document.boundaries, {}));
  EXPECT_EQ(alone.size(), lines.size());
  for (std::size_t k = 0; k < std::min(alone.size(), lines.size()); ++k) {
    EXPECT_EQ(alone[k].fillet, lines[k].fillet);
    EXPECT_NEAR(alone[k].radius, lines[k].radius, 0.15 * lines[k].radius);
  }
  return lines;
}

TEST(TangentLines, AreBothRimsOfAFilletWithItsRadius) {
  for (const double radius : {5.0, 9.0})
    for (const double noise : {0.0, 0.05, 0.1}) {
      const Document document = divided(noisy(filleted_edge(18.0, radius, 0.7), noise, 5));
      ASSERT_EQ(document.partitions.partitions.size(), 3u) << radius << " " << noise;
      const std::vector<TangentLine> lines = tangent_lines_of(document);
      ASSERT_EQ(lines.size(), 2u) << radius << " " << noise;
      EXPECT_EQ(lines[0].fillet, lines[1].fillet);
      for (const TangentLine& line : lines) {
        EXPECT_NEAR(line.radius, radius, 0.04 * radius) << noise;
        const Boundary& boundary = *(*document.boundaries)[line.boundary];
        EXPECT_EQ(boundary.type, BoundaryType::gn);
        EXPECT_TRUE(boundary.left == line.fillet || boundary.right == line.fillet);
      }
    }
}

TEST(TangentLines, AreMeasuredInTheUnitOfThePart) {
  const Triangles part = noisy(filleted_edge(18.0, 5.0, 0.7), 0.05, 5);
  const double metres = 0.001;
  const std::vector<TangentLine> lines = tangent_lines_of(
      divided(moved(part, metres, Eigen::Matrix3d::Identity(), Point(3.0, -2.0, 1.0))));
  ASSERT_EQ(lines.size(), 2u);
  for (const TangentLine& line : lines) EXPECT_NEAR(line.radius, 5.0 * metres, 0.2 * metres);
}

TEST(TangentLines, AreNotWhereAKinkIs) {
  // The cylinder begins 14 degrees off the plane: too little for a sharp line, too much to touch.
  const double radius = 12.0, kink = 14.0 * std::numbers::pi / 180.0;
  const Triangles part = shaped_lattice(40.0, 0.7, [=](double x, double y) {
    const double s = x - 20.0;
    if (s <= 0.0) return Point(s, y, 0.0);
    return Point(radius * (std::sin(kink + s / radius) - std::sin(kink)), y,
                 radius * (std::cos(kink + s / radius) - std::cos(kink)));
  });
  const Document document = divided(noisy(part, 0.05, 3));
  ASSERT_EQ(document.partitions.partitions.size(), 2u);
  EXPECT_TRUE(tangent_lines_of(document).empty());
  // Nor are sharp lines.
  EXPECT_TRUE(tangent_lines_of(divided(divided_cube(10.0, 10))).empty());
}

}  // namespace
}  // namespace arris
