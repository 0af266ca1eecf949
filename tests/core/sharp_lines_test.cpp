#include "core/sharp_lines/sharp_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "core/base/random.h"
#include "core/base/thread_limit.h"
#include "core/sharp_lines/automatic_treatments.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;

/// A mesh with its curvatures.
struct Part {
  explicit Part(const Triangles& triangles)
      : mesh(mesh_of(triangles)), curvatures(curvatures_of(*mesh)) {}

  std::vector<Origin> identify(const SharpLineOptions& options) const {
    return identify_sharp_edges(*mesh, *curvatures, options);
  }
  std::vector<Origin> find(const SharpLineOptions& options) const {
    return value_of(find_sharp_edges(*mesh, *curvatures, nullptr, options));
  }
  std::vector<Line> lines(const std::vector<Origin>& edges) const {
    return derive_lines(*mesh, *curvatures, edges);
  }
  std::vector<Line> found_lines(const SharpLineOptions& options) const {
    return lines(find(options));
  }

  MeshPtr mesh;
  CurvaturesPtr curvatures;
};

SharpLineOptions options_with_angle(double angle) {
  SharpLineOptions options;
  options.angle = angle;
  return options;
}

/// What default parameters come to on this part.
SharpLineOptions default_options(const Part& part) {
  SharpLineOptions options;
  options.angle = default_sharp_angle(*part.mesh, *part.curvatures, LineMethod::walk);
  options.min_length = default_min_length(*part.mesh, LineMethod::walk);
  return options;
}

std::size_t sharp_count(const std::vector<Origin>& edges) {
  return edges.size() - static_cast<std::size_t>(std::ranges::count(edges, Origin::none));
}

std::set<EdgeVertices> sharp_pairs(const Mesh& mesh, const std::vector<Origin>& edges) {
  std::set<EdgeVertices> pairs;
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (edges[e] != Origin::none) pairs.insert(mesh.edge(e));
  return pairs;
}

double total_length(const std::vector<Line>& lines) {
  double sum = 0.0;
  for (const Line& line : lines) sum += line.length;
  return sum;
}

/// Marks the edges of a path of vertices.
void mark(const Mesh& mesh, const std::vector<VertexId>& path, std::vector<Origin>& edges,
          Origin origin = Origin::found) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    edges[mesh.find_edge(path[i], path[i + 1]).value()] = origin;
}

/// A lattice of unit spacing bent along lines of constant x: `turns[x]` is the exterior angle in
/// degrees there (convex positive).
Triangles bent_plate(int size, const std::map<int, double>& turns) {
  return shaped_lattice(size, 1.0, [&](double x, double y) {
    Point p(0.0, y, 0.0);
    double heading = 0.0;
    for (int i = 0; i < static_cast<int>(std::lround(x)); ++i) {
      if (const auto turn = turns.find(i); turn != turns.end()) heading -= turn->second * degree;
      p += Point(std::cos(heading), 0.0, std::sin(heading));
    }
    return p;
  });
}

// ---- shapes whose lines are known ----

TEST(SharpLines, CubeOfEightVerticesHasItsTwelveEdges) {
  const Part part(cube(10.0));
  const std::vector<Line> lines = part.found_lines(options_with_angle(30.0));
  ASSERT_EQ(lines.size(), 12u);
  for (const Line& line : lines) {
    EXPECT_NEAR(line.length, 10.0, 1e-12);
    EXPECT_NEAR(line.mean_angle, 90.0, 1e-4);
    EXPECT_TRUE(line.convex());
    EXPECT_FALSE(line.closed);
  }
}

