#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris::accuracy {

/// What a solid says of a point: how far its surface is (mm, negative inside; near the surface
/// exact on either side of an edge) and the number of the face of the solid that is nearest.
struct SurfaceValue {
  double distance;
  std::uint32_t face;
};
using Solid = std::function<SurfaceValue(const Point&)>;

/// Everything below the plane through `through`; `normal` points out.
Solid half_space(const Point& through, const Point& normal, std::uint32_t face);
/// The faces towards smaller and larger x, y and z have the numbers `faces`, in this order.
Solid block(const Point& low, const Point& high, const std::array<std::uint32_t, 6>& faces);
Solid ball(const Point& centre, double radius, std::uint32_t face);
/// Endless, about the z axis.
Solid cylinder(double radius, std::uint32_t face);
/// About the z axis, from a circle at z = 0 to a tip at z = `height`; endless below.
Solid cone(double radius, double height, std::uint32_t face);
/// About the z axis.
Solid ring(double major_radius, double minor_radius, std::uint32_t face);

Solid common(std::vector<Solid> solids);
Solid united(std::vector<Solid> solids);
/// Common part of two half spaces at a right angle, their edge rounded by a fillet.
Solid rounded(Solid a, Solid b, double radius, std::uint32_t fillet);

}  // namespace arris::accuracy
