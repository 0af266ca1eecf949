#include "core/edge_swapping/swap_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "core/curvature/curvature.h"
#include "core/edge_swapping/equilateralize.h"
#include "core/mesh/geometry.h"
#include "core/mesh/scan.h"
#include "core/samples/mould.h"
#include "core/simplification/noise.h"
#include "core/simplification/simplify.h"
#include "tests/support/meshes.h"
#include "tests/support/nearest.h"

namespace arris {
namespace {

using namespace arris::testing;

constexpr double pi = std::numbers::pi;
const ChunkedArray<Origin> no_edges;

Prepared must(const Result<Prepared>& result) {
  if (!result) throw std::logic_error(result.error().message);
  return *result;
}

Prepared simplified(const Mesh& mesh, double error_zone) {
  SimplifyOptions options;
  options.error_zone = error_zone;
  return must(simplify(mesh, nullptr, no_edges, options));
}

std::vector<double> descending_angles(const Mesh& mesh) {
  std::vector<double> angles;
  for (const Triangle& t : mesh.triangles())
    for (int k = 0; k < 3; ++k)
      angles.push_back(
          corner_angle(mesh.point(t[k]), mesh.point(t[(k + 1) % 3]), mesh.point(t[(k + 2) % 3])));
  std::ranges::sort(angles, std::greater<>());
  return angles;
}

double obtuse_share(const Mesh& mesh) {
  const std::vector<double> angles = descending_angles(mesh);
  const auto wide = std::ranges::count_if(angles, [](double a) { return a > 2.0 * pi / 3.0; });
  return static_cast<double>(wide) / static_cast<double>(mesh.face_count());
}

std::vector<MeshPtr> samples() {
  const SampleMould mould = make_mould({.edge_length = 2.0});
  return {*Mesh::create(mould.points, mould.triangles), mesh_of(irregular_sphere(10.0, 1500, 3)),
          mesh_of(torus(10.0, 4.0, 48, 24)), mesh_of(random_terrain(30, 5)),
          mesh_of(noisy_plane(30.0, 1.0, 0.05, 0.3, 3))};
}

TEST(SwapEdges, LowersTheBendingOfTheWholeMeshAtEverySwap) {
  for (const MeshPtr& scan : samples())
    for (const bool simple : {false, true}) {
      const Prepared start = simplified(*scan, simple ? 0.1 : 0.0);
      const double before = total_bending(*start.mesh);
      double gained = 0.0;
      std::uint64_t swaps = 0, rises = 0;
      SwapOptions options;
      options.observe = [&](double old_cost, double new_cost) {
        ++swaps;
        rises += !(new_cost < old_cost);
        gained += old_cost - new_cost;
      };
      const Prepared result = must(swap_edges(*start.mesh, start.zones, no_edges, options));
      EXPECT_EQ(swaps, result.swaps);
      EXPECT_EQ(rises, 0u);
      // Each swap changes the sum over its five edges and nothing else: what they gained is what
      // the mesh has gained.
      EXPECT_NEAR(total_bending(*result.mesh), before - gained, 1e-9 * before);
    }
}

TEST(SwapEdges, ASecondRunDoesNothing) {
  for (const MeshPtr& scan : samples())
    for (const auto& swap : {swap_edges, equilateralize}) {
      const Prepared start = simplified(*scan, 0.1);
      const Prepared once = must(swap(*start.mesh, start.zones, no_edges, {}, {}));
      const Prepared twice = must(swap(*once.mesh, once.zones, no_edges, {}, {}));
      EXPECT_EQ(twice.swaps, 0u);
      EXPECT_EQ(twice.mesh->hash(), once.mesh->hash());
      EXPECT_EQ(*twice.zones, *once.zones);
    }
}

TEST(SwapEdges, FindsTheStraightRidge) {
  // A roof whose squares along the ridge are cut across it: swaps bring the ridge back.
  const double height = 3.0;
  Triangles roof;
  for (int i = 0; i <= 10; ++i) {
    roof.points.insert(roof.points.end(), {Point(-5, i, 0), Point(0, i, height), Point(5, i, 0)});
    if (i == 0) continue;
    const VertexId a = 3 * (i - 1), b = 3 * i;
    roof.triangles.insert(
        roof.triangles.end(),
        {{a, a + 1, b}, {a + 1, b + 1, b}, {a + 1, a + 2, b + 1}, {a + 2, b + 2, b + 1}});
  }
  const MeshPtr straight = mesh_of(roof);
  // Cut two ridge edges across: faces either side of ridge edge k, k + 1 become their other pair.
  std::vector<Triangle> wrong;
  for (const Triangle& t : roof.triangles) {
    if (t == Triangle{7, 10, 9} || t == Triangle{7, 8, 10}) continue;
    if (t == Triangle{16, 19, 18} || t == Triangle{16, 17, 19}) continue;
    wrong.push_back(t);
  }
  for (const VertexId ridge : {7u, 16u}) {
    wrong.push_back({ridge, ridge + 1, ridge + 2});
    wrong.push_back({ridge + 1, ridge + 3, ridge + 2});
  }
  const MeshPtr crossed = mesh_of({roof.points, wrong});
  ASSERT_FALSE(crossed->find_edge(7, 10));
  const Prepared result = must(swap_edges(*crossed, nullptr, no_edges));
  for (VertexId v = 1; v + 3 < 33; v += 3) EXPECT_TRUE(result.mesh->find_edge(v, v + 3)) << v;
  EXPECT_LE(total_bending(*result.mesh), total_bending(*straight) + 1e-9);
}

TEST(Equilateralize, LowersTheListOfAllAnglesAtEverySwap) {
  for (const MeshPtr& scan : samples()) {
    const Prepared start = simplified(*scan, 0.1);
    std::uint64_t rises = 0;
    SwapOptions options;
    options.observe = [&](double before, double after) { rises += !(after < before); };
    const Prepared result = must(equilateralize(*start.mesh, start.zones, no_edges, options));
    EXPECT_EQ(rises, 0u);
    if (result.swaps == 0) continue;
    EXPECT_LT(descending_angles(*result.mesh), descending_angles(*start.mesh));
  }
}

TEST(Equilateralize, LowersTheShareOfWideAnglesOnSphereAndTorus) {
  for (const MeshPtr& mesh :
       {mesh_of(irregular_sphere(10.0, 3000, 3)), mesh_of(torus(10.0, 4.0, 80, 40))}) {
    SimplifyOptions options;
    options.error_zone = 0.1;
    options.max_edge_length = 3.0 * mesh->mean_edge_length();
    options.cost = StarCost::flat;  // makes the most slivers of the three
    const Prepared simple = must(simplify(*mesh, nullptr, no_edges, options));
    const Prepared result = must(equilateralize(*simple.mesh, simple.zones, no_edges));
    std::printf("share of faces with an angle above 120 degrees: %.3f before, %.3f after\n",
                obtuse_share(*simple.mesh), obtuse_share(*result.mesh));
    EXPECT_LT(obtuse_share(*result.mesh), 0.8 * obtuse_share(*simple.mesh));
  }
}

// The smoothing effect (4.1, 4.2).

/// Mean angle in degrees between the normals of a clean mesh, weighted by area, and the surface of
/// another beside them.
double normal_error(const Mesh& clean, const Mesh& mesh) {
  const auto normal = [](const Mesh& m, FaceId f) {
    const Triangle& t = m.triangle(f);
    return Point((m.point(t[1]) - m.point(t[0])).cross(m.point(t[2]) - m.point(t[0])));
  };
  const Nearest surface = Nearest::faces(mesh);
  double sum = 0.0, area = 0.0;
  for (FaceId f = 0; f < clean.face_count(); ++f) {
    const Triangle& t = clean.triangle(f);
    const Point centre = (clean.point(t[0]) + clean.point(t[1]) + clean.point(t[2])) / 3.0;
    const Point m = normal(clean, f);
    const Point n = normal(mesh, static_cast<FaceId>(surface.find(centre).element));
    sum += m.norm() * std::atan2(m.cross(n).norm(), m.dot(n));
    area += m.norm();
  }
  return sum / area * 180.0 / pi;
}

/// Both phases bring the normals nearer to the truth. What a swap can add depends on the scheme
/// before it: the least area is nearly what swaps would make of it, so they are held to their
/// promise after the scheme that does not look at the angles between faces.
void expect_smoother(const std::string& name, const Mesh& clean, const Mesh& noisy) {
  const double noise = estimate_noise(noisy), scan = normal_error(clean, noisy);
  const double by_default = normal_error(clean, *must(simplify(noisy, nullptr, no_edges)).mesh);
  EXPECT_LT(by_default, scan);
  SimplifyOptions options;
  options.error_zone = 3.0 * noise;
  options.cost = StarCost::angle;
  const Prepared simple = must(simplify(noisy, nullptr, no_edges, options));
  const Prepared smooth = must(swap_edges(*simple.mesh, simple.zones, no_edges));
  const double less = normal_error(clean, *simple.mesh);
  const double least = normal_error(clean, *smooth.mesh);
  std::printf(
      "%s: mean normal error %.2f degrees; simplified by default %.2f; at three times the noise "
      "%.2f, swapped %.2f\n",
      name.c_str(), scan, by_default, less, least);
  EXPECT_LT(less, scan);
  EXPECT_LT(least, less);
}

TEST(Preparation, BringsTheNormalsOfTheSampleMouldNearerToTheTruth) {
  const SampleMould noisy = make_mould(), clean = make_mould({.noise = 0.0});
  expect_smoother("mould", **Mesh::create(clean.points, clean.triangles),
                  **Mesh::create(noisy.points, noisy.triangles));
}

TEST(Preparation, BringsTheNormalsOfRealPairsNearerToTheTruth) {
  const std::string folder = std::string(ARRIS_SOURCE_DIR) + "/../shared/data/pairs/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const auto load = [&](const char* name) { return (*load_scan(folder + name))->mesh; };
  expect_smoother("block", *load("block_gt.obj"), *load("block_n1.obj"));
  // Noise of a third of an edge: simplification still helps, swaps leave it as it is.
  const MeshPtr harsh = load("Fandisk0.3_Noisy.obj"), clean = load("Fandisk0.3_Original.obj");
  EXPECT_LT(normal_error(*clean, *must(simplify(*harsh, nullptr, no_edges)).mesh),
            normal_error(*clean, *harsh));
}

}  // namespace
}  // namespace arris
