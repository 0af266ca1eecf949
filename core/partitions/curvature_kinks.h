#pragma once

#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

/// Lengths in mean edges.
struct CurvatureKinkOptions {
  float across = 2.8F;       // across the kink, where the sides end
  float along = 3.0F;        // spread of the weights along it
  float spread = 1.2F;       // of the weights that tell where "across" is
  float ridge = 0.02F;       // holds slopes down where the faces of a side lie at one distance
  float least_slant = 0.6F;  // cosine across the kink from which an edge counts as lying along it
};

/// Where the curvature changes at once: the foot of a fillet, a plane that becomes a cylinder.
struct CurvatureKinks {
  /// Degrees, 0 or more, per edge: by how much (rms over a window) one normal field that is linear
  /// over the surface misses what one such field for each side of the edge explains.
  std::vector<float> at_edge;
  /// Degrees: what the two fields still miss, for one of the two angles of a normal (median).
  float noise = 0.0F;
};

/// `table`: of the mesh, with no neighbours over sharp edges, which windows do not cross.
/// `skipped`: per face, 1 for those that are not to be read (rounded by a sharp line). Errors:
/// cancelled.
Result<CurvatureKinks> measure_curvature_kinks(const Mesh& mesh, const FaceTable& table,
                                               const std::vector<std::uint8_t>& skipped,
                                               const CurvatureKinkOptions& options,
                                               const Context& context);

}  // namespace arris
