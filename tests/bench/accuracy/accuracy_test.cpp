// How the bench measures, on borders and proposals that can be worked out by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/bench/accuracy/curves.h"
#include "tests/bench/accuracy/proposals.h"
#include "tests/bench/accuracy/score.h"
#include "tests/bench/accuracy/turning.h"
#include "tests/support/documents.h"

namespace arris::accuracy {
namespace {

using namespace arris::testing;

constexpr double pi = std::numbers::pi;
constexpr int side = 40;  // of the lattice, in its edges of 1 mm

Document flat() { return document_of(noisy_plane(side, 1.0, 0.0, 0.0, 1)); }

/// A label for each square of the lattice, by its lower corner.
std::vector<std::uint32_t> by_square(const Mesh& mesh,
                                     const std::function<std::uint32_t(int, int)>& label) {
  std::vector<std::uint32_t> labels;
  for (const Triangle& t : mesh.triangles()) {
    const Point centre = (mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0;
    labels.push_back(
        label(static_cast<int>(std::floor(centre.x())), static_cast<int>(std::floor(centre.y()))));
  }
  return labels;
}

std::vector<std::uint32_t> halves(const Mesh& mesh) {
  return by_square(mesh, [](int x, int) { return x < side / 2 ? 1u : 2u; });
}

Part part_of(const Document& document, std::vector<std::uint32_t> patches) {
  Part part;
  part.scan = document.scan;
  part.truth.patches = std::move(patches);
  part.edge = 1.0;
  part.tolerance = 1.5;
  return part;
}

Score score_of(const Part& part, std::vector<std::uint32_t> labels) {
  Found found;
  found.labels = std::move(labels);
  return value_of(Scorer(part).score(found));
}

TEST(Turning, AStraightBorderAlongTheLatticeDoesNotTurn) {
  const Document document = flat();
  const auto chains =
      chains_of(*document.mesh, edges_between(*document.mesh, halves(*document.mesh)));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].size(), side + 1u);
  const Turning turning = turning_of(chains, 1.0);
  EXPECT_NEAR(turning.raw, 0.0, 1e-9);
  EXPECT_NEAR(turning.smoothed, 0.0, 1e-9);
}

TEST(Turning, AStraightBorderAcrossTheLatticeZigzagsUntilSmoothed) {
  const Document document = flat();
  const auto chains = chains_of(
      *document.mesh, edges_between(*document.mesh, by_square(*document.mesh, [](int x, int y) {
        return x + y < side ? 1u : 2u;
      })));
  ASSERT_EQ(chains.size(), 1u);
  const double edges = static_cast<double>(chains[0].size() - 1);
  const Turning turning = turning_of(chains, 1.0);
  EXPECT_NEAR(turning.raw, 90.0 * (edges - 1.0) / edges, 1e-9);
  EXPECT_LT(turning.smoothed, 0.05 * turning.raw);
}

TEST(Turning, ACircleTurnsOnceRound) {
  constexpr int steps = 60;
  constexpr double radius = 10.0;
  Polyline circle;
  for (int k = 0; k < steps; ++k) {
    const double t = 2.0 * pi * k / steps;
    circle.emplace_back(radius * std::cos(t), radius * std::sin(t), 0.0);
  }
  circle.push_back(circle.front());
  const double length = 2.0 * steps * radius * std::sin(pi / steps);
  const Turning turning = turning_of({circle}, 2.0);
  EXPECT_NEAR(turning.raw, 2.0 * 360.0 / length, 1e-9);
  // A round of averaging shrinks a regular polygon by this factor.
  const double factor = (1.0 + 2.0 * std::cos(2.0 * pi / steps)) / 3.0;
  EXPECT_NEAR(turning.smoothed, turning.raw / std::pow(factor, 4), 1e-9);
}

TEST(Turning, ChainsEndWhereThreeMeetAndShortOnesDoNotCount) {
  const Document document = flat();
  const auto edges = edges_between(*document.mesh, by_square(*document.mesh, [](int x, int y) {
    return x < side / 2 ? 1u : y < 15 ? 2u : 3u;
  }));
  const auto chains = chains_of(*document.mesh, edges);
  EXPECT_EQ(chains.size(), 3u);
  EXPECT_TRUE(std::isnan(turning_of({Polyline(6, Point::Zero())}, 1.0).raw));
  Polyline five;
  for (int k = 0; k <= 5; ++k) five.emplace_back(k, k % 2, 0.0);
  EXPECT_TRUE(std::isnan(turning_of({five}, 1.0).raw));
  const std::vector<Polyline> many(5, five);  // of 5 sqrt(2) mm each
  EXPECT_TRUE(std::isnan(turning_of({five}, 1.0, {.least_edges = 5}).raw));
  EXPECT_NEAR(turning_of(many, 1.0, {.least_edges = 5}).raw, 4.0 * 90.0 / (5.0 * std::sqrt(2.0)),
              1e-9);
}

TEST(Turning, OfBordersThatAreNoLinesAgainstTheTruth) {
  const Document document = flat();
  const Mesh& mesh = *document.mesh;
  const auto stairs = by_square(mesh, [](int x, int y) { return x + y < side ? 1u : 2u; });
  const Part part = part_of(document, stairs);
  EXPECT_NEAR(score_of(part, stairs).partitions.turning, 1.0, 1e-12);
  EXPECT_NEAR(score_of(part, stairs).partitions.smoothed_turning, 1.0, 1e-12);
  EXPECT_NEAR(score_of(part, halves(mesh)).partitions.turning, 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(score_of(part_of(document, halves(mesh)), stairs).partitions.turning))
      << "against a straight border";
  Found lines_only;
  lines_only.labels = stairs;
  lines_only.line_edges = edges_between(mesh, stairs);
  const Score none = value_of(Scorer(part).score(lines_only));
  EXPECT_TRUE(std::isnan(none.partitions.turning));
}

TEST(Partitions, RandIndexAndShares) {
  const Document document = flat();
  const Mesh& mesh = *document.mesh;
  const Part part = part_of(document, halves(mesh));
  const PartitionScore same = score_of(part, halves(mesh)).partitions;
  EXPECT_NEAR(same.rand, 1.0, 1e-12);
  EXPECT_NEAR(same.largest, 0.5, 1e-12);

  const PartitionScore one =
      score_of(part, std::vector<std::uint32_t>(mesh.face_count(), 7)).partitions;
  EXPECT_NEAR(one.rand, 0.5, 1e-12);
  EXPECT_NEAR(one.largest, 1.0, 1e-12);

  const PartitionScore quarters =
      score_of(
          part,
          by_square(mesh, [](int x, int y) { return 1u + 2u * (x < side / 2) + (y < side / 2); }))
          .partitions;
  EXPECT_NEAR(quarters.rand, 0.75, 1e-12);
  EXPECT_NEAR(quarters.largest, 0.25, 1e-12);

  // Each of the faces in no partition stands for itself.
  const PartitionScore half =
      score_of(part, by_square(mesh, [](int x, int) { return x < side / 2 ? 0u : 2u; })).partitions;
  const double faces = static_cast<double>(mesh.face_count()) / 2.0;
  EXPECT_NEAR(half.rand, 0.75 + 0.25 / faces, 1e-12);
  EXPECT_NEAR(half.assigned, 0.5, 1e-12);
}

/// Proposals on the flat lattice, true border at x = 20 and a true curve that parts nothing at
/// x = 8.
class Proposals : public ::testing::Test {
 protected:
  Proposals() : document_(flat()), part_(part_of(document_, halves(*document_.mesh))) {
    part_.truth.curves.push_back(segment({8.0, 0.0, 0.0}, {8.0, side, 0.0}, 15.0, Demand::may));
  }

