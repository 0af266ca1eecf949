#include "core/simplification/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stop_token>

#include "core/base/random.h"
#include "core/base/thread_limit.h"
#include "core/edge_swapping/equilateralize.h"
#include "core/edge_swapping/swap_edges.h"
#include "core/mesh/scan.h"
#include "core/samples/mould.h"
#include "core/simplification/noise.h"
#include "core/simplification/working_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/nearest.h"

namespace arris {
namespace {

using namespace arris::testing;

const ChunkedArray<Origin> no_edges;

MeshPtr mould_mesh(double noise = 0.05) {
  const SampleMould mould = make_mould({.edge_length = 1.5, .noise = noise});
  return *Mesh::create(mould.points, mould.triangles);
}

MeshPtr with_noise(const Triangles& mesh, double sigma, std::uint64_t seed) {
  Random random(seed);
  Triangles noisy = mesh;
  const MeshPtr clean = mesh_of(mesh);
  for (VertexId v = 0; v < noisy.points.size(); ++v) {
    Point normal = Point::Zero();
    clean->for_ring(v, [&](HalfEdgeId h) {
      if (clean->face(h) == no_id) return;
      const Triangle& t = clean->triangle(clean->face(h));
      normal +=
          (clean->point(t[1]) - clean->point(t[0])).cross(clean->point(t[2]) - clean->point(t[0]));
    });
    noisy.points[v] += sigma * random.gaussian() * normal.normalized();
  }
  return mesh_of(noisy);
}

Prepared must(const Result<Prepared>& result) {
  if (!result) throw std::logic_error(result.error().message);
  return *result;
}

Prepared simplified(const Mesh& mesh, double error_zone, StarCost cost = StarCost::flat) {
  SimplifyOptions options;
  options.error_zone = error_zone;
  options.cost = cost;
  return must(simplify(mesh, nullptr, no_edges, options));
}

struct Topology {
  std::int64_t euler_number = 0;
  std::size_t components = 0, border_loops = 0;
  bool operator==(const Topology&) const = default;
};

Topology topology_of(const Mesh& mesh) {
  Topology result;
  std::vector<char> seen_vertex(mesh.vertex_count(), 0);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(v)) continue;
    ++result.euler_number;
    if (seen_vertex[v]) continue;
    ++result.components;
    seen_vertex[v] = 1;
    std::vector<VertexId> front{v};
    while (!front.empty()) {
      const VertexId w = front.back();
      front.pop_back();
      mesh.for_ring(w, [&](HalfEdgeId h) {
        if (seen_vertex[mesh.to(h)]) return;
        seen_vertex[mesh.to(h)] = 1;
        front.push_back(mesh.to(h));
      });
    }
  }
  result.euler_number +=
      static_cast<std::int64_t>(mesh.face_count()) - static_cast<std::int64_t>(mesh.edge_count());
  std::vector<char> seen(2 * mesh.edge_count(), 0);
  for (HalfEdgeId h = 0; h < seen.size(); ++h) {
    if (mesh.face(h) != no_id || seen[h]) continue;
    ++result.border_loops;
    for (HalfEdgeId g = h; !seen[g]; g = mesh.next(g)) seen[g] = 1;
  }
  return result;
}

double largest_angle_between_faces(const Mesh& mesh) {
  double largest = 0.0;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.is_border_edge(e)) continue;
    const auto normal = [&](FaceId f) {
      const Triangle& t = mesh.triangle(f);
      return Point(
          (mesh.point(t[1]) - mesh.point(t[0])).cross(mesh.point(t[2]) - mesh.point(t[0])));
    };
    const Point m = normal(mesh.edge_faces(e)[0]), n = normal(mesh.edge_faces(e)[1]);
    largest = std::max(largest, std::atan2(m.cross(n).norm(), m.dot(n)));
  }
  return largest;
}

