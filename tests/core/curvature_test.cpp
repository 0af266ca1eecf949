#include "core/curvature/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <ostream>
#include <stop_token>
#include <string>

#include "core/base/random.h"
#include "core/base/thread_limit.h"
#include "core/mesh/geometry.h"
#include "tests/support/meshes.h"
#include "tests/support/test_name.h"

namespace arris {
namespace {

using namespace arris::testing;

constexpr double pi = std::numbers::pi;
constexpr std::array pairings{InvariantPairing::h1_k1, InvariantPairing::h2_k1,
                              InvariantPairing::h1_k2, InvariantPairing::h2_k2};

CurvaturesPtr curvatures_of(const Mesh& mesh, InvariantPairing pairing = InvariantPairing::h1_k1) {
  CurvatureOptions options;
  options.pairing = pairing;
  Result<CurvaturesPtr> result = compute_curvatures(mesh, options);
  if (!result) throw std::logic_error(result.error().message);
  return *result;
}

double largest_error(const std::vector<double>& values, double truth) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value - truth));
  return largest;
}

double mean_error(const std::vector<double>& values, double truth) {
  double sum = 0.0;
  for (const double value : values) sum += std::abs(value - truth);
  return sum / values.size();
}

/// Neighbours of v in the order of its faces.
std::vector<VertexId> ring(const Mesh& mesh, VertexId v) {
  std::vector<VertexId> result;
  mesh.for_ring(v, [&](HalfEdgeId h) { result.push_back(mesh.to(h)); });
  return result;
}

/// Splits flat faces at v0 again: each face {0, a, b} becomes two at a point on the side a-b.
Triangles split_round_first(const Triangles& mesh, const std::vector<double>& shares) {
  Triangles result{mesh.points, {}};
  std::size_t k = 0;
  for (Triangle t : mesh.triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    if (t[0] != 0) continue;
    const double share = shares[k++ % shares.size()];
    if (share <= 0.0) {
      result.triangles.push_back(t);
      continue;
    }
    const auto middle = static_cast<VertexId>(result.points.size());
    result.points.push_back((1.0 - share) * mesh.points[t[1]] + share * mesh.points[t[2]]);
    result.triangles.push_back({t[0], t[1], middle});
    result.triangles.push_back({t[0], middle, t[2]});
  }
  return result;
}

struct CornerCase {
  std::array<int, 3> sectors;
  double ik1, ikabs, tolerance;
};

/// Otherwise GoogleTest prints the bytes of the case, which are not all of them set.
void PrintTo(const CornerCase& c, std::ostream* out) {
  *out << "sectors " << c.sectors[0] << " " << c.sectors[1] << " " << c.sectors[2];
}

class BoxCorner : public ::testing::TestWithParam<CornerCase> {};

