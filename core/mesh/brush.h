#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// The faces a round brush touches: those that reach into the sphere of `radius` about `centre` and
/// hang together with `start` through edges with others that do. So a brush never touches a sheet
/// that is near in space but far on the surface. Ascending; empty where `start` itself is too far.
std::vector<FaceId> faces_within(const Mesh& mesh, FaceId start, const Point& centre,
                                 double radius);

}  // namespace arris