TEST(SharpLines, DividedCubeHasTwelveLinesBetweenEightCorners) {
  for (const int divisions : {2, 3, 7, 12}) {
    SCOPED_TRACE(divisions);
    const Part part(divided_cube(10.0, divisions));
    const std::vector<Origin> edges = part.find(default_options(part));
    const auto at_rim = [](const Point& p) {
      int sides = 0;
      for (int k = 0; k < 3; ++k) sides += p[k] == 0.0 || p[k] == 10.0;
      return sides;
    };
    for (EdgeId e = 0; e < part.mesh->edge_count(); ++e) {
      const auto [a, b] = part.mesh->edge(e);
      // On an edge of the cube: both ends on two sides at least, and the middle, too.
      const Point middle = (part.mesh->point(a) + part.mesh->point(b)) / 2.0;
      EXPECT_EQ(edges[e] != Origin::none, at_rim(middle) >= 2);
    }
    const std::vector<Line> lines = part.lines(edges);
    ASSERT_EQ(lines.size(), 12u);
    std::set<VertexId> ends;
    for (const Line& line : lines) {
      EXPECT_NEAR(line.length, 10.0, 1e-9);
      EXPECT_NEAR(line.mean_angle, 90.0, 1e-4);
      EXPECT_EQ(line.vertices.size(), static_cast<std::size_t>(divisions + 1));
      ends.insert({line.vertices.front(), line.vertices.back()});
    }
    ASSERT_EQ(ends.size(), 8u);
    for (const VertexId v : ends) EXPECT_EQ(at_rim(part.mesh->point(v)), 3);
  }
}

TEST(SharpLines, StepHasTwoLinesOfOppositeSignHoweverLow) {
  for (const double step : {1.0, 2.0, 5.0}) {
    SCOPED_TRACE(step);
    const Part part(stepped_plate(10.0, 20.0, step, 1.0));
    SharpLineOptions options = default_options(part);
    options.parallel_distance = 2;  // even with the wider strip
    const std::vector<Line> lines = part.found_lines(options);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_NE(lines[0].convex(), lines[1].convex());
    for (const Line& line : lines) {
      EXPECT_NEAR(line.length, 20.0, 1e-9);
      EXPECT_NEAR(std::abs(line.mean_angle), 90.0, 1e-4);
      for (const VertexId v : line.vertices) EXPECT_NEAR(part.mesh->point(v).x(), 0.0, 1e-12);
      const double z = part.mesh->point(line.vertices[0]).z();
      EXPECT_NEAR(z, line.convex() ? step : 0.0, 1e-12);
    }
  }
}

TEST(SharpLines, CappedCylinderHasItsTwoRims) {
  constexpr int around = 48;
  const Part part(capped_cylinder(10.0, 20.0, around, 10, 6));
  const std::vector<Line> lines = part.found_lines(default_options(part));
  ASSERT_EQ(lines.size(), 2u);
  for (const Line& line : lines) {
    EXPECT_TRUE(line.closed);
    EXPECT_EQ(line.vertices.front(), line.vertices.back());
    EXPECT_NEAR(line.length, around * 2.0 * 10.0 * std::sin(pi / around), 1e-9);
    EXPECT_NEAR(line.mean_angle, 90.0, 1e-3);
    const double z = part.mesh->point(line.vertices[0]).z();
    for (const VertexId v : line.vertices) EXPECT_EQ(part.mesh->point(v).z(), z);
  }
}

TEST(SharpLines, ConeHasItsBaseCircleAndNoClutterAtTheApex) {
  constexpr int around = 48;
  const Part part(cone(10.0, 10.0, around, 10));
  const std::vector<Line> lines = part.found_lines(default_options(part));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_NEAR(lines[0].length, around * 2.0 * 10.0 * std::sin(pi / around), 1e-9);
  for (const VertexId v : lines[0].vertices) EXPECT_EQ(part.mesh->point(v).z(), 0.0);
}

TEST(SharpLines, RidgeIsFoundJustAboveTheThresholdAndNotBelow) {
  for (const double angle : {15.0, 30.0, 60.0, 120.0}) {
    SCOPED_TRACE(angle);
    const Part part(roof(angle * degree, 5.0, 12.0, 1.0));
    const std::vector<Line> lines = part.found_lines(options_with_angle(angle - 0.1));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0].length, 12.0, 1e-9) << "up to both borders";
    EXPECT_NEAR(lines[0].mean_angle, angle, 1e-4);
    EXPECT_TRUE(part.mesh->is_border(lines[0].vertices.front()));
    EXPECT_TRUE(part.mesh->is_border(lines[0].vertices.back()));
    EXPECT_EQ(sharp_count(part.find(options_with_angle(angle + 0.1))), 0u);
  }
}