TEST_P(BoxCorner, HasTheValuesOfTheMethod) {
  const auto& [sectors, ik1, ikabs, tolerance] = GetParam();
  const MeshPtr mesh = mesh_of(box_corner(sectors[0], sectors[1], sectors[2]));
  const CurvaturesPtr c = curvatures_of(*mesh);
  ASSERT_FALSE(mesh->is_border(0));
  EXPECT_NEAR(c->ih1[0], 1.5, 1e-6);
  EXPECT_NEAR(c->ik1[0], ik1, tolerance);
  EXPECT_NEAR(c->ikabs[0], ikabs, tolerance);
  EXPECT_NEAR(c->ik2[0], 2.0, 1e-12);
  EXPECT_NEAR(curvatures_of(*mesh, InvariantPairing::h1_k2)->ikabs[0], 5.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Curvature, BoxCorner,
    ::testing::Values(CornerCase{{1, 1, 1}, 4.0 / 3.0, 19.0 / 3.0, 1e-5},
                      CornerCase{{1, 1, 2}, 1.534, 5.932, 6e-4},
                      CornerCase{{2, 1, 1}, 1.534, 5.932, 6e-4},
                      CornerCase{{2, 2, 2}, 2.196, 4.609, 6e-4},
                      CornerCase{{200, 200, 200}, 8.0 / 3.0, 11.0 / 3.0, 1e-3}),
    [](const auto& corner) { return test_name(::testing::PrintToString(corner.param)); });

TEST(Curvature, SplittingFlatFacesLeavesTheInvariantsAlone) {
  // A corner of three unequal sectors, convex, and one of a saddle.
  const std::vector<Triangles> corners{
      {{{0, 0, 0}, {2, 0, -0.5}, {-0.3, 1.7, -1}, {-1, -1.5, -0.2}},
       {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}},
      {{{0, 0, 0}, {2, 0, 1}, {0, 1.5, -1}, {-1.2, 0, 1.4}, {0, -1, -0.7}},
       {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}}};
  for (const Triangles& corner : corners) {
    const CurvaturesPtr whole = curvatures_of(*mesh_of(corner), InvariantPairing::h1_k2);
    for (const std::vector<double>& shares :
         {std::vector{0.5}, std::vector{0.1, 0.9}, std::vector{0.3, 0.0, 0.8, 0.55}}) {
      const MeshPtr mesh = mesh_of(split_round_first(corner, shares));
      const CurvaturesPtr split = curvatures_of(*mesh, InvariantPairing::h1_k2);
      EXPECT_NEAR(split->ih1[0], whole->ih1[0], 1e-6);
      EXPECT_NEAR(split->ik2[0], whole->ik2[0], 1e-10);
      EXPECT_NEAR(split->ikabs[0], whole->ikabs[0], 1e-5);
      EXPECT_EQ(split->ik1[0] > 0.0, whole->ik1[0] > 0.0);
      for (const VertexId v : ring(*mesh, 0)) {
        const double beta = split->beta[*mesh->find_edge(0, v)];
        if (v < corner.points.size()) {
          EXPECT_NEAR(beta, whole->beta[*mesh_of(corner)->find_edge(0, v)], 1e-6);
        } else {
          EXPECT_NEAR(beta, 0.0, 1e-6);
        }
      }
    }
  }
}

class StraightEdge : public ::testing::TestWithParam<double> {};

TEST_P(StraightEdge, KeepsOneIkabsUpToTheRaggedBorder) {
  const double angle = GetParam();
  // The ends of the roof are torn: the ridge ends at (0, 0, 0), its neighbours on the border move
  // along y, but within their planes.
  Triangles torn = roof(angle, 4.0, 10.0, 1.0);
  Random random(7);
  for (Point& p : torn.points)
    if ((p.y() == 0.0 || p.y() == 10.0) && std::abs(p.x()) > 1e-9)
      p.y() += random.uniform(-0.8, 0.8);
  for (const Triangles& triangles : {roof(angle, 4.0, 10.0, 1.0), torn}) {
    const MeshPtr mesh = mesh_of(triangles);
    for (const InvariantPairing pairing : {InvariantPairing::h1_k1, InvariantPairing::h1_k2}) {
      const CurvaturesPtr c = curvatures_of(*mesh, pairing);
      int on_ridge = 0;
      for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
        if (std::abs(mesh->point(v).x()) > 1e-9) continue;
        ++on_ridge;
        const bool border = mesh->is_border(v);
        // At the border one edge of the ridge stands for the half of the star that is there.
        EXPECT_NEAR(c->ih1[v], 3.0 * angle / (2.0 * pi), 1e-6) << "border " << border;
        EXPECT_NEAR(c->ik1[v], 0.0, 1e-9);
        EXPECT_NEAR(c->ik2[v], 0.0, 1e-9);
        EXPECT_NEAR(c->ikabs[v], ikabs_of_straight_edge(angle), 1e-5);
        EXPECT_EQ(std::isnan(c->k[v]), border);
      }
      EXPECT_EQ(on_ridge, 11);
    }
  }
  EXPECT_DOUBLE_EQ(ikabs_of_straight_edge(angle), 9.0 * angle * angle / (pi * pi));
}

INSTANTIATE_TEST_SUITE_P(Curvature, StraightEdge,
                         ::testing::Values(0.05, 0.5, pi / 2.0, 2.5, -0.5, -pi / 2.0),
                         [](const auto& angle) {
                           const auto degrees = std::lround(std::abs(angle.param) * 180.0 / pi);
                           return (angle.param > 0.0 ? "convex_by_" : "concave_by_") +
                                  std::to_string(degrees) + "_degrees";
                         });

TEST(Curvature, ScalingScalesCurvaturesAndLeavesInvariantsAlone) {
  const Triangles base = random_terrain(12, 3);
  const MeshPtr mesh = mesh_of(base);
  const CurvaturesPtr c = curvatures_of(*mesh);
  for (const double s : {1e-3, 0.5, 8.0, 1e4}) {
    Triangles scaled = base;
    for (Point& p : scaled.points) p *= s;
    const CurvaturesPtr d = curvatures_of(*mesh_of(scaled));
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      if (mesh->is_border(v)) continue;
      const double size = std::abs(c->h[v]) + std::sqrt(std::abs(c->k[v]));
      EXPECT_NEAR(d->h[v] * s, c->h[v], 1e-5 * size);
      EXPECT_NEAR(d->h_area[v] * s, c->h_area[v], 1e-5 * size);
      EXPECT_NEAR(d->k[v] * s * s, c->k[v], 1e-5 * size * size);
      EXPECT_NEAR(d->k_area[v] * s * s, c->k_area[v], 1e-5 * size * size);
      EXPECT_NEAR(d->kabs[v] * s * s, c->kabs[v], 1e-4 * size * size);
      EXPECT_NEAR(d->ih1[v], c->ih1[v], 1e-6);
      EXPECT_NEAR(d->ih2[v], c->ih2[v], 1e-6);
      EXPECT_NEAR(d->ik1[v], c->ik1[v], 1e-9);
      EXPECT_NEAR(d->ik2[v], c->ik2[v], 1e-9);
      EXPECT_NEAR(d->ikabs[v], c->ikabs[v], 1e-5);
    }
  }
}

