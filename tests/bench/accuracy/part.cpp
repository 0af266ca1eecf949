#include "tests/bench/accuracy/part.h"

#include <utility>

namespace arris::accuracy {

double mean_inner_edge(const Mesh& mesh) {
  double sum = 0.0;
  std::size_t count = 0;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.is_border_edge(e)) continue;
    sum += mesh.edge_length(e);
    ++count;
  }
  return sum / static_cast<double>(count);
}

Result<ScanPtr> scan_of(std::vector<Point> points, const std::vector<Triangle>& triangles) {
  PolygonFile file;
  file.format = "PLY";
  file.points = std::move(points);
  file.starts.push_back(0);
  for (const Triangle& t : triangles) {
    file.corners.insert(file.corners.end(), t.begin(), t.end());
    file.starts.push_back(file.corners.size());
  }
  return make_scan(std::move(file), "memory");
}

}  // namespace arris::accuracy
