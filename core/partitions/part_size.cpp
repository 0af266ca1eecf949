#include "core/partitions/part_size.h"

#include <cmath>

namespace arris {

double part_size(const Mesh& mesh) {
  return mesh.area() > 0.0 ? std::sqrt(mesh.area()) / mesh.mean_edge_length() : 0.0;
}

}  // namespace arris
