#pragma once

#include <algorithm>
#include <cmath>

#include "core/mesh/mesh.h"

namespace arris {

inline double squared_distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a, to_p = p - a;
  const double length2 = along.squaredNorm();
  if (!(length2 > 0.0)) return to_p.squaredNorm();
  const double share = std::clamp(to_p.dot(along) / length2, 0.0, 1.0);
  return (to_p - share * along).squaredNorm();
}

/// Exact to rounding for any triangle, degenerate ones included.
inline double squared_distance_to_triangle(const Point& p, const Point& a, const Point& b,
                                           const Point& c) {
  const Point ab = b - a, ac = c - a, ap = p - a;
  const Point n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  if (n2 > 0.0 && n.dot(ab.cross(ap)) >= 0.0 && n.dot(ap.cross(ac)) >= 0.0 &&
      n.dot((c - b).cross(p - b)) >= 0.0) {
    const double height = n.dot(ap);
    return height * height / n2;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

/// A triangle made ready for many distance queries.
struct TriangleQuery {
  Point a, b, c;
  Point normal;      ///< Unit.
  Point to_b, to_c;  ///< Dual vectors: their products with p - a are the coordinates of b and c.

  /// `unit_normal`: that of a, b, c, which is not degenerate.
  void set(const Point& a_, const Point& b_, const Point& c_, const Point& unit_normal) {
    a = a_;
    b = b_;
    c = c_;
    normal = unit_normal;
    const Point ab = b - a, ac = c - a;
    to_b = ac.cross(normal);
    to_b /= to_b.dot(ab);
    to_c = normal.cross(ab);
    to_c /= to_c.dot(ac);
  }

  /// True where the foot of p lies in the triangle and within the square root of `radius2`.
  bool is_over(const Point& p, double radius2) const {
    const Point d = p - a;
    const double height = d.dot(normal);
    if (height * height > radius2) return false;
    const double u = d.dot(to_b), v = d.dot(to_c);
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0;
  }

  /// True where the foot of p lies in the triangle, but farther.
  bool is_far_over(const Point& p, double radius2) const {
    const Point d = p - a;
    const double height = d.dot(normal);
    if (height * height <= radius2) return false;
    const double u = d.dot(to_b), v = d.dot(to_c);
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0;
  }

  double squared_distance(const Point& p) const { return squared_distance_to_triangle(p, a, b, c); }
};

}  // namespace arris
