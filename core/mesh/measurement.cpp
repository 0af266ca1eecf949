#include "core/mesh/measurement.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace arris {

Measurement measure(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to) {
  Measurement result;
  result.difference = to.point - from.point;
  result.distance = result.difference.norm();
  if (from.face == no_id || to.face == no_id) return result;
  const auto normal = [&](FaceId f) {
    const Triangle& t = mesh.triangle(f);
    const Point& a = mesh.point(t[0]);
    return Point((mesh.point(t[1]) - a).cross(mesh.point(t[2]) - a));
  };
  const Point m = normal(from.face), n = normal(to.face);
  if (m.norm() > 0.0 && n.norm() > 0.0)
    result.angle = std::atan2(m.cross(n).norm(), m.dot(n)) * 180.0 / std::numbers::pi;
  return result;
}

Point mean_normal_at(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  Point sum = Point::Zero();
  for (const VertexId v : vertices) {
    if (v >= mesh.vertex_count()) continue;
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (mesh.face(h) == no_id) return;
      const Triangle& t = mesh.triangle(mesh.face(h));
      sum += (mesh.point(t[1]) - mesh.point(t[0])).cross(mesh.point(t[2]) - mesh.point(t[0]));
    });
  }
  const double length = sum.norm();
  return length > 0.0 ? Point(sum / length) : sum;
}

}  // namespace arris
