// Sides of partitions between corners, the cuts that leave at most four, and the operation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "core/base/random.h"
#include "core/document/history.h"
#include "core/document/journal.h"
#include "core/guidance/worklist.h"
#include "core/mesh/geometry.h"
#include "core/partitions/four_sided_cuts.h"
#include "core/partitions/interactive_treatments.h"
#include "core/partitions/sides.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;

constexpr double pi = std::numbers::pi;

/// A document whose partitions are the edge-connected sets of faces of equal label; 0: none.
Document labelled(const Triangles& triangles, const std::function<int(const Point&)>& label_at) {
  Document document = document_of(triangles);
  const Mesh& mesh = *document.mesh;
  std::vector<int> wanted(mesh.face_count());
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    wanted[f] = label_at((mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0);
  }
  FoundPartitions found;
  found.labels.assign(mesh.face_count(), 0);
  for (FaceId start = 0; start < mesh.face_count(); ++start) {
    if (wanted[start] == 0 || found.labels[start] != 0) continue;
    Partition partition;
    partition.anchor = mesh.triangle(start);
    const auto label = static_cast<std::uint32_t>(found.partitions.size() + 1);
    std::vector<FaceId> front{start};
    found.labels[start] = label;
    while (!front.empty()) {
      const FaceId f = front.back();
      front.pop_back();
      ++partition.faces;
      partition.area += face_area(mesh, f);
      HalfEdgeId h = mesh.face_half_edge(f);
      for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
        const FaceId g = mesh.face(Mesh::opposite(h));
        if (g == no_id || found.labels[g] != 0 || wanted[g] != wanted[f]) continue;
        found.labels[g] = label;
        front.push_back(g);
      }
    }
    found.partitions.push_back(partition);
  }
  document.partitions = number_partitions(mesh, found, {}, document.next_id);
  document.boundaries = std::make_shared<const Boundaries>(
      derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions));
  return document;
}

/// A flat lattice of side `size` and spacing 1.
Triangles plate(double size) { return noisy_plane(size, 1.0, 0.0, 0.0, 1); }

std::vector<Outline> outlines(const Document& document) {
  return outlines_of(*document.mesh, document.lines, document.partitions);
}
/// Of the partition at a point of its plane.
Outline outline_at(const Document& document, const Point& point) {
  const Mesh& mesh = *document.mesh;
  FaceId nearest = 0;
  double least = 1e300;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    const Point middle = (mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0;
    if ((middle - point).norm() < least) {
      least = (middle - point).norm();
      nearest = f;
    }
  }
  return outline_of(mesh, document.lines, document.partitions,
                    *document.partitions.find(document.partitions.label(nearest)));
}
FourSidedPlan plan_of(const Document& document, std::uint32_t id) {
  return value_of(four_sided_cuts(*document.mesh, *document.curvatures, document.lines,
                                  document.partitions, *document.partitions.find(id)));
}
/// Of the only partition with more than four sides or a hole.
FourSidedPlan only_plan(const Document& document) {
  const std::vector<Outline> all = outlines(document);
  std::uint32_t id = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!all[k].is_four_sided()) {
      EXPECT_EQ(id, 0u);
      id = document.partitions.partitions[k]->id;
    }
  return plan_of(document, id);
}
std::vector<std::size_t> sorted_sides(const Document& document) {
  std::vector<std::size_t> sides;
  for (const Outline& outline : outlines(document)) sides.push_back(outline.sides());
  std::ranges::sort(sides);
  return sides;
}
double smallest_share(const Document& document) {
  double least = 1e300, all = 0.0;
  for (const PartitionPtr& partition : document.partitions.partitions) {
    least = std::min(least, partition->area);
    all += partition->area;
  }
  return least / all;
}

/// An L of two arms, 10 wide and 20 long; nothing else is assigned.
int in_l(const Point& p) {
  return (p.x() > 5 && p.x() < 25 && p.y() > 5 && p.y() < 15) ||
         (p.x() > 5 && p.x() < 15 && p.y() > 5 && p.y() < 25);
}

