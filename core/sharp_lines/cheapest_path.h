#pragma once

#include <functional>
#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"

namespace arris {

/// What a path along edges costs (sections 6.3.2 and method.md 5): the length of an edge, less
/// where it is sharp, so that a path drawn by hand snaps to high |IHe|.
struct PathCost {
  double angle = 0.5;   ///< Radians: an edge this sharp costs about a third of its length.
  double least = 0.05;  ///< Share of its length that the sharpest edge still costs, above 0 to 1.
};

/// The cheapest path along edges inside the mesh from one of `sources` to one of `targets` over
/// edges for which `may_use` holds. Vertices from source to target; empty where there is none, or
/// it would be longer than `reach` (mm). Ties go to the lower vertex ids. The cost follows the part
/// of the mesh that is as near as the target.
std::vector<VertexId> cheapest_path(const Mesh& mesh, const Curvatures& curvatures,
                                    const std::vector<VertexId>& sources,
                                    const std::vector<VertexId>& targets, const PathCost& cost,
                                    double reach, const std::function<bool(EdgeId)>& may_use);

}  // namespace arris
