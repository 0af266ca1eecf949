#pragma once

#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/line_regions.h"
#include "core/sharp_lines/normal_jump.h"

namespace arris {

struct ExactCreaseOptions {
  float least_angle = 5.0F;  // degrees: less is not asked for
  float flat = 0.1F;         // degrees: the exterior angle of an edge within a flat or ruled face
  float flat_share = 0.2F;   // of the edges about a crease of a mesh without noise are flat
  float group_flat_share = 0.15F;  // the same within two edges of a group of creases, on the mean
  // The jump over the window is the angle of the edge itself, within these shares of it: more, and
  // the edge is one of several over which a cut corner turns; less, and a curved face turns there.
  float most_jump = 1.4F;
  float least_jump = 0.3F;
  float most_facet = 60.0F;   // degrees: no curved face is tessellated as coarsely as that
  float most_beyond = 0.4F;   // share of a group of creases over which the jump may be more
  float least_length = 3.0F;  // mean edges: of a group of creases, unless its faces are large
};

/// The edges at which a mesh without noise turns all at once: there the exterior angle is exact,
/// and windows would only blur it. Decided place by place, so that a mesh may be clean here and
/// noisy there: about such an edge there are edges with no angle at all, which no noisy mesh has.
/// Degrees, convex positive; by increasing edge.
std::vector<BorderEdge> find_exact_creases(const Mesh& mesh, const std::vector<float>& beta,
                                           const FaceTable& table, const NormalJump& jump,
                                           const ExactCreaseOptions& options);

/// Takes the exact creases over: borders found by windows within two edges of one go.
std::vector<BorderEdge> merge_creases(const Mesh& mesh, const std::vector<BorderEdge>& borders,
                                      std::vector<BorderEdge> creases);

}  // namespace arris
