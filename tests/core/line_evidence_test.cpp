// Sharp lines by the jump of the normals: all that are there and nothing else, on noisy parts and
// on clean ones, the same wherever and however the part lies.

#include "core/sharp_lines/line_evidence.h"
#include "core/base/thread_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "core/base/random.h"
#include "core/document/history.h"
#include "core/sharp_lines/sharp_lines.h"
#include "tests/support/documents.h"
#include "tests/support/meshes.h"

namespace arris {
namespace {

using namespace arris::testing;

/// The lines of the default method, at its default threshold or another.
Document lined(const Triangles& part, double angle = 0.0) {
  nlohmann::json parameters = nlohmann::json::object();
  if (angle > 0.0) parameters["angle"] = angle;
  return applied(document_of(part), {"find_sharp_lines", parameters});
}

double length_of(const Document& document) {
  double length = 0.0;
  for (const LinePtr& line : document.lines.lines) length += line->length;
  return length;
}

/// How far a point is from the nearest edge of a cube from (0, 0, 0) to (size, size, size).
double distance_to_cube_edge(const Point& p, double size) {
  std::array<double, 3> off;
  for (int k = 0; k < 3; ++k)
    off[static_cast<std::size_t>(k)] = std::min(std::abs(p[k]), std::abs(p[k] - size));
  std::sort(off.begin(), off.end());
  return std::hypot(off[0], off[1]);
}

Point corner_of(const Triangles& part) {
  Point corner = part.points.front();
  for (const Point& p : part.points) corner = corner.cwiseMin(p);
  return corner;
}

/// The points of all lines.
std::vector<Point> points_of(const Document& document) {
  std::vector<Point> points;
  for (const LinePtr& line : document.lines.lines)
    for (const VertexId v : line->vertices) points.push_back(document.mesh->point(v));
  return points;
}

/// The farthest that a point of one is from the nearest of the other.
double farthest(const std::vector<Point>& from, const std::vector<Point>& to) {
  double far = 0.0;
  for (const Point& p : from) {
    double near = 1e300;
    for (const Point& q : to) near = std::min(near, (p - q).norm());
    far = std::max(far, near);
  }
  return far;
}

TEST(NormalJump, FindsTheTwelveEdgesOfANoisyCube) {
  constexpr double size = 20.0;
  for (const double noise : {0.05, 0.1, 0.2, 0.3}) {
    const Triangles clean = divided_cube(size, 24);
    const Point corner = corner_of(clean);
    const Document document = lined(noisy(clean, noise, 7));
    EXPECT_EQ(document.lines.lines.size(), 12u) << noise;
    EXPECT_NEAR(length_of(document), 12.0 * size, 0.15 * 12.0 * size) << noise;
    const double edge = document.mesh->mean_edge_length();
    for (const Point& p : points_of(document))
      EXPECT_LT(distance_to_cube_edge(p - corner, size), 1.5 * edge) << noise;
    for (const LinePtr& line : document.lines.lines) {
      EXPECT_TRUE(line->convex());
      EXPECT_GT(line->mean_angle, 60.0);  // of 90, less what the windows take off at the corners
    }
  }
}

TEST(NormalJump, FindsNothingOnSmoothNoisyParts) {
  for (const double noise : {0.05, 0.1, 0.2, 0.3})
    for (const std::uint64_t seed : {1u, 2u}) {
      const auto none = [&](const char* name, const Triangles& part) {
        const Document document = lined(noisy(part, noise, seed));
        EXPECT_TRUE(document.lines.lines.empty()) << name << " at " << noise;
      };
      none("plane", noisy_plane(40.0, 1.0, 0.0, 0.2, seed));
      none("cylinder", cylinder_wall(12.0, 40.0, 72, 40));
      none("sphere", icosphere(20.0, 4));
      none("torus", torus(20.0, 8.0, 120, 50));
    }
}

TEST(NormalJump, AFilletIsNoLineAndAFoldIs) {
  // Two planes at right angles, joined over a radius in edges.
  const auto bent = [](double radius) {
    return shaped_lattice(60.0, 1.0, [radius](double x, double y) {
      const double arc = radius * std::numbers::pi / 2.0, s = x - 30.0;
      if (s < -arc / 2.0) return Point(s + arc / 2.0, y, 0.0);
      const double angle =
          std::min((s + arc / 2.0) / std::max(radius, 1e-9), std::numbers::pi / 2.0);
      if (radius > 0.0 && s < arc / 2.0)
        return Point(radius * std::sin(angle), y, -radius * (1.0 - std::cos(angle)));
      return Point(radius, y, -radius - (s - arc / 2.0));
    });
  };
  for (const double noise : {0.05, 0.1}) {
    const Document fold = lined(noisy(bent(0.0), noise, 3));
    EXPECT_EQ(fold.lines.lines.size(), 1u) << noise;
    EXPECT_NEAR(length_of(fold), 60.0, 9.0) << noise;
    const Document fillet = lined(noisy(bent(8.0), noise, 3));
    EXPECT_TRUE(fillet.lines.lines.empty()) << noise;
  }
}

/// The outline (r, z), run through and closed, turned about the z axis, in triangles of about 1 mm.
Triangles revolved(const std::vector<Eigen::Vector2d>& corners) {
  Triangles part;
  std::vector<std::pair<VertexId, VertexId>> rings;  // first vertex and number of vertices of each
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d from = corners[k], to = corners[(k + 1) % corners.size()];
    const double steps = std::ceil((to - from).norm() / 0.87);
    for (double i = 0.0; i < steps; ++i) {
      const Eigen::Vector2d p = from + (to - from) * (i / steps);
      const auto count = static_cast<VertexId>(std::round(2.0 * std::numbers::pi * p.x()));
      rings.emplace_back(static_cast<VertexId>(part.points.size()), count);
      const double start = 0.5 * static_cast<double>(rings.size() % 2);
      for (VertexId j = 0; j < count; ++j) {
        const double a = 2.0 * std::numbers::pi * (j + start) / count;
        part.points.emplace_back(p.x() * std::cos(a), p.x() * std::sin(a), p.y());
      }
    }
  }
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const auto [a, na] = rings[k];
    const auto [b, nb] = rings[(k + 1) % rings.size()];
    const auto at = [](VertexId first, VertexId count, VertexId i) { return first + i % count; };
    for (VertexId i = 0, j = 0; i < na || j < nb;) {
      const VertexId p = at(a, na, i), q = at(b, nb, j);
      if (j == nb || (i < na && (i + 0.5) / na <= (j + 0.5) / nb)) {
        part.triangles.push_back({p, at(a, na, i + 1), q});
        ++i;
      } else {
        part.triangles.push_back({p, at(b, nb, j + 1), q});
        ++j;
      }
    }
  }
  return part;
}

