#include "core/partitions/partitions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "core/base/random.h"
#include "core/base/thread_limit.h"
#include "core/mesh/geometry.h"
#include "core/partitions/boundaries.h"
#include "core/partitions/front_rule.h"
#include "core/partitions/intervals.h"
#include "core/sharp_lines/sharp_lines.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;

constexpr double pi = std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A mesh with its curvatures and sharp lines.
struct Part {
  explicit Part(const Triangles& triangles)
      : mesh(mesh_of(triangles)), curvatures(curvatures_of(*mesh)) {}
  Part(const Triangles& triangles, double angle) : Part(triangles) {
    SharpLineOptions options;
    options.angle = angle;
    set_lines(value_of(find_sharp_edges(*mesh, *curvatures, nullptr, options)));
  }
  void set_lines(const std::vector<Origin>& edges) {
    lines = relink_lines(*mesh, *curvatures, edges, {}, next_id);
  }
  const std::vector<double>& values(Criterion criterion) const {
    return values_of(*curvatures, criterion);
  }
  FoundPartitions find(const PartitionOptions& options) const {
    return value_of(propagate_fronts(*mesh, values(options.criterion), lines, options));
  }
  Partitions partitions(const PartitionOptions& options) {
    return number_partitions(*mesh, find(options), {}, next_id);
  }
  /// Partitions from labels as they are; ids are the labels.
  Partitions labelled(const std::vector<std::uint32_t>& labels) const {
    Partitions result;
    result.labels = ChunkedArray<std::uint32_t>(labels, {});
    for (const std::uint32_t id : std::set<std::uint32_t>(labels.begin(), labels.end())) {
      if (id == 0) continue;
      Partition partition;
      partition.id = id;
      result.partitions.push_back(std::make_shared<const Partition>(partition));
    }
    return result;
  }
  std::vector<Boundary> boundaries(const Partitions& partitions) const {
    std::vector<Boundary> result;
    for (const BoundaryPtr& b : derive_boundaries(*mesh, *curvatures, lines, partitions))
      result.push_back(*b);
    return result;
  }

  MeshPtr mesh;
  CurvaturesPtr curvatures;
  SharpLines lines;
  std::uint32_t next_id = 1;
};

PartitionOptions with_intervals(std::vector<CurvatureInterval> intervals,
                                Criterion criterion = Criterion::kabs) {
  PartitionOptions options;
  options.criterion = criterion;
  options.intervals = std::move(intervals);
  return options;
}

std::map<BoundaryType, int> count_types(const std::vector<Boundary>& boundaries) {
  std::map<BoundaryType, int> count;
  for (const Boundary& boundary : boundaries) ++count[boundary.type];
  return count;
}

/// What section 6 of method.md says of vertices and faces, word by word.
struct Votes {
  Votes(const Part& part, Criterion criterion) : mesh(*part.mesh), lines(part.lines) {
    const std::vector<double>& values = part.values(criterion);
    std::vector<bool> on_line(mesh.vertex_count(), false), on_border = on_line;
    for (EdgeId e = 0; e < mesh.edge_count(); ++e)
      for (const VertexId v : mesh.edge(e)) {
        if (lines.is_sharp(e)) on_line[v] = true;
        if (mesh.is_border_edge(e)) on_border[v] = true;
      }
    for (VertexId v = 0; v < mesh.vertex_count(); ++v)
      regular.push_back(!on_line[v] && !on_border[v] && !mesh.is_isolated(v));
    value = values;
  }

  bool has_vote(FaceId f) const {
    const Triangle& t = mesh.triangle(f);
    return regular[t[0]] || regular[t[1]] || regular[t[2]];
  }
  bool passes(FaceId f, const CurvatureInterval& interval) const {
    for (const VertexId v : mesh.triangle(f))
      if (regular[v] && !(value[v] >= interval.min && value[v] <= interval.max)) return false;
    return has_vote(f);
  }
  /// The face across the longest edge that is not sharp and not on the border.
  FaceId across_longest(FaceId f) const {
    double longest = -1.0;
    FaceId across = no_id;
    HalfEdgeId h = mesh.face_half_edge(f);
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
      const FaceId other = mesh.face(Mesh::opposite(h));
      if (other == no_id || lines.is_sharp(h >> 1) || mesh.edge_length(h >> 1) <= longest) continue;
      longest = mesh.edge_length(h >> 1);
      across = other;
    }
    return across;
  }

  const Mesh& mesh;
  const SharpLines& lines;
  std::vector<bool> regular;
  std::vector<double> value;
};

/// Components of the faces `chosen` across edges that are not sharp: the lowest face of each.
std::vector<FaceId> components(const Mesh& mesh, const SharpLines& lines,
                               const std::vector<bool>& chosen) {
  std::vector<FaceId> root(mesh.face_count());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](FaceId f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_faces(e);
    if (a == no_id || b == no_id || lines.is_sharp(e) || !chosen[a] || !chosen[b]) continue;
    const FaceId x = find(a), y = find(b);
    root[std::max(x, y)] = std::min(x, y);
  }
  for (FaceId f = 0; f < mesh.face_count(); ++f) root[f] = chosen[f] ? find(f) : no_id;
  return root;
}

