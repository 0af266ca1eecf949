#include "tests/bench/accuracy/solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arris::accuracy {

Solid half_space(const Point& through, const Point& normal, std::uint32_t face) {
  const Point unit = normal.normalized();
  const double offset = unit.dot(through);
  return [=](const Point& p) { return SurfaceValue{unit.dot(p) - offset, face}; };
}

Solid block(const Point& low, const Point& high, const std::array<std::uint32_t, 6>& faces) {
  return [=](const Point& p) {
    SurfaceValue value{low.x() - p.x(), faces[0]};
    for (int axis = 0; axis < 3; ++axis) {
      const double below = low[axis] - p[axis], above = p[axis] - high[axis];
      if (below > value.distance) value = {below, faces[2 * axis]};
      if (above > value.distance) value = {above, faces[2 * axis + 1]};
    }
    return value;
  };
}

Solid ball(const Point& centre, double radius, std::uint32_t face) {
  return [=](const Point& p) { return SurfaceValue{(p - centre).norm() - radius, face}; };
}

Solid cylinder(double radius, std::uint32_t face) {
  return [=](const Point& p) { return SurfaceValue{p.head<2>().norm() - radius, face}; };
}

Solid cone(double radius, double height, std::uint32_t face) {
  const double slant = std::hypot(radius, height);
  return [=](const Point& p) {
    const double across = (p.head<2>().norm() * height + (p.z() - height) * radius) / slant;
    return SurfaceValue{across, face};
  };
}

Solid ring(double major_radius, double minor_radius, std::uint32_t face) {
  return [=](const Point& p) {
    const double aside = p.head<2>().norm() - major_radius;
    return SurfaceValue{std::hypot(aside, p.z()) - minor_radius, face};
  };
}

Solid common(std::vector<Solid> solids) {
  return [solids = std::move(solids)](const Point& p) {
    SurfaceValue value = solids.front()(p);
    for (std::size_t k = 1; k < solids.size(); ++k)
      if (const SurfaceValue other = solids[k](p); other.distance > value.distance) value = other;
    return value;
  };
}

Solid united(std::vector<Solid> solids) {
  return [solids = std::move(solids)](const Point& p) {
    SurfaceValue value = solids.front()(p);
    for (std::size_t k = 1; k < solids.size(); ++k)
      if (const SurfaceValue other = solids[k](p); other.distance < value.distance) value = other;
    return value;
  };
}

Solid rounded(Solid a, Solid b, double radius, std::uint32_t fillet) {
  return [a = std::move(a), b = std::move(b), radius, fillet](const Point& p) {
    const SurfaceValue first = a(p), second = b(p);
    const double u = first.distance + radius, v = second.distance + radius;
    if (u > 0.0 && v > 0.0) return SurfaceValue{std::hypot(u, v) - radius, fillet};
    return first.distance > second.distance ? first : second;
  };
}

}  // namespace arris::accuracy