/// A regular hexagon of side n in a lattice of equilateral triangles.
Triangles hexagon(int n) {
  Triangles mesh;
  std::map<std::pair<int, int>, VertexId> index;
  const auto inside = [&](int a, int b) {
    return std::abs(a) <= n && std::abs(b) <= n && std::abs(a + b) <= n;
  };
  for (int a = -n; a <= n; ++a)
    for (int b = -n; b <= n; ++b)
      if (inside(a, b)) {
        index[{a, b}] = static_cast<VertexId>(mesh.points.size());
        mesh.points.emplace_back(a + 0.5 * b, b * std::sqrt(0.75), 0.0);
      }
  for (const auto& [at, v] : index) {
    const auto [a, b] = at;
    if (inside(a + 1, b) && inside(a, b + 1))
      mesh.triangles.push_back({v, index[{a + 1, b}], index[{a, b + 1}]});
    if (inside(a + 1, b) && inside(a + 1, b - 1))
      mesh.triangles.push_back({v, index[{a + 1, b - 1}], index[{a + 1, b}]});
  }
  return mesh;
}

/// The surface of the unit cubes (i, j, k) of a box of n for which `full` holds.
Triangles surface_of_cubes(int n, const std::function<bool(int, int, int)>& full) {
  Triangles mesh;
  std::map<std::array<int, 3>, VertexId> index;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [it, fresh] = index.try_emplace(at, static_cast<VertexId>(mesh.points.size()));
    if (fresh) mesh.points.emplace_back(at[0], at[1], at[2]);
    return it->second;
  };
  const auto is_full = [&](std::array<int, 3> c) {
    return std::ranges::all_of(c, [&](int x) { return x >= 0 && x < n; }) && full(c[0], c[1], c[2]);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        for (int axis = 0; axis < 3 && is_full({i, j, k}); ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> beyond{i, j, k};
            beyond[axis] += side == 1 ? 1 : -1;
            if (is_full(beyond)) continue;
            std::array<int, 3> corner{i, j, k};
            corner[axis] += side;
            std::array<int, 3> b = corner, c = corner, d = corner;
            ++b[(axis + 1) % 3], ++c[(axis + 1) % 3];
            ++c[(axis + 2) % 3], ++d[(axis + 2) % 3];
            std::array<VertexId, 4> q{vertex(corner), vertex(b), vertex(c), vertex(d)};
            if (side == 0) std::swap(q[1], q[3]);
            mesh.triangles.push_back({q[0], q[1], q[2]});
            mesh.triangles.push_back({q[0], q[2], q[3]});
          }
  return mesh;
}

/// A prism over an L: two sides of six corners, six walls.
Triangles l_prism() {
  return surface_of_cubes(16, [](int i, int j, int k) { return k < 6 && (i < 8 || j < 8); });
}

/// What must hold of a document whose partitions were cut.
void expect_whole(const Document& document) {
  const Mesh& mesh = *document.mesh;
  const Boundaries fresh =
      derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions);
  ASSERT_EQ(document.boundaries->size(), fresh.size());
  for (std::size_t k = 0; k < fresh.size(); ++k)
    ASSERT_TRUE(*(*document.boundaries)[k] == *fresh[k]);
  std::map<std::uint32_t, std::uint32_t> faces;
  for (FaceId f = 0; f < mesh.face_count(); ++f) ++faces[document.partitions.label(f)];
  for (const PartitionPtr& partition : document.partitions.partitions) {
    ASSERT_EQ(partition->faces, faces[partition->id]);
    ASSERT_EQ(faces_of(mesh, document.partitions, *partition).size(), partition->faces)
        << "in one piece";
  }
}

// ---- sides ----

TEST(Sides, OfSimpleShapes) {
  EXPECT_EQ(sorted_sides(labelled(plate(20.0), [](const Point&) { return 1; })),
            std::vector<std::size_t>{4});
  EXPECT_EQ(sorted_sides(labelled(hexagon(10), [](const Point&) { return 1; })),
            std::vector<std::size_t>{6});
  EXPECT_EQ(sorted_sides(labelled(plate(30.0), in_l)), std::vector<std::size_t>{6});
  for (const int divisions : {1, 2, 5, 12}) {
    const Document box = divided_at_edges(document_of(divided_cube(10.0, divisions)));
    ASSERT_EQ(box.partitions.partitions.size(), 6u);
    EXPECT_EQ(sorted_sides(box), std::vector<std::size_t>(6, 4)) << divisions;
  }
}