/// Everything a preparation phase promises about its result, against the scan it began with.
void expect_sound(const Mesh& scan, const Prepared& result, const std::string& what) {
  SCOPED_TRACE(what);
  const Mesh& mesh = *result.mesh;
  ASSERT_EQ(mesh.vertex_count(), scan.vertex_count());
  for (VertexId v = 0; v < scan.vertex_count(); ++v) ASSERT_EQ(mesh.point(v), scan.point(v));

  // The envelope.
  const double rounding = 1e-12 * scan.diagonal();
  const Nearest surface = Nearest::faces(mesh), border = Nearest::border(mesh);
  std::size_t outside = 0, off_border = 0;
  for (VertexId v = 0; v < scan.vertex_count(); ++v) {
    if (scan.is_isolated(v)) continue;
    const double radius = result.zones->radius(v) + rounding;
    outside += !(surface.find(scan.point(v)).distance <= radius);
    if (scan.is_border(v)) off_border += !(border.find(scan.point(v)).distance <= radius);
  }
  EXPECT_EQ(outside, 0u);
  EXPECT_EQ(off_border, 0u);

  // Who answers: each removed vertex once, nearly as near as the surface is.
  std::vector<int> answers(mesh.vertex_count(), 0);
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    for (const VertexId v : result.zones->of_face(f)) ++answers[v];
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    for (const VertexId v : result.zones->of_border_edge(e)) ++answers[v];
  const std::vector<double> distances = zone_distances(mesh, *result.zones);
  std::size_t unanswered = 0, far = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (scan.is_isolated(v)) continue;
    unanswered += answers[v] != (mesh.is_isolated(v) ? 1 : 0);
    far += !(distances[v] <= result.zones->radius(v) + rounding);
  }
  EXPECT_EQ(unanswered, 0u);
  EXPECT_EQ(far, 0u);
  EXPECT_TRUE(result.zones->check(mesh).has_value());

  // Topology, orientation, shape of the faces.
  EXPECT_EQ(topology_of(mesh), topology_of(scan));
  EXPECT_LE(largest_angle_between_faces(mesh),
            std::max(largest_angle_between_faces(scan), 2.0 * std::numbers::pi / 3.0) + 1e-9);
  std::set<Triangle> before, faces;
  const auto sorted = [](Triangle t) {
    std::ranges::sort(t);
    return t;
  };
  for (const Triangle& t : scan.triangles()) before.insert(sorted(t));
  std::size_t degenerate = 0;
  for (const Triangle& t : mesh.triangles()) {
    EXPECT_TRUE(faces.insert(sorted(t)).second) << "a face twice";
    const Point a = mesh.point(t[1]) - mesh.point(t[0]), b = mesh.point(t[2]) - mesh.point(t[0]);
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
    degenerate += !(a.cross(b).norm() > 0.99e-4 * longest) && !before.contains(sorted(t));
  }
  EXPECT_EQ(degenerate, 0u);
}