// ---- shapes whose partitions are known ----

TEST(PartitionsOfShapes, DividedCubeHasItsSixSides) {
  for (const int divisions : {4, 9}) {
    Part part(divided_cube(10.0, divisions), 30.0);
    const Partitions found = part.partitions(with_intervals({{0.0, 1e-6}}));
    ASSERT_EQ(found.partitions.size(), 6u);
    for (const PartitionPtr& partition : found.partitions) {
      EXPECT_NEAR(partition->area, 100.0, 1e-9);
      EXPECT_EQ(partition->faces, static_cast<std::uint32_t>(2 * divisions * divisions));
      EXPECT_NEAR(partition->mean_value, 0.0, 1e-9);
      EXPECT_EQ(found.find(partition->id), partition.get());
    }
    for (FaceId f = 0; f < part.mesh->face_count(); ++f) EXPECT_NE(found.label(f), 0u);
    const std::vector<Boundary> boundaries = part.boundaries(found);
    ASSERT_EQ(boundaries.size(), 12u);
    for (const Boundary& boundary : boundaries) {
      EXPECT_EQ(boundary.type, BoundaryType::c0);
      EXPECT_NE(boundary.left, boundary.right);
      EXPECT_NE(boundary.left, 0u);
      EXPECT_NE(boundary.right, 0u);
      EXPECT_NEAR(boundary.length, 10.0, 1e-9);
      EXPECT_NEAR(boundary.mean_angle, 90.0, 1e-4);
      ASSERT_NE(part.lines.find(boundary.line), nullptr);
      EXPECT_EQ(part.lines.find(boundary.line)->vertices, boundary.vertices);
    }
  }
}

TEST(PartitionsOfShapes, CubeOfEightVerticesHasNoRegularVertexAndSoNoPartition) {
  Part part(cube(10.0), 30.0);
  EXPECT_TRUE(part.partitions(with_intervals({{0.0, infinite}})).partitions.empty());
}

TEST(PartitionsOfShapes, AreasWithoutARegularVertexArePartitionsWhereAsked) {
  for (const Criterion criterion : {Criterion::kabs, Criterion::ikabs}) {
    Part part(cube(10.0), 30.0);
    PartitionOptions options = with_intervals({{0.5, infinite}, {0.0, 1e-6}});
    options.criterion = criterion;
    options.bare_areas = true;
    const FoundPartitions found = part.find(options);
    ASSERT_EQ(found.partitions.size(), 6u);
    for (const Partition& side : found.partitions) {
      EXPECT_EQ(side.faces, 2u);
      EXPECT_NEAR(side.area, 100.0, 1e-9);
      EXPECT_EQ(side.mean_value, 0.0);
      EXPECT_EQ(side.interval, options.intervals[1]);
    }
    EXPECT_EQ(std::count(found.labels.begin(), found.labels.end(), 0u), 0);
    options.min_faces = 3;
    EXPECT_TRUE(part.find(options).partitions.empty());
    options.min_faces = 1;
    options.intervals = {{1e-6, infinite}};
    EXPECT_TRUE(part.find(options).partitions.empty());
  }
}

TEST(PartitionsOfShapes, ABareWallHasTheCurvatureOfItsCylinder) {
  // Only the end circles have vertices, 40 each: the wall unrolls, and its Kabs is 1 / r^2 but for
  // the polygon's turn over its perimeter.
  const double radius = 10.0;
  Part part(capped_cylinder(radius, 30.0, 40, 1, 1), 30.0);
  PartitionOptions options = with_intervals({{0.0, infinite}});
  options.bare_areas = true;
  const FoundPartitions found = part.find(options);
  ASSERT_EQ(found.partitions.size(), 3u);
  int walls = 0;
  for (const Partition& partition : found.partitions) {
    if (partition.faces != 80u) continue;
    ++walls;
    EXPECT_NEAR(partition.mean_value, 1.0 / (radius * radius), 0.01 / (radius * radius));
  }
  EXPECT_EQ(walls, 1);
}

TEST(PartitionsOfShapes, StepHasTwoLevelsAndAWall) {
  Part part(stepped_plate(10.0, 20.0, 4.0, 1.0), 30.0);
  const Partitions found = part.partitions(with_intervals({{0.0, 1e-6}}));
  ASSERT_EQ(found.partitions.size(), 3u);
  std::vector<double> areas;
  for (const PartitionPtr& partition : found.partitions) areas.push_back(partition->area);
  std::ranges::sort(areas);
  EXPECT_NEAR(areas[0], 80.0, 1e-9);
  EXPECT_NEAR(areas[1], 200.0, 1e-9);
  EXPECT_NEAR(areas[2], 200.0, 1e-9);
  const auto types = count_types(part.boundaries(found));
  EXPECT_EQ(types.at(BoundaryType::c0), 2);
  EXPECT_EQ(types.at(BoundaryType::border), 4) << "two levels and both ends of the wall";
  EXPECT_EQ(types.size(), 2u);
}