TEST(Sides, RoundBordersHaveNoCorner) {
  for (const double radius : {6.0, 9.0, 14.0}) {
    const Document document = labelled(plate(40.0), [&](const Point& p) {
      return std::hypot(p.x() - 20.3, p.y() - 19.6) < radius ? 1 : 2;
    });
    const Outline disc = outline_at(document, {20.0, 20.0, 0.0});
    ASSERT_EQ(disc.loops.size(), 1u);
    EXPECT_TRUE(disc.loops[0].corners.empty()) << radius;
    EXPECT_EQ(disc.sides(), 1u);
    const Outline round_it = outline_at(document, {1.0, 1.0, 0.0});
    ASSERT_EQ(round_it.loops.size(), 2u);
    EXPECT_EQ(round_it.loops[0].corners.size(), 4u);
    EXPECT_TRUE(round_it.loops[1].corners.empty()) << radius;
    EXPECT_FALSE(round_it.is_four_sided());
  }
}

TEST(Sides, ZigzagAcrossALatticeIsStraight) {
  for (const double degrees : {5.0, 11.0, 17.0, 24.0, 31.0, 35.0}) {
    const double slope = std::tan(degrees * pi / 180.0);
    const Document document = labelled(
        plate(40.0), [&](const Point& p) { return p.y() - 20.2 < slope * (p.x() - 20.0) ? 1 : 2; });
    EXPECT_EQ(sorted_sides(document), (std::vector<std::size_t>{4, 4})) << degrees;
  }
}

TEST(Sides, AnExtremityCountsWhereTheNeighbourChanges) {
  // Three squares: two of them beside the long side of the third.
  const Document document = labelled(plate(20.0), [](const Point& p) {
    return p.y() < 10.0 ? 1 : p.x() < 10.0 ? 2 : 3;
  });
  EXPECT_EQ(outline_at(document, {10.0, 5.0, 0.0}).sides(), 5u);
  EXPECT_EQ(outline_at(document, {5.0, 15.0, 0.0}).sides(), 4u);
}

TEST(Sides, ALineThatEndsAtAStraightBorderMakesNoCorner) {
  Document document = labelled(plate(20.0), [](const Point& p) { return p.y() < 10.0 ? 1 : 2; });
  const Mesh& mesh = *document.mesh;
  const auto vertex = [&](double x, double y) {
    for (VertexId v = 0; v < mesh.vertex_count(); ++v)
      if ((mesh.point(v) - Point(x, y, 0.0)).norm() < 1e-9) return v;
    return no_id;
  };
  document = applied(document, {"draw_line", {{"vertices", {vertex(10, 10), vertex(10, 15)}}}});
  ASSERT_EQ(document.lines.lines.size(), 1u);
  ASSERT_EQ(document.partitions.partitions.size(), 2u);
  EXPECT_EQ(sorted_sides(document), (std::vector<std::size_t>{4, 4}));
}

TEST(Sides, OfClosedSurfacesTubesAndHandles) {
  const auto all = [](const Point&) { return 1; };
  const std::vector<Outline> sphere = outlines(labelled(icosphere(5.0, 3), all));
  ASSERT_EQ(sphere.size(), 1u);
  EXPECT_EQ(sphere[0].sides(), 0u);
  EXPECT_EQ(sphere[0].handles, 0u);
  EXPECT_FALSE(sphere[0].is_four_sided());
  EXPECT_EQ(outlines(labelled(torus(10.0, 3.0, 40, 16), all))[0].handles, 1u);
  const Outline tube = outlines(labelled(cylinder_wall(5.0, 12.0, 40, 12), all))[0];
  EXPECT_EQ(tube.loops.size(), 2u);
  EXPECT_EQ(tube.sides(), 2u);
  EXPECT_EQ(tube.handles, 0u);
  // A torus but for a disc: one loop without a corner, and still no patch.
  const Outline holed = outlines(labelled(torus(10.0, 3.0, 60, 24), [](const Point& p) {
    return (p - Point(13.0, 0.0, 0.0)).norm() < 2.5 ? 0 : 1;
  }))[0];
  EXPECT_EQ(holed.loops.size(), 1u);
  EXPECT_EQ(holed.handles, 1u);
  EXPECT_FALSE(holed.is_four_sided());
}