TEST(SharpLines, ValleyIsAConcaveRidge) {
  Triangles valley = roof(50.0 * degree, 5.0, 12.0, 1.0);
  for (Point& p : valley.points) p.z() = -p.z();
  const Part part(valley);
  const std::vector<Line> lines = part.found_lines(options_with_angle(30.0));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].mean_angle, -50.0, 1e-4);
  EXPECT_FALSE(lines[0].convex());
}

TEST(SharpLines, ThresholdOfVerticesIsTheIKabsOfAStraightEdge) {
  for (const double angle : {10.0, 30.0, 90.0}) {
    const Part part(roof(angle * degree, 5.0, 12.0, 1.0));
    for (VertexId v = 0; v < part.mesh->vertex_count(); ++v)
      if (std::abs(part.mesh->point(v).x()) < 1e-12) {
        EXPECT_NEAR(part.curvatures->ikabs[v], ikabs_of_straight_edge(angle * degree), 1e-5);
      }
    EXPECT_NEAR(ikabs_of_straight_edge(angle * degree), 9.0 * angle * angle / (180.0 * 180.0),
                1e-12);
  }
}

TEST(SharpLines, NoisyPlaneHasNone) {
  for (const double sigma : {0.0, 0.02, 0.03, 0.04})  // of the spacing; a scanner's is 0.04 to 0.1
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Part part(noisy_plane(40.0, 1.0, sigma, 0.2, seed));
      EXPECT_EQ(part.found_lines(default_options(part)).size(), 0u)
          << "sigma " << sigma << ", seed " << seed;
    }
}

TEST(SharpLines, RoughPlaneHasNextToNone) {
  for (const double sigma : {0.06, 0.08, 0.1}) {
    std::size_t sharp = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Part part(noisy_plane(40.0, 1.0, sigma, 0.2, seed));
      sharp += sharp_count(part.find(default_options(part)));
      all += part.mesh->edge_count();
    }
    EXPECT_LT(sharp, all / 1000) << "sigma " << sigma;
  }
}

TEST(SharpLines, AngleNoiseIsThatOfTheNoiseAndNotOfTheLines) {
  const Part calm(noisy_plane(40.0, 1.0, 0.02, 0.0, 3)),
      rough(noisy_plane(40.0, 1.0, 0.04, 0.0, 3));
  EXPECT_NEAR(angle_noise(*rough.curvatures) / angle_noise(*calm.curvatures), 2.0, 0.05);
  const Part step(stepped_plate(20.0, 40.0, 5.0, 1.0));
  EXPECT_NEAR(angle_noise(*step.curvatures), 0.0, 1e-3);
  const double angle = default_sharp_angle(*rough.mesh, *rough.curvatures, LineMethod::walk);
  EXPECT_GT(angle, 2.0 * angle_noise(*rough.curvatures));
  EXPECT_GE(angle, default_sharp_angle(*calm.mesh, *calm.curvatures, LineMethod::walk));
}

TEST(SharpLines, CancelledWorkIsAnErrorThatSaysSo) {
  const Part part(divided_cube(10.0, 4));
  std::stop_source stop;
  stop.request_stop();
  const auto result = find_sharp_edges(*part.mesh, *part.curvatures, nullptr, {},
                                       Context(nullptr, stop.get_token()));
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().cancelled);
}

// ---- the automatic treatments ----

TEST(ParallelLines, WeakerOfTwoCloseOnesGoes) {
  // A bevel one edge wide: 50 degrees, then 35.
  const Part part(bent_plate(20, {{10, 50.0}, {11, 35.0}}));
  SharpLineOptions options = options_with_angle(20.0);
  options.parallel_distance = 0;
  EXPECT_EQ(part.found_lines(options).size(), 2u);
  options.parallel_distance = 1;
  const std::vector<Line> lines = part.found_lines(options);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].mean_angle, 50.0, 1e-4);
  EXPECT_NEAR(lines[0].length, 20.0, 1e-9);
}

