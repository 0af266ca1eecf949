#pragma once

#include "core/mesh/mesh.h"

namespace arris {

/// The root of a part's area in mean edges: about how many edges lie across it. 0 without area.
/// What is large on a part (a radius that reads as flat, a blend) is so whatever the scan's
/// density: such lengths are given for the usual size and scaled by the part's to it.
double part_size(const Mesh& mesh);

constexpr double usual_part_size = 155.0;

}  // namespace arris
