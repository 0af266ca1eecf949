#pragma once

#include <vector>

#include "core/mesh/mesh.h"
#include "core/simplification/error_zones.h"

namespace arris {

/// How far a face uses up the error zones it answers for.
struct FaceOccupancy {
  double share = 0.0;      ///< Largest distance over radius, 0 to 1; 0 where it answers for none.
  VertexId worst = no_id;  ///< The initial vertex with that share; no_id where there is none.
  double distance = 0.0;   ///< Of `worst` from the surface, mm.
  double radius = 0.0;     ///< Of the zone of `worst`, mm.
};

/// Of one face, the vertices of its border edges among them.
FaceOccupancy occupancy_of_face(const Mesh& mesh, const ErrorZones& zones, FaceId f);

struct Occupancy {
  std::vector<double> shares;  ///< Of each face.
  FaceOccupancy worst;         ///< Of all faces; of equal ones the least vertex id.
};

/// Of all faces. `zones` are those of `mesh`.
Occupancy occupancy_of(const Mesh& mesh, const ErrorZones& zones);

}  // namespace arris
