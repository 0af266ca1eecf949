#include "core/simplification/working_mesh.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"

namespace arris {

WorkingMesh::WorkingMesh(const Mesh& mesh, const ErrorZones& zones,
                         const ChunkedArray<Origin>& sharp)
    : points_(mesh.points()),
      faces_(mesh.face_count()),
      normals_(mesh.face_count()),
      first_side_(mesh.vertex_count(), no_id),
      next_zone_(mesh.vertex_count(), no_id),
      first_border_zone_(mesh.vertex_count(), no_id),
      flags_(mesh.vertex_count(), 0) {
  set_radii(zones.radii());
  std::vector<SideId> side_of(2 * mesh.edge_count(), no_id);
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    HalfEdgeId h = mesh.face_half_edge(f);
    for (SideId k = 0; k < 3; ++k, h = mesh.next(h)) side_of[h] = 4 * f + k;
  }
  parallel_for(mesh.face_count(), [&](std::size_t i) {
    const FaceId f = static_cast<FaceId>(i);
    Face& face = faces_[f];
    face.vertices = mesh.triangle(f);
    normals_[f] = normal_of(face.vertices[0], face.vertices[1], face.vertices[2]);
    HalfEdgeId h = mesh.face_half_edge(f);
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
      face.twins[k] = side_of[Mesh::opposite(h)];
      if (!sharp.empty() && sharp[h >> 1] != Origin::none) face.sharp |= 1u << k;
    }
  });
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    for (SideId k = 0; k < 3; ++k) {
      const VertexId v = faces_[f].vertices[k];
      vertices_in_mesh_ += first_side_[v] == no_id;
      if (faces_[f].twins[k] == no_id) {
        flags_[v] |= border_flag;
        first_side_[v] = 4 * f + k;
        const EdgeId e = mesh.find_edge(v, faces_[f].vertices[(k + 1) % 3]).value();
        for (const VertexId zone : zones.of_border_edge(e)) add_border_zone(v, zone);
      } else if (!is_border(v)) {
        first_side_[v] = 4 * f + k;
      }
      if (faces_[f].sharp >> k & 1u)
        for (const VertexId end : {v, faces_[f].vertices[(k + 1) % 3]}) flags_[end] |= sharp_flag;
    }
    for (const VertexId zone : zones.of_face(f)) add_zone(f, zone);
  }
  vertices_before_ = vertices_in_mesh_;
}

void WorkingMesh::set_radii(std::vector<double> radii) {
  radii_ = std::move(radii);
  squared_radii_.resize(radii_.size());
  std::ranges::transform(radii_, squared_radii_.begin(), [](double r) { return r * r; });
}

bool WorkingMesh::has_edge(VertexId a, VertexId b) const {
  bool found = false;
  for_neighbours(a, [&](VertexId v) { found = found || v == b; });
  return found;
}

Point WorkingMesh::normal_of(VertexId a, VertexId b, VertexId c) const {
  if (b < a && b < c) return unit_normal(points_[b], points_[c], points_[a]);
  if (c < a && c < b) return unit_normal(points_[c], points_[a], points_[b]);
  return unit_normal(points_[a], points_[b], points_[c]);
}

void WorkingMesh::set_face(FaceId f, VertexId a, VertexId b, VertexId c, const Point& normal) {
  faces_[f] = {{a, b, c}, no_id, {no_id, no_id, no_id}, 0};
  normals_[f] = normal;
}

Result<Prepared> WorkingMesh::finish() const {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> face_starts{0};
  std::vector<VertexId> face_zones;
  const auto append = [&](std::vector<VertexId>& list, VertexId first) {
    const std::size_t begin = list.size();
    for (VertexId v = first; v != no_id; v = next_zone_[v]) list.push_back(v);
    std::sort(list.begin() + static_cast<std::ptrdiff_t>(begin), list.end());
  };
  for (const Face& face : faces_) {
    if (face.vertices[0] == no_id) continue;
    triangles.push_back(face.vertices);
    append(face_zones, face.first_zone);
    face_starts.push_back(static_cast<std::uint32_t>(face_zones.size()));
  }
  Result<MeshPtr> mesh =
      Mesh::create(std::vector<Point>(points_.begin(), points_.end()), std::move(triangles));
  if (!mesh) return tl::unexpected(mesh.error());

  std::vector<EdgeId> border_edges;
  std::vector<std::uint32_t> border_starts{0};
  std::vector<VertexId> border_zones;
  for (EdgeId e = 0; e < (*mesh)->edge_count(); ++e) {
    if (!(*mesh)->is_border_edge(e)) continue;
    const HalfEdgeId inner = (*mesh)->face(2 * e) != no_id ? 2 * e : 2 * e + 1;
    const VertexId first = first_border_zone_[(*mesh)->from(inner)];
    if (first == no_id) continue;
    border_edges.push_back(e);
    append(border_zones, first);
    border_starts.push_back(static_cast<std::uint32_t>(border_zones.size()));
  }
  Prepared result;
  result.mesh = *mesh;
  result.zones = std::make_shared<const ErrorZones>(
      radii_, std::move(face_starts), std::move(face_zones), std::move(border_edges),
      std::move(border_starts), std::move(border_zones));
  result.vertices_before = vertices_before_;
  result.vertices_after = vertices_in_mesh_;
  return result;
}

std::vector<Origin> carry_sharp_edges(const Mesh& from, const ChunkedArray<Origin>& sharp,
                                      const Mesh& to) {
  std::vector<Origin> result(to.edge_count(), Origin::none);
  for (EdgeId e = 0; e < sharp.size(); ++e) {
    if (sharp[e] == Origin::none) continue;
    const std::optional<EdgeId> same = to.find_edge(from.edge(e)[0], from.edge(e)[1]);
    if (same && !to.is_border_edge(*same)) result[*same] = sharp[e];
  }
  return result;
}

}  // namespace arris
