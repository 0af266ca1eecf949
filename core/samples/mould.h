#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

struct MouldOptions {
  /// mm, 0.1 to 5 (others count as the nearest): the default gives about 25,000 faces, like the
  /// paper's ski-boot part. No edge is under 0.86 of it, the mean is about 1.2 of it.
  double edge_length = 0.92;
  double noise = 0.05;     // mm; standard deviation of the sensor noise
  std::uint64_t seed = 1;  // of the noise, the ragged border and the jitter of the points
};

/// A line of the sample that is truly sharp (or a border of a blend), as a dense polyline.
struct TrueLine {
  std::string name;
  std::vector<Point> points;
  bool closed = false;
  /// Exterior angle in degrees where it is largest; positive: convex. 0 for the border of a blend.
  /// A line that fades out ends where it falls below 10 degrees.
  double angle = 0.0;
  bool fillet = false;  ///< True for the border of a blend (tangent-continuous), not a sharp line.
};

/// The sample mould with what is true of it.
struct SampleMould {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> face_areas;  ///< For each face the number of the area it belongs to.
  std::vector<std::string> area_names;    ///< Area k is area_names[k].
  std::vector<TrueLine> lines;
  /// For each vertex the index of the true sharp line it lies nearest to within half an edge, or
  /// -1.
  std::vector<std::int32_t> vertex_lines;
};

/// The sample: an open free-form mould part of about 108 x 104 x 21 mm with a raised boss with
/// draft walls (sharp edges at its foot), a concave oval line with a small radius, fillets of 2 to
/// 6 mm, a step that fades out, a ragged border, and sensor noise. The same options give the same
/// bytes.
SampleMould make_mould(const MouldOptions& options = {});

}  // namespace arris
