#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// Twice the radius of a face's inscribed circle over that of its circumscribed one: 1 for an
/// equilateral triangle, towards 0 for slivers, 0 for one without area.
double face_quality(const Point& a, const Point& b, const Point& c);
double face_quality(const Mesh& mesh, FaceId f);

/// Of each face.
std::vector<double> face_qualities(const Mesh& mesh);

/// Share, 0 to 1, of the corners of all faces whose angle is above `degrees` (0 to 180).
double share_of_angles_above(const Mesh& mesh, double degrees);

}  // namespace arris