TEST(Curvature, TurningTheFacesTurnsTheSignsOnly) {
  const Triangles base = random_terrain(12, 5);
  Triangles turned = base;
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  const MeshPtr mesh = mesh_of(base);
  const CurvaturesPtr c = curvatures_of(*mesh), d = curvatures_of(*mesh_of(turned));
  for (EdgeId e = 0; e < mesh->edge_count(); ++e) EXPECT_FLOAT_EQ(d->beta[e], -c->beta[e]);
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    EXPECT_NEAR(d->ih1[v], -c->ih1[v], 1e-9);
    EXPECT_NEAR(d->ih2[v], -c->ih2[v], 1e-9);
    EXPECT_NEAR(d->ikabs[v], c->ikabs[v], 1e-9);
    if (mesh->is_border(v)) continue;
    EXPECT_NEAR(d->h[v], -c->h[v], 1e-9);
    EXPECT_NEAR(d->k[v], c->k[v], 1e-9);
    EXPECT_NEAR(d->kabs[v], c->kabs[v], 1e-9);
    EXPECT_NEAR(d->ik1[v], c->ik1[v], 1e-9);
    EXPECT_NEAR(d->ik2[v], c->ik2[v], 1e-9);
  }
}

TEST(Curvature, AngleDeviationsAddUpToTwoPiTimesTheEulerNumber) {
  const auto sum = [](const Triangles& triangles) {
    const MeshPtr mesh = mesh_of(triangles);
    double total = 0.0;
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) total += angle_deviation(*mesh, v);
    return total;
  };
  for (int genus = 0; genus <= 3; ++genus)
    EXPECT_NEAR(sum(block_with_holes(genus)), 2.0 * pi * (2 - 2 * genus), 1e-10) << genus;
  EXPECT_NEAR(sum(irregular_sphere(3.0, 500, 1)), 4.0 * pi, 1e-9);
  EXPECT_NEAR(sum(torus(5.0, 2.0, 40, 20)), 0.0, 1e-9);
  EXPECT_NEAR(sum(cone(1.0, 2.0, 30, 5)), 4.0 * pi, 1e-9);
}

TEST(Curvature, GaussianCurvatureTimesCellsAddsUpToo) {
  const MeshPtr mesh = mesh_of(icosphere(2.0, 3));
  const CurvaturesPtr c = curvatures_of(*mesh);
  double total = 0.0;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v)
    total += angle_deviation(*mesh, v) / c->k[v];  // the areas of the cells
  double area = 0.0;
  for (const Triangle& t : mesh->triangles())
    area += (mesh->point(t[1]) - mesh->point(t[0]))
                .cross(mesh->point(t[2]) - mesh->point(t[0]))
                .norm() /
            2.0;
  ASSERT_EQ(c->mixed_area_vertices, 0u);
  EXPECT_NEAR(total, area, 1e-9 * area);
}

TEST(Curvature, SpheresConvergeOnAnyTriangulationByTheModulusButNotByTheArea) {
  constexpr double radius = 2.0;
  double before_k = 0.0, before_h = 0.0;
  for (const int vertices : {250, 1000, 4000}) {
    const CurvaturesPtr c = curvatures_of(*mesh_of(irregular_sphere(radius, vertices, 11)));
    const double k = mean_error(c->k, 1.0 / (radius * radius)) * radius * radius;
    const double h = mean_error(c->h, 1.0 / radius) * radius;
    const double h_area = mean_error(c->h_area, 1.0 / radius) * radius;
    EXPECT_LT(h, h_area) << "eq. 6 beats eq. 5";
    EXPECT_GT(h_area, 0.1) << "eq. 5 stays wrong however fine";
    if (before_k > 0.0) {  // four times the vertices: half the edge length
      EXPECT_LT(k, 0.5 * before_k);
      EXPECT_LT(h, 0.5 * before_h);
    }
    before_k = k;
    before_h = h;
  }
  EXPECT_LT(before_k, 0.005);
  EXPECT_LT(before_h, 0.005);
}