TEST(NormalJump, FindsTheRimsOfHolesOfFewEdges) {
  for (const double radius : {1.3, 1.6, 2.0, 2.4, 3.0})
    for (const double noise : {0.05, 0.1}) {
      const Triangles washer = revolved({{radius, 0.0}, {14.0, 0.0}, {14.0, 7.0}, {radius, 7.0}});
      const Document document = lined(noisy(washer, noise, 5));
      EXPECT_EQ(document.lines.lines.size(), 4u) << radius << " " << noise;
      for (const LinePtr& line : document.lines.lines) {
        EXPECT_TRUE(line->closed) << radius << " " << noise;
        EXPECT_TRUE(line->convex());
        for (const VertexId v : line->vertices) {
          const Point& p = document.mesh->point(v);
          const double r = p.head<2>().norm();
          EXPECT_LT(std::min(std::abs(r - radius), std::abs(r - 14.0)), 1.0);
          EXPECT_LT(std::min(std::abs(p.z()), std::abs(p.z() - 7.0)), 1.0);
        }
      }
    }
}

TEST(NormalJump, ALineEndsWhereItsJumpFadesOut) {
  // A ridge whose angle falls from 70 degrees to nothing along y: the line parts no areas.
  constexpr double size = 60.0;
  const auto angle_at = [](double y) { return 70.0 * std::max(0.0, 1.0 - y / 50.0); };
  const Triangles part = shaped_lattice(size, 1.0, [&](double x, double y) {
    const double slope = std::tan(angle_at(y) / 2.0 * std::numbers::pi / 180.0);
    return Point(x, y, -slope * std::abs(x - size / 2.0));
  });
  const Document document = lined(noisy(part, 0.05, 5));
  ASSERT_EQ(document.lines.lines.size(), 1u);
  double last = 0.0;
  for (const Point& p : points_of(document)) {
    EXPECT_NEAR(p.x(), size / 2.0, 2.0);
    last = std::max(last, p.y());
  }
  EXPECT_GT(angle_at(last), 8.0);   // it does not run on where nothing jumps
  EXPECT_LT(angle_at(last), 40.0);  // nor stop where the ridge is clear
}