TEST(PartitionsOfShapes, CappedCylinderHasCapWallCap) {
  Part part(capped_cylinder(10.0, 20.0, 48, 12, 6), 30.0);
  const Partitions found = part.partitions(with_intervals({{0.0, 1.0}}));
  ASSERT_EQ(found.partitions.size(), 3u);
  const double cap = 48 * 0.5 * 100.0 * std::sin(2.0 * pi / 48);
  const double wall = 48 * 20.0 * std::sin(pi / 48) * 20.0;
  std::vector<double> areas;
  for (const PartitionPtr& partition : found.partitions) areas.push_back(partition->area);
  std::ranges::sort(areas);
  EXPECT_NEAR(areas[0], cap, 1e-9);
  EXPECT_NEAR(areas[1], cap, 1e-9);
  EXPECT_NEAR(areas[2], wall, 1e-9);
  const std::vector<Boundary> boundaries = part.boundaries(found);
  ASSERT_EQ(boundaries.size(), 2u);
  for (const Boundary& boundary : boundaries) {
    EXPECT_EQ(boundary.type, BoundaryType::c0);
    EXPECT_TRUE(boundary.closed);
    EXPECT_EQ(boundary.vertices.front(), boundary.vertices.back());
  }
}

TEST(PartitionsOfShapes, TwoIntervalsPartFlatFromCurved) {
  // The caps have Kabs 0, the wall 1/100.
  Part part(capped_cylinder(10.0, 20.0, 48, 12, 6), 30.0);
  const Partitions found = part.partitions(with_intervals({{0.0, 0.005}, {0.005, 0.02}}));
  ASSERT_EQ(found.partitions.size(), 3u);
  int flat = 0;
  for (const PartitionPtr& partition : found.partitions) {
    if (partition->interval.min == 0.0) {
      ++flat;
      EXPECT_LT(partition->mean_value, 0.005);
    } else {
      EXPECT_NEAR(partition->mean_value, 0.01, 5e-4);
    }
  }
  EXPECT_EQ(flat, 2);
  EXPECT_TRUE(part.partitions(with_intervals({{0.02, 0.03}})).partitions.empty());
}

TEST(PartitionsOfShapes, BlendWithoutSharpLineIsAGnBoundary) {
  // A plate that turns into a quarter of a cylinder of radius 10 along x = 20, and flat again.
  constexpr double radius = 10.0, arc = radius * pi / 2.0;
  Part part(shaped_lattice(60.0, 1.0, [&](double x, double y) {
    if (x <= 20.0) return Point(x, y, 0.0);
    if (x >= 20.0 + arc) return Point(20.0 + radius, y, -radius - (x - 20.0 - arc));
    const double turn = (x - 20.0) / radius;
    return Point(20.0 + radius * std::sin(turn), y, -radius * (1.0 - std::cos(turn)));
  }));
  const double cut = 0.5 / (radius * radius);
  const Partitions found = part.partitions(with_intervals({{0.0, cut}, {cut, infinite}}));
  EXPECT_EQ(found.partitions.size(), 3u);
  // The row of faces between a flat vertex and a curved one passes neither interval.
  const auto types = count_types(part.boundaries(found));
  EXPECT_FALSE(types.contains(BoundaryType::c0));
  EXPECT_EQ(types.at(BoundaryType::undefined) + (types.contains(BoundaryType::gn) ? 1 : 0) > 0,
            true);
}

// ---- typing (figure 30) on a lattice whose labels and lines are given ----

class Typing : public ::testing::Test {
 protected:
  static constexpr VertexId side = 11;  // vertices; spacing 1

  static VertexId at(VertexId x, VertexId y) { return y * side + x; }
  Point centre(FaceId f) const {
    const Triangle& t = part.mesh->triangle(f);
    return (part.mesh->point(t[0]) + part.mesh->point(t[1]) + part.mesh->point(t[2])) / 3.0;
  }
  template <class Label>
  Partitions label(const Label& label_at) const {
    std::vector<std::uint32_t> labels(part.mesh->face_count());
    for (FaceId f = 0; f < labels.size(); ++f) labels[f] = label_at(centre(f));
    return part.labelled(labels);
  }
  void draw(const std::vector<VertexId>& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      edges[part.mesh->find_edge(path[i], path[i + 1]).value()] = Origin::drawn;
    part.set_lines(edges);
  }
  std::vector<VertexId> column(VertexId x, VertexId begin, VertexId end) const {
    std::vector<VertexId> path;
    for (VertexId y = begin; y <= end; ++y) path.push_back(at(x, y));
    return path;
  }

  Part part{noisy_plane(10.0, 1.0, 0.0, 0.0, 1)};
  std::vector<Origin> edges = std::vector<Origin>(part.mesh->edge_count(), Origin::none);
};

TEST_F(Typing, NothingFoundHasNoBoundaries) {
  EXPECT_TRUE(part.boundaries({}).empty());
  EXPECT_TRUE(part.boundaries(label([](const Point&) { return 0u; })).empty());
}

TEST_F(Typing, WholePlateIsClosedByTheBorder) {
  const auto boundaries = part.boundaries(label([](const Point&) { return 5u; }));
  ASSERT_EQ(boundaries.size(), 1u);
  EXPECT_EQ(boundaries[0].type, BoundaryType::border);
  EXPECT_TRUE(boundaries[0].closed);
  EXPECT_NEAR(boundaries[0].length, 40.0, 1e-9);
  EXPECT_EQ(boundaries[0].left + boundaries[0].right, 5u);
}