TEST(ParallelLines, ThoseFartherApartThanTheStripStay) {
  const Part part(bent_plate(20, {{10, 50.0}, {13, 35.0}}));
  SharpLineOptions options = options_with_angle(20.0);
  options.parallel_distance = 2;
  EXPECT_EQ(part.found_lines(options).size(), 2u);
  options.parallel_distance = 3;
  EXPECT_EQ(part.found_lines(options).size(), 1u);
}

TEST(ParallelLines, ThoseOfOppositeSignStay) {
  const Part part(bent_plate(20, {{10, 50.0}, {11, -35.0}}));
  SharpLineOptions options = options_with_angle(20.0);
  options.parallel_distance = 2;
  EXPECT_EQ(part.found_lines(options).size(), 2u);
}

TEST(ParallelLines, BothRimsOfAThinWallStay) {
  const Part part(bent_plate(20, {{10, 90.0}, {11, 90.0}}));
  SharpLineOptions options = options_with_angle(30.0);
  options.parallel_distance = 2;
  EXPECT_EQ(part.found_lines(options).size(), 2u);
}

TEST(ParallelLines, OneThatIsBesideAnotherOnlyInPartStays) {
  const Part part(bent_plate(20, {{10, 60.0}, {11, 35.0}}));
  const auto column = [&](VertexId x, VertexId end) {
    std::vector<VertexId> path;
    for (VertexId y = 0; y <= end; ++y) path.push_back(y * 21 + x);
    return path;
  };
  // The stronger line runs beside two thirds of the weaker.
  std::vector<Origin> edges(part.mesh->edge_count(), Origin::none);
  mark(*part.mesh, column(10, 13), edges);
  mark(*part.mesh, column(11, 20), edges);
  const std::vector<Origin> before = edges;
  remove_parallel_lines(*part.mesh, *part.curvatures, 1, edges);
  EXPECT_EQ(edges, before);
  // All of it: the weaker goes.
  mark(*part.mesh, column(10, 20), edges);
  remove_parallel_lines(*part.mesh, *part.curvatures, 1, edges);
  const std::vector<Line> left = part.lines(edges);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_NEAR(left[0].mean_angle, 60.0, 1e-4);
}

class Gaps : public ::testing::Test {
 protected:
  Part part{shaped_lattice(20.0, 1.0, [](double x, double y) {
    return Point(x, y, -std::abs(x - 10.0) * std::tan(0.4));
  })};
  std::vector<Origin> edges = std::vector<Origin>(part.mesh->edge_count(), Origin::none);

  /// Vertices of column x of the lattice.
  std::vector<VertexId> column(int x, int begin, int end) const {
    std::vector<VertexId> path;
    for (int y = begin; y <= end; ++y) path.push_back(static_cast<VertexId>(y * 21 + x));
    return path;
  }
};

TEST_F(Gaps, NearlyMeetingEndsAreBridgedAlongTheShortestPath) {
  mark(*part.mesh, column(10, 2, 8), edges);
  mark(*part.mesh, column(10, 11, 18), edges);
  bridge_gaps(*part.mesh, *part.curvatures, 2.5, edges);
  EXPECT_EQ(part.lines(edges).size(), 2u) << "the gap is 3 mm wide";
  bridge_gaps(*part.mesh, *part.curvatures, 3.5, edges);
  const std::vector<Line> lines = part.lines(edges);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].length, 16.0, 1e-9);
  EXPECT_EQ(lines[0].origin, Origin::merged);
  for (int y = 8; y < 11; ++y)
    EXPECT_EQ(edges[part.mesh->find_edge(y * 21 + 10, (y + 1) * 21 + 10).value()], Origin::merged);
}