TEST(Sides, OfOnePartitionAreThoseOfAll) {
  const Document document = applied(
      applied(document_of(sample_mould(1.5)), {"find_sharp_lines", {}}), {"find_partitions", {}});
  const std::vector<Outline> all = outlines(document);
  ASSERT_GT(all.size(), 5u);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Outline one = outline_of(*document.mesh, document.lines, document.partitions,
                                   *document.partitions.partitions[k]);
    ASSERT_EQ(one.loops.size(), all[k].loops.size());
    EXPECT_EQ(one.handles, all[k].handles);
    for (std::size_t loop = 0; loop < one.loops.size(); ++loop) {
      EXPECT_EQ(one.loops[loop].half_edges, all[k].loops[loop].half_edges);
      EXPECT_EQ(one.loops[loop].corners, all[k].loops[loop].corners);
    }
  }
  const double share = four_sided_share(document.partitions, all);
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 1.0);
}

// ---- cuts ----

TEST(FourSidedCuts, AnLIsCutFromItsInnerCorner) {
  const Document document = labelled(plate(30.0), in_l);
  const FourSidedPlan plan = only_plan(document);
  EXPECT_EQ(plan.obstacle, "");
  ASSERT_EQ(plan.cuts.size(), 1u);
  const FourSidedCut& cut = plan.cuts[0];
  ASSERT_EQ(cut.strokes.size(), 1u);
  EXPECT_EQ(cut.strokes[0], cut.path);
  const Mesh& mesh = *document.mesh;
  const std::set<std::pair<double, double>> ends{
      {mesh.point(cut.path.front()).x(), mesh.point(cut.path.front()).y()},
      {mesh.point(cut.path.back()).x(), mesh.point(cut.path.back()).y()}};
  EXPECT_EQ(ends, (std::set<std::pair<double, double>>{{5.0, 5.0}, {15.0, 15.0}}));
  EXPECT_NEAR(cut.length, std::hypot(10.0, 10.0), 6.0) << "along a lattice";
  const Document split = applied(document, {"split_to_four_sides", json::object()});
  EXPECT_EQ(sorted_sides(split), (std::vector<std::size_t>{4, 4}));
  EXPECT_NEAR(smallest_share(split), 0.5, 0.05);
  expect_whole(split);
}

TEST(FourSidedCuts, AHexagonIsCutInHalves) {
  const Document document = labelled(hexagon(10), [](const Point&) { return 1; });
  const FourSidedPlan plan = only_plan(document);
  ASSERT_EQ(plan.cuts.size(), 1u);
  EXPECT_NEAR(plan.cuts[0].length, 20.0, 1e-9);
  const Document split = applied(document, {"split_to_four_sides", json::object()});
  EXPECT_EQ(sorted_sides(split), (std::vector<std::size_t>{4, 4}));
  EXPECT_NEAR(smallest_share(split), 0.5, 1e-9);
}

TEST(FourSidedCuts, AUIsCutTwice) {
  const Document document = labelled(plate(40.0), [](const Point& p) {
    const bool in_box = p.x() > 5 && p.x() < 35 && p.y() > 5 && p.y() < 35;
    return in_box && !(p.x() > 15 && p.x() < 25 && p.y() > 15);
  });
  ASSERT_EQ(sorted_sides(document), std::vector<std::size_t>{8});
  const FourSidedPlan plan = only_plan(document);
  EXPECT_EQ(plan.cuts.size(), 2u);
  const Document split = applied(document, {"split_to_four_sides", json::object()});
  EXPECT_EQ(sorted_sides(split), (std::vector<std::size_t>{4, 4, 4}));
}

TEST(FourSidedCuts, ACylinderWallIsCutOnOppositeSides) {
  const Document document =
      labelled(cylinder_wall(5.0, 12.0, 40, 14), [](const Point&) { return 1; });
  const FourSidedPlan plan = only_plan(document);
  EXPECT_EQ(plan.obstacle, "");
  ASSERT_EQ(plan.cuts.size(), 1u);
  ASSERT_EQ(plan.cuts[0].strokes.size(), 2u);
  EXPECT_NEAR(plan.cuts[0].length, 24.0, 4.0);
  const Mesh& mesh = *document.mesh;
  std::array<Point, 2> middle;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<VertexId>& stroke = plan.cuts[0].strokes[k];
    EXPECT_TRUE(mesh.is_border(stroke.front()) && mesh.is_border(stroke.back()));
    middle[k] = mesh.point(stroke[stroke.size() / 2]);
    middle[k].z() = 0.0;
  }
  EXPECT_LT(middle[0].normalized().dot(middle[1].normalized()), -0.8);
  const Document split = applied(document, {"split_to_four_sides", json::object()});
  EXPECT_EQ(sorted_sides(split), (std::vector<std::size_t>{4, 4}));
  EXPECT_GT(smallest_share(split), 0.4);
}

