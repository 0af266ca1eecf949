#include "tests/bench/accuracy/narrow.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/parallel.h"
#include "tests/bench/accuracy/kd_tree.h"

namespace arris::accuracy {

namespace {

/// The value below which a share of 0.95 of them lies, between neighbours by a straight line.
double percentile_95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double place = 0.95 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

/// Centres of the faces on surfaces whose every part lies within `width` of their border: too
/// narrow for the scan to show.
std::vector<Point> narrow_centres(const Mesh& mesh, const std::vector<std::uint32_t>& surfaces,
                                  double width) {
  std::map<std::uint32_t, std::vector<FaceId>> faces_of;
  for (FaceId f = 0; f < surfaces.size(); ++f) faces_of[surfaces[f]].push_back(f);
  // A vertex lies on a border of each surface round it where there is more than one.
  std::vector<char> shared(mesh.vertex_count(), 0);
  std::vector<std::uint32_t> first(mesh.vertex_count(), no_id);
  for (FaceId f = 0; f < surfaces.size(); ++f)
    for (const VertexId v : mesh.triangle(f)) {
      if (first[v] == no_id) first[v] = f;
      if (surfaces[first[v]] != surfaces[f]) shared[v] = 1;
    }
  std::vector<Point> result;
  for (const auto& [surface, faces] : faces_of) {
    std::vector<VertexId> border;
    std::vector<Point> centres;
    for (const FaceId f : faces) {
      const Triangle& t = mesh.triangle(f);
      for (const VertexId v : t)
        if (shared[v]) border.push_back(v);
      centres.push_back((mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0);
    }
    if (border.empty()) continue;
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    std::vector<Point> points;
    for (const VertexId v : border) points.push_back(mesh.point(v));
    const KdTree tree(std::move(points));
    std::vector<double> distances(centres.size());
    parallel_for(centres.size(),
                 [&](std::size_t i) { distances[i] = tree.nearest(centres[i]).distance; });
    if (percentile_95(std::move(distances)) < width)
      result.insert(result.end(), centres.begin(), centres.end());
  }
  return result;
}

}  // namespace

std::vector<Point> narrow_centres(const Part& part) {
  if (part.truth.surfaces.empty()) return {};
  return narrow_centres(*part.scan->mesh, part.truth.surfaces, part.tolerance);
}

}  // namespace arris::accuracy