TEST_F(Gaps, EndsThatDoNotPointAtEachOtherAreLeftAlone) {
  mark(*part.mesh, column(9, 2, 10), edges);  // both end at y = 10, side by side
  mark(*part.mesh, column(11, 2, 10), edges);
  const std::vector<Origin> before = edges;
  bridge_gaps(*part.mesh, *part.curvatures, 3.0, edges);
  EXPECT_EQ(edges, before);
}

TEST_F(Gaps, EndsOnTheBorderAreNoLooseEnds) {
  mark(*part.mesh, column(10, 0, 9), edges);
  mark(*part.mesh, column(10, 11, 20), edges);
  bridge_gaps(*part.mesh, *part.curvatures, 2.5, edges);
  const std::vector<Line> lines = part.lines(edges);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].length, 20.0, 1e-9);
}

TEST_F(Gaps, ShortLinesGoAndLongOnesAndGroupsStay) {
  mark(*part.mesh, column(3, 2, 4), edges);    // 2 edges, alone
  mark(*part.mesh, column(10, 2, 12), edges);  // 10 edges with a branch of one
  mark(*part.mesh, {5 * 21 + 10, 5 * 21 + 11}, edges);
  mark(*part.mesh, {0 * 21 + 16, 1 * 21 + 16, 2 * 21 + 16}, edges);  // from the border, 2 edges
  ASSERT_EQ(part.lines(edges).size(), 5u);
  const double slope = 1.0 / std::cos(0.4);
  remove_short_lines(*part.mesh, *part.curvatures, 2.0, edges);
  EXPECT_EQ(part.lines(edges).size(), 5u) << "2 mm is not shorter than 2 mm";
  remove_short_lines(*part.mesh, *part.curvatures, 2.1, edges);
  EXPECT_EQ(part.lines(edges).size(), 3u);
  EXPECT_NEAR(total_length(part.lines(edges)), 10.0 + slope, 1e-9);
  remove_short_lines(*part.mesh, *part.curvatures, 12.0, edges);
  EXPECT_EQ(sharp_count(edges), 0u) << "a connected group shorter than that in all";
}

// ---- what holds on any mesh, under any threshold ----

SharpLineOptions random_options(const Mesh& mesh, Random& random) {
  SharpLineOptions options;
  options.angle = random.uniform(2.0, 70.0);
  options.candidates = 1 + static_cast<int>(random.bits() % 6);
  options.parallel_distance = static_cast<int>(random.bits() % 3);
  options.min_length = random.uniform(0.0, 4.0) * mesh.mean_edge_length();
  options.bridge_gap = random.bits() % 2 ? random.uniform(0.5, 4.0) * mesh.mean_edge_length() : 0.0;
  return options;
}

void expect_proper_edges(const Mesh& mesh, const std::vector<Origin>& edges) {
  ASSERT_EQ(edges.size(), mesh.edge_count());
  for (EdgeId e = 0; e < edges.size(); ++e)
    EXPECT_FALSE(edges[e] != Origin::none && mesh.is_border_edge(e)) << "edge " << e;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    int sharp = 0;
    HalfEdgeId h = mesh.face_half_edge(f);
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) sharp += edges[h >> 1] != Origin::none;
    EXPECT_LT(sharp, 3) << "face " << f;
  }
}

void expect_proper_lines(const Mesh& mesh, const std::vector<Origin>& edges,
                         const std::vector<Line>& lines) {
  std::vector<int> valence(mesh.vertex_count(), 0);
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (edges[e] != Origin::none)
      for (const VertexId v : mesh.edge(e)) ++valence[v];
  std::vector<int> uses(mesh.edge_count(), 0);
  for (const Line& line : lines) {
    ASSERT_GE(line.vertices.size(), 2u);
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i) {
      const auto e = mesh.find_edge(line.vertices[i], line.vertices[i + 1]);
      ASSERT_TRUE(e);
      ++uses[*e];
      length += mesh.edge_length(*e);
      EXPECT_TRUE(i == 0 || valence[line.vertices[i]] == 2) << "inside a line";
    }
    EXPECT_NEAR(line.length, length, 1e-9 * (1.0 + length));
    if (line.closed) {
      EXPECT_EQ(line.vertices.front(), line.vertices.back());
      EXPECT_EQ(valence[line.vertices.front()], 2) << "a closed line has no end";
    } else {
      EXPECT_NE(valence[line.vertices.front()], 2) << "a line ends at an extremity";
      EXPECT_NE(valence[line.vertices.back()], 2);
    }
  }
  for (EdgeId e = 0; e < edges.size(); ++e)
    EXPECT_EQ(uses[e], edges[e] != Origin::none ? 1 : 0) << "edge " << e;
}

