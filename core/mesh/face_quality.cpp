#include "core/mesh/face_quality.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/base/parallel.h"

namespace arris {

double face_quality(const Point& a, const Point& b, const Point& c) {
  // With sides x, y, z and area A: r = 2 A / (x + y + z) and R = x y z / (4 A). Taken in units of
  // the largest coordinate, so that no size of mesh overflows or vanishes.
  const double unit =
      std::max((b - a).lpNorm<Eigen::Infinity>(), (c - a).lpNorm<Eigen::Infinity>());
  if (!(unit > 0.0)) return 0.0;
  const Point ab = (b - a) / unit, ac = (c - a) / unit;
  const double x = ab.norm(), y = ac.norm(), z = (ac - ab).norm();
  const double product = x * y * z;
  if (!(product > 0.0)) return 0.0;
  return std::min(4.0 * ab.cross(ac).squaredNorm() / ((x + y + z) * product), 1.0);
}

double face_quality(const Mesh& mesh, FaceId f) {
  const Triangle& t = mesh.triangle(f);
  return face_quality(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]));
}

std::vector<double> face_qualities(const Mesh& mesh) {
  std::vector<double> qualities(mesh.face_count());
  parallel_for(qualities.size(),
               [&](std::size_t f) { qualities[f] = face_quality(mesh, static_cast<FaceId>(f)); });
  return qualities;
}

}  // namespace arris
