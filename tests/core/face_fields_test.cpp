// What can be told of a face: how well it is shaped, and how much of its error zones it uses up.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/face_quality.h"
#include "core/simplification/occupancy.h"
#include "core/simplification/simplify.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

TEST(FaceQuality, IsOneForEquilateralFacesOfAnySize) {
  for (const double size : {1e-200, 1e-6, 1.0, 1e6, 1e150}) {
    const double quality =
        face_quality({0, 0, 0}, {size, 0, 0}, {size / 2, size * std::sqrt(3.0) / 2, 0});
    EXPECT_NEAR(quality, 1.0, 1e-12) << size;
    EXPECT_LE(quality, 1.0);
  }
}

TEST(FaceQuality, OfARightIsoscelesFaceIsTwiceTheRatioOfItsCircles) {
  // Legs 1: inscribed radius 1 - 1/sqrt(2), circumscribed 1/sqrt(2).
  const double expected = 2.0 * (1.0 - std::numbers::sqrt2 / 2) * std::numbers::sqrt2;
  EXPECT_NEAR(face_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), expected, 1e-12);
  EXPECT_NEAR(face_quality({5, 5, 5}, {5, 5, 8}, {5, 8, 5}), expected, 1e-12);
}

TEST(FaceQuality, IsZeroWithoutAreaAndFallsTowardsItForSlivers) {
  EXPECT_EQ(face_quality({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0.0);
  EXPECT_EQ(face_quality({0, 0, 0}, {1, 0, 0}, {1, 0, 0}), 0.0);
  EXPECT_EQ(face_quality({0, 0, 0}, {1, 0, 0}, {3, 0, 0}), 0.0);
  double before = 1.0;
  for (const double height : {0.8, 0.3, 0.1, 0.01, 1e-4}) {
    const double quality = face_quality({0, 0, 0}, {1, 0, 0}, {0.5, height, 0});
    EXPECT_LT(quality, before);
    EXPECT_GT(quality, 0.0);
    before = quality;
  }
}

TEST(FaceQuality, DoesNotDependOnWhichCornerComesFirst) {
  const Point a(0, 0, 0), b(3, 1, 0.5), c(1, 4, -2);
  EXPECT_NEAR(face_quality(a, b, c), face_quality(b, c, a), 1e-15);
  EXPECT_NEAR(face_quality(a, b, c), face_quality(c, b, a), 1e-15);
}

TEST(FaceQuality, WideAnglesAreCountedByCorner) {
  // One right angle in each of the two halves of a square, none above it.
  const MeshPtr square =
      testing::mesh_of({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  EXPECT_DOUBLE_EQ(share_of_angles_above(*square, 89.0), 2.0 / 6.0);
  EXPECT_EQ(share_of_angles_above(*square, 91.0), 0.0);
  EXPECT_DOUBLE_EQ(share_of_angles_above(*square, 1.0), 1.0);
  // An equilateral mesh has 60 degrees everywhere.
  const MeshPtr even =
      testing::mesh_of({{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}, {{0, 1, 2}}});
  EXPECT_EQ(share_of_angles_above(*even, 60.1), 0.0);
  EXPECT_EQ(share_of_angles_above(*even, 59.9), 1.0);
}

/// The square from (0, 0) to (4, 4) cut along its diagonal, and isolated points of the scan.
MeshPtr square_with(const std::vector<Point>& removed) {
  testing::Triangles square{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  square.points.insert(square.points.end(), removed.begin(), removed.end());
  return testing::mesh_of(square);
}

TEST(Occupancy, IsTheLargestDistanceOverRadiusOfTheZonesOfAFace) {
  // Vertices 4 and 5 above face 0, 6 above face 1.
  const MeshPtr mesh = square_with({{2, 1, 0.01}, {3, 1, -0.03}, {1, 3, 0.02}});
  const ErrorZones zones({0.04}, {0, 2, 3}, {4, 5, 6}, {}, {0}, {});
  const Occupancy occupancy = occupancy_of(*mesh, zones);
  ASSERT_EQ(occupancy.shares.size(), 2u);
  EXPECT_NEAR(occupancy.shares[0], 0.75, 1e-12);
  EXPECT_NEAR(occupancy.shares[1], 0.5, 1e-12);
  EXPECT_EQ(occupancy.worst.worst, 5u);
  EXPECT_NEAR(occupancy.worst.distance, 0.03, 1e-12);
  EXPECT_EQ(occupancy.worst.radius, 0.04);
}

TEST(Occupancy, MeasuresEachZoneByItsOwnRadius) {
  const MeshPtr mesh = square_with({{3, 1, 0.01}, {1, 3, 0.05}});
  const ErrorZones zones({1, 1, 1, 1, 0.0125, 0.1}, {0, 1, 2}, {4, 5}, {}, {0}, {});
  const Occupancy occupancy = occupancy_of(*mesh, zones);
  EXPECT_NEAR(occupancy.shares[0], 0.8, 1e-12);
  EXPECT_NEAR(occupancy.shares[1], 0.5, 1e-12);
  EXPECT_EQ(occupancy.worst.worst, 4u) << "nearer, but it uses up more of its zone";
}

TEST(Occupancy, ABorderEdgeAnswersWithItsFace) {
  const MeshPtr mesh = square_with({{2, -0.03, 0}});
  const EdgeId border = *mesh->find_edge(0, 1);
  const ErrorZones zones({0.04}, {0, 0, 0}, {}, {border}, {0, 1}, {4});
  const Occupancy occupancy = occupancy_of(*mesh, zones);
  const FaceId face = *mesh->find_face({0, 1, 2});
  EXPECT_NEAR(occupancy.shares[face], 0.75, 1e-12);
  EXPECT_EQ(occupancy.shares[1 - face], 0.0);
  EXPECT_EQ(occupancy.worst.worst, 4u);
}

TEST(Occupancy, IsZeroWhereNothingWasRemoved) {
  const MeshPtr mesh = testing::mesh_of(testing::icosphere(10.0, 2));
  const Occupancy occupancy = occupancy_of(*mesh, ErrorZones::start(*mesh, 0.0));
  for (const double share : occupancy.shares) EXPECT_EQ(share, 0.0);
  EXPECT_EQ(occupancy.worst.worst, no_id);
}

TEST(Occupancy, OfASimplifiedMeshNeverPassesItsZonesAndIsThatOfItsVertices) {
  const MeshPtr mesh = testing::mesh_of(testing::noisy_plane(20.0, 1.0, 0.02, 0.2, 7));
  SimplifyOptions options;
  options.error_zone = 0.05;
  const Prepared prepared = testing::value_of(simplify(*mesh, nullptr, {}, options));
  ASSERT_GT(prepared.zones->removed_count(), 100u);
  const Occupancy occupancy = occupancy_of(*prepared.mesh, *prepared.zones);
  double largest = 0.0;
  for (const double distance : zone_distances(*prepared.mesh, *prepared.zones))
    if (distance > largest) largest = distance;
  EXPECT_GT(largest, 0.0);
  EXPECT_DOUBLE_EQ(occupancy.worst.distance, largest);
  EXPECT_DOUBLE_EQ(occupancy.worst.share, largest / 0.05);
  for (FaceId f = 0; f < prepared.mesh->face_count(); ++f) {
    EXPECT_LE(occupancy.shares[f], 1.0 + 1e-12);
    EXPECT_EQ(occupancy.shares[f], occupancy_of_face(*prepared.mesh, *prepared.zones, f).share);
  }
}

}  // namespace
}  // namespace arris