TEST(Curvature, RegularSpheresConvergeAtEveryVertex) {
  double before = std::numeric_limits<double>::infinity();
  for (int level = 2; level <= 5; ++level) {
    const CurvaturesPtr c = curvatures_of(*mesh_of(icosphere(1.0, level)));
    const double error =
        std::max({largest_error(c->k, 1.0), largest_error(c->h, 1.0), largest_error(c->kabs, 2.0)});
    EXPECT_LT(error, 0.35 * before);
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

TEST(Curvature, RegularToriConvergeAtEveryVertexByEitherEquation) {
  constexpr double major = 3.0, minor = 1.0;
  double before = std::numeric_limits<double>::infinity();
  double before_difference = before;
  for (const int n : {24, 48, 96}) {
    const MeshPtr mesh = mesh_of(torus(major, minor, 3 * n, n));
    const CurvaturesPtr c = curvatures_of(*mesh);
    double error = 0.0, difference = 0.0;
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      const Point& p = mesh->point(v);
      const double r = std::hypot(p.x(), p.y());
      const double across = (r - major) / (minor * r);
      const double h = (1.0 / minor + across) / 2.0;
      error = std::max({error, std::abs(c->h[v] - h), std::abs(c->h_area[v] - h),
                        std::abs(c->k[v] - across / minor)});
      difference = std::max(difference, std::abs(c->h[v] - c->h_area[v]));
    }
    EXPECT_LT(error, 0.35 * before) << n;
    EXPECT_LT(difference, 0.35 * before_difference) << n;
    before = error;
    before_difference = difference;
  }
  EXPECT_LT(before, 0.01);
}

TEST(Curvature, ModulusIsAThirdOfTheStarOnALattice) {
  // Lattices whose stars are symmetric about their vertex: the two areas are one and the same.
  const MeshPtr mesh = mesh_of(cylinder_wall(2.0, 3.0, 40, 12));
  const CurvaturesPtr c = curvatures_of(*mesh);
  for (VertexId v = 0; v < mesh->vertex_count(); ++v)
    if (!mesh->is_border(v)) {
      EXPECT_NEAR(c->h[v], c->h_area[v], 1e-9);
    }
}

TEST(Curvature, KabsOfACylinderTendsToOneOverTheSquaredRadius) {
  constexpr double radius = 4.0;
  double before = std::numeric_limits<double>::infinity();
  for (const int n : {16, 32, 64, 128}) {
    const double step = 2.0 * pi * radius / n;
    const MeshPtr mesh = mesh_of(cylinder_wall(radius, 10.0 * step, n, 10));
    const CurvaturesPtr c = curvatures_of(*mesh);
    double error = 0.0;
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      if (mesh->is_border(v)) continue;
      EXPECT_NEAR(c->k[v], 0.0, 1e-9);
      EXPECT_GT(c->h[v], 0.0);
      error = std::max(error, std::abs(c->kabs[v] * radius * radius - 1.0));
      EXPECT_NEAR(cylinder_radius(c->kabs[v]), radius, 0.05 * radius);
    }
    EXPECT_LT(error, 0.35 * before);
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

TEST(Curvature, EllipsoidsAreMeasuredNotAsserted) {
  constexpr double a = 3.0, b = 2.0, c = 1.5;
  for (int level = 2; level <= 5; ++level) {
    const MeshPtr mesh = mesh_of(ellipsoid(a, b, c, level));
    const CurvaturesPtr curvatures = curvatures_of(*mesh);
    double k_error = 0.0, h_error = 0.0;
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      const Point p = mesh->point(v);
      const Point q(p.x() / (a * a), p.y() / (b * b), p.z() / (c * c));
      const double w = q.squaredNorm(), abc = a * b * c;
      const double k = 1.0 / (abc * abc * w * w);
      const double h =
          std::abs(p.squaredNorm() - a * a - b * b - c * c) / (2.0 * abc * abc * std::pow(w, 1.5));
      EXPECT_TRUE(std::isfinite(curvatures->k[v]) && std::isfinite(curvatures->h[v]));
      k_error += std::abs(curvatures->k[v] / k - 1.0) / mesh->vertex_count();
      h_error += std::abs(curvatures->h[v] / h - 1.0) / mesh->vertex_count();
    }
    RecordProperty("mean_error_of_k_in_percent_level_" + std::to_string(level),
                   std::to_string(100.0 * k_error));
    RecordProperty("mean_error_of_h_in_percent_level_" + std::to_string(level),
                   std::to_string(100.0 * h_error));
  }
}

TEST(Curvature, ModulusIsTheAreaOfTheCircumcentricCell) {
  // A pyramid over a polygon inscribed in a circle about the foot of its apex: no obtuse angle.
  const std::vector<double> directions{0.0, 1.1, 2.3, 3.2, 4.4, 5.3};
  Triangles pyramid{{{0.0, 0.0, 0.6}}, {}};
  for (const double d : directions) pyramid.points.emplace_back(std::cos(d), std::sin(d), 0.0);
  const auto n = static_cast<VertexId>(directions.size());
  for (VertexId i = 0; i < n; ++i) pyramid.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  const MeshPtr mesh = mesh_of(pyramid);
  const CurvaturesPtr c = curvatures_of(*mesh);

  double cell = 0.0;  // built from midpoints and circumcentres
  for (const Triangle& t : pyramid.triangles) {
    const Point p = pyramid.points[t[0]], a = pyramid.points[t[1]] - p,
                b = pyramid.points[t[2]] - p;
    const Point normal = a.cross(b);
    const Point centre = (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
                         (2.0 * normal.squaredNorm());
    cell += (a / 2.0).cross(centre).dot(normal.normalized()) / 2.0;
    cell += centre.cross(b / 2.0).dot(normal.normalized()) / 2.0;
  }
  EXPECT_EQ(c->mixed_area_vertices, 0u);
  EXPECT_NEAR(angle_deviation(*mesh, 0) / c->k[0], cell, 1e-12);

  double edges = 0.0;
  for (EdgeId e = 0; e < mesh->edge_count(); ++e)
    if (!mesh->is_border_edge(e)) edges += edge_mean_curvature(*mesh, *c, e) / 2.0;
  EXPECT_NEAR(c->h[0] * cell, edges, 1e-6) << "half of He of each edge belongs to the vertex";
}

TEST(Curvature, ObtuseStarsFallBackOnTheMixedAreaAndAreCounted) {
  // On a flat cone, triangles with a wide angle away from its apex: the modulus is negative.
  Triangles star{{{0.0, 0.0, 0.0}}, {}};
  constexpr VertexId n = 8;
  for (VertexId i = 0; i < 2 * n; ++i) {
    const double reach = i % 2 ? 1.0 : 6.0, angle = pi * i / n;
    star.points.emplace_back(reach * std::cos(angle), reach * std::sin(angle), -0.05 * reach);
  }
  for (VertexId i = 0; i < 2 * n; ++i) star.triangles.push_back({0, 1 + i, 1 + (i + 1) % (2 * n)});
  const MeshPtr mesh = mesh_of(star);
  double modulus = 0.0, mixed = 0.0;
  for (const Triangle& t : star.triangles) {
    const Point a = star.points[t[1]] - star.points[0], b = star.points[t[2]] - star.points[0];
    const double area = a.cross(b).norm() / 2.0;
    modulus += area / 2.0 - a.dot(b) / (2.0 * area) * (b - a).squaredNorm() / 8.0;
    mixed += area / 4.0;  // obtuse, but not at the middle
  }
  ASSERT_LT(modulus, 0.0);
  const CurvaturesPtr c = curvatures_of(*mesh);
  EXPECT_EQ(c->mixed_area_vertices, 1u);
  EXPECT_NEAR(angle_deviation(*mesh, 0) / c->k[0], mixed, 1e-9);
  EXPECT_GT(c->k[0], 0.0);
}

TEST(Curvature, ValuesAreFiniteOnWildMeshes) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Triangles wild = random_terrain(15, seed);
    Random random(seed);
    for (Point& p : wild.points) p += 0.45 * Point(random.gaussian(), random.gaussian(), 0.0);
    const MeshPtr mesh = mesh_of(wild);
    for (const InvariantPairing pairing : pairings) {
      const CurvaturesPtr c = curvatures_of(*mesh, pairing);
      EXPECT_GT(c->mixed_area_vertices, 0u);
      for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
        for (const auto* values : {&c->ih1, &c->ih2, &c->ik1, &c->ik2, &c->ikabs})
          ASSERT_TRUE(std::isfinite((*values)[v])) << "vertex " << v;
        ASSERT_GE(c->ikabs[v], 0.0);
        if (mesh->is_border(v)) continue;
        for (const auto* values : {&c->k, &c->k_area, &c->h, &c->h_area, &c->kabs})
          ASSERT_TRUE(std::isfinite((*values)[v])) << "vertex " << v;
        ASSERT_GE(c->kabs[v], 0.0);
      }
      for (const float beta : c->beta) ASSERT_TRUE(std::isfinite(beta));
    }
  }
}

