#pragma once

#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// Intervals from the part's own distribution of the criterion (weighted by area, sharp lines and
/// border left out): the areas of low curvature, and what is more curved. They meet at the value
/// that parts the logarithms of the values best into two classes (Otsu's criterion).
std::vector<CurvatureInterval> default_intervals(const Mesh& mesh, const Curvatures& curvatures,
                                                 Criterion criterion, const SharpLines& lines);

/// Faces below which a partition on this part, found by this method, is rather noise than an area.
std::uint32_t default_min_faces(const Mesh& mesh, PartitionMethod method);

/// Faces below which an unassigned area on this part is rather a speck of noise than an area.
std::uint32_t default_fill_holes(const Mesh& mesh);

}  // namespace arris
