#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// A height field and the part of the plane it is wanted over.
struct HeightField {
  std::function<double(const Eigen::Vector2d&)> height;
  std::function<bool(const Eigen::Vector2d&)> inside;  ///< One piece without holes.
  Eigen::Vector2d low, high;                           ///< A box around what is inside.
};

struct ScannedSurface {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

/// Points on the surface as a scanner would leave them and an irregular triangulation: no two
/// points nearer than `spacing` in space and no gap a point would fit in (walls are as dense as
/// flats), triangulated by Delaunay in the plane and then by swaps that make the largest angle in
/// space smaller. One component, one border loop, no fold (every face looks up), no vertex without
/// a face. Vertices are numbered in rows along x. The same arguments give the same result.
ScannedSurface scan_height_field(const HeightField& field, double spacing, std::uint64_t seed);

}  // namespace arris
