#include "core/edge_swapping/equilateralize.h"

#include <algorithm>
#include <cmath>

namespace arris {

namespace {

/// Cosine of the largest angle of a triangle; bit for bit the same whichever corner comes first.
double largest_angle_cosine(const Point& a, const Point& b, const Point& c) {
  const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
  // The law of cosines at the corner opposite the longest side.
  const double longest = std::max({ab, bc, ca});
  const double least = std::min({ab, bc, ca});
  const double middle = std::max(std::min(ab, bc), std::min(std::max(ab, bc), ca));
  if (!(least > 0.0)) return -1.0;
  return (least + middle - longest) / (2.0 * std::sqrt(least * middle));
}

/// Cosines are compared, which fall where angles grow: values that depend on the face alone, so
/// that the list of all of them falls exactly, without a least gain.
SwapEngine::Values largest_angle(const WorkingMesh& mesh, const SwapCase& s) {
  const Point &a = mesh.point(s.a), &b = mesh.point(s.b);
  const Point &c = mesh.point(s.c), &d = mesh.point(s.d);
  const double before = std::min(largest_angle_cosine(a, b, c), largest_angle_cosine(b, a, d));
  const double after = std::min(largest_angle_cosine(a, d, c), largest_angle_cosine(d, b, c));
  return {-before, -after, after > before};
}

}  // namespace

Result<Prepared> equilateralize(const Mesh& mesh, const ErrorZonesPtr& zones,
                                const ChunkedArray<Origin>& sharp, const SwapOptions& options,
                                const Context& context) {
  return run_swaps(mesh, zones, sharp, largest_angle, false, options, context,
                   "equilateralisation");
}

}  // namespace arris