TEST(NormalJump, CleanMeshesOfAnyFinenessAreExact) {
  const Document coarse = lined(cube(20.0));
  EXPECT_EQ(coarse.lines.lines.size(), 12u);
  for (const LinePtr& line : coarse.lines.lines) EXPECT_NEAR(line->mean_angle, 90.0, 1e-3);
  const Document sides = applied(coarse, {"find_partitions"});
  EXPECT_EQ(sides.partitions.partitions.size(), 6u);
  for (const int divisions : {2, 5, 16, 40}) {
    const Document document = lined(divided_cube(20.0, divisions));
    EXPECT_EQ(document.lines.lines.size(), 12u) << divisions;
    EXPECT_NEAR(length_of(document), 240.0, 1e-9) << divisions;
  }
  for (const int sectors : {16, 48, 96}) {
    const Document document = lined(capped_cylinder(10.0, 30.0, sectors, 12, 4));
    EXPECT_EQ(document.lines.lines.size(), 2u) << sectors;
    for (const LinePtr& line : document.lines.lines) EXPECT_TRUE(line->closed);
  }
  // Two edges of opposite sign one edge apart.
  const Document step = lined(stepped_plate(6.0, 20.0, 1.0, 1.0));
  ASSERT_EQ(step.lines.lines.size(), 2u);
  EXPECT_NE(step.lines.lines[0]->convex(), step.lines.lines[1]->convex());
}

TEST(NormalJump, DoesNotDependOnUnitPlaceOrientationOrOrder) {
  const Triangles part = noisy(divided_cube(20.0, 20), 0.1, 11);
  const Document reference = lined(part);
  const std::vector<Point> expected = points_of(reference);
  const double edge = reference.mesh->mean_edge_length();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Point(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  struct Move {
    double scale;
    Eigen::Matrix3d turn;
    Point shift;
  };
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  const Point here = Point::Zero();
  for (const Move& move :
       {Move{0.001, still, here}, Move{1000.0, still, here}, Move{1.0 / 25.4, still, here},
        Move{1.0, turn, here}, Move{1.0, still, Point(500.0, -300.0, 40.0)}}) {
    const Document document = lined(moved(part, move.scale, move.turn, move.shift));
    EXPECT_EQ(document.lines.lines.size(), reference.lines.lines.size());
    std::vector<Point> back;
    for (const Point& p : points_of(document))
      back.push_back(move.turn.transpose() * ((p - move.shift) / move.scale));
    EXPECT_LT(farthest(back, expected), edge);
    EXPECT_LT(farthest(expected, back), edge);
  }
  // Mirrored (and turned inside out by it, so that the faces turn, too), and in another order.
  Triangles mirrored = part;
  for (Point& p : mirrored.points) p.x() = -p.x();
  for (Triangle& t : mirrored.triangles) std::swap(t[1], t[2]);
  std::vector<Point> back = points_of(lined(mirrored));
  for (Point& p : back) p.x() = -p.x();
  EXPECT_LT(farthest(back, expected), edge);
  EXPECT_LT(farthest(expected, back), edge);
  Triangles shuffled = part;
  Random random(3);
  for (std::size_t k = shuffled.triangles.size() - 1; k > 0; --k)
    std::swap(shuffled.triangles[k], shuffled.triangles[random.bits() % (k + 1)]);
  back = points_of(lined(shuffled));
  EXPECT_LT(farthest(back, expected), edge);
  EXPECT_LT(farthest(expected, back), edge);
}

TEST(LineEvidence, IsTheSameWhateverTheNumberOfThreads) {
  const MeshPtr mesh = mesh_of(sample_mould(1.5));
  const CurvaturesPtr curvatures = curvatures_of(*mesh);
  const auto gathered = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    return value_of(gather_line_evidence(*mesh, *curvatures));
  };
  const LineEvidencePtr one = gathered(1), four = gathered(4);
  ASSERT_EQ(one->jump.size(), four->jump.size());
  EXPECT_EQ(std::memcmp(one->jump.data(), four->jump.data(), one->jump.size() * sizeof(float)), 0);
  ASSERT_EQ(one->candidates.edges().size(), four->candidates.edges().size());
  for (std::size_t k = 0; k < one->candidates.edges().size(); ++k) {
    EXPECT_EQ(one->candidates.edges()[k].edge, four->candidates.edges()[k].edge);
    EXPECT_EQ(one->candidates.edges()[k].height, four->candidates.edges()[k].height);
    EXPECT_EQ(one->candidates.edges()[k].place.value, four->candidates.edges()[k].place.value);
  }
}