TEST_F(Typing, TwoPartitionsMeetInGn) {
  const auto boundaries =
      part.boundaries(label([](const Point& p) { return p.x() < 5 ? 1u : 2u; }));
  ASSERT_EQ(boundaries.size(), 3u);
  for (const Boundary& boundary : boundaries) {
    if (boundary.type == BoundaryType::border) {
      EXPECT_NEAR(boundary.length, 20.0, 1e-9);
      continue;
    }
    EXPECT_EQ(boundary.type, BoundaryType::gn);
    EXPECT_NEAR(boundary.length, 10.0, 1e-9);
    EXPECT_EQ(std::minmax(boundary.left, boundary.right), std::minmax(1u, 2u));
    // Going up along +y, partition 1 (low x) is on the left.
    const bool up = part.mesh->point(boundary.vertices[0]).y() == 0.0;
    EXPECT_EQ(boundary.left, up ? 1u : 2u);
  }
}

TEST_F(Typing, AnIslandAmongUnassignedFacesIsUndefined) {
  const auto boundaries = part.boundaries(label(
      [](const Point& p) { return p.x() > 3 && p.x() < 6 && p.y() > 3 && p.y() < 7 ? 9u : 0u; }));
  ASSERT_EQ(boundaries.size(), 1u);
  EXPECT_EQ(boundaries[0].type, BoundaryType::undefined);
  EXPECT_TRUE(boundaries[0].closed);
  EXPECT_NEAR(boundaries[0].length, 14.0, 1e-9);
}

TEST_F(Typing, SharpLineStaysC0WhateverLiesBeside) {
  draw(column(5, 0, 10));
  // Nothing, one side, both sides different, one and the same on both sides.
  const auto c0_sides = [&](const Partitions& partitions) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (const Boundary& boundary : part.boundaries(partitions)) {
      if (boundary.type != BoundaryType::c0) continue;
      EXPECT_NEAR(boundary.length, 10.0, 1e-9);
      EXPECT_EQ(boundary.line, part.lines.lines[0]->id);
      sides.push_back(std::minmax(boundary.left, boundary.right));
    }
    return sides;
  };
  using Sides = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(c0_sides({}), (Sides{{0, 0}}));
  EXPECT_EQ(c0_sides(label([](const Point& p) { return p.x() < 5 ? 1u : 0u; })), (Sides{{0, 1}}));
  EXPECT_EQ(c0_sides(label([](const Point& p) { return p.x() < 5 ? 1u : 2u; })), (Sides{{1, 2}}));
  EXPECT_EQ(c0_sides(label([](const Point&) { return 3u; })), (Sides{{3, 3}}));
}

TEST_F(Typing, LineThatFadesOutAndGoesOnAsGnIsTwoBoundaries) {
  draw(column(5, 0, 6));
  const auto boundaries =
      part.boundaries(label([](const Point& p) { return p.x() < 5 ? 1u : 2u; }));
  const auto types = count_types(boundaries);
  EXPECT_EQ(types.at(BoundaryType::c0), 1);
  EXPECT_EQ(types.at(BoundaryType::gn), 1);
  for (const Boundary& boundary : boundaries) {
    const auto ends = std::set{boundary.vertices.front(), boundary.vertices.back()};
    if (boundary.type == BoundaryType::c0) {
      EXPECT_NEAR(boundary.length, 6.0, 1e-9);
      EXPECT_EQ(ends, (std::set{at(5, 0), at(5, 6)}));
    }
    if (boundary.type == BoundaryType::gn) {
      EXPECT_NEAR(boundary.length, 4.0, 1e-9);
      EXPECT_EQ(ends, (std::set{at(5, 6), at(5, 10)}));
    }
  }
}

TEST_F(Typing, C0IsCutWhereThePartitionBesideItChanges) {
  draw(column(5, 0, 10));
  const auto boundaries = part.boundaries(label([](const Point& p) {
    return p.x() > 5 ? 3u : p.y() < 4 ? 1u : 2u;
  }));
  std::multiset<double> c0, gn;
  for (const Boundary& boundary : boundaries) {
    if (boundary.type == BoundaryType::c0) c0.insert(std::round(boundary.length));
    if (boundary.type == BoundaryType::gn) gn.insert(std::round(boundary.length));
  }
  EXPECT_EQ(c0, (std::multiset<double>{4.0, 6.0}));
  EXPECT_EQ(gn, (std::multiset<double>{5.0}));
}

TEST_F(Typing, DanglingLineInsideAPartitionIsOneC0) {
  draw(column(5, 3, 7));
  const auto types = count_types(part.boundaries(label([](const Point&) { return 1u; })));
  EXPECT_EQ(types.at(BoundaryType::c0), 1);
  EXPECT_EQ(types.at(BoundaryType::border), 1);
}

// ---- what holds on any mesh, under any intervals ----

