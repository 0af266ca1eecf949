#pragma once

#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/border_test.h"
#include "core/sharp_lines/normal_jump.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

struct LineRegionOptions {
  WatershedOptions watershed;
  BorderTestOptions test;
  float first_cut = 21.0F;      // degrees: borders weaker than this by their jump go untested
  float least_height = 5.0F;    // degrees: of these, the ones that are kept for low thresholds
  float first_quantile = 0.4F;  // of a border's jump along its length: what it counts for
  float first_area = 40.0F;     // faces below which a region joins the more easily
  float quantile = 0.4F;        // the same for the test of whole borders
  float area = 25.0F;
  float thin = 1.6F;    // mean edges: a strip thinner than this joins the more easily
  float narrow = 4.0F;  // mean edges: borders of strips thinner than this are measured again
  int smoothing = 20;   // rounds of taking teeth off the borders
};

/// An edge of a border between regions, and up to which threshold it is one.
struct BorderEdge {
  EdgeId edge = no_id;
  float height = 0.0F;  ///< Degrees: the border stays where the threshold is below this.
  BorderPlace place;    ///< As last measured before the border went.
  bool exact = false;   ///< An edge of a mesh without noise: its own exterior angle is the measure.
};

/// One mark per vertex: 1 within `rings` edges of one of `borders` that stands above `height`
/// (degrees).
std::vector<std::uint8_t> vertices_near(const Mesh& mesh, const std::vector<BorderEdge>& borders,
                                        float height, int rings);

/// The regions of a mesh at every threshold at once, as the edges of their borders by increasing
/// edge number: those with a height above a threshold are the borders at it.
///
/// A watershed of the normal jump gives the first regions; weak borders go by the jump; the rest
/// are tested as whole borders (BorderTest), and the weakest goes, again and again, while what
/// became longer is tested again. `tubes`: per face, as by find_tight_tubes(); each is a region of
/// its own before borders are tested. Errors: cancelled.
Result<std::vector<BorderEdge>> find_line_regions(const Mesh& mesh, const FaceTable& table,
                                                  const std::vector<Eigen::Vector3f>& normals,
                                                  const NormalJump& jump,
                                                  const std::vector<std::uint32_t>& tubes,
                                                  const LineRegionOptions& options,
                                                  const Context& context);

}  // namespace arris