TEST(Curvature, ZeroAreaFacesContributeNoAreaAndKeepValuesFinite) {
  // A flat square fan whose first face is a sliver of no area: 0, 1 and 5 lie in a line.
  Triangles square{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {2, 0, 0}},
                   {{0, 1, 5}, {0, 5, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const MeshPtr mesh = mesh_of(square);
  const CurvaturesPtr c = curvatures_of(*mesh);
  EXPECT_NEAR(angle_deviation(*mesh, 0), 0.0, 1e-12);
  EXPECT_NEAR(c->k[0], 0.0, 1e-12);
  EXPECT_NEAR(c->h[0], 0.0, 1e-6);
  EXPECT_NEAR(c->ikabs[0], 0.0, 1e-6);
  for (const float beta : c->beta) EXPECT_NEAR(beta, 0.0, 1e-6) << "taken across the sliver";
}

TEST(Curvature, BorderAndIsolatedVerticesAreUndefinedNotZero) {
  Triangles plate = noisy_plane(8.0, 1.0, 0.1, 0.2, 3);
  plate.points.emplace_back(20.0, 20.0, 20.0);
  const MeshPtr mesh = mesh_of(plate);
  const CurvaturesPtr c = curvatures_of(*mesh);
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    const bool closed_star = !mesh->is_border(v) && !mesh->is_isolated(v);
    for (const auto* values : {&c->k, &c->k_area, &c->h, &c->h_area, &c->kabs})
      EXPECT_EQ(std::isnan((*values)[v]), !closed_star) << "vertex " << v;
    for (const auto* values : {&c->ih1, &c->ih2, &c->ik1, &c->ik2, &c->ikabs})
      EXPECT_EQ(std::isnan((*values)[v]), mesh->is_isolated(v)) << "vertex " << v;
    EXPECT_EQ(c->shape[v] == Shape::undefined, !closed_star);
    if (!mesh->is_border(v)) continue;
    double betas = 0.0;
    mesh->for_ring(v, [&](HalfEdgeId h) { betas += c->beta[h >> 1]; });
    EXPECT_NEAR(c->ih1[v], 1.5 * betas / pi, 1e-9);
    EXPECT_NEAR(c->ih2[v], c->ih1[v], 1e-12);
    EXPECT_EQ(c->ik1[v], 0.0);
    EXPECT_EQ(c->ik2[v], 0.0);
  }
  for (EdgeId e = 0; e < mesh->edge_count(); ++e)
    if (mesh->is_border_edge(e)) {
      EXPECT_EQ(c->beta[e], 0.0f);
    }
}

TEST(Curvature, OrderHoldsInteriorVerticesByDecreasingIkabs) {
  // The cube has eight equal corners: ties.
  for (const Triangles& triangles : {noisy_plane(10.0, 1.0, 0.1, 0.2, 9), divided_cube(4.0, 4),
                                     stepped_plate(5.0, 10.0, 2.0, 1.0)}) {
    const MeshPtr mesh = mesh_of(triangles);
    const CurvaturesPtr c = curvatures_of(*mesh);
    std::vector<VertexId> expected;
    for (VertexId v = 0; v < mesh->vertex_count(); ++v)
      if (!mesh->is_border(v)) expected.push_back(v);
    std::ranges::stable_sort(expected, std::greater<>(), [&](VertexId v) { return c->ikabs[v]; });
    EXPECT_EQ(c->by_decreasing_ikabs, expected);
  }
}

TEST(Curvature, ConvexIsPositive) {
  const MeshPtr mesh = mesh_of(stepped_plate(5.0, 10.0, 2.0, 1.0));
  const CurvaturesPtr c = curvatures_of(*mesh);
  int convex = 0, concave = 0;
  for (EdgeId e = 0; e < mesh->edge_count(); ++e) {
    const Point a = mesh->point(mesh->edge(e)[0]), b = mesh->point(mesh->edge(e)[1]);
    if (std::abs(c->beta[e]) < 1e-6) continue;
    EXPECT_NEAR(std::abs(c->beta[e]), pi / 2.0, 1e-6);
    EXPECT_EQ(a.x(), 0.0);
    EXPECT_EQ(b.x(), 0.0);
    EXPECT_EQ(c->beta[e] > 0.0, a.z() == 2.0) << "the upper line is convex, the lower concave";
    ++(c->beta[e] > 0.0 ? convex : concave);
    EXPECT_NEAR(edge_mean_curvature(*mesh, *c, e), 0.5 * c->beta[e] * (b - a).norm(), 1e-9);
  }
  EXPECT_EQ(convex, 10);
  EXPECT_EQ(concave, 10);
}

TEST(Curvature, CubeEdgesHaveARightExteriorAngle) {
  const MeshPtr mesh = mesh_of(cube());
  const CurvaturesPtr c = curvatures_of(*mesh);
  int right = 0;
  for (const float beta : c->beta) {
    EXPECT_TRUE(std::abs(beta) < 1e-6 || std::abs(beta - pi / 2.0) < 1e-6);
    right += beta > 1.0f;
  }
  EXPECT_EQ(right, 12);
}

void expect_shape(
    const Triangles& triangles, Shape shape,
    const std::function<bool(const Point&)>& counts = [](const Point&) { return true; }) {
  const MeshPtr mesh = mesh_of(triangles);
  const CurvaturesPtr c = curvatures_of(*mesh);
  int seen = 0;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    if (mesh->is_border(v) || !counts(mesh->point(v))) continue;
    ++seen;
    ASSERT_EQ(c->shape[v], shape) << "vertex " << v;
  }
  EXPECT_GT(seen, 20);
}