void expect_proper_partitions(const Part& part, const Partitions& found) {
  const Mesh& mesh = *part.mesh;
  ASSERT_EQ(found.labels.size(), mesh.face_count());
  // Assigned and unassigned are all; each partition counts its own faces and area.
  std::map<std::uint32_t, std::uint32_t> faces;
  std::map<std::uint32_t, double> area;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (found.labels[f] != 0) {
      ++faces[found.labels[f]];
      area[found.labels[f]] += face_area(mesh, f);
    }
  ASSERT_EQ(faces.size(), found.partitions.size());
  for (const PartitionPtr& partition : found.partitions) {
    EXPECT_EQ(partition->faces, faces[partition->id]);
    EXPECT_NEAR(partition->area, area[partition->id], 1e-9 * (1.0 + area[partition->id]));
    const auto anchor = mesh.find_face(partition->anchor);
    ASSERT_TRUE(anchor);
    EXPECT_EQ(found.labels[*anchor], partition->id) << "found again by its anchor";
    // Edge-connected without a step over a sharp edge.
    std::vector<bool> own(mesh.face_count());
    for (FaceId f = 0; f < mesh.face_count(); ++f) own[f] = found.labels[f] == partition->id;
    const std::vector<FaceId> component = components(mesh, part.lines, own);
    for (FaceId f = 0; f < mesh.face_count(); ++f)
      if (own[f] && component[f] != component[*anchor]) {
        ADD_FAILURE() << "partition " << partition->id << " is in pieces";
        break;
      }
  }
}

void expect_proper_boundaries(const Part& part, const Partitions& found,
                              const std::vector<Boundary>& boundaries) {
  const Mesh& mesh = *part.mesh;
  const auto label_left_of = [&](HalfEdgeId h) {
    return mesh.face(h) == no_id ? 0u : found.label(mesh.face(h));
  };
  std::vector<int> uses(mesh.edge_count(), 0), passes(mesh.vertex_count(), 0),
      ends(mesh.vertex_count(), 0);
  for (const Boundary& boundary : boundaries) {
    ASSERT_GE(boundary.vertices.size(), 2u);
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < boundary.vertices.size(); ++i) {
      const VertexId a = boundary.vertices[i], b = boundary.vertices[i + 1];
      const EdgeId e = mesh.find_edge(a, b).value();
      const HalfEdgeId h = a < b ? 2 * e : 2 * e + 1;
      ++uses[e];
      length += mesh.edge_length(e);
      EXPECT_EQ(label_left_of(h), boundary.left);
      EXPECT_EQ(label_left_of(Mesh::opposite(h)), boundary.right);
      const bool c0 = part.lines.is_sharp(e), border = !c0 && mesh.is_border_edge(e);
      EXPECT_EQ(boundary.type == BoundaryType::c0, c0);
      EXPECT_EQ(boundary.type == BoundaryType::border, border);
      EXPECT_EQ(boundary.type == BoundaryType::gn,
                !c0 && !border && boundary.left != 0 && boundary.right != 0);
      if (i > 0) ++passes[a];
    }
    if (boundary.type == BoundaryType::c0) {
      const Line* line = part.lines.find(boundary.line);
      ASSERT_NE(line, nullptr);
      for (const VertexId v : boundary.vertices)
        EXPECT_NE(std::ranges::find(line->vertices, v), line->vertices.end());
    } else {
      EXPECT_EQ(boundary.line, 0u);
    }
    EXPECT_NEAR(boundary.length, length, 1e-9 * (1.0 + length));
    EXPECT_TRUE(!boundary.closed || boundary.vertices.front() == boundary.vertices.back());
    if (boundary.closed) {
      ++passes[boundary.vertices.front()];
    } else {
      ++ends[boundary.vertices.front()];
      ++ends[boundary.vertices.back()];
    }
  }
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const bool is_boundary =
        part.lines.is_sharp(e) || label_left_of(2 * e) != label_left_of(2 * e + 1);
    EXPECT_EQ(uses[e], is_boundary ? 1 : 0) << "edge " << e;
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_TRUE(passes[v] == 0 || (passes[v] == 1 && ends[v] == 0))
        << "boundaries meet inside one, at vertex " << v;
}

/// Intervals cut at random quantiles of the values; sometimes with gaps, sometimes overlapping.
PartitionOptions random_options(const Part& part, Random& random) {
  PartitionOptions options;
  options.criterion = random.bits() % 2 ? Criterion::kabs : Criterion::ikabs;
  std::vector<double> values;
  for (VertexId v = 0; v < part.mesh->vertex_count(); ++v)
    if (!part.mesh->is_border(v)) values.push_back(part.values(options.criterion)[v]);
  std::ranges::sort(values);
  const auto at = [&](double q) {
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  };
  const int count = 1 + static_cast<int>(random.bits() % 3);
  for (int k = 0; k < count; ++k) {
    const double low = random.uniform(0.0, 0.6);
    options.intervals.push_back(
        {random.bits() % 2 ? at(low) : 0.0,
         random.bits() % 3 ? at(low + random.uniform(0.1, 0.4)) : infinite});
  }
  options.min_faces = random.bits() % 2 ? 1 : 1 + static_cast<std::uint32_t>(random.bits() % 12);
  return options;  // fill_holes stays 0: the plain algorithm
}