struct Case {
  std::string name;
  std::function<MeshPtr()> mesh;
  std::vector<double> radii;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Envelope : public ::testing::TestWithParam<Case> {};

TEST_P(Envelope, HoldsAfterEveryPhase) {
  const MeshPtr scan = GetParam().mesh();
  if (!scan) GTEST_SKIP() << "the shared data is not here";
  for (const double radius : GetParam().radii) {
    SCOPED_TRACE("error zone " + std::to_string(radius));
    const Prepared simple = simplified(*scan, radius);
    expect_sound(*scan, simple, "simplified");
    const Prepared smooth = must(swap_edges(*simple.mesh, simple.zones, no_edges));
    expect_sound(*scan, smooth, "simplified and swapped");
    const Prepared again = must(simplify(*smooth.mesh, smooth.zones, no_edges));
    expect_sound(*scan, again, "simplified, swapped, simplified");
    EXPECT_LE(again.vertices_after, smooth.vertices_after);
    expect_sound(*scan, must(equilateralize(*again.mesh, again.zones, no_edges)), "all");
    const Prepared swapped = must(swap_edges(
        *scan, std::make_shared<const ErrorZones>(ErrorZones::start(*scan, radius)), no_edges));
    expect_sound(*scan, swapped, "swapped alone");
    expect_sound(*scan, must(simplify(*swapped.mesh, swapped.zones, no_edges)),
                 "swapped, simplified");
  }
}

MeshPtr shared_scan(const std::string& name) {
  const std::string path = std::string(ARRIS_SOURCE_DIR) + "/../shared/data/" + name;
  if (!std::filesystem::exists(path)) return nullptr;
  const Result<ScanPtr> scan = load_scan(path);
  return scan ? (*scan)->mesh : nullptr;
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, Envelope,
    ::testing::Values(
        Case{"mould", [] { return mould_mesh(); }, {0.0, 0.02, 0.05, 0.3}},
        Case{"sphere", [] { return mesh_of(irregular_sphere(10.0, 3000, 7)); }, {0.02, 0.2, 3.0}},
        Case{"torus", [] { return mesh_of(torus(10.0, 4.0, 60, 40)); }, {0.02, 0.2, 2.0}},
        Case{"noisy_plane",
             [] { return mesh_of(noisy_plane(40.0, 0.8, 0.02, 0.3, 3)); },
             {0.01, 0.02, 0.1, 5.0}},
        Case{"terrain", [] { return mesh_of(random_terrain(40, 5)); }, {0.05, 0.5}},
        Case{"genus_3", [] { return mesh_of(block_with_holes(3)); }, {0.0, 0.1, 10.0}},
        Case{"step", [] { return mesh_of(stepped_plate(5.0, 10.0, 2.0, 0.5)); }, {0.0, 0.1}},
        Case{"noisy_mould", [] { return mould_mesh(0.2); }, {0.02, 0.3}},
        Case{"block", [] { return shared_scan("pairs/block_n1.obj"); }, {0.05}},
        Case{"pumptopcover", [] { return shared_scan("truth/pumptopcover_scan.ply"); }, {0.05}},
        Case{"broken", [] { return shared_scan("broken/raw_mesh.ply"); }, {0.01}}),
    [](const auto& tested) { return tested.param.name; });

TEST(Simplify, LosesHalfOfTheSampleMouldAtItsSensorAccuracy) {
  const SampleMould mould = make_mould();
  const MeshPtr scan = *Mesh::create(mould.points, mould.triangles);
  const Prepared result = simplified(*scan, 0.05);
  EXPECT_LE(2 * result.vertices_after, result.vertices_before);
  EXPECT_EQ(result.vertices_before, scan->vertex_count());
}

TEST(Simplify, LeavesThePlainFacesOfACubeBare) {
  // Inside flat sides nothing is needed but the corners; edges keep what no flat star can spare.
  const MeshPtr cube = mesh_of(divided_cube(10.0, 12));
  const Prepared result = simplified(*cube, 1e-6);
  EXPECT_EQ(result.vertices_after, 8u);
  EXPECT_EQ(result.mesh->face_count(), 12u);
}

TEST(Simplify, WithoutAZoneTakesOnlyWhatLiesInFlatParts) {
  const MeshPtr sphere = mesh_of(icosphere(10.0, 4));
  EXPECT_EQ(simplified(*sphere, 0.0).vertices_after, sphere->vertex_count());
}

TEST(Simplify, MakesNoEdgeLongerThanTheLimit) {
  const MeshPtr plane = mesh_of(noisy_plane(40.0, 0.8, 0.02, 0.3, 3));
  double longest_before = 0.0;
  for (EdgeId e = 0; e < plane->edge_count(); ++e)
    longest_before = std::max(longest_before, plane->edge_length(e));
  SimplifyOptions options;
  options.error_zone = 0.1;
  options.max_edge_length = 3.0;
  ASSERT_LT(longest_before, options.max_edge_length);
  const Prepared limited = must(simplify(*plane, nullptr, no_edges, options));
  for (EdgeId e = 0; e < limited.mesh->edge_count(); ++e)
    EXPECT_LE(limited.mesh->edge_length(e), options.max_edge_length);
  EXPECT_GT(limited.vertices_after, 2 * simplified(*plane, 0.1).vertices_after);
  EXPECT_LT(2 * limited.vertices_after, limited.vertices_before);
}

TEST(Simplify, StopsAtTheTarget) {
  const MeshPtr plane = mesh_of(noisy_plane(40.0, 0.8, 0.02, 0.3, 3));
  SimplifyOptions options;
  options.error_zone = 0.1;
  options.target_vertices = 1000;
  EXPECT_EQ(must(simplify(*plane, nullptr, no_edges, options)).vertices_after, 1000u);
}

TEST(Simplify, TakesTheLeastCurvedVerticesFirst) {
  // A plate with a dome on it: the first half to go is from the flat part.
  Triangles plate = noisy_plane(40.0, 1.0, 0.0, 0.3, 3);
  for (Point& p : plate.points) p[2] += 8.0 * std::exp(-(p - Point(20, 20, 0)).squaredNorm() / 40);
  const MeshPtr mesh = mesh_of(plate);
  Point centre = 0.5 * (mesh->box_min() + mesh->box_max());
  centre[2] = 0.0;
  SimplifyOptions options;
  options.error_zone = 1.0;
  options.target_vertices = mesh->vertex_count() / 2;
  const Prepared half = must(simplify(*mesh, nullptr, no_edges, options));
  std::size_t dome = 0;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v)
    dome += half.mesh->is_isolated(v) && mesh->point(v)[2] > 2.0;
  EXPECT_EQ(dome, 0u);
}