Triangles inside_out(Triangles triangles) {
  for (Triangle& t : triangles.triangles) std::swap(t[1], t[2]);
  return triangles;
}

TEST(Curvature, ShapesAreThoseOfTheFigures) {
  expect_shape(icosphere(2.0, 4), Shape::elliptic_convex);
  expect_shape(inside_out(icosphere(2.0, 4)), Shape::elliptic_concave);
  expect_shape(cylinder_wall(2.0, 6.0, 60, 30), Shape::ridge);
  expect_shape(inside_out(cylinder_wall(2.0, 6.0, 60, 30)), Shape::valley);
  expect_shape(noisy_plane(10.0, 1.0, 0.0, 0.2, 1), Shape::flat);
  const auto inner = [](const Point& p) { return std::hypot(p.x(), p.y()) < 1.4; };
  const auto outer = [](const Point& p) { return std::hypot(p.x(), p.y()) > 2.9; };
  expect_shape(torus(2.0, 1.0, 80, 40), Shape::saddle, inner);
  expect_shape(torus(2.0, 1.0, 80, 40), Shape::elliptic_convex, outer);
}

TEST(Curvature, PlaneIsFlatInEveryQuantity) {
  const MeshPtr mesh = mesh_of(noisy_plane(10.0, 0.5, 0.0, 0.25, 4));
  const CurvaturesPtr c = curvatures_of(*mesh);
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    EXPECT_NEAR(c->ikabs[v], 0.0, 1e-9);
    if (mesh->is_border(v)) continue;
    EXPECT_NEAR(c->k[v], 0.0, 1e-9);
    EXPECT_NEAR(c->h[v], 0.0, 1e-9);
    EXPECT_NEAR(c->kabs[v], 0.0, 1e-9);
  }
}