TEST(FourSidedCuts, APlateWithAHoleIsFirstOpenedByTwoCuts) {
  for (const bool is_round : {false, true}) {
    const Document document = labelled(plate(40.0), [&](const Point& p) {
      const double x = std::abs(p.x() - 20.0), y = std::abs(p.y() - 20.0);
      return (is_round ? std::hypot(x, y) : std::max(x, y)) > 8.0 ? 1 : 0;
    });
    const FourSidedPlan plan = only_plan(document);
    EXPECT_EQ(plan.obstacle, "");
    ASSERT_GE(plan.cuts.size(), 3u) << "two pieces of five or six sides";
    EXPECT_EQ(plan.cuts[0].strokes.size(), 2u);
    for (std::size_t k = 1; k < plan.cuts.size(); ++k) EXPECT_EQ(plan.cuts[k].strokes.size(), 1u);
    const Document split = applied(document, {"split_to_four_sides", json::object()});
    EXPECT_EQ(split.partitions.partitions.size(), plan.cuts.size() + 1);
    for (const std::size_t sides : sorted_sides(split)) EXPECT_LE(sides, 4u);
    for (const Outline& outline : outlines(split)) EXPECT_TRUE(outline.is_four_sided());
    EXPECT_GT(smallest_share(split), 0.05);
    expect_whole(split);
  }
}

TEST(FourSidedCuts, PathsRunInsideAndMeetTheBorderAtTheirEndsOnly) {
  const Document document = applied(
      applied(document_of(sample_mould(1.5)), {"find_sharp_lines", {}}), {"find_partitions", {}});
  const Mesh& mesh = *document.mesh;
  int strokes = 0;
  const std::vector<Outline> all = outlines(document);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const PartitionPtr& partition = document.partitions.partitions[k];
    if (all[k].is_four_sided()) continue;
    for (const FourSidedCut& cut : plan_of(document, partition->id).cuts)
      for (const std::vector<VertexId>& stroke : cut.strokes) {
        ++strokes;
        for (const HalfEdgeId h : half_edges_of(mesh, stroke)) {
          EXPECT_FALSE(document.lines.is_sharp(h >> 1));
          for (const FaceId f : mesh.edge_faces(h >> 1)) {
            ASSERT_NE(f, no_id);
            EXPECT_EQ(document.partitions.label(f), partition->id);
          }
        }
        EXPECT_EQ(half_edges_of(mesh, stroke).size(), stroke.size() - 1);
        for (std::size_t i = 1; i + 1 < stroke.size(); ++i) {
          mesh.for_ring(stroke[i], [&](HalfEdgeId h) {
            EXPECT_EQ(document.partitions.label(mesh.face(h)), partition->id);
            EXPECT_FALSE(document.lines.is_sharp(h >> 1));
          });
        }
      }
  }
  EXPECT_GT(strokes, 10);
}

TEST(FourSidedCuts, SayWhyAClosedSurfaceOrAHandleIsLeft) {
  const Document sphere = labelled(icosphere(5.0, 3), [](const Point&) { return 1; });
  EXPECT_TRUE(plan_of(sphere, 1).cuts.empty());
  EXPECT_NE(plan_of(sphere, 1).obstacle.find("closed"), std::string::npos);
  const Document holed = labelled(torus(10.0, 3.0, 60, 24), [](const Point& p) {
    return (p - Point(13.0, 0.0, 0.0)).norm() < 2.5 ? 0 : 1;
  });
  EXPECT_TRUE(plan_of(holed, 1).cuts.empty());
  EXPECT_NE(plan_of(holed, 1).obstacle.find("handle"), std::string::npos);
}

/// A terrain parted by the nearest of random seeds, some of it unassigned.
Document random_division(std::uint64_t seed, int parts) {
  Random random(seed);
  const Triangles terrain = random_terrain(40, seed);
  Point low = terrain.points[0], high = low;
  for (const Point& p : terrain.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<Point> seeds;
  for (int k = 0; k < parts; ++k)
    seeds.emplace_back(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()), 0.0);
  return labelled(terrain, [&](const Point& p) {
    const auto away = [&](const Point& s) { return std::hypot(p.x() - s.x(), p.y() - s.y()); };
    const auto nearest = std::ranges::min_element(seeds, {}, away);
    return static_cast<int>(nearest - seeds.begin());  // the first stays unassigned
  });
}

