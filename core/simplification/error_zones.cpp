#include "core/simplification/error_zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/hash.h"
#include "core/mesh/distance.h"

namespace arris {

ErrorZones ErrorZones::start(const Mesh& mesh, double radius) {
  return {{radius}, std::vector<std::uint32_t>(mesh.face_count() + 1, 0), {}, {}, {0}, {}};
}

ErrorZones::ErrorZones(std::vector<double> radii, std::vector<std::uint32_t> face_starts,
                       std::vector<VertexId> face_zones, std::vector<EdgeId> border_edges,
                       std::vector<std::uint32_t> border_starts, std::vector<VertexId> border_zones)
    : radii_(std::move(radii)),
      face_starts_(std::move(face_starts)),
      face_zones_(std::move(face_zones)),
      border_edges_(std::move(border_edges)),
      border_starts_(std::move(border_starts)),
      border_zones_(std::move(border_zones)) {
  const auto hash = [](const auto& values) {
    return hash_bytes(values.data(), values.size() * sizeof values[0]);
  };
  const std::uint64_t parts[] = {hash(radii_),        hash(face_starts_),   hash(face_zones_),
                                 hash(border_edges_), hash(border_starts_), hash(border_zones_)};
  hash_ = hash_bytes(parts, sizeof parts);
}

double ErrorZones::largest_radius() const { return *std::ranges::max_element(radii_); }

std::span<const VertexId> ErrorZones::of_border_edge(EdgeId e) const {
  const auto found = std::ranges::lower_bound(border_edges_, e);
  if (found == border_edges_.end() || *found != e) return {};
  const std::size_t k = static_cast<std::size_t>(found - border_edges_.begin());
  return {border_zones_.data() + border_starts_[k], border_zones_.data() + border_starts_[k + 1]};
}

Result<void> ErrorZones::check(const Mesh& mesh) const {
  const auto is_vertex = [&](VertexId v) { return v < mesh.vertex_count(); };
  const auto is_border = [&](EdgeId e) { return e < mesh.edge_count() && mesh.is_border_edge(e); };
  if (face_count() != mesh.face_count() ||
      (radii_.size() != 1 && radii_.size() != mesh.vertex_count()) ||
      !std::ranges::all_of(face_zones_, is_vertex) ||
      !std::ranges::all_of(border_zones_, is_vertex) ||
      !std::ranges::all_of(border_edges_, is_border))
    return fail("The error zones belong to another mesh: start again from the scan.");
  return {};
}

std::size_t ErrorZones::bytes() const {
  return 8 * radii_.capacity() +
         4 * (face_starts_.capacity() + face_zones_.capacity() + border_edges_.capacity() +
              border_starts_.capacity() + border_zones_.capacity());
}

std::vector<double> zone_distances(const Mesh& mesh, const ErrorZones& zones) {
  std::vector<double> distances(mesh.vertex_count(), std::numeric_limits<double>::quiet_NaN());
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    for (const VertexId v : t) distances[v] = 0.0;
    for (const VertexId v : zones.of_face(f))
      distances[v] = std::sqrt(squared_distance_to_triangle(mesh.point(v), mesh.point(t[0]),
                                                            mesh.point(t[1]), mesh.point(t[2])));
  }
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_border_edge(e)) continue;
    for (const VertexId v : zones.of_border_edge(e))
      distances[v] = std::sqrt(squared_distance_to_segment(
          mesh.point(v), mesh.point(mesh.edge(e)[0]), mesh.point(mesh.edge(e)[1])));
  }
  return distances;
}

}  // namespace arris
