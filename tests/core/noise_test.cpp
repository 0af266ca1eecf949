// The noise of a part, and the defaults that come from it: none where there is none, right where
// there is some, and the same whatever the unit.

#include "core/simplification/noise.h"
#include "core/base/thread_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/sharp_lines/sharp_lines.h"
#include "tests/support/documents.h"
#include "tests/support/meshes.h"

namespace arris {
namespace {

using namespace arris::testing;

Triangles scaled(const Triangles& mesh, double scale) {
  Triangles result = mesh;
  for (Point& p : result.points) p *= scale;
  return result;
}

/// Square ribs `width` cells wide and `height` cells high with grooves between; cells of 1. Half of
/// the vertices lie within two edges of a sharp line where both are 6.
Triangles ribs(int width, int height, int count, int length) {
  std::vector<std::array<double, 2>> profile{{0.0, 0.0}};
  const auto run = [&](int steps, double along, double up) {
    for (int i = 0; i < steps; ++i)
      profile.push_back({profile.back()[0] + along, profile.back()[1] + up});
  };
  for (int k = 0; k < count; ++k) {
    run(width, 1.0, 0.0);
    run(height, 0.0, 1.0);
    run(width, 1.0, 0.0);
    run(height, 0.0, -1.0);
  }
  Triangles result;
  const auto columns = static_cast<VertexId>(profile.size());
  for (int j = 0; j <= length; ++j)
    for (const auto& [s, z] : profile) result.points.emplace_back(s, j, z);
  for (VertexId j = 0; j < static_cast<VertexId>(length); ++j)
    for (VertexId i = 0; i + 1 < columns; ++i) {
      const VertexId a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      result.triangles.push_back({a, b, c});
      result.triangles.push_back({a, c, d});
    }
  return result;
}

/// The estimate over the mean edge.
double share_of(const Triangles& part) {
  const MeshPtr mesh = mesh_of(part);
  return estimate_noise(*mesh) / mesh->mean_edge_length();
}

/// The mean of the estimates over the true noise, for parts that differ in their noise only.
double mean_ratio(const Triangles& part, double share, int parts) {
  double sum = 0.0;
  for (int seed = 1; seed <= parts; ++seed)
    sum += share_of(noisy(part, share, static_cast<std::uint64_t>(seed))) / share;
  return sum / parts;
}

const Eigen::Matrix3d askew =
    Eigen::AngleAxisd(0.7, Point(1.0, 2.0, 3.0).normalized()).toRotationMatrix();

TEST(Noise, IsNoneOnACubeHoweverFewItsTriangles) {
  for (const int divisions : {1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 32, 64}) {
    EXPECT_EQ(share_of(divided_cube(20.0, divisions)), 0.0) << divisions;
    // Turned, its sides are flat up to rounding.
    EXPECT_LT(share_of(moved(divided_cube(20.0, divisions), 1.0, askew, Point(5.0, -7.0, 11.0))),
              1e-12)
        << divisions;
  }
  for (const int genus : {0, 1, 3}) EXPECT_EQ(share_of(block_with_holes(genus)), 0.0);
}

TEST(Noise, IsNoneOnTessellatedCadSurfaces) {
  for (const int around : {6, 8, 12, 16, 24, 48, 96, 256})
    for (const int along : {1, 3, 20}) {
      const std::string what = std::to_string(around) + " x " + std::to_string(along);
      EXPECT_LT(share_of(capped_cylinder(10.0, 30.0, around, along, along)), 1e-9) << what;
      EXPECT_LT(share_of(cylinder_wall(10.0, 30.0, around, along)), 1e-9) << what;
      EXPECT_LT(share_of(cone(10.0, 20.0, around, along)), 1e-9) << what;
    }
  for (const int steps : {8, 12, 16, 24, 48, 120, 240})
    EXPECT_LT(share_of(torus(20.0, 8.0, steps, steps / 2)), 1e-9) << steps;
  EXPECT_LT(share_of(stepped_plate(20.0, 40.0, 5.0, 1.0)), 1e-9);
  EXPECT_LT(share_of(roof(0.3, 20.0, 40.0, 1.0)), 1e-9);
  EXPECT_LT(share_of(ribs(2, 2, 10, 40)), 1e-9);
}

TEST(Noise, IsNoneOnBentSurfacesWithoutFlatFacesCoarseOrFine) {
  for (int level = 0; level <= 6; ++level)
    EXPECT_LT(share_of(icosphere(10.0, level)), 0.002) << level;
  for (int level = 2; level <= 6; ++level)
    EXPECT_LT(share_of(ellipsoid(15.0, 10.0, 5.0, level)), 0.002) << level;
  for (const int vertices : {100, 300, 1000, 5000})
    EXPECT_LT(share_of(irregular_sphere(10.0, vertices, 3)), 0.002) << vertices;
}

TEST(Noise, IsNoneOnALargeFlatPlateOfSlivers) {
  // A fan from one far corner over 400 short edges of the opposite side.
  Triangles plate{{Point(0.0, 0.0, 0.0)}, {}};
  for (int k = 0; k <= 400; ++k) plate.points.emplace_back(1000.0, 0.05 * k, 0.0);
  for (VertexId k = 1; k <= 400; ++k) plate.triangles.push_back({0, k, k + 1});
  EXPECT_EQ(share_of(plate), 0.0);
  EXPECT_LT(share_of(moved(plate, 1.0, askew, Point(1.0, 2.0, 3.0))), 1e-9);
}

TEST(Noise, IsRightOnPlanesCylindersAndSpheres) {
  for (const double share : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    EXPECT_NEAR(mean_ratio(noisy_plane(60.0, 1.0, 0.0, 0.2, 5), share, 2), 1.0, 0.1) << share;
    EXPECT_NEAR(mean_ratio(cylinder_wall(10.0, 40.0, 60, 40), share, 2), 1.0, 0.1) << share;
    EXPECT_NEAR(mean_ratio(capped_cylinder(10.0, 30.0, 60, 30, 10), share, 2), 1.0, 0.1) << share;
    EXPECT_NEAR(mean_ratio(icosphere(10.0, 4), share, 2), 1.0, 0.1) << share;
    EXPECT_NEAR(mean_ratio(irregular_sphere(10.0, 3000, 3), share, 2), 1.0, 0.1) << share;
    EXPECT_NEAR(mean_ratio(torus(20.0, 8.0, 120, 60), share, 1), 1.0, 0.1) << share;
    EXPECT_NEAR(mean_ratio(cone(10.0, 20.0, 96, 24), share, 2), 1.0, 0.15) << share;
  }
}

TEST(Noise, IsRightWhereHalfOfTheVerticesLieAtSharpLines) {
  for (const double share : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    EXPECT_NEAR(mean_ratio(divided_cube(20.0, 8), share, 16), 1.0, 0.15) << share;
    EXPECT_NEAR(mean_ratio(divided_cube(20.0, 12), share, 8), 1.0, 0.15) << share;
    EXPECT_NEAR(mean_ratio(stepped_plate(5.0, 40.0, 5.0, 1.0), share, 8), 1.0, 0.15) << share;
    EXPECT_NEAR(mean_ratio(ribs(6, 6, 10, 40), share, 2), 1.0, 0.15) << share;
    EXPECT_NEAR(mean_ratio(roof(0.7, 6.0, 40.0, 1.0), share, 8), 1.0, 0.15) << share;
  }
}

TEST(Noise, IsNeverFarTooLargeOnPartsThatAreNearlyAllSharpLines) {
  // No two-ring keeps clear of the lines; before, the estimate was 3 to 60 times the noise.
  for (const double share : {0.005, 0.02, 0.1, 0.3}) {
    for (const int divisions : {3, 4, 5})
      EXPECT_LT(mean_ratio(divided_cube(20.0, divisions), share, 16), 1.6)
          << divisions << " " << share;
    EXPECT_LT(mean_ratio(ribs(3, 3, 10, 40), share, 2), 1.6) << share;
  }
}

TEST(Noise, FollowsThePartWhereverAndHoweverItLies) {
  const Triangles part = noisy(divided_cube(20.0, 12), 0.1, 3);
  const double noise = estimate_noise(*mesh_of(part));
  for (const int power : {-40, -3, 1, 10, 40})
    EXPECT_EQ(estimate_noise(*mesh_of(scaled(part, std::ldexp(1.0, power)))),
              std::ldexp(noise, power));
  for (const double scale : {1e-6, 0.001, 1.0 / 25.4, 1000.0})
    EXPECT_NEAR(estimate_noise(*mesh_of(scaled(part, scale))), scale * noise, 1e-9 * scale * noise);
  EXPECT_NEAR(estimate_noise(*mesh_of(moved(part, 1.0, askew, Point(300.0, -200.0, 100.0)))), noise,
              1e-6 * noise);
}

TEST(Noise, IsTheSameForAnyNumberOfThreads) {
  const MeshPtr mesh =
      mesh_of(noisy_plane(200.0, 1.0, 0.1, 0.2, 5));  // not all places are looked at
  const double noise = estimate_noise(*mesh);
  const ThreadLimit one(1);
  EXPECT_EQ(estimate_noise(*mesh), noise);
}

TEST(Noise, IsNoneWhereThereIsNothingToTellItBy) {
  EXPECT_EQ(share_of({{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)}, {{0, 1, 2}}}), 0.0);
  // Faces without area, all at one place or on one line.
  Triangles flat = divided_cube(1.0, 4);
  for (Point& p : flat.points) p = Point(p.x(), 0.0, 0.0);
  EXPECT_EQ(estimate_noise(*mesh_of(flat)), 0.0);
  for (Point& p : flat.points) p = Point(1.0, 2.0, 3.0);
  EXPECT_EQ(estimate_noise(*mesh_of(flat)), 0.0);
}

// Defaults.

/// The whole default flow, as `arris-cli segment` runs it.
Document segmented(const Triangles& part) {
  Document document = document_of(part);
  for (const char* step : {"simplify", "find_sharp_lines", "equilateralize", "find_partitions"})
    document = applied(document, {step});
  return document;
}

/// A part as scanned: a mould with a boss, fillets, a rim, and noise.
Triangles scanned_part() { return sample_mould(1.8); }

struct Outcome {
  std::vector<std::vector<VertexId>> lines;
  std::map<Triangle, std::uint32_t> labels;
  bool operator==(const Outcome&) const = default;
};

Outcome outcome_of(const Document& document) {
  Outcome result;
  for (const LinePtr& line : document.lines.lines) result.lines.push_back(line->vertices);
  for (FaceId f = 0; f < document.mesh->face_count(); ++f)
    result.labels[document.mesh->triangle(f)] = document.partitions.labels[f];
  return result;
}

TEST(Defaults, GiveTheVerySameInUnitsThatDifferByAPowerOfTwo) {
  const Triangles part = scanned_part();
  const Outcome outcome = outcome_of(segmented(part));
  ASSERT_GT(outcome.lines.size(), 3u);
  for (const int power : {-20, -1, 3, 20})
    EXPECT_EQ(outcome_of(segmented(scaled(part, std::ldexp(1.0, power)))), outcome) << power;
}

TEST(Defaults, GiveTheSameInAnyUnit) {
  const Triangles part = scanned_part();
  const Document document = segmented(part);
  const Outcome outcome = outcome_of(document);
  double length = 0.0;
  for (const LinePtr& line : document.lines.lines) length += line->length;
  ASSERT_GT(document.partitions.partitions.size(), 5u);
  for (const double scale : {1e-6, 0.001, 1.0 / 25.4, 1000.0}) {
    const Document other = segmented(scaled(part, scale));
    EXPECT_EQ(other.partitions.partitions.size(), document.partitions.partitions.size()) << scale;
    EXPECT_EQ(outcome_of(other), outcome) << scale;
    double other_length = 0.0;
    for (const LinePtr& line : other.lines.lines) other_length += line->length;
    EXPECT_NEAR(other_length, scale * length, 1e-9 * scale * length) << scale;
  }
}

TEST(Defaults, GiveTheSameForAPartWithoutNoiseInAnyUnit) {
  for (const double scale : {1.0, 0.001, 1.0 / 25.4, 1000.0}) {
    const Document post = segmented(scaled(capped_cylinder(10.0, 30.0, 64, 30, 10), scale));
    EXPECT_EQ(post.lines.lines.size(), 2u) << scale;
    EXPECT_EQ(post.partitions.partitions.size(), 3u) << scale;
    EXPECT_NEAR(assigned_share(post), 1.0, 1e-9) << scale;
  }
}

TEST(Defaults, KeepTheSidesOfACubeOfTwelveTriangles) {
  for (const double size : {1e-3, 0.1, 1.0, 20.0, 1e4})
    for (const bool turned : {false, true}) {
      const Document document = segmented(
          moved(cube(1.0), size, turned ? askew : Eigen::Matrix3d::Identity(), Point::Zero()));
      EXPECT_EQ(document.lines.lines.size(), 12u) << size << turned;
      EXPECT_EQ(document.partitions.partitions.size(), 6u) << size << turned;
      EXPECT_NEAR(assigned_share(document), 1.0, 1e-9) << size << turned;
      for (const PartitionPtr& side : document.partitions.partitions)
        EXPECT_NEAR(side->area, size * size, 1e-9 * size * size) << size << turned;
    }
}

TEST(Defaults, KeepTheSidesOfADividedCube) {
  for (const int divisions : {2, 3, 4, 6, 8, 16})
    for (const bool turned : {false, true}) {
      const Document document =
          segmented(moved(divided_cube(1.0, divisions), 20.0,
                          turned ? askew : Eigen::Matrix3d::Identity(), Point::Zero()));
      EXPECT_EQ(document.lines.lines.size(), 12u) << divisions << turned;
      EXPECT_EQ(document.partitions.partitions.size(), 6u) << divisions << turned;
      EXPECT_NEAR(assigned_share(document), 1.0, 1e-9) << divisions << turned;
    }
}

TEST(Defaults, AreLengthsOfThePartAndNotRounded) {
  const Document document = document_of(noisy(divided_cube(20.0, 12), 0.1, 3));
  const Mesh& mesh = *document.mesh;
  const Document simplified = applied(document, {"simplify"});
  EXPECT_EQ(simplified.step("simplify")->parameters["error_zone"], 3.0 * estimate_noise(mesh));
  EXPECT_EQ(simplified.step("simplify")->parameters["max_edge_length"],
            2.0 * mesh.mean_edge_length());
  const Document lined = applied(document, {"find_sharp_lines"});
  EXPECT_EQ(lined.step("find_sharp_lines")->parameters["min_length"],
            default_min_length(mesh, LineMethod::normal_jump));
}

TEST(Defaults, ReadLikeNumbersWhereTheyAreShown) {
  const Document document =
      applied(document_of(noisy(divided_cube(20.0, 12), 0.1, 3)), {"simplify"});
  const std::string gist = find_operation("simplify")->words(document.step("simplify")->parameters);
  EXPECT_LE(std::count_if(gist.begin(), gist.end(), [](char c) { return c >= '1' && c <= '9'; }), 3)
      << gist;
}

/// Lengths are accepted up to 1000 times the part, whatever the unit.
TEST(Defaults, BoundsOfLengthsFollowThePart) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const Document document = document_of(scaled(cube(1.0), scale));
    const double longest = 1000.0 * document.mesh->diagonal();
    for (const auto& [step, name] :
         {std::pair{"simplify", "error_zone"}, std::pair{"simplify", "max_edge_length"},
          std::pair{"find_sharp_lines", "min_length"},
          std::pair{"find_sharp_lines", "bridge_gap"}}) {
      EXPECT_TRUE(resolve(document, {step, {{name, 0.999 * longest}}})) << name;
      EXPECT_FALSE(resolve(document, {step, {{name, 1.001 * longest}}})) << name;
    }
  }
}

}  // namespace
}  // namespace arris