TEST(LineEvidence, RegionBordersAtAThresholdAreAmongThoseOfALowerOne) {
  const MeshPtr mesh = mesh_of(sample_mould(1.2));
  const LineEvidencePtr evidence = value_of(gather_line_evidence(*mesh, *curvatures_of(*mesh)));
  LineChoiceOptions plain;  // the borders alone: nothing closed, nothing dropped
  plain.least_slit = plain.gap = plain.spur = plain.least_group = 0.0F;
  std::vector<EdgeId> more;
  for (const float angle : {8.0F, 15.0F, 25.0F, 40.0F, 60.0F}) {
    LineChoiceOptions options = plain;
    options.angle = angle;
    const std::vector<EdgeId> chosen = evidence->candidates.choose(options);
    if (angle > 8.0F) {
      EXPECT_TRUE(std::includes(more.begin(), more.end(), chosen.begin(), chosen.end())) << angle;
    }
    more = chosen;
  }
}

TEST(LineEvidence, WhatRunsBesideALineDoublesItAndIsNone) {
  // On a plate: a border between regions along y = 20, and what parts no regions beside it, away
  // from it, and where it ends.
  const MeshPtr mesh = mesh_of(noisy_plane(40.0, 1.0, 0.0, 0.0, 1));
  const FaceTable table(*mesh);
  std::vector<BorderEdge> edges;
  const auto row = [&](double y, double from, double to, float height) {
    std::vector<EdgeId> added;
    for (EdgeId e = 0; e < mesh->edge_count(); ++e) {
      const Point a = mesh->point(mesh->edge(e)[0]), b = mesh->point(mesh->edge(e)[1]);
      const double middle = 0.5 * (a.x() + b.x());
      if (a.y() != b.y() || std::abs(a.y() - y) > 0.5 || middle < from || middle > to) continue;
      edges.push_back({e, height, {50.0F, 50.0F, 50.0F}});
      added.push_back(e);
    }
    return added;
  };
  const Point corner = corner_of(noisy_plane(40.0, 1.0, 0.0, 0.0, 1));
  const auto x = [&](double at) { return corner.x() + at; };
  const double y = corner.y() + 20.0;
  std::vector<EdgeId> lines = row(y, x(2.0), x(28.0), 50.0F);
  const std::vector<EdgeId> beside = row(y + 2.0, x(2.0), x(24.0), 0.0F);
  const std::vector<EdgeId> away = row(y + 6.0, x(2.0), x(24.0), 0.0F);
  const std::vector<EdgeId> beyond = row(y, x(28.0), x(38.0), 0.0F);
  ASSERT_GT(std::min({lines.size(), beside.size(), away.size(), beyond.size()}), 8u);
  std::sort(edges.begin(), edges.end(),
            [](const BorderEdge& a, const BorderEdge& b) { return a.edge < b.edge; });
  const std::vector<EdgeId> chosen = CandidateGraph(*mesh, table, edges).choose({});
  for (const auto* more : {&away, &beyond}) lines.insert(lines.end(), more->begin(), more->end());
  std::sort(lines.begin(), lines.end());
  EXPECT_EQ(chosen, lines);
}

