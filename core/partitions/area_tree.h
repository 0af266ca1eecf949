#pragma once

#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/partitions/area_borders.h"
#include "core/partitions/border_kink.h"
#include "core/partitions/curvature_kinks.h"
#include "core/partitions/partitions.h"
#include "core/partitions/surface_fit.h"
#include "core/partitions/surface_growing.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/lines.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

/// Lengths in mean edges, angles in degrees, areas in equilateral faces of the mean edge.
struct AreaTreeOptions {
  float band = 1.5F;         // faces nearer than this to a line are rounded by it: they do not vote
  float narrow_band = 0.8F;  // and nearer than this in strips too narrow for that,
  int narrow_rings = 3;      // told by steps over sides from faces that vote
  CurvatureKinkOptions kinks;
  WatershedOptions watershed{0.5F, 6.0F};  // of the kinks
  float first_cut = 1.8F;                  // borders weaker than this by their kinks go unfitted
  float first_quantile = 0.4F;             // of a border's kinks along it: what it counts for
  float first_area = 40.0F;                // below it an area joins the more easily
  int growths = 6;                         // rounds of growing surfaces, at most: they end
  double settled = 0.03;                   // when the noise changes by less than this share of it
  double most_drift = 3.0;   // distances over whole surfaces to those over a few edges
  double most_spread = 1.5;  // and angles: above, surfaces have run into one another
  float inner = 0.3F;        // height up to which the pieces of one surface are joined
  SurfaceGrowingOptions growing;
  int grain = 8;              // faces that make one sample of an area
  float same = 1.1F;          // times its area, up to which an area that grows stays what it was
  std::size_t samples = 128;  // of an area, at most
  // Misfits are summed up over samples. One surface may take the place of two where it misses no
  // more than this in all, and this for each sample of the smaller area (up to so many), and this
  // for each mean edge of border that goes.
  float rise = 10.0F;
  float rise_each = 1.0F;
  float rise_area = 50.0F;
  float rise_border = 0.6F;
  float free = 2.5F;  // mean misfit at which an area is rather free than of a surface
  // Over a border without a kink areas become a free one where no more is lost than this, and this
  // for each mean edge of it.
  float free_rise = 30.0F;
  float free_border = 1.0F;
  float wide = 100.0F;      // radius of a sphere or cylinder beyond which it is rather a free area
  float blend = 15.0F;      // least radius of a torus up to which it is more than a free area
  float kink = 2.4F;        // degrees of kink at which areas are joined
  float small = 25.0F;      // areas under this are joined the more easily
  float line_share = 0.5F;  // of a border that is a line: from here on nothing is joined over it
  int rounds = 5;           // up to the height 1, measured again after each
  float distance = 0.01F;   // least noise of a sample along the normal
  float angle = 0.3F;       // and across
  double face_noise = 1.5;  // distance of a face over that of a sample
  bool surfaces = true;     // joins by fitted surfaces
  BorderKinkOptions border;
  AreaBorderOptions settling;
};

/// Areas of a mesh, joined up to some height.
struct Areas {
  std::vector<std::uint32_t> of_face;
  std::vector<FittedSurface> surfaces;  ///< Of each: mean edges, about the middle of the box.
};

/// Areas of a mesh at every level of detail at once: the smallest ones, and in which order they are
/// joined.
struct AreaTree {
  FaceTable table;                      ///< Without neighbours over lines.
  std::vector<float> edge_length;       ///< Mean edges.
  std::vector<std::uint8_t> banded;     ///< Per face: 1 where a line rounds it.
  std::vector<std::uint32_t> smallest;  ///< Per face: its smallest area, from 0.
  std::vector<FittedSurface> surfaces;  ///< Of those.
  /// `gone` becomes part of `into`, which is of `surface` then, where areas are joined up to
  /// `height`; 1 is the usual. By increasing height.
  struct Join {
    std::uint32_t into, gone;
    float height;
    FittedSurface surface;
  };
  std::vector<Join> joins;
  SurfaceNoise noise;       ///< Of the samples that were fitted.
  SurfaceNoise face_noise;  ///< Of a face.
  AreaTreeOptions options;

  std::size_t bytes() const;
  /// Joined up to `height`, with their borders settled, and no area under `least` faces unless
  /// lines enclose it.
  Areas cut(float height, std::uint32_t least) const;
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
