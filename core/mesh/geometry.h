#pragma once

#include <cmath>
#include <numbers>

#include "core/mesh/mesh.h"

namespace arris {

/// Degrees of a radian, in the precision of what is told in them.
template <class Real>
inline constexpr Real in_degrees = static_cast<Real>(180.0 / std::numbers::pi);
/// Radians of a degree.
template <class Real>
inline constexpr Real in_radians = static_cast<Real>(std::numbers::pi / 180.0);

/// The normal of a face, as long as twice its area (mm^2).
inline Point area_normal(const Mesh& mesh, FaceId f) {
  const Triangle& t = mesh.triangle(f);
  return (mesh.point(t[1]) - mesh.point(t[0])).cross(mesh.point(t[2]) - mesh.point(t[0]));
}

inline double face_area(const Mesh& mesh, FaceId f) { return 0.5 * area_normal(mesh, f).norm(); }

/// Unit normal of a triangle, zero where it has none. Bit for bit the same whichever corner comes
/// first if the smallest vertex id is passed as `a`.
inline Point unit_normal(const Point& a, const Point& b, const Point& c) {
  const Point n = (b - a).cross(c - a);
  const double length = n.norm();
  return length > 0.0 ? Point(n / length) : Point(Point::Zero());
}

/// Of a face, from its corners in their order.
inline Point unit_normal(const Mesh& mesh, FaceId f) {
  const Triangle& t = mesh.triangle(f);
  return unit_normal(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]));
}

/// Cross products this small beside the squared lengths they come from are rounding.
inline constexpr double cross_rounding = 1e-12;

/// Interior angle of the triangle p, a, b at p, in radians, by atan2 (exact to rounding at any
/// angle; 0 for a point).
inline double corner_angle(const Point& p, const Point& a, const Point& b) {
  const Point u = a - p, w = b - p;
  return std::atan2(u.cross(w).norm(), u.dot(w));
}

/// Angle in radians, 0 to pi, between unit vectors; exact to rounding at any angle, symmetric bit
/// for bit.
inline double angle_between(const Point& m, const Point& n) {
  const double z = 0.25 * (m - n).squaredNorm();  // sin^2 of half the angle
  if (z > 0.25) return 2.0 * std::atan2((m - n).norm(), (m + n).norm());
  // asin(x) for x <= 1/2 by the rational function of Cephes (Moshier): most angles are small, and
  // this is the inner loop of every phase.
  const double numerator = ((((4.253011369004428248960e-3 * z - 6.019598008014123785661e-1) * z +
                              5.444622390564711410273e0) *
                                 z -
                             1.626247967210700244449e1) *
                                z +
                            1.956261983317594739197e1) *
                               z -
                           8.198089802484824371615e0;
  const double denominator =
      ((((z - 1.474091372988853791896e1) * z + 7.049610280856842141659e1) * z -
        1.471791292232726029859e2) *
           z +
       1.395105614657485689735e2) *
          z -
      4.918853881490881290097e1;
  const double x = std::sqrt(z);
  return 2.0 * (x + x * z * numerator / denominator);
}

}  // namespace arris