TEST(PartitionsProperty, PartitionsAndBoundariesAreProperUnderAnyIntervals) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Part part(random_terrain(10 + static_cast<int>(random.bits() % 16), seed),
              random.uniform(15.0, 80.0));
    for (int k = 0; k < 4; ++k) {
      PartitionOptions options = random_options(part, random);
      options.fill_holes = static_cast<std::uint32_t>(random.bits() % 2 * (random.bits() % 40));
      const Partitions found = part.partitions(options);
      expect_proper_partitions(part, found);
      for (const PartitionPtr& partition : found.partitions)
        EXPECT_GE(partition->faces, options.min_faces);
      expect_proper_boundaries(part, found, part.boundaries(found));
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(PartitionsProperty, OneIntervalGivesTheComponentsOfThePassingFaces) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Part part(random_terrain(10 + static_cast<int>(random.bits() % 16), seed),
                    random.uniform(15.0, 80.0));
    PartitionOptions options = random_options(part, random);
    options.intervals.resize(1);
    options.min_faces = 1;
    const Votes votes(part, options.criterion);
    std::vector<bool> passes(part.mesh->face_count());
    for (FaceId f = 0; f < passes.size(); ++f) passes[f] = votes.passes(f, options.intervals[0]);
    const std::vector<FaceId> component = components(*part.mesh, part.lines, passes);
    const FoundPartitions found = part.find(options);
    std::map<FaceId, std::uint32_t> label_of;
    std::map<std::uint32_t, FaceId> component_of;
    for (FaceId f = 0; f < passes.size(); ++f) {
      if (!votes.has_vote(f)) continue;
      ASSERT_EQ(found.labels[f] != 0, passes[f]) << "face " << f;
      if (!passes[f]) continue;
      const auto label = label_of.try_emplace(component[f], found.labels[f]).first->second;
      const auto owner = component_of.try_emplace(found.labels[f], component[f]).first->second;
      ASSERT_EQ(label, found.labels[f]) << "one component, one partition";
      ASSERT_EQ(owner, component[f]) << "one partition, one component";
    }
    EXPECT_EQ(label_of.size(), found.partitions.size());
  }
}

// Finding asks the whole mesh at once, explanations and treatments a face at a time.
TEST(PartitionsProperty, VotesAreTheSameCountedAtOnceOrAskedFor) {
  Part part(random_terrain(14, 5), 40.0);
  const std::vector<double>& values = part.values(Criterion::kabs);
  const FrontRule asked(*part.mesh, values, part.lines);
  FrontRule counted = asked;
  counted.count_all_votes();
  const CurvatureInterval interval{0.0, values[part.mesh->vertex_count() / 2]};
  std::array<int, 4> faces_by_votes{};
  for (FaceId f = 0; f < part.mesh->face_count(); ++f) {
    ASSERT_EQ(asked.votes(f), counted.votes(f)) << f;
    ASSERT_EQ(asked.passes(f, interval), counted.passes(f, interval)) << f;
    int regular = 0;
    for (const VertexId v : part.mesh->triangle(f)) {
      ASSERT_EQ(asked.is_regular(v), counted.is_regular(v)) << v;
      regular += !part.mesh->is_border(v) && sharp_edges_at(*part.mesh, part.lines, v).empty();
    }
    ASSERT_EQ(asked.votes(f), regular) << f;
    ++faces_by_votes[static_cast<std::size_t>(regular)];
  }
  for (const int count : faces_by_votes) EXPECT_GT(count, 0) << "every case came about";
}

TEST(PartitionsProperty, FacesWithoutAVoteJoinAcrossTheirLongestEdge) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Part part(random_terrain(10 + static_cast<int>(random.bits() % 16), seed),
                    random.uniform(10.0, 50.0));
    const PartitionOptions options = random_options(part, random);
    const Votes votes(part, options.criterion);
    const FoundPartitions found = part.find(options);
    for (FaceId f = 0; f < part.mesh->face_count(); ++f) {
      if (votes.has_vote(f)) continue;
      const FaceId across = votes.across_longest(f);
      EXPECT_EQ(found.labels[f], across == no_id ? 0u : found.labels[across]) << "face " << f;
    }
  }
}