TEST(FourSidedCuts, LeaveAtMostFourSidesOrSayWhyNot) {
  int cut = 0, kept = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Document document = random_division(seed, 4 + static_cast<int>(seed % 17));
    std::set<std::uint32_t> before;
    for (const PartitionPtr& partition : document.partitions.partitions)
      before.insert(partition->id);
    const Result<Document> split = apply(document, {"split_to_four_sides", json::object()});
    if (!split) {
      EXPECT_FALSE(split.error().message.empty());
      continue;
    }
    expect_whole(*split);
    if (::testing::Test::HasFatalFailure()) return;
    const std::vector<Outline> all = outlines(*split);
    const Correction& correction = *split->corrections.back();
    bool any_left = false;
    for (std::size_t k = 0; k < all.size(); ++k) {
      ++(all[k].is_four_sided() ? cut : kept);
      any_left = any_left || !all[k].is_four_sided();
    }
    EXPECT_EQ(any_left, correction.state == CorrectionState::adapted) << seed;
    EXPECT_EQ(any_left, !correction.message.empty()) << seed << " " << correction.message;
    EXPECT_GT(four_sided_share(split->partitions, all),
              four_sided_share(document.partitions, outlines(document)));
  }
  EXPECT_GT(cut, 400);
  EXPECT_LT(kept, cut / 50);
}

TEST(FourSidedCuts, DoNotDependOnTheUnit) {
  const auto scaled = [](const Document& document, const Triangles& triangles, double scale) {
    Document result =
        document_of(moved(triangles, scale, Eigen::Matrix3d::Identity(), Point::Zero()));
    result.partitions = document.partitions;
    result.next_id = document.next_id;
    result.boundaries = std::make_shared<const Boundaries>(
        derive_boundaries(*result.mesh, *result.curvatures, result.lines, result.partitions));
    return applied(result, {"split_to_four_sides", json::object()});
  };
  const auto labels = [](const Document& document) {
    std::vector<std::uint32_t> result;
    for (FaceId f = 0; f < document.mesh->face_count(); ++f)
      result.push_back(document.partitions.label(f));
    return result;
  };
  const std::vector<std::pair<Document, Triangles>> cases{
      {labelled(plate(30.0), in_l), plate(30.0)},
      {labelled(hexagon(10), [](const Point&) { return 1; }), hexagon(10)},
      {labelled(cylinder_wall(5.0, 12.0, 40, 14), [](const Point&) { return 1; }),
       cylinder_wall(5.0, 12.0, 40, 14)},
      {random_division(3, 9), random_terrain(40, 3)}};
  for (const auto& [document, triangles] : cases) {
    const auto once = labels(applied(document, {"split_to_four_sides", json::object()}));
    for (const double scale : {1000.0, 0.0254})
      EXPECT_EQ(labels(scaled(document, triangles, scale)), once);
  }
}

// ---- the operation ----

TEST(SplitToFourSides, ComplainsOfWhatItCannotDo) {
  const auto error = [](const Document& document, const json& parameters) {
    const Result<Document> result = apply(document, {"split_to_four_sides", parameters});
    return result ? std::string("done") : result.error().message;
  };
  const Document bare = document_of(plate(10.0));
  EXPECT_EQ(error(bare, json::object()), "Find partitions first: there are none yet.");
  const Document square = labelled(plate(20.0), [](const Point&) { return 1; });
  EXPECT_NE(error(square, json::object()).find("at most four sides"), std::string::npos);
  EXPECT_NE(error(square, {{"partitions", {1u}}}).find("Partition 1 has at most four"),
            std::string::npos);
  const Document l = labelled(plate(30.0), in_l);
  EXPECT_NE(error(l, {{"partitions", {77u}}}).find("no partition 77"), std::string::npos);
  EXPECT_NE(error(l, {{"partitions", json::array()}}).find("partitions"), std::string::npos);
  EXPECT_NE(error(l, {{"partitions", "all"}}).find("partitions"), std::string::npos);
  EXPECT_NE(error(l, {{"angle", 3}}).find("angle"), std::string::npos);
  const Document locked = applied(l, {"lock", {{"partitions", {1u}}}});
  EXPECT_NE(error(locked, {{"partitions", {1u}}}).find("unlock"), std::string::npos);
  EXPECT_NE(error(locked, json::object()).find("not locked"), std::string::npos);
  const Document sphere = labelled(icosphere(5.0, 3), [](const Point&) { return 1; });
  EXPECT_NE(error(sphere, {{"partitions", {1u}}}).find("closed"), std::string::npos);
}

