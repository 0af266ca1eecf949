#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/mesh/mesh.h"
#include "core/partitions/border_kink.h"
#include "core/partitions/continuation.h"
#include "core/partitions/surface_fit.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/lines.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

/// Lengths in mean edges, radii for a part of the usual size; angles in degrees, areas in
/// equilateral faces of the mean edge.
struct AreaJoiningOptions {
  float same = 1.1F;          // times its area, up to which an area that grows stays what it was
  std::size_t samples = 256;  // of an area, at most
  // Misfits are summed up over samples. One surface may take the place of two where it misses no
  // more than this in all, and this for each sample of the smaller area (up to so many), and this
  // for each mean edge of border that goes, of samples of 8 faces.
  float rise = 15.0F;
  float rise_each = 1.5F;
  float rise_area = 50.0F;
  float rise_border = 0.6F;
  // Narrow strips along lines: areas of less than this share of faces that vote, and less than so
  // many samples in the smaller one, bend too much for a surface; but they are joined by it all the
  // same, where that makes nothing worse.
  float strip_votes = 0.4F;
  float strip_samples = 8.0F;
  float free = 2.5F;  // mean misfit at which an area is rather free than of a surface
  // Over a border without a kink areas become a free one where no more is lost than this, and this
  // for each mean edge of it.
  float free_rise = 30.0F;
  float free_border = 1.0F;
  // Such areas of at least so many samples and less than this share of a kink may be one smooth
  // surface, of this degree, that none of CAD is near to.
  bool free_forms = true;
  float free_samples = 40.0F;
  float free_kink = 0.5F;
  int free_degree = 4;
  float wide = 100.0F;      // radius of a sphere or cylinder beyond which it is rather a free area
  float blend = 15.0F;      // least radius of a torus up to which it is more than a free area
  float kink = 2.4F;        // degrees of kink at which areas are joined
  float small = 25.0F;      // areas under this are joined the more easily
  float line_share = 0.5F;  // of a border that is a line: from here on nothing is joined over it
  int rounds = 5;           // up to the height 1, measured again after each
  bool surfaces = true;     // joins by fitted surfaces
  bool continuations = true;  // joins surfaces that run on into one another
  BorderKinkOptions border;
  ContinuationOptions continuation;
};

/// `gone` becomes part of `into`, which is of `surface` then, where areas are joined up to
/// `height`; 1 is the usual.
struct AreaJoin {
  std::uint32_t into, gone;
  float height;
  FittedSurface surface;
};

struct AreasToJoin {
  const Mesh& mesh;
  const FaceTable& table;  ///< Without neighbours over lines.
  const SharpLines& lines;
  const FaceRegions& areas;
  const std::vector<std::uint8_t>& banded;          ///< Per face: 1 for those that do not vote.
  std::vector<std::vector<SurfaceSample>> samples;  ///< Of each area.
  int grain;                                        ///< Faces that make one sample.
  SurfaceNoise noise;                               ///< Of a sample.
  float face_noise;                                 ///< Degrees, of a face's normal.
};

struct JoinedAreas {
  std::vector<FittedSurface> surfaces;  ///< Of each area, before any is joined.
  std::vector<AreaJoin> joins;          ///< By increasing height.
};

/// Joins areas, those first that lose least by it: by what one fitted surface misses more than
/// two, or by the kink between them. Round after round, since what borders say is measured anew
/// between larger areas. Ends early where `context` is cancelled.
JoinedAreas join_areas(AreasToJoin areas, const AreaJoiningOptions& options,
                       const Context& context);

}  // namespace arris
