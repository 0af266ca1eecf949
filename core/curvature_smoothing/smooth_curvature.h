#pragma once

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// Section 4.4. Curvature is smoothed, never a position.
struct SmoothCurvatureOptions {
  int passes = 3;  // of eq. 20 over the whole part, 1 to 100
};

/// K, H, Kabs and the invariants of each vertex off sharp lines and off the border as the mean over
/// its two-ring, weighted by 1/distance (eq. 20), the vertex itself weighing as much as its nearest
/// neighbour. Neighbours on a sharp line or the border are left out and the ring is not grown
/// through them: no value leaks across a line. IHe and shapes stay as they are. Errors: cancelled.
Result<CurvaturesPtr> smooth_curvatures(const Mesh& mesh, const Curvatures& curvatures,
                                        const SharpLines& lines,
                                        const SmoothCurvatureOptions& options = {},
                                        const Context& context = {});

}  // namespace arris
