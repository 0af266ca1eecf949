// Versions of a part compared: what one has and the other has not.

#include "core/document/comparison.h"

#include <gtest/gtest.h>

#include "tests/support/documents.h"

namespace arris {
namespace {

using testing::applied;
using testing::cube_document;
using testing::divided_at_edges;
using testing::document_of;
using testing::value_of;

double length_of(const Document& document) {
  double length = 0.0;
  for (const LinePtr& line : document.lines.lines) length += line->length;
  return length;
}

double length_of(const Mesh& mesh, const std::vector<std::vector<VertexId>>& paths) {
  double length = 0.0;
  for (const std::vector<VertexId>& path : paths)
    for (std::size_t k = 1; k < path.size(); ++k) {
      EXPECT_TRUE(mesh.find_edge(path[k - 1], path[k])) << "a stretch runs along edges";
      length += (mesh.point(path[k]) - mesh.point(path[k - 1])).norm();
    }
  return length;
}

/// A flat square of 20 by 20 with one line drawn along y at each of these x.
Document plate_with_lines(const std::vector<double>& places) {
  Document document = document_of(testing::noisy_plane(20.0, 1.0, 0.0, 0.0, 1));
  const auto at = [&](double x, double y) {
    VertexId nearest = 0;
    for (VertexId v = 0; v < document.mesh->vertex_count(); ++v)
      if ((document.mesh->point(v) - Point(x, y, 0)).norm() <
          (document.mesh->point(nearest) - Point(x, y, 0)).norm())
        nearest = v;
    return nearest;
  };
  for (const double x : places)
    document = applied(document, {"draw_line", {{"vertices", {at(x, 2.0), at(x, 18.0)}}}});
  return document;
}

void expect_alike(const Comparison& comparison) {
  for (const Departure& only : comparison.only) {
    EXPECT_TRUE(only.stretches.empty());
    EXPECT_EQ(only.sharp_length, 0.0);
    EXPECT_EQ(only.soft_length, 0.0);
  }
  EXPECT_EQ(comparison.divided_otherwise.value_or(0.0), 0.0);
}

TEST(Compare, VersionIsLikeItself) {
  const Document cube = cube_document();
  const Comparison comparison = value_of(compare(cube, cube));
  expect_alike(comparison);
  ASSERT_EQ(comparison.partitions.size(), 6u);
  for (const auto& [left, right] : comparison.partitions) EXPECT_EQ(left, right);
}

TEST(Compare, DeletedLineIsInOneVersionOnly) {
  const Document cube = cube_document();
  ASSERT_EQ(cube.lines.lines.size(), 12u);
  const Document without = applied(cube, {"delete_lines", {{"lines", {cube.lines.lines[4]->id}}}});
  const Comparison comparison = value_of(compare(cube, without));
  // All of it but what lies within the tolerance of the lines it runs into at both ends.
  const Departure& only = comparison.only[0];
  ASSERT_EQ(only.stretches.size(), 1u);
  const double length = cube.lines.lines[4]->length, edge = 1.0;
  EXPECT_GE(only.sharp_length, length - 2.0 * (comparison.tolerance + edge));
  EXPECT_LT(only.sharp_length, length);
  EXPECT_NEAR(length_of(*cube.mesh, only.stretches), only.sharp_length, 1e-12);
  EXPECT_TRUE(comparison.only[1].stretches.empty());
}

TEST(Compare, LineMovedByLessThanTheToleranceIsTheSame) {
  const Document five = plate_with_lines({5.0});
  const Comparison near = value_of(compare(five, plate_with_lines({6.0})));
  ASSERT_GE(near.tolerance, 1.0);
  expect_alike(near);
  const Document ten = plate_with_lines({10.0});
  const Comparison far = value_of(compare(five, ten));
  EXPECT_DOUBLE_EQ(far.only[0].sharp_length, length_of(five));
  EXPECT_DOUBLE_EQ(far.only[1].sharp_length, length_of(ten));
  EXPECT_EQ(far.only[0].soft_length, 0.0);
}

TEST(Compare, OnlyTheStretchThatDepartsIsNamed) {
  const Document two = plate_with_lines({5.0, 12.0});
  const Comparison comparison = value_of(compare(two, plate_with_lines({12.0})));
  ASSERT_EQ(comparison.only[0].stretches.size(), 1u);
  for (const VertexId v : comparison.only[0].stretches[0])
    EXPECT_NEAR(two.mesh->point(v).x(), 5.0, 1e-9);
}

TEST(Compare, SharpLineIsNotMadeUpForByASoftBoundary) {
  const Document cube = cube_document();
  const std::uint32_t line = cube.lines.lines[0]->id;
  // Without its line the border between the two sides stays where it is, as Gn.
  const Document soft = applied(cube, {"delete_lines", {{"lines", {line}}}});
  const Comparison comparison = value_of(compare(cube, soft));
  EXPECT_GT(comparison.only[0].sharp_length, 0.0);
  EXPECT_EQ(comparison.only[1].soft_length, 0.0) << "but a border where the line was is no news";
  EXPECT_EQ(comparison.divided_otherwise, 0.0);
}

TEST(Compare, ConnectedPartitionsAreDividedOtherwiseByTheSmallerOne) {
  const Document cube = cube_document();
  const std::uint32_t a = cube.partitions.partitions[0]->id;
  std::uint32_t b = 0;
  for (const BoundaryPtr& boundary : *cube.boundaries) {
    if (boundary->left == a && boundary->right != a) b = boundary->right;
    if (boundary->right == a && boundary->left != a) b = boundary->left;
  }
  ASSERT_NE(b, 0u);
  const Document connected = applied(cube, {"connect_partitions", {{"partitions", {a, b}}}});
  const Comparison comparison = value_of(compare(cube, connected));
  EXPECT_NEAR(*comparison.divided_otherwise, 1.0 / 6.0, 1e-9);
  EXPECT_EQ(comparison.partitions.size(), 5u) << "the side taken in stands for nothing";
}

TEST(Compare, ThrownTogetherInEitherOrderIsTheSame) {
  const Document document = document_of(testing::sample_mould(1.0));
  const auto version = [&](double angle) {
    return applied(applied(document, {"find_sharp_lines", {{"angle", angle}}}),
                   {"find_partitions"});
  };
  const Document low = version(15.0), high = version(35.0);
  const Comparison there = value_of(compare(low, high)), back = value_of(compare(high, low));
  EXPECT_GT(there.only[0].sharp_length, 0.0);
  for (const std::size_t side : {0u, 1u}) {
    EXPECT_EQ(there.only[side].stretches, back.only[1 - side].stretches);
    EXPECT_EQ(there.only[side].sharp_length, back.only[1 - side].sharp_length);
  }
  EXPECT_NEAR(*there.divided_otherwise, *back.divided_otherwise, 1e-9);
  EXPECT_LE(there.only[0].sharp_length, length_of(low) * (1.0 + 1e-12));
}

TEST(Compare, VersionsOnDifferentMeshesMeetOnTheScan) {
  // Far fewer vertices on the sides of the cube: nothing is divided otherwise.
  const Document scan = document_of(testing::divided_cube(10.0, 10));
  const Document fine = divided_at_edges(scan);
  const Document coarse = divided_at_edges(
      applied(scan, {"simplify", {{"error_zone", 0.01}, {"max_edge_length", 3.5}}}));
  ASSERT_LT(coarse.mesh->face_count(), fine.mesh->face_count() / 2);
  const Comparison comparison = value_of(compare(fine, coarse));
  expect_alike(comparison);
  EXPECT_EQ(comparison.partitions.size(), 6u);
}

TEST(Compare, WherePartitionsAreNotFoundInBothOnlyLinesCount) {
  const Document cube = cube_document();
  const Document bare = document_of(testing::divided_cube(10.0, 10));
  const Comparison comparison = value_of(compare(cube, bare));
  EXPECT_DOUBLE_EQ(comparison.only[0].sharp_length, length_of(cube));
  EXPECT_EQ(comparison.only[0].soft_length, 0.0);
  EXPECT_FALSE(comparison.divided_otherwise);
}

TEST(Compare, OtherScansAreRefusedInASentence) {
  const Document cube = cube_document();
  const Result<Comparison> other = compare(cube, document_of(testing::cube(3.0)));
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("not of one scan"), std::string::npos);
  EXPECT_FALSE(compare(cube, Document{}));
}

}  // namespace
}  // namespace arris
