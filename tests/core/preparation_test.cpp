// What the preparation (sections 4.1 to 4.3) is for: fewer vertices, truer normals, better faces,
// the lines still there. Measured on the sample mould, whose truth is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/edge_swapping/equilateralize.h"
#include "core/edge_swapping/swap_edges.h"
#include "core/mesh/distance.h"
#include "core/mesh/geometry.h"
#include "core/simplification/simplify.h"
#include "tests/support/documents.h"
#include "tests/support/nearest.h"

namespace arris {
namespace {

using testing::applied;
using testing::document_of;
using testing::value_of;

const ChunkedArray<Origin> no_edges;

std::size_t vertices_in_faces(const Mesh& mesh) {
  std::size_t count = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) count += !mesh.is_isolated(v);
  return count;
}

/// Share of a true line's points within `reach` of a line found.
double share_found(const TrueLine& line, const Document& document, double reach) {
  std::size_t near = 0;
  for (const Point& p : line.points) {
    double least = reach * reach * 2.0;
    for (const LinePtr& found : document.lines.lines)
      for (std::size_t i = 0; i + 1 < found->vertices.size(); ++i)
        least = std::min(least,
                         squared_distance_to_segment(p, document.mesh->point(found->vertices[i]),
                                                     document.mesh->point(found->vertices[i + 1])));
    near += least <= reach * reach;
  }
  return static_cast<double>(near) / static_cast<double>(line.points.size());
}

TEST(Preparation, AtTheSensorsAccuracyHalfTheVerticesGo) {
  const MouldOptions options;
  const Document document = document_of(testing::sample_mould(options.edge_length));
  const Document simplified =
      applied(document, {"simplify", {{"error_zone", options.noise}, {"max_edge_length", 0.0}}});
  EXPECT_LE(2 * vertices_in_faces(*simplified.mesh), vertices_in_faces(*document.mesh));
}

TEST(Preparation, TheTrueSharpLinesAreStillFound) {
  SampleMould mould = make_mould();
  const Document document = document_of({mould.points, mould.triangles});
  const double mean = document.mesh->mean_edge_length();
  Document prepared = applied(document, {"simplify"});
  prepared = applied(prepared, {"find_sharp_lines", {{"method", "walk"}}});
  EXPECT_LE(vertices_in_faces(*prepared.mesh), 0.55 * vertices_in_faces(*document.mesh));
  int lines = 0;
  for (const TrueLine& line : mould.lines) {
    // Those whose angle stays what it is all along; the others fade out below any threshold.
    if (line.fillet || !line.name.starts_with("boss")) continue;
    ++lines;
    EXPECT_GE(share_found(line, prepared, mean), 0.95) << line.name;
  }
  EXPECT_EQ(lines, 2);
}

/// Mean angle in degrees between the normals of a clean mesh and those of another at the same
/// places, weighted by area.
double normal_error(const Mesh& clean, const Mesh& mesh) {
  const auto normal = [](const Mesh& m, FaceId f) {
    const Triangle& t = m.triangle(f);
    return Point((m.point(t[1]) - m.point(t[0])).cross(m.point(t[2]) - m.point(t[0])));
  };
  const testing::Nearest nearest = testing::Nearest::faces(mesh);
  double sum = 0.0, area = 0.0;
  for (FaceId f = 0; f < clean.face_count(); ++f) {
    const Triangle& t = clean.triangle(f);
    const Point own = normal(clean, f);
    const auto hit =
        nearest.find((clean.point(t[0]) + clean.point(t[1]) + clean.point(t[2])) / 3.0);
    const Point other = normal(mesh, hit.element);
    sum += own.norm() * angle_between(own.normalized(), other.normalized());
    area += own.norm();
  }
  return sum / area * 180.0 / std::numbers::pi;
}

TEST(Preparation, NormalsComeNearerToTheTruthAndNearerStillWithSwaps) {
  const MouldOptions noisy, clean{.noise = 0.0};
  SampleMould scan = make_mould(noisy), truth = make_mould(clean);
  const MeshPtr mesh = testing::mesh_of({scan.points, scan.triangles});
  const MeshPtr clean_mesh = testing::mesh_of({truth.points, truth.triangles});
  SimplifyOptions options;
  options.error_zone = 3.0 * noisy.noise;
  options.cost = StarCost::angle;
  const Prepared simplified = value_of(simplify(*mesh, nullptr, no_edges, options));
  const Prepared swapped = value_of(swap_edges(*simplified.mesh, simplified.zones, no_edges));
  const double before = normal_error(*clean_mesh, *mesh);
  const double after = normal_error(*clean_mesh, *simplified.mesh);
  EXPECT_LT(after, 0.9 * before);
  EXPECT_LT(normal_error(*clean_mesh, *swapped.mesh), after);
}

/// Share of face angles above 120 degrees.
double blunt_share(const Mesh& mesh) {
  std::size_t blunt = 0;
  for (const Triangle& t : mesh.triangles())
    for (int k = 0; k < 3; ++k)
      blunt += corner_angle(mesh.point(t[k]), mesh.point(t[(k + 1) % 3]),
                            mesh.point(t[(k + 2) % 3])) > 2.0 * std::numbers::pi / 3.0;
  return static_cast<double>(blunt) / (3.0 * static_cast<double>(mesh.face_count()));
}

TEST(Preparation, EquilateralisationLeavesFewerBluntAngles) {
  for (const testing::Triangles& part :
       {testing::irregular_sphere(10.0, 3000, 3), testing::torus(10.0, 3.0, 90, 30)}) {
    const MeshPtr mesh = testing::mesh_of(part);
    SimplifyOptions options;
    options.error_zone = 0.1;
    const Prepared simplified = value_of(simplify(*mesh, nullptr, no_edges, options));
    const Prepared better = value_of(equilateralize(*simplified.mesh, simplified.zones, no_edges));
    const double before = blunt_share(*simplified.mesh), after = blunt_share(*better.mesh);
    EXPECT_LT(after, before);
  }
}

}  // namespace
}  // namespace arris
