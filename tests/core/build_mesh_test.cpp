#include "core/mesh/build_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/mesh/scan.h"
#include "tests/support/meshes.h"

namespace arris {
namespace {

using Polygons = std::vector<std::vector<VertexId>>;

struct Built {
  MeshPtr mesh;
  std::vector<std::uint32_t> source_faces;
  LoadReport report;

  /// The vertex of the file that vertex v of the mesh is, or is a copy of.
  VertexId original(VertexId v) const {
    return v < report.file_vertices ? v : report.copies[v - report.file_vertices];
  }
};

PolygonFile file_of(const std::vector<Point>& points, const Polygons& polygons) {
  PolygonFile file;
  file.points = points;
  file.starts.push_back(0);
  for (const std::vector<VertexId>& polygon : polygons) {
    file.corners.insert(file.corners.end(), polygon.begin(), polygon.end());
    file.starts.push_back(file.corners.size());
  }
  return file;
}

/// Builds, and checks what must hold of every result.
Built build(const std::vector<Point>& points, const Polygons& polygons) {
  const PolygonFile file = file_of(points, polygons);
  Built built;
  Result<BuiltMesh> result = build_mesh(file.points, file.starts, file.corners, built.report);
  if (!result) throw std::runtime_error(result.error().message);
  built.mesh = result->mesh;
  built.source_faces = result->source_faces;

  const LoadReport& report = built.report;
  EXPECT_EQ(report.file_vertices, points.size());
  EXPECT_EQ(report.file_faces, polygons.size());
  EXPECT_EQ(report.vertices, built.mesh->vertex_count());
  EXPECT_EQ(report.vertices, points.size() + report.copies.size());
  EXPECT_EQ(report.faces, built.mesh->face_count());
  EXPECT_EQ(report.edges, built.mesh->edge_count());
  EXPECT_EQ(built.source_faces.size(), built.mesh->face_count());
  EXPECT_TRUE(std::is_sorted(built.source_faces.begin(), built.source_faces.end()));
  EXPECT_TRUE(report.left_out_faces.empty());
  EXPECT_EQ(report.clean(), report.sentences().empty());
  for (VertexId v = 0; v < built.mesh->vertex_count(); ++v) {
    const Point& mine = built.mesh->point(v);
    const Point& theirs = points[built.original(v)];
    EXPECT_TRUE(mine == theirs || !theirs.allFinite());
  }
  for (FaceId f = 0; f < built.mesh->face_count(); ++f) {
    const std::vector<VertexId>& polygon = polygons[built.source_faces[f]];
    for (const VertexId v : built.mesh->triangle(f))
      EXPECT_NE(std::find(polygon.begin(), polygon.end(), built.original(v)), polygon.end());
  }
  return built;
}

Polygons polygons_of(const std::vector<Triangle>& triangles) {
  Polygons polygons;
  for (const Triangle& t : triangles) polygons.push_back({t[0], t[1], t[2]});
  return polygons;
}

bool says(const LoadReport& report, const std::string& text) {
  for (const std::string& sentence : report.sentences())
    if (sentence.find(text) != std::string::npos) return true;
  return false;
}

double area_of(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles())
    sum += 0.5 * (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)).norm();
  return sum;
}

const std::vector<Point> unit_square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(BuildMesh, AMeshWithoutFaultsIsKeptToTheLetter) {
  for (const testing::Triangles& t : {testing::icosphere(1.0, 2), testing::block_with_holes(2),
                                      testing::cylinder_wall(1, 2, 12, 5)}) {
    const Built built = build(t.points, polygons_of(t.triangles));
    EXPECT_TRUE(built.report.clean());
    EXPECT_TRUE(built.report.sentences().empty());
    EXPECT_EQ(built.mesh->triangles(), t.triangles);
    EXPECT_EQ(built.report.components, 1u);
  }
}

TEST(BuildMesh, CountsAreThoseOfTopology) {
  const auto report = [](const testing::Triangles& t) {
    return build(t.points, polygons_of(t.triangles)).report;
  };
  EXPECT_EQ(report(testing::icosphere(1, 1)).euler_number, 2);
  EXPECT_EQ(report(testing::torus(3, 1, 12, 8)).euler_number, 0);
  EXPECT_EQ(report(testing::block_with_holes(3)).euler_number, -4);
  const LoadReport wall = report(testing::cylinder_wall(1, 2, 12, 5));
  EXPECT_EQ(wall.euler_number, 0);
  EXPECT_EQ(wall.border_loops, 2u);
  EXPECT_EQ(wall.border_edges, 24u);
}

TEST(BuildMesh, PolygonsAreCutWithoutFlippedTriangles) {
  EXPECT_EQ(build(unit_square, {{0, 1, 2, 3}}).mesh->triangles(),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  // An arrow head: only the fans from its tip and from its notch lie inside.
  const std::vector<Point> arrow{{0, 0, 0}, {2, -2, 0}, {1, 0, 0}, {2, 2, 0}};
  for (const std::vector<VertexId>& order : Polygons{{0, 1, 2, 3}, {1, 2, 3, 0}, {3, 0, 1, 2}}) {
    const Built built = build(arrow, {order});
    EXPECT_EQ(built.mesh->face_count(), 2u);
    EXPECT_NEAR(area_of(*built.mesh), 2.0, 1e-12);
    EXPECT_EQ(built.report.split_polygons, (std::vector<std::uint32_t>{0}));
    EXPECT_TRUE(says(built.report, "1 polygon had more than three corners"));
  }
  // A corner in the middle of a side: no triangle needs to be without area.
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_TRUE(build(points, {{0, 1, 2, 3, 4}}).report.zero_area_faces.empty());
}

TEST(BuildMesh, AHugePolygonDoesNotTakeForever) {
  // A star, so that no fan is without flipped triangles.
  std::vector<Point> points;
  std::vector<VertexId> polygon;
  constexpr int corners = 200000;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners, radius = k % 2 ? 1.0 : 2.0;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    polygon.push_back(static_cast<VertexId>(k));
  }
  const PolygonFile file = file_of(points, {polygon});
  LoadReport report;
  ASSERT_TRUE(build_mesh(file.points, file.starts, file.corners, report));
  EXPECT_EQ(report.faces, corners - 2u);
}