TEST(Simplify, KeepsSharpEdges) {
  const MeshPtr roof = mesh_of(arris::testing::roof(1.0, 5.0, 10.0, 0.5));
  ChunkedArray<Origin> sharp(roof->edge_count(), Origin::none);
  std::vector<EdgeVertices> ridge;
  for (EdgeId e = 0; e < roof->edge_count(); ++e) {
    if (roof->is_border_edge(e)) continue;
    const auto normal = [&](FaceId f) {
      const Triangle& t = roof->triangle(f);
      return Point((roof->point(t[1]) - roof->point(t[0]))
                       .cross(roof->point(t[2]) - roof->point(t[0]))
                       .normalized());
    };
    if (normal(roof->edge_faces(e)[0]).dot(normal(roof->edge_faces(e)[1])) > 0.9) continue;
    sharp.set(e, Origin::found);
    ridge.push_back(roof->edge(e));
  }
  ASSERT_EQ(ridge.size(), 20u);
  SimplifyOptions options;
  options.error_zone = 0.5;
  const Prepared result = must(simplify(*roof, nullptr, sharp, options));
  for (const EdgeVertices& e : ridge) EXPECT_TRUE(result.mesh->find_edge(e[0], e[1]));
  const ChunkedArray<Origin> carried(carry_sharp_edges(*roof, sharp, *result.mesh), {});
  std::size_t count = 0;
  for (EdgeId e = 0; e < result.mesh->edge_count(); ++e) count += carried[e] != Origin::none;
  EXPECT_EQ(count, ridge.size());
  EXPECT_LT(simplified(*roof, 0.5).vertices_after, result.vertices_after);
  // Swaps leave them, too, and go on from the carried flags.
  for (const auto& swap : {swap_edges, equilateralize})
    for (const EdgeVertices& e : ridge)
      EXPECT_TRUE(
          must(swap(*result.mesh, result.zones, carried, {}, {})).mesh->find_edge(e[0], e[1]));
}

TEST(Simplify, HoldsEachVertexToItsOwnRadius) {
  const MeshPtr plane = mesh_of(noisy_plane(40.0, 0.8, 0.05, 0.3, 3));
  const double middle = 0.5 * (plane->box_min()[0] + plane->box_max()[0]);
  SimplifyOptions options;
  for (const Point& p : plane->points()) options.radii.push_back(p[0] < middle ? 0.0 : 0.1);
  const Prepared result = must(simplify(*plane, nullptr, no_edges, options));
  expect_sound(*plane, result, "two radii");
  std::size_t left = 0, right = 0;
  for (VertexId v = 0; v < plane->vertex_count(); ++v)
    (plane->point(v)[0] < middle ? left : right) += result.mesh->is_isolated(v);
  EXPECT_LT(50 * left, right);
}

TEST(Simplify, ASecondRunMayBeWiderOrNarrower) {
  const MeshPtr scan = mould_mesh();
  const Prepared first = simplified(*scan, 0.05);
  SimplifyOptions options;
  options.error_zone = 0.15;
  const Prepared wider = must(simplify(*first.mesh, first.zones, no_edges, options));
  EXPECT_EQ(wider.zones->radii(), std::vector<double>{0.15});
  EXPECT_LT(wider.vertices_after, first.vertices_after);
  expect_sound(*scan, wider, "wider");
  options.error_zone = 0.02;
  const Prepared narrower = must(simplify(*wider.mesh, wider.zones, no_edges, options));
  expect_sound(*scan, narrower, "narrower");
  for (VertexId v = 0; v < scan->vertex_count(); ++v)
    EXPECT_EQ(narrower.zones->radius(v), wider.mesh->is_isolated(v) ? 0.15 : 0.02);
}