TEST(SplitToFourSides, CutsOnlyWhatIsMeant) {
  const Document document = divided_at_edges(document_of(l_prism()));
  ASSERT_EQ(sorted_sides(document), (std::vector<std::size_t>{4, 4, 4, 4, 4, 4, 6, 6}));
  const std::vector<Outline> all = outlines(document);
  const auto six = std::ranges::find_if(all, [](const Outline& o) { return o.sides() == 6; });
  const std::uint32_t id =
      document.partitions.partitions[static_cast<std::size_t>(six - all.begin())]->id;
  const Document one = applied(document, {"split_to_four_sides", {{"partitions", {id}}}});
  EXPECT_EQ(sorted_sides(one), (std::vector<std::size_t>{4, 4, 4, 4, 4, 4, 4, 4, 6}));
  const Document both = applied(one, {"split_to_four_sides", json::object()});
  EXPECT_EQ(sorted_sides(both), std::vector<std::size_t>(10, 4));
  EXPECT_EQ(sorted_sides(applied(document, {"split_to_four_sides", json::object()})),
            std::vector<std::size_t>(10, 4));
}

TEST(SplitToFourSides, IsUndoneRedoneAndReplayed) {
  const TempFolder folder;
  const std::string file = write_mesh(folder, "mould.ply", sample_mould(1.5));
  History history;
  for (const Operation& operation :
       {Operation{"open", {{"file", file}}}, Operation{"find_sharp_lines", json::object()},
        Operation{"find_partitions", json::object()}})
    ASSERT_TRUE(history.run(operation));
  const std::string before = hash_of(history.current());
  ASSERT_TRUE(history.run({"split_to_four_sides", json::object()}));
  const std::string after = hash_of(history.current());
  EXPECT_NE(after, before);
  expect_whole(history.current());
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(hash_of(history.current()), before);
  ASSERT_TRUE(history.redo());
  EXPECT_EQ(hash_of(history.current()), after);
  ASSERT_TRUE(history.run({"find_partitions", json::object()}));
  const auto replayed = replay(folder.write("operations.jsonl", journal_text(history)), {file});
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_TRUE(replayed->warnings.empty());
  EXPECT_EQ(hash_of(replayed->history.current()), hash_of(history.current()));
}

TEST(SplitToFourSides, IsDoneAgainOnWhatIsFoundThen) {
  const Document document = divided_at_edges(document_of(l_prism()));
  const Document split = applied(document, {"split_to_four_sides", json::object()});
  const Operation again{"find_partitions", document.step("find_partitions")->parameters};
  Document found = applied(split, again);
  EXPECT_EQ(sorted_sides(found), std::vector<std::size_t>(10, 4));
  EXPECT_EQ(found.corrections.back()->state, CorrectionState::applied);
  // Without the lines it is one closed surface: nothing to cut, and it says so.
  Document merged = applied(split, {"find_sharp_lines", {{"angle", 120.0}}});
  ASSERT_TRUE(merged.lines.lines.empty());
  merged = applied(merged, {"find_partitions", {{"intervals", {{0.0, 100.0}}}}});
  ASSERT_EQ(merged.corrections.back()->operation.name, "split_to_four_sides");
  EXPECT_NE(merged.corrections.back()->state, CorrectionState::applied);
  EXPECT_TRUE(merged.corrections.back()->message.ends_with("."));
  // Back under the old thresholds it does what it did; lifted, the six corners are back.
  found =
      applied(applied(merged, {"find_sharp_lines", {{"angle", 30.0}, {"min_length", 0.0}}}), again);
  EXPECT_EQ(sorted_sides(found), std::vector<std::size_t>(10, 4));
  found = applied(found, {"lift_correction", {{"correction", found.corrections.back()->id}}});
  EXPECT_EQ(sorted_sides(found), sorted_sides(document));
}

