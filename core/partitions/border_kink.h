#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

/// What the normals on both sides of a border between two areas say, summed up along it: a linear
/// regression of their two angles on the distance across and along. Additive.
struct BorderSums {
  struct Side {
    Eigen::Matrix3f gram = Eigen::Matrix3f::Zero();                         // of (1, t, y)
    Eigen::Matrix<float, 3, 2> right = Eigen::Matrix<float, 3, 2>::Zero();  // degrees
  };
  std::array<Side, 2> sides;
  float length = 0.0F;  ///< Mean edges.

  void add(const BorderSums& other);
  /// Seen from the other side: a half turn about the normal.
  BorderSums turned() const;

  /// Degrees (rms) by which one linear field over both sides misses what one for each explains;
  /// 0 where a side has no faces.
  float kink() const;
};

/// Lengths in mean edges.
struct BorderKinkOptions {
  float near = 0.3F;   // across the border, the strip about it that is left out
  float far = 4.0F;    // across the border, where the sides end
  float along = 1.5F;  // reach along the border
};

/// Border edges between areas, with the sums at each: the first side is that of the area with the
/// lower label.
struct BorderPlaces {
  std::vector<EdgeId> edges;       ///< Ascending.
  std::vector<BorderSums> places;  ///< Of each.
};

/// `labels`: per face, its area. `table` has no neighbours over sharp edges; those are no borders.
/// `skipped`: per face, 1 for those not to be read.
BorderPlaces measure_borders(const Mesh& mesh, const FaceTable& table,
                             const std::vector<std::uint32_t>& labels,
                             const std::vector<std::uint8_t>& skipped,
                             const BorderKinkOptions& options);

/// The sums along a path of half-edges between two sides: `side_of(f)` is 0 or 1 for the faces of
/// the one and the other, 2 elsewhere. Places that do not part the two are passed over.
BorderSums measure_path(const Mesh& mesh, const FaceTable& table,
                        const std::vector<HalfEdgeId>& path,
                        const std::function<int(FaceId)>& side_of,
                        const std::vector<std::uint8_t>& skipped, const BorderKinkOptions& options,
                        FaceWindow& window);

/// The kink in degrees without what the noise of the normals (degrees) adds to it over so many
/// faces as the sums read, `most_faces` at most; 0 where the noise explains all of it.
float clear_kink(const BorderSums& sums, const BorderKinkOptions& options, float noise,
                 float most_faces);

}  // namespace arris
