#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/partitions/boundaries.h"
#include "core/partitions/partition_surfaces.h"

namespace arris {

/// A Gn boundary along which two areas touch: one normal, and another curvature across it. A fillet
/// is a strip between two such.
struct TangentLine {
  std::size_t boundary = 0;  ///< Its place in the boundaries.
  std::uint32_t fillet = 0;  ///< The partition of the two that is bent the more across it.
  double radius = 0.0;       ///< Of that bend, in the mesh's unit.
  double kink = 0.0;         ///< Angle between both areas along it, degrees.
};

struct TangentLineOptions {
  double reach = 6.0;       // mean edges: faces so far from the boundary are read,
  double rim = 1.0;         // and from here on, where an area is wide enough: nearer ones may be of
                            // the other
  double kink = 3.0;        // degrees: what the noise makes of none,
  double astray = 1.25;     // mean edges that a boundary may lie off the true line: there one area
                            // has turned away from the other, which is no kink,
  double most_kink = 12.0;  // degrees: and at most
  double least_ratio = 1.5;  // of the curvature of the fillet to the other's
  double least_turn = 3.0;   // degrees that the fillet turns within the reach
};

/// The tangent lines among the boundaries, in their order.
///
/// On both sides the turn of the normals about the boundary is a line over the distance from it,
/// least squares over all of its length: its slopes are the curvatures, and where the two miss each
/// other is the kink. That needs no surface that explains the areas; but where `surfaces` (as by
/// fit_partition_surfaces(), or empty) has a radius for the fillet that agrees, it is the better
/// one. Errors: cancelled.
Result<std::vector<TangentLine>> find_tangent_lines(const Mesh& mesh, const Partitions& partitions,
                                                    const Boundaries& boundaries,
                                                    const std::vector<PartitionSurface>& surfaces,
                                                    const TangentLineOptions& options = {},
                                                    const Context& context = {});

}  // namespace arris
