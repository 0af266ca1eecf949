#pragma once

#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// The automatic treatments of section 6.3.1. Each takes and changes one Origin per edge.

/// Of two lines of the same sign that run side by side, at most `distance` edges apart over most of
/// the length of the weaker, the weaker goes. Lines of opposite sign are a small step and both
/// stay.
void remove_parallel_lines(const Mesh& mesh, const Curvatures& curvatures, int distance,
                           std::vector<Origin>& edges);

/// Joins pairs of loose ends no farther apart than `gap` (mm) by the shortest path on the mesh,
/// where the lines point towards each other. The new edges have origin `merged`.
void bridge_gaps(const Mesh& mesh, const Curvatures& curvatures, double gap,
                 std::vector<Origin>& edges);

/// Lines that touch no other line (on the border counts as touching nothing) and are shorter than
/// `min_length` (mm) go; so do connected groups of lines with less than that in all.
void remove_short_lines(const Mesh& mesh, const Curvatures& curvatures, double min_length,
                        std::vector<Origin>& edges);

}  // namespace arris