TEST(SharpLinesProperty, EdgesAndLinesAreProperUnderAnyThresholds) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Part part(random_terrain(12 + static_cast<int>(random.bits() % 20), seed));
    for (int k = 0; k < 5; ++k) {
      const SharpLineOptions options = random_options(*part.mesh, random);
      const std::vector<Origin> raw = part.identify(options);
      expect_proper_edges(*part.mesh, raw);
      expect_proper_lines(*part.mesh, raw, part.lines(raw));
      for (EdgeId e = 0; e < raw.size(); ++e)
        if (raw[e] != Origin::none) {
          EXPECT_GT(std::abs(part.curvatures->beta[e]), options.angle * degree - 1e-6);
        }
      const std::vector<Origin> treated = part.find(options);
      expect_proper_edges(*part.mesh, treated);
      expect_proper_lines(*part.mesh, treated, part.lines(treated));
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(SharpLinesProperty, NothingSharpIsLeftOverBetweenTwoLines) {
  // The closing pass: a free edge above TV_IH joins unless it would close a triangle.
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const Part part(random_terrain(20, seed));
    const Mesh& mesh = *part.mesh;
    const SharpLineOptions options = options_with_angle(random.uniform(5.0, 50.0));
    const std::vector<Origin> edges = part.identify(options);
    std::vector<bool> on_line(mesh.vertex_count(), false);
    for (EdgeId e = 0; e < edges.size(); ++e)
      if (edges[e] != Origin::none)
        for (const VertexId v : mesh.edge(e)) on_line[v] = true;
    for (EdgeId e = 0; e < edges.size(); ++e) {
      if (edges[e] != Origin::none || mesh.is_border_edge(e) || !on_line[mesh.edge(e)[0]] ||
          !on_line[mesh.edge(e)[1]] ||
          std::abs(part.curvatures->beta[e]) < options.angle * degree + 1e-6)
        continue;
      bool closes = false;
      for (const HalfEdgeId h : {2 * e, 2 * e + 1})
        closes = closes || (edges[mesh.next(h) >> 1] != Origin::none &&
                            edges[mesh.previous(h) >> 1] != Origin::none);
      EXPECT_TRUE(closes) << "seed " << seed << ", edge " << e;
    }
  }
}

TEST(SharpLinesProperty, AnyNumberOfThreadsGivesTheSame) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    const Part part(random_terrain(60, 5));
    return part.find(options_with_angle(25.0));
  };
  const std::vector<Origin> one = run(1);
  EXPECT_GT(sharp_count(one), 100u);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(7), one);
}

TEST(SharpLinesProperty, TurnedRoundTheSameEdgesChangeSign) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Triangles terrain = random_terrain(20, seed);
    Triangles turned = terrain;
    for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
    const Part part(terrain), other(turned);
    const SharpLineOptions options = default_options(part);
    ASSERT_NEAR(default_options(other).angle, options.angle, 1e-9);
    const std::vector<Origin> edges = part.find(options);
    ASSERT_EQ(other.find(options), edges) << "seed " << seed;
    const std::vector<Line> lines = part.lines(edges), turned_lines = other.lines(edges);
    ASSERT_EQ(lines.size(), turned_lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k) {
      EXPECT_EQ(lines[k].vertices, turned_lines[k].vertices);
      EXPECT_NEAR(lines[k].mean_angle, -turned_lines[k].mean_angle, 1e-4);
    }
  }
}