TEST(PartitionsProperty, FilledHolesAreThoseUnderTheLimitAndNoOthers) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Part part(random_terrain(10 + static_cast<int>(random.bits() % 16), seed),
                    random.uniform(15.0, 80.0));
    const Mesh& mesh = *part.mesh;
    PartitionOptions options = random_options(part, random);
    const std::vector<std::uint32_t> plain = part.find(options).labels;
    options.fill_holes = 2 + static_cast<std::uint32_t>(random.bits() % 30);
    const std::vector<std::uint32_t> filled = part.find(options).labels;

    std::vector<bool> open(mesh.face_count());
    for (FaceId f = 0; f < open.size(); ++f) open[f] = plain[f] == 0;
    const std::vector<FaceId> hole = components(mesh, part.lines, open);
    std::map<FaceId, std::uint32_t> faces;                     // of each hole
    std::map<FaceId, std::map<std::uint32_t, double>> beside;  // length shared with each partition
    for (FaceId f = 0; f < open.size(); ++f)
      if (open[f]) ++faces[hole[f]];
    for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
      auto [a, b] = mesh.edge_faces(e);
      if (a == no_id || b == no_id || part.lines.is_sharp(e) || open[a] == open[b]) continue;
      if (open[b]) std::swap(a, b);
      beside[hole[a]][plain[b]] += mesh.edge_length(e);
    }
    for (FaceId f = 0; f < open.size(); ++f) {
      if (!open[f]) {
        EXPECT_EQ(filled[f], plain[f]) << "what was assigned stays";
      } else if (faces[hole[f]] >= options.fill_holes || beside[hole[f]].empty()) {
        EXPECT_EQ(filled[f], 0u) << "face " << f;
      } else {
        double longest = 0.0;
        for (const auto& [label, length] : beside[hole[f]]) longest = std::max(longest, length);
        ASSERT_NE(filled[f], 0u) << "face " << f;
        EXPECT_NEAR(beside[hole[f]][filled[f]], longest, 1e-9) << "face " << f;
      }
    }
  }
}

TEST(PartitionsProperty, PartitionsAreNumberedByDecreasingSeed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Part part(random_terrain(20, seed), 40.0);
    PartitionOptions options = random_options(part, random);
    options.intervals.resize(1);
    const Votes votes(part, options.criterion);
    const FoundPartitions found = part.find(options);
    std::vector<double> highest(found.partitions.size() + 1, 0.0);
    for (FaceId f = 0; f < part.mesh->face_count(); ++f)
      for (const VertexId v : part.mesh->triangle(f))
        if (votes.has_vote(f) && votes.regular[v])
          highest[found.labels[f]] = std::max(highest[found.labels[f]], votes.value[v]);
    for (std::size_t k = 2; k < highest.size(); ++k)
      EXPECT_LE(highest[k], highest[k - 1]) << "seed " << seed;
  }
}

TEST(PartitionsProperty, LaterIntervalsTakeOnlyWhatIsLeft) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Part part(random_terrain(20, seed), 40.0);
    PartitionOptions both = random_options(part, random);
    both.intervals.resize(1);
    both.intervals.push_back({0.0, infinite});
    both.min_faces = 1;
    PartitionOptions first = both;
    first.intervals.pop_back();
    const Votes votes(part, both.criterion);
    const FoundPartitions alone = part.find(first), together = part.find(both);
    for (FaceId f = 0; f < part.mesh->face_count(); ++f) {
      if (!votes.has_vote(f)) continue;
      EXPECT_NE(together.labels[f], 0u) << "the second interval takes everything";
      EXPECT_TRUE(alone.labels[f] == 0 || together.labels[f] == alone.labels[f]);
    }
  }
}

TEST(PartitionsProperty, AnyNumberOfThreadsGivesTheSame) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    const Part part(random_terrain(60, 5), 40.0);
    return part.find(with_intervals({{0.0, 0.5}, {0.5, infinite}})).labels;
  };
  const std::vector<std::uint32_t> one = run(1);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(7), one);
}

TEST(PartitionsProperty, CancelledWorkIsAnErrorThatSaysSo) {
  const Part part(divided_cube(10.0, 4), 30.0);
  std::stop_source stop;
  stop.request_stop();
  const auto result =
      propagate_fronts(*part.mesh, part.curvatures->kabs, part.lines, with_intervals({{0.0, 1.0}}),
                       Context(nullptr, stop.get_token()));
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().cancelled);
}

// ---- identity ----

TEST(PartitionIds, KeptByMostSharedAreaAndNeverUsedTwice) {
  Part part(noisy_plane(10.0, 1.0, 0.0, 0.0, 1));
  const Mesh& mesh = *part.mesh;
  const auto found_by = [&](const auto& label_at, std::uint32_t count) {
    FoundPartitions found;
    found.labels.resize(mesh.face_count());
    found.partitions.resize(count);
    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      const Triangle& t = mesh.triangle(f);
      found.labels[f] = label_at((mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0);
    }
    return found;
  };
  const auto id_at = [&](const Partitions& partitions, double x) {
    for (FaceId f = 0; f < mesh.face_count(); ++f)
      if (std::abs(mesh.point(mesh.triangle(f)[0]).x() - x) < 0.1) return partitions.label(f);
    return 0u;
  };
  std::uint32_t next_id = 40;
  const Partitions whole =
      number_partitions(mesh, found_by([](const Point&) { return 1u; }, 1), {}, next_id);
  ASSERT_EQ(whole.partitions.size(), 1u);
  EXPECT_EQ(whole.partitions[0]->id, 40u);
  // Cut at x = 3: the larger piece keeps the id, although it is label 2.
  const Partitions cut = number_partitions(
      mesh, found_by([](const Point& p) { return p.x() < 3 ? 1u : 2u; }, 2), whole, next_id);
  EXPECT_EQ(id_at(cut, 1.0), 41u);
  EXPECT_EQ(id_at(cut, 8.0), 40u);
  // The cut moves: ids go with the area.
  const Partitions moved = number_partitions(
      mesh, found_by([](const Point& p) { return p.x() < 5 ? 2u : 1u; }, 2), cut, next_id);
  EXPECT_EQ(id_at(moved, 1.0), 41u);
  EXPECT_EQ(id_at(moved, 8.0), 40u);
  EXPECT_EQ(next_id, 42u);
  // Equal shares: the lower id.
  const Partitions joined =
      number_partitions(mesh, found_by([](const Point&) { return 1u; }, 1), moved, next_id);
  EXPECT_EQ(joined.partitions[0]->id, 40u);
  // 41 is gone for good.
  const Partitions again = number_partitions(
      mesh, found_by([](const Point& p) { return p.x() < 3 ? 1u : 2u; }, 2), joined, next_id);
  EXPECT_EQ(id_at(again, 1.0), 42u);
  EXPECT_EQ(again.find(41), nullptr);
}