TEST(Curvature, FlatSidesAreFlatUpToTheirEdgesHoweverTheyAreCut) {
  // A block whose sides are cut into squares, and the same drawn out into needles.
  for (const double stretch : {1.0, 1000.0}) {
    Triangles block = divided_cube(10.0, 8);
    Point low = block.points[0], high = low;
    for (Point& p : block.points) {
      p.x() *= stretch;
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const MeshPtr mesh = mesh_of(block);
    const CurvaturesPtr c = curvatures_of(*mesh);
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      int sides = 0;
      for (int axis = 0; axis < 3; ++axis)
        sides += mesh->point(v)[axis] == low[axis] || mesh->point(v)[axis] == high[axis];
      if (sides != 1) continue;
      for (const auto* values : {&c->k, &c->h, &c->kabs, &c->ikabs})
        EXPECT_NEAR((*values)[v], 0.0, 1e-9) << "vertex " << v;
    }
  }
}

TEST(Curvature, BordersDoNotReachInside) {
  // A cap of a sphere, by rings round its pole, and a pipe: every vertex off the border is right.
  constexpr int rings = 18, around = 72;
  constexpr double radius = 25.0, opening = 0.9;
  Triangles cap{{Point(0, 0, radius)}, {}};
  const auto at = [](int ring, int step) {
    return static_cast<VertexId>(1 + (ring - 1) * around + step % around);
  };
  for (int ring = 1; ring <= rings; ++ring)
    for (int step = 0; step < around; ++step) {
      const double polar = opening * ring / rings, turn = 2 * pi * step / around;
      cap.points.push_back({radius * std::sin(polar) * std::cos(turn),
                            radius * std::sin(polar) * std::sin(turn), radius * std::cos(polar)});
    }
  for (int step = 0; step < around; ++step) {
    cap.triangles.push_back({0, at(1, step), at(1, step + 1)});
    for (int ring = 1; ring < rings; ++ring) {
      cap.triangles.push_back({at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)});
      cap.triangles.push_back({at(ring, step), at(ring + 1, step + 1), at(ring, step + 1)});
    }
  }
  const auto check = [](const Triangles& part, double k, double k_error, double h, double h_error) {
    const MeshPtr mesh = mesh_of(part);
    const CurvaturesPtr c = curvatures_of(*mesh);
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      if (mesh->is_border(v)) {
        EXPECT_TRUE(std::isnan(c->k[v]) && std::isnan(c->h[v]) && std::isnan(c->kabs[v]));
        continue;
      }
      EXPECT_NEAR(c->k[v], k, k_error) << "vertex " << v;
      EXPECT_NEAR(c->h[v], h, h_error) << "vertex " << v;
    }
  };
  check(cap, 1.0 / (radius * radius), 0.05 / (radius * radius), 1.0 / radius, 0.05 / radius);
  check(cylinder_wall(10.0, 20.0, 110, 40), 0.0, 1e-6, 0.05, 0.02 * 0.05);
}