TEST(SharpLinesProperty, ScalingScalesLengthsOnly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Triangles terrain = random_terrain(20, seed);
    Triangles scaled = terrain;
    for (Point& p : scaled.points) p *= 25.4;
    const Part part(terrain), other(scaled);
    Random random(seed);
    SharpLineOptions options = random_options(*part.mesh, random), larger = options;
    larger.min_length *= 25.4;
    larger.bridge_gap *= 25.4;
    const std::vector<Origin> edges = part.find(options);
    ASSERT_EQ(other.find(larger), edges) << "seed " << seed;
    EXPECT_NEAR(total_length(other.lines(edges)), 25.4 * total_length(part.lines(edges)),
                1e-9 * total_length(other.lines(edges)));
  }
}

TEST(SharpLinesProperty, NumberingDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Triangles terrain = random_terrain(20, seed);
    Random random(seed + 100);
    std::vector<VertexId> new_id(terrain.points.size());
    std::iota(new_id.begin(), new_id.end(), 0u);
    for (std::size_t i = new_id.size(); i > 1; --i)
      std::swap(new_id[i - 1], new_id[random.bits() % i]);
    Triangles renumbered;
    renumbered.points.resize(terrain.points.size());
    for (std::size_t v = 0; v < new_id.size(); ++v)
      renumbered.points[new_id[v]] = terrain.points[v];
    for (const Triangle& t : terrain.triangles)
      renumbered.triangles.push_back({new_id[t[1]], new_id[t[2]], new_id[t[0]]});
    std::ranges::reverse(renumbered.triangles);
    const Part part(terrain), other(renumbered);
    const SharpLineOptions options = options_with_angle(random.uniform(5.0, 50.0));
    std::set<EdgeVertices> expected;
    for (const auto& [a, b] : sharp_pairs(*part.mesh, part.identify(options)))
      expected.insert({std::min(new_id[a], new_id[b]), std::max(new_id[a], new_id[b])});
    EXPECT_EQ(sharp_pairs(*other.mesh, other.identify(options)), expected) << "seed " << seed;
  }
}

// ---- identity ----

std::map<EdgeVertices, std::uint32_t> ids_by_edge(const SharpLines& lines) {
  std::map<EdgeVertices, std::uint32_t> ids;
  for (const LinePtr& line : lines.lines)
    for (std::size_t i = 0; i + 1 < line->vertices.size(); ++i)
      ids[{std::min(line->vertices[i], line->vertices[i + 1]),
           std::max(line->vertices[i], line->vertices[i + 1])}] = line->id;
  return ids;
}

TEST(LineIds, SameEdgesKeepTheirLinesToTheLetter) {
  const Part part(divided_cube(10.0, 5));
  const std::vector<Origin> edges = part.find(options_with_angle(30.0));
  std::uint32_t next_id = 1;
  const SharpLines first = relink_lines(*part.mesh, *part.curvatures, edges, {}, next_id);
  EXPECT_EQ(first.lines.size(), 12u);
  EXPECT_EQ(next_id, 13u);
  const SharpLines second = relink_lines(*part.mesh, *part.curvatures, edges, first, next_id);
  EXPECT_EQ(next_id, 13u);
  EXPECT_EQ(second.lines, first.lines) << "the very same line values, shared";
  EXPECT_EQ(second.find(0), nullptr);
  for (const LinePtr& line : second.lines) EXPECT_EQ(second.find(line->id), line.get());
}

TEST(LineIds, LongerPieceKeepsTheIdWhenALineIsCut) {
  const Part part(roof(1.0, 5.0, 12.0, 1.0));
  std::vector<Origin> edges = part.find(options_with_angle(30.0));
  std::uint32_t next_id = 7;
  const SharpLines whole = relink_lines(*part.mesh, *part.curvatures, edges, {}, next_id);
  ASSERT_EQ(whole.lines.size(), 1u);
  const std::vector<VertexId> path = whole.lines[0]->vertices;
  edges[part.mesh->find_edge(path[4], path[5]).value()] = Origin::none;
  const SharpLines cut = relink_lines(*part.mesh, *part.curvatures, edges, whole, next_id);
  ASSERT_EQ(cut.lines.size(), 2u);
  EXPECT_EQ(cut.lines[0]->id, 7u);
  EXPECT_NEAR(cut.lines[0]->length, 7.0, 1e-9);
  EXPECT_EQ(cut.lines[1]->id, 8u);
  EXPECT_NEAR(cut.lines[1]->length, 4.0, 1e-9);
  // Joined again: the one line shares most with 7; 8 is gone for good.
  edges[part.mesh->find_edge(path[4], path[5]).value()] = Origin::found;
  const SharpLines joined = relink_lines(*part.mesh, *part.curvatures, edges, cut, next_id);
  ASSERT_EQ(joined.lines.size(), 1u);
  EXPECT_EQ(joined.lines[0]->id, 7u);
  EXPECT_EQ(next_id, 9u);
}

