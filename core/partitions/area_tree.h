#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/partitions/area_borders.h"
#include "core/partitions/area_joining.h"
#include "core/partitions/curvature_kinks.h"
#include "core/partitions/partitions.h"
#include "core/partitions/smallest_areas.h"
#include "core/partitions/surface_fit.h"
#include "core/partitions/surface_growing.h"
#include "core/sharp_lines/lines.h"

namespace arris {

struct AreaTreeOptions {
  SmallestAreaOptions smallest;
  CurvatureKinkOptions kinks;
  int growths = 6;           // rounds of growing surfaces, at most: they end
  double settled = 0.03;     // when the noise changes by less than this share of it
  double most_drift = 3.0;   // distances over whole surfaces to those over a few edges
  double most_spread = 1.5;  // and angles: above, surfaces have run into one another
  float inner = 0.3F;        // height up to which the pieces of one surface are joined
  SurfaceGrowingOptions growing;
  int grain = 8;            // faces that make one sample of an area, more on fine scans
  float distance = 0.01F;   // least noise of a sample along the normal, mean edges
  float angle = 0.3F;       // and across, degrees
  double face_noise = 1.5;  // distance of a face over that of a sample
  AreaJoiningOptions joining;
  AreaBorderOptions borders;
};

/// The smallest areas of a tree, joined up to some height.
struct Areas {
  std::vector<std::uint32_t> of_piece;  ///< Numbers from 0, by their lowest face.
  /// Of each: mean edges, about the middle of the box; type free where none explains it.
  std::vector<FittedSurface> surfaces;
};

/// Areas of a mesh at every level of detail at once: the smallest ones, and in which order they are
/// joined. Their borders lie already where those of the usual height settle, and between their
/// pieces where the pieces' do, so that a cut only puts pieces together.
struct AreaTree {
  std::vector<std::array<FaceId, 3>> neighbours;  ///< Of each face, none over lines.
  std::vector<std::uint8_t> banded;               ///< Per face: 1 where a line rounds it.
  std::vector<std::uint32_t> of_face;             ///< Per face: its smallest area.
  /// A smallest area; connected.
  struct Piece {
    FittedSurface surface;
    std::vector<FaceId> faces;  ///< Ascending; none where it was taken up by those beside it.
    double area = 0.0;          ///< In the square of the mesh's unit.
    /// Those it meets not only over lines, and the length of border, mean edges.
    std::vector<std::pair<std::uint32_t, float>> beside;
  };
  std::vector<Piece> pieces;
  std::vector<AreaJoin> joins;  ///< Of pieces, by increasing height.
  SurfaceNoise noise;           ///< Of the samples that were fitted.
  SurfaceNoise face_noise;      ///< Of a face.

  std::size_t bytes() const;
  /// Joined up to `height`, and no area under `least` faces unless lines enclose it.
  Areas cut(float height, std::uint32_t least) const;
  /// Of each face.
  std::vector<std::uint32_t> by_face(const Areas& areas) const;
};

/// Errors: cancelled.
Result<AreaTree> grow_area_tree(const Mesh& mesh, const SharpLines& lines,
                                const AreaTreeOptions& options, const Context& context);

/// The areas of a tree as partitions: joined up to `height`, none under `least` faces unless lines
/// enclose it. Each holds the values of the criterion that its regular vertices have as its
/// interval. `values`: the criterion per vertex. `taken`: faces that are not to be had, one flag
/// each, or empty.
FoundPartitions partitions_of(const Mesh& mesh, const AreaTree& tree, float height,
                              std::uint32_t least, Criterion criterion,
                              const std::vector<double>& values,
                              const std::vector<bool>& taken = {});

}  // namespace arris
