#pragma once

#include <span>

#include "core/mesh/mesh.h"

namespace arris {

/// The step from one coordinate to the next that a file could hold where the part lies farthest
/// from the origin, judged by the coordinates themselves: that of 32-bit numbers where all of them
/// are such (also those written as text with seven to nine digits), else that of the last of the
/// decimal digits with which they are written; 0 where they have the digits of 64-bit numbers.
/// Looks at some thousands of points, evenly chosen; non-finite ones do not count.
double coordinate_step(std::span<const Point> points);

}  // namespace arris