TEST(LineIds, EqualSharesGoToTheLowerId) {
  const Part part(roof(1.0, 5.0, 12.0, 1.0));
  std::vector<Origin> edges = part.find(options_with_angle(30.0));
  std::uint32_t next_id = 1;
  const std::vector<VertexId> path = part.lines(edges)[0].vertices;
  const EdgeId first = part.mesh->find_edge(path[5], path[6]).value(),
               second = part.mesh->find_edge(path[6], path[7]).value();
  edges[first] = edges[second] = Origin::none;  // two pieces of 5 mm
  const SharpLines cut = relink_lines(*part.mesh, *part.curvatures, edges, {}, next_id);
  ASSERT_EQ(cut.lines.size(), 2u);
  ASSERT_NEAR(cut.lines[0]->length, cut.lines[1]->length, 1e-12);
  edges[first] = edges[second] = Origin::found;
  const SharpLines joined = relink_lines(*part.mesh, *part.curvatures, edges, cut, next_id);
  ASSERT_EQ(joined.lines.size(), 1u);
  EXPECT_EQ(joined.lines[0]->id, 1u);
}

TEST(LineIds, NeverUsedTwiceOverARandomLife) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const Part part(random_terrain(20, seed));
    Random random(seed);
    std::uint32_t next_id = 1;
    std::set<std::uint32_t> retired;
    SharpLines lines;
    for (int k = 0; k < 15; ++k) {
      const std::uint32_t before = next_id;
      const std::vector<Origin> edges = part.find(random_options(*part.mesh, random));
      const SharpLines next = relink_lines(*part.mesh, *part.curvatures, edges, lines, next_id);
      expect_proper_lines(*part.mesh, edges, part.lines(edges));
      std::set<std::uint32_t> ids, old_ids;
      for (const LinePtr& line : lines.lines) old_ids.insert(line->id);
      for (const LinePtr& line : next.lines) {
        EXPECT_TRUE(ids.insert(line->id).second) << "twice at once";
        EXPECT_FALSE(retired.contains(line->id)) << "back from the dead";
        EXPECT_LT(line->id, next_id);
        EXPECT_TRUE(old_ids.contains(line->id) || line->id >= before);
      }
      EXPECT_TRUE(std::ranges::is_sorted(next.lines, {}, [](const LinePtr& l) { return l->id; }));
      // A line that kept its id shares an edge with the one it was.
      const auto was = ids_by_edge(lines), is = ids_by_edge(next);
      for (const std::uint32_t id : ids) {
        if (!old_ids.contains(id)) continue;
        EXPECT_TRUE(std::ranges::any_of(is, [&](const auto& entry) {
          const auto old = was.find(entry.first);
          return entry.second == id && old != was.end() && old->second == id;
        }));
      }
      // Whoever keeps all its edges keeps its id.
      std::set<std::vector<VertexId>> old_paths;
      for (const LinePtr& line : lines.lines) old_paths.insert(line->vertices);
      for (const LinePtr& line : next.lines)
        EXPECT_TRUE(!old_paths.contains(line->vertices) || old_ids.contains(line->id));
      for (const std::uint32_t id : old_ids)
        if (!ids.contains(id)) retired.insert(id);
      lines = next;
    }
  }
}

}  // namespace
}  // namespace arris