/// The 2D polygon as one face in a plane that is not along the axes.
double area_of(const std::vector<Point>& outline) {
  Point sum = Point::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    sum += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]);
  return 0.5 * sum.norm();
}

/// Builds one polygon and checks that its triangles cover it without overlap: none is turned over,
/// and their areas add up to its own.
Built expect_covered(const std::vector<Point>& points, const std::vector<VertexId>& polygon) {
  Eigen::Matrix3d turn;
  turn = Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized());
  std::vector<Point> turned, outline;
  for (const Point& p : points) turned.push_back(turn * p + Point(100, -50, 20));
  for (const VertexId v : polygon) outline.push_back(turned[v]);
  Point normal = Point::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    normal += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]);
  const Built built = build(turned, {polygon});
  EXPECT_TRUE(built.report.crossed_polygons.empty());
  EXPECT_NEAR(area_of(*built.mesh), area_of(outline), 1e-9 * area_of(outline));
  for (const auto& [a, b, c] : built.mesh->triangles()) {
    const Point& origin = built.mesh->point(a);
    EXPECT_GE((built.mesh->point(b) - origin).cross(built.mesh->point(c) - origin).dot(normal),
              0.0);
  }
  EXPECT_TRUE(built.report.degenerate_faces.empty());
  return built;
}

std::vector<VertexId> numbered(std::size_t count) {
  std::vector<VertexId> ids(count);
  for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<VertexId>(k);
  return ids;
}

TEST(BuildMesh, ConcavePolygonsAreCovered) {
  std::vector<Point> comb{{0, 0, 0}};
  for (int tooth = 0; tooth < 9; ++tooth) {
    const double x = 2.0 * tooth;
    if (tooth > 0) comb.push_back({x, 1, 0});
    for (const Point& p : {Point(x, 5, 0), Point(x + 1, 5, 0), Point(x + 1, 1, 0)})
      comb.push_back(p);
  }
  comb.back() = {17, 0, 0};
  std::vector<Point> spiral, back;
  for (int k = 0; k <= 120; ++k) {
    const double angle = 0.15 * k;
    spiral.push_back({(1 + 0.3 * angle) * std::cos(angle), (1 + 0.3 * angle) * std::sin(angle), 0});
    back.push_back(
        {(1.8 + 0.3 * angle) * std::cos(angle), (1.8 + 0.3 * angle) * std::sin(angle), 0});
  }
  spiral.insert(spiral.end(), back.rbegin(), back.rend());
  // A letter U, a cross, a staircase with corners in the middle of its sides.
  const std::vector<Point> u{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0},
                             {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  std::vector<Point> stairs{{0, 0, 0}, {5, 0, 0}, {10, 0, 0}};
  for (int step = 1; step <= 10; ++step) {
    stairs.push_back({11.0 - step, step - 0.5, 0});
    stairs.push_back({11.0 - step, double(step), 0});
    if (step < 10) stairs.push_back({10.0 - step, double(step), 0});
  }
  stairs.push_back({0, 10, 0});
  for (std::vector<Point> outline : {comb, spiral, u, stairs}) {
    for (int turn = 0; turn < 3; ++turn) {
      const Built built = expect_covered(outline, numbered(outline.size()));
      EXPECT_EQ(built.mesh->face_count(), outline.size() - 2);
      EXPECT_TRUE(built.report.zero_area_faces.empty());
      EXPECT_EQ(built.report.border_edges, outline.size());
      std::rotate(outline.begin(),
                  outline.begin() + static_cast<std::ptrdiff_t>(outline.size() / 3), outline.end());
    }
    std::reverse(outline.begin(), outline.end());
    expect_covered(outline, numbered(outline.size()));
  }
}

TEST(BuildMesh, RandomStarsAreCovered) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  for (int round = 0; round < 200; ++round) {
    const int n = 5 + static_cast<int>(random() % 60);
    std::vector<Point> points;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n, r = radius(random);
      points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    EXPECT_EQ(expect_covered(points, numbered(points.size())).mesh->face_count(),
              points.size() - 2);
  }
}