TEST(Simplify, RefusesWhatDoesNotFit) {
  const MeshPtr sphere = mesh_of(icosphere(1.0, 2));
  const MeshPtr other = mesh_of(icosphere(1.0, 3));
  const auto message = [](const Result<Prepared>& result) {
    return result ? std::string() : result.error().message;
  };
  SimplifyOptions options;
  options.error_zone = -1.0;
  EXPECT_NE(message(simplify(*sphere, nullptr, no_edges, options)), "");
  options.error_zone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(simplify(*sphere, nullptr, no_edges, options)), "");
  options = {};
  options.max_edge_length = -1.0;
  EXPECT_NE(message(simplify(*sphere, nullptr, no_edges, options)), "");
  options = {};
  options.radii = {1.0, 1.0};
  EXPECT_NE(message(simplify(*sphere, nullptr, no_edges, options)), "");
  const Prepared prepared = simplified(*other, 0.1);
  EXPECT_NE(message(simplify(*sphere, prepared.zones, no_edges)), "");
  EXPECT_NE(message(swap_edges(*sphere, prepared.zones, no_edges)), "");
  const ChunkedArray<Origin> sharp(other->edge_count(), Origin::none);
  EXPECT_NE(message(simplify(*sphere, nullptr, sharp)), "");
  EXPECT_NE(message(equilateralize(*sphere, nullptr, sharp)), "");
}

TEST(Simplify, LeavesMeshesAloneThatHaveNothingToGive) {
  const MeshPtr single = mesh_of({{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)}, {{0, 1, 2}}});
  EXPECT_EQ(simplified(*single, 10.0).mesh->face_count(), 1u);
  const MeshPtr tetrahedron =
      mesh_of({{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)},
               {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
  EXPECT_EQ(simplified(*tetrahedron, 10.0).mesh->face_count(), 4u);
  const MeshPtr empty = mesh_of({{}, {}});
  EXPECT_EQ(simplified(*empty, 1.0).mesh->face_count(), 0u);
}

TEST(Simplify, CanBeCancelled) {
  const MeshPtr sphere = mesh_of(icosphere(1.0, 5));
  std::stop_source stop;
  const Context context(
      [&](double fraction, std::string_view) {
        if (fraction > 0.3) stop.request_stop();
      },
      stop.get_token());
  SimplifyOptions options;
  options.error_zone = 0.1;
  const Result<Prepared> result = simplify(*sphere, nullptr, no_edges, options, context);
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().cancelled);
  stop.request_stop();
  EXPECT_TRUE(swap_edges(*sphere, nullptr, no_edges, {}, context).error().cancelled);
}

TEST(Simplify, ProgressRunsFromZeroToOne) {
  const MeshPtr scan = mould_mesh();
  double last = 0.0;
  bool falls = false;
  const Context context([&](double fraction, std::string_view) {
    falls = falls || fraction < last;
    last = fraction;
  });
  ASSERT_TRUE(simplify(*scan, nullptr, no_edges, {}, context));
  EXPECT_EQ(last, 1.0);
  EXPECT_FALSE(falls);
}

TEST(Simplify, GivesTheSameBytesWhateverTheThreads) {
  const MeshPtr scan = mould_mesh();
  const auto run = [&](std::size_t threads) {
    const ThreadLimit control(threads);
    const Prepared simple = must(simplify(*scan, nullptr, no_edges));
    return must(swap_edges(*simple.mesh, simple.zones, no_edges));
  };
  const Prepared one = run(1);
  for (const std::size_t threads : {1, 2, 4}) {
    const Prepared other = run(threads);
    EXPECT_EQ(one.mesh->hash(), other.mesh->hash());
    EXPECT_EQ(*one.zones, *other.zones);
  }
}

// Stars.

/// All triangulations of corners first..last.
std::vector<std::vector<StarFace>> triangulations(int first, int last) {
  if (last < first + 2) return {{}};
  std::vector<std::vector<StarFace>> all;
  for (int m = first + 1; m < last; ++m)
    for (const auto& left : triangulations(first, m))
      for (const auto& right : triangulations(m, last)) {
        std::vector<StarFace> faces{{static_cast<std::int8_t>(first), static_cast<std::int8_t>(m),
                                     static_cast<std::int8_t>(last)}};
        faces.insert(faces.end(), left.begin(), left.end());
        faces.insert(faces.end(), right.begin(), right.end());
        all.push_back(std::move(faces));
      }
  return all;
}

