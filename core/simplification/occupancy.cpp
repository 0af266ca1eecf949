#include "core/simplification/occupancy.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/distance.h"

namespace arris {

namespace {

/// The larger share goes first, then the smaller vertex id, whatever the order of the calls.
void take_worse(FaceOccupancy& worst, const FaceOccupancy& other) {
  if (other.worst == no_id) return;
  if (worst.worst == no_id || other.share > worst.share ||
      (other.share == worst.share && other.worst < worst.worst))
    worst = other;
}

FaceOccupancy of_zone(const ErrorZones& zones, VertexId v, double squared_distance) {
  const double distance = std::sqrt(squared_distance);
  const double radius = zones.radius(v);
  return {distance > 0.0 ? distance / radius : 0.0, v, distance, radius};
}

}  // namespace

FaceOccupancy occupancy_of_face(const Mesh& mesh, const ErrorZones& zones, FaceId f) {
  const Triangle& t = mesh.triangle(f);
  const Point &a = mesh.point(t[0]), &b = mesh.point(t[1]), &c = mesh.point(t[2]);
  FaceOccupancy result;
  for (const VertexId v : zones.of_face(f))
    take_worse(result, of_zone(zones, v, squared_distance_to_triangle(mesh.point(v), a, b, c)));
  HalfEdgeId h = mesh.face_half_edge(f);
  for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
    if (mesh.face(Mesh::opposite(h)) != no_id) continue;
    for (const VertexId v : zones.of_border_edge(h >> 1))
      take_worse(result,
                 of_zone(zones, v,
                         squared_distance_to_segment(mesh.point(v), mesh.point(mesh.from(h)),
                                                     mesh.point(mesh.to(h)))));
  }
  return result;
}

Occupancy occupancy_of(const Mesh& mesh, const ErrorZones& zones) {
  std::vector<FaceOccupancy> faces(mesh.face_count());
  parallel_for(faces.size(), [&](std::size_t f) {
    faces[f] = occupancy_of_face(mesh, zones, static_cast<FaceId>(f));
  });
  Occupancy result;
  result.shares.reserve(faces.size());
  for (const FaceOccupancy& face : faces) {
    result.shares.push_back(face.share);
    take_worse(result.worst, face);
  }
  return result;
}

}  // namespace arris
