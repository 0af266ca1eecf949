#pragma once

#include <optional>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// A point on the surface, and the face it lies on (no_id: none known).
struct SurfacePoint {
  Point point = Point::Zero();
  FaceId face = no_id;
};

/// What can be measured between two points of a part.
struct Measurement {
  double distance = 0.0;             ///< Mesh unit.
  Point difference = Point::Zero();  ///< From the first to the second point.
  std::optional<double> angle;  ///< Between the outward normals of the faces, 0 to 180 degrees.
};

/// Without an angle where a face is not known or has no area.
Measurement measure(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to);

/// Where the surface faces at these vertices: the mean of the normals of the faces round them,
/// weighted by area, as a unit vector; zero where they cancel out. Vertices that the mesh does not
/// have are passed over.
Point mean_normal_at(const Mesh& mesh, const std::vector<VertexId>& vertices);

}  // namespace arris
