#pragma once

#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/partitions/sides.h"
#include "core/sharp_lines/lines.h"

/// Cuts that leave no more than four sides (the paper's further work).
namespace arris {

struct FourSidedOptions {
  SideOptions sides;
  /// An edge costs so many times its length more where the bend of the surface (the root of Kabs,
  /// times the length of the edge) changes along it by 1, and less as the square of that: cuts keep
  /// to where the surface is even.
  double curvature = 1.0;
  /// A cut of length c off a border of length b (the shorter way round between its ends) costs
  /// 1 + balance q / (1 - q) times more, q = (c / b)^2: short beside what it cuts off on both
  /// sides, and so far from running along the border.
  double balance = 1.0;
  double longest = 0.9;  ///< Highest c / b of a cut; a corner of 120 degrees cut off has 0.87.
  /// Other corners looked at from each, the nearest first; all of them where these do not do.
  std::size_t partners = 12;
  /// Corners looked at on each loop for the cuts to a hole, and half as many places between them.
  std::size_t hole_ends = 12;
};

/// One cut: what cut_off() takes, and what it draws.
struct FourSidedCut {
  /// From the border to the border. One that opens a hole goes in to it, round it along its border
  /// and out again.
  std::vector<VertexId> path;
  std::vector<std::vector<VertexId>> strokes;  ///< The new borders: one, or two to a hole.
  double length = 0.0;                         ///< mm, of the strokes.
};

struct FourSidedPlan {
  /// In the order in which they are made; each lies in one piece of those before it.
  std::vector<FourSidedCut> cuts;
  std::string obstacle;  ///< Why a piece keeps more than four sides; empty: none does.
};

/// Proposes cuts for one partition so that each piece has at most four sides.
///
/// A disc with n > 4 corners is cut between corners: of all ways to part its outline into pieces of
/// three or four sides the cheapest (a dynamic programme over the pairs of corners; a cut costs the
/// cheapest path through the inside, by length and curvature, and its balance). Where no pair of
/// corners does, a cut runs from a corner to a point of a side. A partition with holes is first
/// given two cuts from the longest of them to the outer loop, as opposite as is cheap, at corners
/// where there are any; a ring with none thereby becomes two pieces of four sides. Paths run over
/// edges inside the partition, touch its border at their ends only, and cross no sharp line.
///
/// A cut is kept only if counting the sides of what it leaves says that it is better than before.
/// Equal costs are broken by the order of corners and vertices; costs are whole numbers of a
/// millionth of a mean edge, so that neither the unit nor the order of a sum decides. Worked out
/// at a cost that follows the partition. Errors: cancelled.
Result<FourSidedPlan> four_sided_cuts(const Mesh& mesh, const Curvatures& curvatures,
                                      const SharpLines& lines, const Partitions& partitions,
                                      const Partition& partition,
                                      const FourSidedOptions& options = {},
                                      const Context& context = {});

/// The partition that a path of four_sided_cuts() or split_partition lies in; 0: none.
std::uint32_t partition_along(const Mesh& mesh, const Partitions& partitions,
                              const std::vector<VertexId>& path);

}  // namespace arris
