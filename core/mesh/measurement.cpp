#include "core/mesh/measurement.h"

#include <cmath>
#include <numbers>

#include "core/mesh/geometry.h"

namespace arris {

Measurement measure(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to) {
  Measurement result;
  result.difference = to.point - from.point;
  result.distance = result.difference.norm();
  if (from.face == no_id || to.face == no_id) return result;
  const Point m = area_normal(mesh, from.face), n = area_normal(mesh, to.face);
  if (m.norm() > 0.0 && n.norm() > 0.0)
    result.angle = std::atan2(m.cross(n).norm(), m.dot(n)) * 180.0 / std::numbers::pi;
  return result;
}

Point mean_normal_at(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  Point sum = Point::Zero();
  for (const VertexId v : vertices) {
    if (v >= mesh.vertex_count()) continue;
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (mesh.face(h) != no_id) sum += area_normal(mesh, mesh.face(h));
    });
  }
  const double length = sum.norm();
  return length > 0.0 ? Point(sum / length) : sum;
}

}  // namespace arris