TEST(Curvature, NeedlesAreAsGoodAsOtherFaces) {
  // A pipe of radius 10 made of faces 60 long and 0.65 wide; its middle ring is off the border.
  const MeshPtr mesh = mesh_of(cylinder_wall(10.0, 120.0, 96, 2));
  const CurvaturesPtr c = curvatures_of(*mesh);
  int inside = 0;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    if (mesh->is_border(v)) continue;
    ++inside;
    EXPECT_NEAR(c->k[v], 0.0, 1e-6);
    EXPECT_NEAR(c->h[v], 0.05, 0.02 * 0.05);
    EXPECT_NEAR(c->kabs[v], 0.01, 0.04 * 0.01);
  }
  EXPECT_EQ(inside, 96);
}

TEST(Curvature, PairingsMakeUpIkabs) {
  const MeshPtr mesh = mesh_of(random_terrain(12, 8));
  for (const InvariantPairing pairing : pairings) {
    const CurvaturesPtr c = curvatures_of(*mesh, pairing);
    const bool first_h = pairing == InvariantPairing::h1_k1 || pairing == InvariantPairing::h1_k2;
    const bool first_k = pairing == InvariantPairing::h1_k1 || pairing == InvariantPairing::h2_k1;
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
      const double h = first_h ? c->ih1[v] : c->ih2[v], k = first_k ? c->ik1[v] : c->ik2[v];
      EXPECT_NEAR(c->ikabs[v], std::max(0.0, 4.0 * h * h - 2.0 * k), 1e-9);
      if (!mesh->is_border(v)) {
        EXPECT_NEAR(c->kabs[v], std::max(0.0, 4.0 * c->h[v] * c->h[v] - 2.0 * c->k[v]), 1e-9);
      }
    }
  }
}

TEST(Curvature, CornerAnglesAreExactAtAnyAngle) {
  const Point p(1.0, 2.0, 3.0), u(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0);
  for (const double angle : {1e-12, 1e-8, 0.1, pi / 2.0, 3.0, pi - 1e-8}) {
    const Point far = 1e-3 * (std::cos(angle) * u + std::sin(angle) * v);
    EXPECT_NEAR(corner_angle(Point::Zero(), 50.0 * u, far), angle, 1e-15 + 1e-14 * angle);
  }
  EXPECT_EQ(corner_angle(p, p, Point(p + u)), 0.0);
  EXPECT_DOUBLE_EQ(corner_angle(p, Point(p + u), Point(p - u)), pi);
}

TEST(Curvature, RadiusReadsAsThatOfACylinder) {
  EXPECT_DOUBLE_EQ(cylinder_radius(0.25), 2.0);
  EXPECT_TRUE(std::isinf(cylinder_radius(0.0)));
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Curvature, IsTheSameWhateverTheNumberOfThreads) {
  const MeshPtr mesh = mesh_of(noisy_plane(100.0, 1.0, 0.2, 0.25, 6));
  CurvaturesPtr one;
  {
    const ThreadLimit limit(1);
    one = curvatures_of(*mesh);
  }
  for (const std::size_t threads : {2, 3, 8}) {
    const ThreadLimit limit(threads);
    const CurvaturesPtr many = curvatures_of(*mesh);
    EXPECT_TRUE(same_bytes(one->k, many->k));
    EXPECT_TRUE(same_bytes(one->k_area, many->k_area));
    EXPECT_TRUE(same_bytes(one->h, many->h));
    EXPECT_TRUE(same_bytes(one->h_area, many->h_area));
    EXPECT_TRUE(same_bytes(one->kabs, many->kabs));
    EXPECT_TRUE(same_bytes(one->ih1, many->ih1));
    EXPECT_TRUE(same_bytes(one->ih2, many->ih2));
    EXPECT_TRUE(same_bytes(one->ik1, many->ik1));
    EXPECT_TRUE(same_bytes(one->ik2, many->ik2));
    EXPECT_TRUE(same_bytes(one->ikabs, many->ikabs));
    EXPECT_TRUE(same_bytes(one->beta, many->beta));
    EXPECT_TRUE(same_bytes(one->shape, many->shape));
    EXPECT_EQ(one->by_decreasing_ikabs, many->by_decreasing_ikabs);
    EXPECT_EQ(one->mixed_area_vertices, many->mixed_area_vertices);
    EXPECT_EQ(one->shape_tolerance, many->shape_tolerance);
  }
}

TEST(Curvature, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  const MeshPtr mesh = mesh_of(cube());
  const Result<CurvaturesPtr> result =
      compute_curvatures(*mesh, {}, Context(nullptr, stop.get_token()));
  ASSERT_FALSE(result.has_value());
  EXPECT_TRUE(result.error().cancelled);
}

}  // namespace
}  // namespace arris