TEST(PartitionIds, SameResultSharesEverything) {
  Part part(divided_cube(10.0, 20), 30.0);
  const PartitionOptions options = with_intervals({{0.0, 1e-6}});
  const Partitions first = part.partitions(options);
  const Partitions second = number_partitions(*part.mesh, part.find(options), first, part.next_id);
  EXPECT_EQ(second.partitions, first.partitions) << "the very same values, shared";
  EXPECT_TRUE(second.labels == first.labels);
  EXPECT_LT(second.labels.bytes_beyond(first.labels), 1000u);
}

// ---- default intervals ----

void expect_sane(const std::vector<CurvatureInterval>& intervals) {
  ASSERT_FALSE(intervals.empty());
  EXPECT_EQ(intervals.front().min, 0.0);
  EXPECT_EQ(intervals.back().max, infinite);
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    EXPECT_LT(intervals[k].min, intervals[k].max);
    EXPECT_TRUE(k == 0 || intervals[k].min == intervals[k - 1].max) << "no gap, no overlap";
  }
}

TEST(DefaultIntervals, OneForAPartThatIsFlatEverywhere) {
  for (const Criterion criterion : {Criterion::kabs, Criterion::ikabs}) {
    const Part plate(noisy_plane(20.0, 1.0, 0.0, 0.0, 1)), box(divided_cube(10.0, 8), 30.0);
    for (const Part* part : {&plate, &box}) {
      const auto intervals =
          default_intervals(*part->mesh, *part->curvatures, criterion, part->lines);
      expect_sane(intervals);
      EXPECT_EQ(intervals.size(), 1u);
    }
  }
}

TEST(DefaultIntervals, PartFlatAreasFromCurvedOnesOnACadPart) {
  for (const double radius : {6.0, 7.0, 9.0, 10.0, 11.0, 13.0}) {
    const Part part(capped_cylinder(radius, 20.0, 48, 12, 6), 30.0);
    const auto intervals =
        default_intervals(*part.mesh, *part.curvatures, Criterion::kabs, part.lines);
    expect_sane(intervals);
    ASSERT_EQ(intervals.size(), 2u);
    // The caps have Kabs 0; the wall 1 / radius^2, and is above the cut by more than rounding.
    EXPECT_LT(intervals[0].max, 0.99 / (radius * radius)) << "radius " << radius;
  }
}

TEST(DefaultIntervals, MostOfANoisyPlaneIsOfLowCurvature) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Part part(noisy_plane(40.0, 1.0, 0.05, 0.2, seed));
    const auto intervals =
        default_intervals(*part.mesh, *part.curvatures, Criterion::kabs, part.lines);
    expect_sane(intervals);
    std::size_t low = 0, all = 0;
    for (VertexId v = 0; v < part.mesh->vertex_count(); ++v) {
      if (part.mesh->is_border(v)) continue;
      ++all;
      low += part.curvatures->kabs[v] <= intervals[0].max;
    }
    EXPECT_GT(low, all * 3 / 4) << "seed " << seed;
  }
}

TEST(DefaultIntervals, AreProperOnAnyPartAndCriterion) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const Criterion criterion : {Criterion::kabs, Criterion::ikabs}) {
      const Part part(random_terrain(15, seed), 40.0);
      expect_sane(default_intervals(*part.mesh, *part.curvatures, criterion, part.lines));
      for (const PartitionMethod method : {PartitionMethod::surfaces, PartitionMethod::fronts})
        EXPECT_GE(default_min_faces(*part.mesh, method), 1u);
    }
}

TEST(DefaultIntervals, ScaleWithThePart) {
  const Triangles small = capped_cylinder(10.0, 20.0, 48, 12, 6);
  Triangles large = small;
  for (Point& p : large.points) p *= 10.0;
  const Part a(small, 30.0), b(large, 30.0);
  const auto x = default_intervals(*a.mesh, *a.curvatures, Criterion::kabs, a.lines);
  const auto y = default_intervals(*b.mesh, *b.curvatures, Criterion::kabs, b.lines);
  ASSERT_EQ(x.size(), 2u);
  ASSERT_EQ(y.size(), 2u);
  EXPECT_NEAR(y[0].max, x[0].max / 100.0, 0.02 * y[0].max) << "Kabs goes with 1 / length^2";
}

}  // namespace
}  // namespace arris