TEST(StarTriangulation, IsTheBestOfAll) {
  Random random(11);
  StarTriangulator triangulator;
  for (int trial = 0; trial < 600; ++trial) {
    StarPolygon polygon;
    polygon.size = 3 + trial % 7;
    polygon.longest_edge = trial % 5 == 0 ? 1.7 : std::numeric_limits<double>::infinity();
    polygon.least_cosine = trial % 3 == 0 ? -0.5 : -1.0;
    std::vector<Point> normals(polygon.size);
    for (int i = 0; i < polygon.size; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.6 * random.uniform()) / polygon.size;
      const double radius = random.uniform(0.5, 1.5);
      polygon.vertices[i] = static_cast<VertexId>((i * 7 + trial) % 16);
      polygon.points[i] = {radius * std::cos(angle), radius * std::sin(angle),
                           random.uniform(-0.5, 0.5)};
      normals[i] = Point(random.gaussian(), random.gaussian(), 3.0).normalized();
      polygon.outer_normals[i] = i == 1 && trial % 2 == 0 ? nullptr : &normals[i];
      polygon.joined[i] = 0;
    }
    if (trial % 4 == 0 && polygon.size > 4) polygon.joined[0] |= 1u << 2;
    triangulator.set(polygon);
    for (const StarCost cost : {StarCost::flat, StarCost::angle, StarCost::area}) {
      std::vector<StarFace> found;
      const bool exists = triangulator.best(cost, found);
      double least = std::numeric_limits<double>::infinity();
      for (const std::vector<StarFace>& faces : triangulations(0, polygon.size - 1)) {
        bool allowed = true;
        for (const StarFace& f : faces) {
          for (const auto& [i, j] : {std::pair(f.first, f.middle), std::pair(f.middle, f.last),
                                     std::pair(f.first, f.last)}) {
            const bool side = j == i + 1 || (i == 0 && j == polygon.size - 1);
            allowed =
                allowed &&
                (side || (!(polygon.joined[i] >> j & 1u) &&
                          (polygon.points[i] - polygon.points[j]).norm() <= polygon.longest_edge));
          }
          const Point &a = polygon.points[f.first], &b = polygon.points[f.middle];
          allowed = allowed && (b - a).cross(polygon.points[f.last] - a).norm() > 1e-3;
        }
        if (allowed) least = std::min(least, triangulator.cost_of(cost, faces));
      }
      if (cost == StarCost::flat) {
        EXPECT_EQ(exists, least < std::numeric_limits<double>::infinity()) << trial;
      }
      if (!exists) continue;
      ASSERT_EQ(found.size(), static_cast<std::size_t>(polygon.size - 2));
      EXPECT_NEAR(triangulator.cost_of(cost, found), least, 1e-9) << trial;
    }
  }
}

// Noise.

TEST(Noise, IsFoundOnPlanesSpheresAndTheSampleMould) {
  for (const double sigma : {0.005, 0.02, 0.1})
    EXPECT_NEAR(estimate_noise(*mesh_of(noisy_plane(60.0, 1.0, sigma, 0.2, 5))), sigma,
                0.1 * sigma);
  EXPECT_NEAR(estimate_noise(*with_noise(icosphere(20.0, 5), 0.02, 3)), 0.02, 0.002);
  EXPECT_NEAR(estimate_noise(*with_noise(torus(20.0, 8.0, 120, 60), 0.05, 3)), 0.05, 0.005);
  const SampleMould mould = make_mould();
  EXPECT_NEAR(estimate_noise(**Mesh::create(mould.points, mould.triangles)), 0.05, 0.0075);
}

TEST(Noise, IsNoneOnAPlaneAndBlindToSharpLines) {
  EXPECT_LT(estimate_noise(*mesh_of(noisy_plane(30.0, 1.0, 0.0, 0.2, 5))), 1e-12);
  EXPECT_LT(estimate_noise(*mesh_of(divided_cube(10.0, 20))), 1e-12);
  EXPECT_EQ(estimate_noise(*mesh_of(cube())), 0.0);
}

}  // namespace
}  // namespace arris