TEST(LineEvidence, BoundsAndSignChooseLines) {
  const Triangles part = noisy(stepped_plate(20.0, 40.0, 8.0, 1.0), 0.05, 2);
  const Document opened = document_of(part);
  const auto found = [&](nlohmann::json parameters) {
    return applied(opened, {"find_sharp_lines", std::move(parameters)}).lines.lines;
  };
  EXPECT_EQ(found({}).size(), 2u);
  const auto convex = found({{"convexity", "convex"}}), concave = found({{"convexity", "concave"}});
  ASSERT_EQ(convex.size(), 1u);
  ASSERT_EQ(concave.size(), 1u);
  EXPECT_TRUE(convex[0]->convex());
  EXPECT_FALSE(concave[0]->convex());
  EXPECT_TRUE(found({{"max_angle", 40.0}}).empty());
  EXPECT_TRUE(found({{"angle", 130.0}}).empty());
}

TEST(LineEvidence, IsSharedBySnapshotsAndNotWorkedOutTwice) {
  const TempFolder folder;
  History history;
  ASSERT_TRUE(history.run({"open", {{"file", write_mesh(folder, "part.ply", sample_mould(2.0))}}}));
  const SharedLineEvidencePtr shared = history.current().evidence;
  ASSERT_NE(shared, nullptr);
  EXPECT_EQ(shared->known(), nullptr);  // opening does not wait for it
  ASSERT_TRUE(history.run({"find_sharp_lines"}));
  const LineEvidencePtr known = shared->known();
  ASSERT_NE(known, nullptr);
  ASSERT_TRUE(history.run({"find_sharp_lines", {{"angle", 40.0}}}));
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(history.current().evidence->known(), known);
}

TEST(LineEvidence, CancelledLeavesTheDocumentAsItWas) {
  const Document opened = document_of(sample_mould(2.0));
  std::stop_source stop;
  stop.request_stop();
  const auto result = apply(opened, {"find_sharp_lines"}, Context(nullptr, stop.get_token()));
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().cancelled);
}

TEST(FindSharpLines, ARowOfTheFirstVersionIsTheWalk) {
  const Document opened = document_of(sample_mould(2.0));
  const Operation stored{
      "find_sharp_lines",
      {{"version", 1}, {"angle", 30.0}, {"min_length", 3.0}, {"bridge_gap", 0.0}}};
  const Document replayed = applied(opened, stored);
  EXPECT_EQ(replayed.step("find_sharp_lines")->parameters["method"], "walk");
  const Document walked = applied(
      opened, {"find_sharp_lines",
               {{"method", "walk"}, {"angle", 30.0}, {"min_length", 3.0}, {"bridge_gap", 0.0}}});
  EXPECT_EQ(hash_of(replayed), hash_of(walked));
  EXPECT_FALSE(apply(opened, {"find_sharp_lines", {{"version", 3}}}));
}

TEST(RecomputeLines, TakesTheThresholdOfTheRegion) {
  // The ridge of a shallow roof is no line at 45 degrees, and is one within the brushed region.
  const Document opened = document_of(noisy(roof(0.6, 20.0, 60.0, 1.0), 0.05, 4));
  const Document none = applied(opened, {"find_sharp_lines", {{"angle", 45.0}}});
  ASSERT_TRUE(none.lines.lines.empty());
  VertexId middle = 0;
  Point centre = (opened.mesh->box_min() + opened.mesh->box_max()) / 2.0;
  centre.z() = opened.mesh->box_max().z();
  for (VertexId v = 0; v < opened.mesh->vertex_count(); ++v)
    if ((opened.mesh->point(v) - centre).norm() < (opened.mesh->point(middle) - centre).norm())
      middle = v;
  constexpr double radius = 10.0;
  const Document some =
      applied(none, {"recompute_lines",
                     {{"region", {{"vertices", {middle}}, {"radius", radius}}}, {"angle", 20.0}}});
  ASSERT_EQ(some.lines.lines.size(), 1u);
  EXPECT_NEAR(length_of(some), 2.0 * radius, 4.0);
}

}  // namespace
}  // namespace arris
