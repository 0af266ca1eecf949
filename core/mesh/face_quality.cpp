#include "core/mesh/face_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"

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

double share_of_angles_above(const Mesh& mesh, double degrees) {
  std::vector<std::uint8_t> counts(mesh.face_count());
  const double limit = degrees * std::numbers::pi / 180.0;
  parallel_for(counts.size(), [&](std::size_t f) {
    const Triangle& t = mesh.triangle(static_cast<FaceId>(f));
    for (std::size_t k = 0; k < 3; ++k) {
      if (corner_angle(mesh.point(t[k]), mesh.point(t[(k + 1) % 3]), mesh.point(t[(k + 2) % 3])) >
          limit)
        ++counts[f];
    }
  });
  if (counts.empty()) return 0.0;
  return std::accumulate(counts.begin(), counts.end(), 0.0) /
         (3.0 * static_cast<double>(counts.size()));
}

}  // namespace arris
