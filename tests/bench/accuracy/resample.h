#pragma once

#include "tests/bench/accuracy/solid.h"
#include "tests/support/meshes.h"

namespace arris::accuracy {

/// The surface of a solid as a scanner that sees it from all sides would leave it: a closed mesh of
/// irregular triangles whose edges are about `edge` long in the mean, every vertex on the surface
/// and none on its edges, where triangles cut across as they do in a scan.
///
/// A grid turned against the solid is walked through: one vertex for each cell the surface passes
/// (surface nets), made even and put back on the surface. `low`, `high`: a box around the solid.
/// The same arguments give the same result.
testing::Triangles resample(const Solid& solid, const Point& low, const Point& high, double edge);

}  // namespace arris::accuracy
