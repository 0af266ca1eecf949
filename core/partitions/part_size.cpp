#include "core/partitions/part_size.h"

#include <cmath>

#include "core/mesh/geometry.h"

namespace arris {

double part_size(const Mesh& mesh) {
  double area = 0.0;
  for (FaceId f = 0; f < mesh.face_count(); ++f) area += face_area(mesh, f);
  return area > 0.0 ? std::sqrt(area) / mesh.mean_edge_length() : 0.0;
}

}  // namespace arris