TEST(BuildMesh, KeyHolePolygonsKeepTheirHoles) {
  // A square with one hole, and with two, whose bridges are walked there and back.
  const std::vector<Point> points{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {2, 2, 0}, {2, 4, 0},
                                  {4, 4, 0}, {4, 2, 0}, {6, 6, 0}, {6, 7, 0}, {7, 7, 0}, {7, 6, 0}};
  const Built one = expect_covered(points, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
  EXPECT_EQ(one.report.border_loops, 2u);
  EXPECT_EQ(one.report.euler_number, 0);
  EXPECT_NEAR(area_of(*one.mesh), 81 - 4, 1e-9);
  const Built two = expect_covered(points, {0, 1, 2, 10, 11, 8, 9, 10, 2, 3, 0, 4, 5, 6, 7, 4});
  EXPECT_EQ(two.report.border_loops, 3u);
  EXPECT_EQ(two.report.euler_number, -1);
  EXPECT_NEAR(area_of(*two.mesh), 81 - 4 - 1, 1e-9);
}

TEST(BuildMesh, AnOutlineThatRunsStraightBackIsCutOffThere) {
  std::vector<Point> points = unit_square;
  points.push_back({3, 3, 0});
  const Built built = expect_covered(points, {0, 1, 2, 4, 2, 3});
  EXPECT_EQ(built.mesh->face_count(), 2u);
  EXPECT_EQ(built.report.isolated_vertices, (std::vector<std::uint32_t>{4}));
}

TEST(BuildMesh, CrossedOutlinesAreTold) {
  const Built built =
      build({{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {4, 3, 0}, {2, -2, 0}}, {{0, 1, 2, 3, 4}});
  EXPECT_EQ(built.report.crossed_polygons, (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(says(built.report, "1 polygon has an outline that crosses itself"));
}

TEST(BuildMesh, CornersNamedTwiceInARowCountOnce) {
  // Quads that name a corner again, and one that names its first corner at the end.
  const Built built = build(unit_square, {{0, 0, 1, 2}, {0, 2, 3, 3, 0}});
  EXPECT_EQ(built.mesh->triangles(), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(built.report.repeated_corners, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(built.report.degenerate_faces.empty());
  EXPECT_TRUE(built.report.split_polygons.empty());
  EXPECT_EQ(built.report.sentences(),
            (std::vector<std::string>{
                "2 faces name a corner twice in a row; it counts once (first: 0)."}));
}

// ---- bodies that touch

testing::Triangles together(const std::vector<testing::Triangles>& parts) {
  testing::Triangles sum;
  for (const testing::Triangles& part : parts) {
    const VertexId first = static_cast<VertexId>(sum.points.size());
    sum.points.insert(sum.points.end(), part.points.begin(), part.points.end());
    for (const auto& [a, b, c] : part.triangles)
      sum.triangles.push_back({first + a, first + b, first + c});
  }
  return sum;
}

testing::Triangles block_at(const Point& corner, int divisions = 2) {
  testing::Triangles block = testing::divided_cube(2.0, divisions);
  Point low = block.points[0];
  for (const Point& p : block.points) low = low.cwiseMin(p);
  for (Point& p : block.points) p += corner - low;
  return block;
}

/// Loaded with vertices on one place joined.
ScanPtr joined(const testing::Triangles& mesh, const ScanOptions& options = {}) {
  Result<ScanPtr> scan =
      make_scan(file_of(mesh.points, polygons_of(mesh.triangles)), "test", {}, options);
  if (!scan) throw std::runtime_error(scan.error().message);
  return *scan;
}

void turn_over(testing::Triangles& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

TEST(TouchingBodies, AlongAnEdgeStayTwoClosedBodies) {
  for (const int turned : {0, 1, 2, 3}) {
    testing::Triangles a = block_at({0, 0, 0}), b = block_at({2, 2, 0});
    if (turned & 1) turn_over(a);
    if (turned & 2) turn_over(b);
    const LoadReport report = joined(together({a, b}))->report;
    EXPECT_EQ(report.joined.coincident, 3u);
    EXPECT_EQ(report.non_manifold_edges.size(), 2u);
    EXPECT_EQ(report.paired_edges, report.non_manifold_edges);
    EXPECT_EQ(report.border_edges, 0u);
    EXPECT_EQ(report.components, 2u);
    EXPECT_EQ(report.euler_number, 4);
    EXPECT_TRUE(says(report, "2 edges had more than two faces, where bodies touch"));
  }
}

TEST(TouchingBodies, FourAlongOneEdgeAndAtACorner) {
  const LoadReport two = joined(together({block_at({0, 0, 0}), block_at({2, 2, 2})}))->report;
  EXPECT_EQ(two.border_edges, 0u);
  EXPECT_EQ(two.components, 2u);
  // Wedges round the z axis, every second of six sectors.
  testing::Triangles wedges;
  for (int k = 0; k < 3; ++k) {
    const double a = 2 * std::numbers::pi * k / 3, b = a + std::numbers::pi / 3;
    const Point p(std::cos(a), std::sin(a), 0), q(std::cos(b), std::sin(b), 0), up(0, 0, 1);
    const testing::Triangles wedge{
        {Point(0, 0, 0), p, q, up, p + up, q + up},
        {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
    wedges = together({wedges, wedge});
  }
  const LoadReport report = joined(wedges)->report;
  EXPECT_EQ(report.paired_edges.size(), 1u);
  EXPECT_EQ(report.border_edges, 0u);
  EXPECT_EQ(report.components, 3u);
  EXPECT_EQ(report.euler_number, 6);
}

/// Unit cubes; the sides between two of them are left out. Every side has vertices of its own.
testing::Triangles cubes_at(const std::set<std::array<int, 3>>& cells) {
  testing::Triangles body;
  const auto quad = [&](const Point& a, const Point& b, const Point& c, const Point& d) {
    const VertexId v = static_cast<VertexId>(body.points.size());
    body.points.insert(body.points.end(), {a, b, c, d});
    body.triangles.push_back({v, v + 1, v + 2});
    body.triangles.push_back({v, v + 2, v + 3});
  };
  for (const auto& [i, j, k] : cells) {
    const Point o(i, j, k), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    if (!cells.contains({i + 1, j, k})) quad(o + x, o + x + y, o + x + y + z, o + x + z);
    if (!cells.contains({i - 1, j, k})) quad(o + y, o, o + z, o + y + z);
    if (!cells.contains({i, j + 1, k})) quad(o + x + y, o + y, o + y + z, o + x + y + z);
    if (!cells.contains({i, j - 1, k})) quad(o, o + x, o + x + z, o + z);
    if (!cells.contains({i, j, k + 1})) quad(o + z, o + x + z, o + x + y + z, o + y + z);
    if (!cells.contains({i, j, k - 1})) quad(o + y, o + x + y, o + x, o);
  }
  return body;
}

/// Cubes that make one body without a border, with so many edges of four faces, all of them paired.
void expect_one_closed_body(const std::set<std::array<int, 3>>& cells, std::size_t paired) {
  const LoadReport report = joined(cubes_at(cells))->report;
  EXPECT_EQ(report.non_manifold_edges.size(), paired);
  EXPECT_EQ(report.paired_edges.size(), paired);
  EXPECT_EQ(report.border_edges, 0u);
  EXPECT_EQ(report.components, 1u);
}

TEST(TouchingBodies, OneBodyThatTouchesItselfAlongARowOfEdgesStaysClosed) {
  // A ring whose ends meet along an edge: the pairs are told by the wedges they enclose.
  std::set<std::array<int, 3>> cells;
  for (int k = 0; k < 3; ++k)
    for (const auto& [i, j] :
         std::vector<std::array<int, 2>>{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 1}})
      cells.insert({i, j, k});
  expect_one_closed_body(cells, 3);
}

TEST(TouchingBodies, AnEdgeBetweenTwoSlabsIsPairedTheOtherWay) {
  // Two cubes that meet along an edge, between two slabs: paired by the cubes, the faces round
  // either end of the edge would be one fan, and both pairs would share both of their vertices.
  std::set<std::array<int, 3>> cells{{0, 0, 0}, {1, 1, 0}};
  for (const int k : {-1, 1})
    for (const int i : {0, 1})
      for (const int j : {0, 1}) cells.insert({i, j, k});
  expect_one_closed_body(cells, 1);
}

TEST(TouchingBodies, AnyHeapOfCubesCanBeHeld) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    std::set<std::array<int, 3>> cells;
    for (int k = 0; k < 12; ++k)
      cells.insert({int(random() % 3), int(random() % 3), int(random() % 3)});
    const testing::Triangles body = cubes_at(cells);
    const LoadReport report = joined(body)->report;
    EXPECT_EQ(report.faces, body.triangles.size());
    EXPECT_TRUE(report.turned_faces.empty());
    EXPECT_FALSE(report.looks_inside_out);
  }
}

TEST(TouchingBodies, BlocksOneOnTheOtherStayClosed) {
  for (const Point& shift : {Point(0, 0, 2), Point(2, 0, 0), Point(1, 0, 2), Point(1, 1, 2)}) {
    const LoadReport report = joined(together({block_at({0, 0, 0}), block_at(shift)}))->report;
    EXPECT_EQ(report.border_edges, 0u);
    EXPECT_EQ(report.components, 2u);
    EXPECT_EQ(report.euler_number, 4);
    EXPECT_FALSE(report.looks_inside_out);
  }
  // The same of squares.
  std::vector<Point> points;
  for (int k = 0; k < 12; ++k) points.push_back({double(k % 2), double(k / 2 % 2), double(k / 4)});
  const auto box = [](VertexId v) {
    return Polygons{{v, v + 2, v + 3, v + 1},     {v + 4, v + 5, v + 7, v + 6},
                    {v, v + 1, v + 5, v + 4},     {v + 1, v + 3, v + 7, v + 5},
                    {v + 3, v + 2, v + 6, v + 7}, {v + 2, v, v + 4, v + 6}};
  };
  Polygons boxes = box(0);
  for (const std::vector<VertexId>& side : box(4)) boxes.push_back(side);
  const Built built = build(points, boxes);
  EXPECT_EQ(built.report.border_edges, 0u);
  EXPECT_EQ(built.report.components, 2u);
  EXPECT_TRUE(built.report.duplicate_faces.empty());
}

TEST(TouchingBodies, TheBackOfASheetOrOfASkinIsOneFaceTooMany) {
  // A sheet with both sides, and a closed skin with another inside it.
  const Built sheet = build(unit_square, {{0, 1, 2, 3}, {3, 2, 1, 0}});
  EXPECT_EQ(sheet.report.duplicate_faces, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(sheet.mesh->face_count(), 2u);
  testing::Triangles skin = testing::icosphere(1.0, 1), inner = skin;
  turn_over(inner);
  const LoadReport report = joined(together({skin, inner}))->report;
  EXPECT_EQ(report.duplicate_faces.size(), skin.triangles.size());
  EXPECT_EQ(report.faces, skin.triangles.size());
  EXPECT_EQ(report.components, 1u);
}

TEST(TouchingBodies, SheetsThatCrossAreCutAsBefore) {
  const std::vector<Point> points{{0, 0, 0},  {0, 0, 1}, {1, 0, 0},
                                  {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const Built built = build(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}});
  EXPECT_TRUE(built.report.paired_edges.empty());
  EXPECT_EQ(built.report.components, 4u);
  EXPECT_TRUE(says(built.report, "1 edge had more than two faces and was cut open"));
}

// ---- vertices on one place

/// Every face with vertices of its own, moved by up to `step` along each axis.
testing::Triangles soup_of(const testing::Triangles& mesh, double step, std::uint32_t seed) {
  std::mt19937 random(seed);
  testing::Triangles soup;
  for (const Triangle& t : mesh.triangles) {
    const VertexId v = static_cast<VertexId>(soup.points.size());
    for (const VertexId corner : t) {
      Point p = mesh.points[corner];
      for (double& x : p) x += step * (static_cast<double>(random() % 3) - 1.0);
      soup.points.push_back(p);
    }
    soup.triangles.push_back({v, v + 1, v + 2});
  }
  return soup;
}

TEST(CoincidentVertices, AreJoinedAndTold) {
  const testing::Triangles sphere = testing::icosphere(1.0, 2);
  const testing::Triangles soup = soup_of(sphere, 0.0, 1);
  const ScanPtr scan = joined(soup);
  const LoadReport& report = scan->report;
  EXPECT_EQ(report.file_vertices, soup.points.size());
  EXPECT_EQ(report.joined.coincident, soup.points.size() - sphere.points.size());
  EXPECT_EQ(report.vertices, sphere.points.size());
  EXPECT_EQ(report.border_edges, 0u);
  EXPECT_EQ(report.euler_number, 2);
  EXPECT_EQ(report.sentences(), (std::vector<std::string>{
                                    "The 960 vertices of the file lie on 162 places; 798 were "
                                    "joined with an earlier one that has the same coordinates."}));
  ASSERT_NE(scan->file, nullptr);
  EXPECT_EQ(scan->file->points.size(), soup.points.size()) << "the file stays as it was";
}

TEST(CoincidentVertices, OfNoFaceStayAsTheyAre) {
  testing::Triangles cube = testing::cube();
  cube.points.insert(cube.points.begin(), {Point(9, 9, 9), cube.points[0], Point(9, 9, 9)});
  for (Triangle& t : cube.triangles)
    for (VertexId& v : t) v += 3;
  const LoadReport report = joined(cube)->report;
  EXPECT_EQ(report.isolated_vertices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(report.joined.coincident, 0u);
  EXPECT_EQ(report.border_edges, 0u);
}

TEST(CoincidentVertices, StayApartWhereThatIsWished) {
  const testing::Triangles cube = testing::cube();
  const LoadReport report = joined(soup_of(cube, 0.0, 1), {.weld = false})->report;
  EXPECT_EQ(report.components, 12u);
  EXPECT_EQ(report.vertices, 36u);
  EXPECT_EQ(report.joined.coincident_edges, 18u);
  EXPECT_TRUE(says(report,
                   "The 36 vertices of the file lie on 8 places and were kept apart as "
                   "wished, which cuts the surface along 18 edges."));
  const LoadReport nothing = joined(testing::icosphere(1.0, 1), {.weld = false})->report;
  EXPECT_TRUE(nothing.clean());
}

TEST(CoincidentVertices, WhoseLastDigitsDifferAreJoinedWhereThatClosesTheSurface) {
  testing::Triangles sphere = testing::icosphere(10.0, 3);
  for (Point& p : sphere.points)
    for (double& x : p) x = std::round(x * 1e4) / 1e4;  // as written with four decimals
  testing::Triangles soup = soup_of(sphere, 1e-4, 3);
  for (Point& p : soup.points)
    for (double& x : p) x = std::round(x * 1e4) / 1e4;
  const LoadReport report = joined(soup)->report;
  EXPECT_EQ(report.border_edges, 0u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.vertices, sphere.points.size());
  EXPECT_GT(report.joined.near, 0u);
  EXPECT_LT(report.joined.tolerance, 1e-3);
  EXPECT_TRUE(says(report, "of another, which the last digits of the file hardly tell apart"));

  // 32-bit coordinates worked out twice.
  soup = testing::icosphere(10.0, 3);
  std::mt19937 random(9);
  soup = soup_of(soup, 0.0, 1);
  for (Point& p : soup.points)
    for (double& x : p) {
      float f = static_cast<float>(x);
      if (random() % 2) f = std::nextafter(f, 100.0f);
      x = f;
    }
  EXPECT_EQ(joined(soup)->report.border_edges, 0u);
}

TEST(CoincidentVertices, OfASlitThatIsWiderThanTheDigitsStayApart) {
  // A sheet cut in two along x = 0, a hundred steps of the last digit apart.
  testing::Triangles left = testing::noisy_plane(2.0, 0.25, 0.0, 0.0, 1), right = left;
  for (Point& p : left.points) p.x() -= 2.0 + 1e-4;
  testing::Triangles both = together({left, right});
  for (Point& p : both.points)
    for (double& x : p) x = std::round(x * 1e6) / 1e6;
  const LoadReport report = joined(both)->report;
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.joined.near, 0u);
}

// ---- far from the origin

TEST(FarFromTheOrigin, TheStepOfThirtyTwoBitsIsTold) {
  const auto moved_by = [](double x, bool floats) {
    testing::Triangles part = testing::divided_cube(10.0, 20);
    for (Point& p : part.points) {
      p.x() += x;
      p = p * 1.1;
      for (double& coordinate : p) {
        // GCC 12 with -O2 drops a rounding to float and back that goes through no memory.
        const volatile float rounded = static_cast<float>(coordinate);
        if (floats) coordinate = rounded;
      }
    }
    return joined(part)->report;
  };
  EXPECT_TRUE(moved_by(0.0, true).clean());
  EXPECT_TRUE(moved_by(20.0, true).clean());
  EXPECT_TRUE(moved_by(1e5, false).clean()) << "64-bit numbers have digits to spare";
  const LoadReport far = moved_by(1e5, true);
  EXPECT_DOUBLE_EQ(far.coordinate_step, std::ldexp(1.0, -7));
  EXPECT_TRUE(says(far,
                   "times its size from the origin, where its file tells coordinates apart "
                   "only in steps of 0.0078"));
}

TEST(BuildMesh, FacesWithoutThreeVerticesCoverNothing) {
  const Built built = build(unit_square, {{0, 1, 1}, {}, {2}, {0, 1}, {0, 1, 2}, {0, 2, 3, 3}});
  EXPECT_EQ(built.report.degenerate_faces, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(built.mesh->triangles(), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(built.source_faces, (std::vector<std::uint32_t>{4, 5}));
  EXPECT_FALSE(built.report.clean());
  EXPECT_TRUE(says(built.report, "4 faces have fewer than three different corners"));
}

TEST(BuildMesh, FacesWithoutAreaAreKeptAndTold) {
  std::vector<Point> points = unit_square;
  points.push_back({0.5, 0, 0});
  const Built built = build(points, {{4, 1, 2}, {4, 2, 3}, {4, 3, 0}, {0, 1, 4}});
  EXPECT_EQ(built.mesh->face_count(), 4u);
  EXPECT_EQ(built.report.zero_area_faces, (std::vector<std::uint32_t>{3}));
  EXPECT_TRUE(says(built.report, "1 face has no area"));
}

TEST(BuildMesh, DuplicateFacesAreLeftOut) {
  const Built built = build(unit_square, {{0, 1, 2}, {1, 2, 0}, {0, 2, 3}, {3, 2, 0}, {0, 2, 1}});
  EXPECT_EQ(built.report.duplicate_faces, (std::vector<std::uint32_t>{1, 3, 4}));
  EXPECT_EQ(built.mesh->triangles(), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(built.report.non_manifold_edges.empty());
  // Squares that would be cut along different diagonals are the same face too.
  const Built squares = build(unit_square, {{0, 1, 2, 3}, {1, 2, 3, 0}, {3, 2, 1, 0}});
  EXPECT_EQ(squares.report.duplicate_faces, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(squares.mesh->face_count(), 2u);
}

TEST(BuildMesh, NonFinitePointsKeepTheirIdsAndLoseTheirFaces) {
  testing::Triangles t = testing::icosphere(1.0, 1);
  t.points[5].y() = std::numeric_limits<double>::quiet_NaN();
  const Built built = build(t.points, polygons_of(t.triangles));
  EXPECT_EQ(built.report.non_finite_vertices, (std::vector<std::uint32_t>{5}));
  EXPECT_EQ(built.report.isolated_vertices, (std::vector<std::uint32_t>{5}));
  for (std::uint32_t f = 0; f < t.triangles.size(); ++f) {
    const bool uses = std::count(t.triangles[f].begin(), t.triangles[f].end(), 5u) > 0;
    EXPECT_EQ(std::count(built.report.non_finite_faces.begin(), built.report.non_finite_faces.end(),
                         f) > 0,
              uses);
  }
  EXPECT_EQ(built.report.border_loops, 1u) << "where the faces were";
  EXPECT_TRUE(built.mesh->box_max().allFinite());
  EXPECT_TRUE(says(built.report, "1 vertex has a coordinate that is not a finite number (5)"));
}

TEST(BuildMesh, IsolatedVerticesAreKept) {
  const Built built = build(unit_square, {{0, 1, 3}});
  EXPECT_EQ(built.report.isolated_vertices, (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(built.mesh->vertex_count(), 4u);
  EXPECT_EQ(built.report.euler_number, 1);
  EXPECT_TRUE(says(built.report, "1 vertex belongs to no face"));
}

TEST(BuildMesh, ThreeFansOnOneEdgeAreCutOpen) {
  const std::vector<Point> points{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const Built built = build(points, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  EXPECT_EQ(built.report.non_manifold_edges, (std::vector<EdgeVertices>{{0, 1}}));
  EXPECT_EQ(built.report.components, 3u);
  EXPECT_EQ(built.mesh->triangle(0), (Triangle{0, 1, 2})) << "the first keeps the vertices";
  EXPECT_EQ(built.report.non_manifold_vertices, (std::vector<VertexId>{0, 1}));
  EXPECT_EQ(built.report.copies, (std::vector<VertexId>{0, 1, 1, 0}));
  EXPECT_TRUE(says(built.report, "1 edge had more than two faces and was cut open (0-1)."));
}

TEST(BuildMesh, AFinOnASheetIsCutOffAndTheSheetStaysWhole) {
  testing::Triangles t = testing::noisy_plane(1.0, 0.25, 0.0, 0.0, 1);
  const MeshPtr kept = testing::mesh_of(t);
  const Mesh& sheet = *kept;
  EdgeId inner = 0;
  while (sheet.is_border(sheet.edge(inner)[0]) || sheet.is_border(sheet.edge(inner)[1])) ++inner;
  const auto [a, b] = sheet.edge(inner);
  const VertexId tip = static_cast<VertexId>(t.points.size());
  Polygons polygons = polygons_of(t.triangles);
  polygons.push_back({a, b, tip});
  t.points.push_back(t.points[a] + Point(0, 0, 1));
  const Built built = build(t.points, polygons);
  EXPECT_EQ(built.report.non_manifold_edges, (std::vector<EdgeVertices>{{a, b}}));
  EXPECT_EQ(built.report.components, 2u);
  EXPECT_EQ(built.report.border_edges, sheet.border_edge_count() + 3);
  EXPECT_TRUE(std::equal(t.triangles.begin(), t.triangles.end(), built.mesh->triangles().begin()));
}

TEST(BuildMesh, ABowTieIsSplit) {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  const Built built = build(points, {{1, 2, 0}, {3, 4, 0}});
  EXPECT_EQ(built.report.non_manifold_vertices, (std::vector<VertexId>{0}));
  EXPECT_EQ(built.report.copies, (std::vector<VertexId>{0}));
  EXPECT_EQ(built.mesh->triangles(), (std::vector<Triangle>{{1, 2, 0}, {3, 4, 5}}));
  EXPECT_TRUE(built.report.non_manifold_edges.empty());
  EXPECT_TRUE(says(built.report,
                   "1 vertex joined more than one fan of faces and was split (0); "
                   "1 copy was added"));
}

TEST(BuildMesh, FlippedFacesAreTurnedToTheMajority) {
  const testing::Triangles sphere = testing::icosphere(1.0, 2);
  std::vector<Triangle> triangles = sphere.triangles;
  // The first face is among them: the seed of the walk has no say.
  const std::vector<std::uint32_t> flipped{0, 17, 18, 200};
  for (const std::uint32_t f : flipped) std::swap(triangles[f][1], triangles[f][2]);
  const Built built = build(sphere.points, polygons_of(triangles));
  EXPECT_EQ(built.report.turned_faces, flipped);
  EXPECT_EQ(built.report.border_edges, 0u);
  EXPECT_FALSE(built.report.looks_inside_out);
  EXPECT_EQ(built.mesh->triangles(), sphere.triangles);
  EXPECT_TRUE(
      says(built.report, "4 faces ran against their neighbours and were turned round (first: 0)"));
}

TEST(BuildMesh, AMoebiusStripIsCutOnce) {
  for (const int steps : {5, 12, 13}) {
    for (const int rows : {1, 3}) {
      std::vector<Point> points;
      Polygons polygons;
      const auto id = [&](int step, int row) {
        if (step == steps) {
          step = 0;
          row = rows - row;
        }
        return static_cast<VertexId>(step * (rows + 1) + row);
      };
      for (int step = 0; step < steps; ++step)
        for (int row = 0; row <= rows; ++row) {
          const double u = 2 * std::numbers::pi * step / steps, w = double(row) / rows - 0.5;
          const double r = 2 + w * std::cos(u / 2);
          points.push_back({r * std::cos(u), r * std::sin(u), w * std::sin(u / 2)});
        }
      for (int step = 0; step < steps; ++step)
        for (int row = 0; row < rows; ++row) {
          polygons.push_back({id(step, row), id(step + 1, row), id(step + 1, row + 1)});
          polygons.push_back({id(step, row), id(step + 1, row + 1), id(step, row + 1)});
        }
      const Built built = build(points, polygons);
      EXPECT_EQ(built.mesh->face_count(), polygons.size());
      EXPECT_FALSE(built.report.unorientable_edges.empty());
      EXPECT_TRUE(built.report.non_manifold_edges.empty());
      EXPECT_EQ(built.report.components, 1u);
      EXPECT_EQ(built.report.euler_number, 1) << "cut open it is a disc";
      EXPECT_EQ(built.report.border_loops, 1u);
      EXPECT_TRUE(says(built.report, "cannot be oriented"));
    }
  }
}

TEST(BuildMesh, InsideOutIsToldAndNotMended) {
  testing::Triangles t = testing::cube();
  for (Triangle& triangle : t.triangles) std::swap(triangle[1], triangle[2]);
  const Built built = build(t.points, polygons_of(t.triangles));
  EXPECT_TRUE(built.report.looks_inside_out);
  EXPECT_EQ(built.mesh->triangles(), t.triangles);
  EXPECT_TRUE(built.report.turned_faces.empty());
  EXPECT_TRUE(says(built.report, "inside out"));

  // A hollow in a larger body faces inwards and is right to do so.
  testing::Triangles body = testing::divided_cube(4.0, 2);
  const VertexId offset = static_cast<VertexId>(body.points.size());
  for (const Point& p : t.points) body.points.push_back(p + Point(1, 1, 1));
  for (const Triangle& f : t.triangles)
    body.triangles.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  EXPECT_TRUE(build(body.points, polygons_of(body.triangles)).report.clean());

  // An open surface has no inside.
  t.triangles.pop_back();
  EXPECT_FALSE(build(t.points, polygons_of(t.triangles)).report.looks_inside_out);
}

TEST(BuildMesh, NoFaceLeftIsAnError) {
  LoadReport report;
  report.file = "part.off";
  const PolygonFile file = file_of(unit_square, {{0, 1, 1}, {2, 2}});
  const Result<BuiltMesh> built = build_mesh(file.points, file.starts, file.corners, report);
  ASSERT_FALSE(built);
  EXPECT_TRUE(built.error().message.starts_with("part.off has no face that can be used"));
  EXPECT_FALSE(build_mesh({}, {}, {}, report));
}

TEST(BuildMesh, StopsWhenAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  LoadReport report;
  const PolygonFile file = file_of(unit_square, {{0, 1, 2}});
  const Result<BuiltMesh> built =
      build_mesh(file.points, file.starts, file.corners, report, Context({}, stop.get_token()));
  ASSERT_FALSE(built);
  EXPECT_TRUE(built.error().cancelled);
}

/// Whatever the faces, a mesh comes out that has each distinct triangle once.
TEST(BuildMesh, AnySoupOfTrianglesCanBeHeld) {
  std::mt19937 random(7);
  for (int round = 0; round < 4000; ++round) {
    const std::uint32_t vertices = 3 + random() % 10, faces = 1 + random() % 40;
    std::vector<Point> points;
    for (std::uint32_t v = 0; v < vertices; ++v)
      points.push_back({double(random() % 8), double(random() % 8), double(random() % 8)});
    Polygons polygons;
    std::set<std::set<VertexId>> distinct;
    for (std::uint32_t f = 0; f < faces; ++f) {
      polygons.push_back({static_cast<VertexId>(random() % vertices),
                          static_cast<VertexId>(random() % vertices),
                          static_cast<VertexId>(random() % vertices)});
      const std::set<VertexId> corners(polygons.back().begin(), polygons.back().end());
      if (corners.size() == 3) distinct.insert(corners);
    }
    if (distinct.empty()) continue;
    const Built built = build(points, polygons);
    std::set<std::set<VertexId>> found;
    for (const Triangle& t : built.mesh->triangles())
      found.insert({built.original(t[0]), built.original(t[1]), built.original(t[2])});
    ASSERT_EQ(found, distinct) << "round " << round;
    ASSERT_EQ(built.mesh->face_count(), distinct.size());
    if (::testing::Test::HasFailure()) return;
  }
}

/// A clean surface glued together at random vertices: only what is wrong is touched.
TEST(BuildMesh, GluedSurfacesComeApartAgain) {
  std::mt19937 random(11);
  const testing::Triangles t = testing::icosphere(1.0, 2);
  for (int round = 0; round < 200; ++round) {
    std::vector<Triangle> triangles = t.triangles;
    for (int pair = 0; pair < 3; ++pair) {
      const VertexId a = random() % t.points.size(), b = random() % t.points.size();
      for (Triangle& f : triangles) std::replace(f.begin(), f.end(), a, b);
    }
    const Built built = build(t.points, polygons_of(triangles));
    EXPECT_EQ(built.mesh->face_count() + built.report.degenerate_faces.size() +
                  built.report.duplicate_faces.size(),
              triangles.size());
    EXPECT_TRUE(built.report.turned_faces.empty() || !built.report.non_manifold_edges.empty());
  }
}

TEST(LoadReport, TellsTheWorstFirstWithNumbersOneCanRead) {
  LoadReport report;
  EXPECT_TRUE(report.clean());
  for (std::uint32_t k = 0; k < 1234567; ++k) report.isolated_vertices.push_back(k);
  for (VertexId k = 0; k < 24; ++k) report.non_manifold_edges.push_back({123 + k, 456 + k});
  report.turned_faces = {9};
  report.left_out_faces = {7, 8};
  EXPECT_FALSE(report.clean());
  EXPECT_EQ(report.sentences(),
            (std::vector<std::string>{
                "2 faces could not be held by the mesh and were left out (first: 7).",
                "24 edges had more than two faces and were cut open (first: 123-456).",
                "1 face ran against its neighbours and was turned round (9).",
                "1,234,567 vertices belong to no face; they were kept and have no quantities "
                "(first: 0)."}));
}

TEST(LoadReport, JsonHasEveryCountAndTheBeginningOfEveryList) {
  LoadReport report;
  report.file = "na\xFFme.stl";  // not UTF-8
  report.euler_number = -493;
  report.looks_inside_out = true;
  report.non_manifold_edges = {{1, 2}};
  for (std::uint32_t k = 0; k < 5000; ++k) report.duplicate_faces.push_back(k);
  const nlohmann::json json = report.to_json();
  EXPECT_FALSE(json.dump().empty());
  EXPECT_EQ(json["euler_number"], -493);
  EXPECT_EQ(json["looks_inside_out"], true);
  EXPECT_EQ(json["duplicate_faces"]["count"], 5000);
  EXPECT_EQ(json["duplicate_faces"]["first"].size(), 1000u);
  EXPECT_EQ(json["non_manifold_edges"]["first"][0], (nlohmann::json{1, 2}));
  EXPECT_EQ(json["copies"]["count"], 0);
}

TEST(Scan, KeepsTheFileOnlyWhereTheMeshDiffers) {
  const auto keeps = [](const std::vector<Point>& points, const Polygons& polygons) {
    const Result<ScanPtr> scan = make_scan(file_of(points, polygons), "test");
    return (*scan)->file != nullptr;
  };
  EXPECT_FALSE(keeps(unit_square, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_FALSE(keeps(unit_square, {{0, 1, 2}})) << "an isolated vertex is in both";
  EXPECT_TRUE(keeps(unit_square, {{0, 1, 2, 3}}));
  EXPECT_TRUE(keeps(unit_square, {{0, 1, 2}, {0, 1, 2}}));
  EXPECT_TRUE(keeps(unit_square, {{0, 1, 2}, {0, 3, 2}})) << "a face was turned";
  const std::vector<Point> two_by_two{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  EXPECT_TRUE(keeps(two_by_two, {{1, 2, 0}, {3, 4, 0}}));
}

TEST(Scan, TheReportNamesTheFile) {
  PolygonFile file = file_of(unit_square, {{0, 1, 2}, {0, 2, 3}});
  file.format = "PLY";
  file.content_hash = "abc";
  file.bytes = 123;
  const Result<ScanPtr> scan = make_scan(std::move(file), "part.ply");
  ASSERT_TRUE(scan);
  EXPECT_EQ((*scan)->report.file, "part.ply");
  EXPECT_EQ((*scan)->report.format, "PLY");
  EXPECT_EQ((*scan)->report.content_hash, "abc");
  EXPECT_EQ((*scan)->report.file_bytes, 123u);
  EXPECT_EQ((*scan)->source_faces, (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace arris