  VertexId vertex_at(double x, double y) const {
    VertexId nearest = 0;
    for (VertexId v = 0; v < document_.mesh->vertex_count(); ++v)
      if ((document_.mesh->point(v) - Point(x, y, 0.0)).norm() <
          (document_.mesh->point(nearest) - Point(x, y, 0.0)).norm())
        nearest = v;
    return nearest;
  }
  std::vector<VertexId> up(int x, int from, int to) const {
    std::vector<VertexId> path;
    for (int y = from; y <= to; ++y) path.push_back(vertex_at(x, y));
    return path;
  }
  std::optional<bool> leak(std::vector<std::vector<VertexId>> paths) const {
    WorkItem item;
    item.kind = WorkKind::leak;
    item.paths = std::move(paths);
    return ProposalJudge(part_).is_right(document_, item);
  }
  std::optional<bool> loose_end(std::vector<VertexId> path) const {
    WorkItem item;
    item.kind = WorkKind::loose_end;
    item.continuations.emplace_back().vertices = std::move(path);
    return ProposalJudge(part_).is_right(document_, item);
  }

  Document document_;
  Part part_;
};

TEST_F(Proposals, ALeakIsRightAlongTheBorderOfTwoPatches) {
  EXPECT_EQ(leak({up(20, 5, 15)}), true);
  EXPECT_EQ(leak({up(21, 5, 15)}), true) << "an edge beside it";
  EXPECT_EQ(leak({up(30, 5, 15)}), false) << "far from it";
  EXPECT_EQ(leak({up(8, 5, 15)}), false) << "along a curve inside one patch";
}

TEST_F(Proposals, MostOfAllPathsOfALeakMustBeRight) {
  EXPECT_EQ(leak({up(20, 2, 10), up(30, 2, 4)}), true);
  EXPECT_EQ(leak({up(20, 2, 6), up(30, 2, 6)}), false);
}

TEST_F(Proposals, ALooseEndIsRightAlongAnyTrueCurve) {
  EXPECT_EQ(loose_end(up(8, 5, 15)), true);
  EXPECT_EQ(loose_end(up(20, 5, 15)), true);
  EXPECT_EQ(loose_end(up(30, 5, 15)), false);
}

TEST_F(Proposals, WhatProposesNothingOfTheTruthIsNotJudged) {
  WorkItem item;
  item.kind = WorkKind::many_borders;
  item.paths = {up(20, 5, 15)};
  EXPECT_EQ(ProposalJudge(part_).is_right(document_, item), std::nullopt);
  item = {};
  item.kind = WorkKind::loose_end;
  EXPECT_EQ(ProposalJudge(part_).is_right(document_, item), std::nullopt) << "no way on";
  part_.truth.patches.clear();
  EXPECT_EQ(leak({up(20, 5, 15)}), std::nullopt);
}

}  // namespace
}  // namespace arris::accuracy
