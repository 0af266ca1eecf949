#include "core/sharp_lines/normal_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/parallel.h"

namespace arris {

using Eigen::Vector3f;

float normal_noise(const Mesh& mesh, const FaceTable& table) {
  if (table.size() == 0) return 0.0F;
  std::vector<Vector3f> at_vertex(mesh.vertex_count(), Vector3f::Zero());
  parallel_for(at_vertex.size(), [&](std::size_t v) {
    mesh.for_ring(static_cast<VertexId>(v), [&](HalfEdgeId h) {
      if (const FaceId f = mesh.face(h); f != no_id)
        at_vertex[v] += table.faces[f].normal * table.faces[f].area;
    });
    if (const float length = at_vertex[v].norm(); length > 0.0F) at_vertex[v] /= length;
  });
  std::vector<float> angles(table.size());
  parallel_for(angles.size(), [&](std::size_t f) {
    const Triangle& t = mesh.triangle(static_cast<FaceId>(f));
    const Vector3f mean = at_vertex[t[0]] + at_vertex[t[1]] + at_vertex[t[2]];
    const Vector3f& n = table.faces[f].normal;
    angles[f] = std::atan2(n.cross(mean).norm(), n.dot(mean));
  });
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle * static_cast<float>(180.0 / std::numbers::pi);
}

std::vector<Vector3f> filter_normals(const Mesh& mesh, const FaceTable& table,
                                     const NormalFilterOptions& options, const Context& context) {
  std::vector<std::uint32_t> starts(table.size() + 1, 0);
  std::vector<FaceId> beside;
  std::vector<float> distance;
  double sum = 0.0;
  for (FaceId f = 0; f < table.size(); ++f) {
    const std::size_t first = beside.size();
    for (const VertexId v : mesh.triangle(f))
      mesh.for_ring(v, [&](HalfEdgeId h) {
        const FaceId g = mesh.face(h);
        if (g != no_id && g != f) beside.push_back(g);
      });
    std::sort(beside.begin() + static_cast<std::ptrdiff_t>(first), beside.end());
    beside.erase(std::unique(beside.begin() + static_cast<std::ptrdiff_t>(first), beside.end()),
                 beside.end());
    for (std::size_t k = first; k < beside.size(); ++k) {
      distance.push_back((table.faces[beside[k]].centre - table.faces[f].centre).norm());
      sum += distance.back();
    }
    starts[f + 1] = static_cast<std::uint32_t>(beside.size());
  }
  const auto spread =
      static_cast<float>(sum / std::max<double>(1.0, static_cast<double>(beside.size())));
  std::vector<float> weight(beside.size());
  parallel_for(weight.size(), [&](std::size_t k) {
    const float d = distance[k] / spread;
    weight[k] = table.faces[beside[k]].area * std::exp(-0.5F * d * d);
  });
  std::vector<Vector3f> normals(table.size()), next(table.size());
  for (std::size_t f = 0; f < normals.size(); ++f) normals[f] = table.faces[f].normal;
  const float likeness2 = 2.0F * options.likeness * options.likeness;
  for (int round = 0; round < options.rounds && !context.cancelled(); ++round) {
    context.report(static_cast<double>(round) / options.rounds, "filtering normals");
    parallel_for(normals.size(), [&](std::size_t f) {
      Vector3f mean = table.faces[f].area * normals[f];
      for (std::uint32_t k = starts[f]; k < starts[f + 1]; ++k) {
        const Vector3f& other = normals[beside[k]];
        mean += weight[k] * std::exp(-(other - normals[f]).squaredNorm() / likeness2) * other;
      }
      const float length = mean.norm();
      next[f] = length > 0.0F ? Vector3f(mean / length) : normals[f];
    });
    normals.swap(next);
  }
  return normals;
}

}  // namespace arris