TEST(SplitToFourSides, LeavesAPieceThatWasLockedSince) {
  const Document document = divided_at_edges(document_of(l_prism()));
  Document split = applied(document, {"split_to_four_sides", json::object()});
  std::vector<std::uint32_t> ids;
  for (const PartitionPtr& partition : split.partitions.partitions) ids.push_back(partition->id);
  split = applied(split, {"lock", {{"partitions", ids}}});
  const Document found =
      applied(split, {"find_partitions", document.step("find_partitions")->parameters});
  for (FaceId f = 0; f < found.mesh->face_count(); ++f)
    ASSERT_EQ(found.partitions.label(f), split.partitions.label(f));
  EXPECT_EQ(found.corrections.back()->state, CorrectionState::adapted);
}

TEST(SplitToFourSides, MakesOrdinaryBoundaries) {
  const Document document = labelled(plate(30.0), in_l);
  const FourSidedPlan plan = only_plan(document);
  const Document split = applied(document, {"split_to_four_sides", json::object()});
  std::vector<VertexId> gn;
  for (const BoundaryPtr& boundary : *split.boundaries)
    if (boundary->type == BoundaryType::gn) gn = boundary->vertices;
  std::vector<VertexId> path = plan.cuts.at(0).path;
  if (gn != path) std::ranges::reverse(path);
  EXPECT_EQ(gn, path);
  // And it goes as others do.
  const Document joined = applied(
      split,
      {"connect_partitions",
       {{"partitions", {split.partitions.partitions[0]->id, split.partitions.partitions[1]->id}}}});
  EXPECT_EQ(sorted_sides(joined), std::vector<std::size_t>{6});
}

// ---- the worklist ----

TEST(WorklistOfSides, CarriesTheCutsAsGhosts) {
  const Document document = divided_at_edges(document_of(l_prism()));
  std::vector<WorkItem> items = value_of(worklist(document));
  std::erase_if(items, [](const WorkItem& item) { return item.kind != WorkKind::many_borders; });
  ASSERT_EQ(items.size(), 2u);
  for (WorkItem& item : items) {
    EXPECT_EQ(item.size, 6.0);
    EXPECT_FALSE(is_left(item)) << "nothing is wrong with a patch of six sides";
    EXPECT_TRUE(item.paths.empty()) << "worked out for the one that is looked at";
    item = value_of(with_cuts(document, item));
    const FourSidedPlan plan = plan_of(document, item.partitions.at(0));
    ASSERT_EQ(plan.cuts.size(), 1u);
    EXPECT_EQ(item.paths, plan.cuts[0].strokes);
    EXPECT_NE(item.sentence.find("6 sides; a cut of"), std::string::npos) << item.sentence;
  }
  Document done = document;
  for (const WorkItem& item : items)
    done = applied(done, {"split_to_four_sides", {{"partitions", item.partitions}}});
  EXPECT_TRUE(value_of(worklist(done)).empty());
}

TEST(WorklistOfSides, StopsWhenAskedTo) {
  const Document document = divided_at_edges(document_of(l_prism()));
  std::stop_source stop;
  stop.request_stop();
  const Context stopped(nullptr, stop.get_token());
  for (const WorkItem& item : value_of(worklist(document)))
    EXPECT_FALSE(with_cuts(document, item, stopped));
  const Result<Document> split = apply(document, {"split_to_four_sides", json::object()}, stopped);
  ASSERT_FALSE(split);
  EXPECT_TRUE(split.error().message == cancelled().value().message) << split.error().message;
}

TEST(WorklistOfSides, SaysWhatCannotBeCutAndWhatIsLocked) {
  const Document tube = labelled(cylinder_wall(5.0, 12.0, 40, 14), [](const Point&) { return 1; });
  const auto sentence = [](const Document& document) {
    for (const WorkItem& item : value_of(worklist(document)))
      if (item.kind == WorkKind::many_borders) return value_of(with_cuts(document, item)).sentence;
    return std::string();
  };
  EXPECT_NE(sentence(tube).find("1 hole; 2 cuts of"), std::string::npos) << sentence(tube);
  const Document locked = applied(tube, {"lock", {{"partitions", {1u}}}});
  EXPECT_NE(sentence(locked).find("locked"), std::string::npos) << sentence(locked);
  EXPECT_EQ(sentence(labelled(icosphere(5.0, 3), [](const Point&) { return 1; })), "")
      << "a closed surface has no border at all";
}

}  // namespace
}  // namespace arris
