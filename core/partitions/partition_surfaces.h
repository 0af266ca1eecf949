#pragma once

#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/length_unit.h"
#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/partitions/surface_fit.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// The surface that a partition is of, in the mesh's unit, and how far its vertices lie off it.
struct PartitionSurface {
  /// Type free: none of CAD explains it, but maybe a height field of degree four.
  Surface surface;
  bool fitted = false;          ///< Whether any does; the deviations mean nothing otherwise.
  double mean_deviation = 0.0;  ///< Mean distance of the vertices, without sign.
  double max_deviation = 0.0;
  double within = 0.0;     ///< Share of the vertices within `tolerance`, 0 to 1.
  double tolerance = 0.0;  ///< Three times the noise of the scan.
};

/// Fits a surface to each partition listed, in their order, whatever they were found by: least
/// squares of distances and normals over the vertices inside it, those beside lines and other
/// partitions left out where enough others are there. Errors: cancelled.
Result<std::vector<PartitionSurface>> fit_partition_surfaces(const Mesh& mesh,
                                                             const SharpLines& lines,
                                                             const Partitions& partitions,
                                                             const Context& context = {});

/// "R 12.9 mm", "half angle 15°", "R 30, r 3 mm"; empty for planes and free areas.
std::string size_text(const Surface& surface, LengthUnit unit);

}  // namespace arris
