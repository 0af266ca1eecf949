#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/line_evidence.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// Which edges may be sharp by the sign of their exterior angle.
enum class Convexity : std::uint8_t { any, convex, concave };

/// How sharp lines are found.
enum class LineMethod {
  normal_jump,  ///< Borders of regions by the jump of the mean normal: stands the noise of scans.
  walk,         ///< The paper's (section 6.1): walks along edges by |IHe| and IKabs.
};

/// Section 6. Angles in degrees, lengths in the mesh's unit.
struct SharpLineOptions {
  LineMethod method = LineMethod::walk;
  double angle = 30.0;  // TV_IH, over 0 to 180; see default_sharp_angle() for one from the part
  double max_angle = 180.0;              // upper bound of the exterior angle, 0 to 180
  Convexity convexity = Convexity::any;  // convex and concave edges both count in the paper
  int candidates = 3;                    // the paper's alpha (figure 26), 1 to 32; walk
  double min_length = 0.0;               // isolated lines shorter than this go; 0 keeps them
  // Edges between parallel lines of which the weaker goes; 0 keeps both; walk.
  int parallel_distance = 1;
  double bridge_gap = 0.0;  // loose ends no farther apart than this are joined; 0 joins none
};

/// True for an exterior angle (radians, signed) that an edge of a sharp line may have.
inline bool may_be_sharp(float beta, const SharpLineOptions& options) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double angle = std::abs(beta);
  return angle > options.angle * degree &&
         (options.max_angle >= 180.0 || angle <= options.max_angle * degree) &&
         (options.convexity == Convexity::any ||
          (beta > 0.0F) == (options.convexity == Convexity::convex));
}

/// The raw sharp edges of section 6.1: seeds by decreasing IKabs, walks by the candidate rule of
/// figure 26 with TV_IK from TV_IH, closing pass. One flag per edge. A free edge that would make a
/// triangle with two sharp edges is never taken.
std::vector<Origin> identify_sharp_edges(const Mesh& mesh, const Curvatures& curvatures,
                                         const SharpLineOptions& options);

/// The sharp edges by options.method. Walk: identification, then the automatic treatments of
/// section 6.3.1. Normal jump: a choice from `evidence`, which is of this mesh and not null then,
/// at a cost that follows the lines and not the mesh. One flag per edge. Errors: cancelled.
Result<std::vector<Origin>> find_sharp_edges(const Mesh& mesh, const Curvatures& curvatures,
                                             const LineEvidence* evidence,
                                             const SharpLineOptions& options,
                                             const Context& context = {});

/// The edges chosen by the method of the normal jump, by increasing number.
std::vector<EdgeId> choose_sharp_edges(const Mesh& mesh, const LineEvidence& evidence,
                                       const SharpLineOptions& options);

/// Standard deviation in degrees of the exterior angles that noise alone gives this mesh: robust,
/// from the median of |IHe|, so that sharp lines do not count.
double angle_noise(const Curvatures& curvatures);

/// TV_IH for this part in degrees: above what its noise gives an edge (walk), or the jump of the
/// normals (normal jump), and at least what an engineer calls sharp.
double default_sharp_angle(const Mesh& mesh, const Curvatures& curvatures, LineMethod method);

/// Length in mm below which an isolated line on this part is rather noise than a line.
double default_min_length(const Mesh& mesh, LineMethod method);

/// Longest stretch in mm that is closed between two lines: none by the walk.
double default_bridge_gap(const Mesh& mesh, LineMethod method);

}  // namespace arris
