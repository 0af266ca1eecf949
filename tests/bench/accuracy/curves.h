#pragma once

#include <cmath>
#include <numbers>

#include "tests/bench/accuracy/part.h"

/// True curves in one line.
namespace arris::accuracy {

inline TrueCurve segment(const Point& a, const Point& b, double angle,
                         Demand demand = Demand::must) {
  return {{a, b}, demand, angle};
}

/// From direction `u` round to direction `v` (at right angles to it), `turns` of a circle.
inline TrueCurve arc(const Point& centre, const Point& u, const Point& v, double radius,
                     double turns, double angle, Demand demand = Demand::must) {
  constexpr double steps_per_turn = 360.0;
  const double steps = std::ceil(steps_per_turn * turns);
  TrueCurve curve{{}, demand, angle};
  for (double k = 0.0; k <= steps; ++k) {
    const double t = 2.0 * std::numbers::pi * turns * k / steps;
    curve.points.push_back(centre + radius * (std::cos(t) * u + std::sin(t) * v));
  }
  return curve;
}

/// Level circle about the z axis.
inline TrueCurve circle(double radius, double z, double angle) {
  return arc({0.0, 0.0, z}, Point::UnitX(), Point::UnitY(), radius, 1.0, angle);
}

/// The twelve edges of a block, in the order: along x, y, z; of each the four by the other two
/// coordinates, low low, high low, low high, high high (the next axis first).
inline std::vector<TrueCurve> block_edges(const Point& low, const Point& high) {
  std::vector<TrueCurve> curves;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side) {
      Point a = low, b = high;
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      a[u] = b[u] = side & 1 ? high[u] : low[u];
      a[v] = b[v] = side & 2 ? high[v] : low[v];
      curves.push_back(segment(a, b, 90.0));
    }
  return curves;
}

}  // namespace arris::accuracy
