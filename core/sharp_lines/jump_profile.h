#pragma once

#include <array>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/sharp_lines/border_test.h"
#include "core/sharp_lines/candidate_graph.h"

namespace arris {

/// How the surface turns across a place, as it can be drawn: to one side distances are negative, to
/// the other positive, and the turn rises over them where the place is convex.
struct JumpProfile {
  static constexpr float reach = 5.5F;  ///< Mean edges to either side.
  static constexpr float bin = 0.5F;    ///< Mean edges.

  /// The mean of the faces in one bin.
  struct Dot {
    float distance = 0.0F;  ///< Mean edges, -reach to reach.
    float turn = 0.0F;      ///< Degrees, -180 to 180, of the normals from the mean of both sides.
  };
  /// The straight line through one side by which the border test judges.
  struct Side {
    bool fitted = false;    ///< False: too few faces.
    float at_line = 0.0F;   ///< Degrees at distance 0,
    float slope = 0.0F;     ///< and how many more for each mean edge away from it.
    float mean = 0.0F;      ///< Degrees: of the faces that it goes through,
    float distance = 0.0F;  ///< and their mean distance, mean edges, 0 or more.
  };

  std::vector<Dot> dots;          ///< By increasing distance; bins without a face are left out.
  std::array<Side, 2> sides;      ///< Where distances are negative, and where they are positive.
  float near = 0.0F, far = 0.0F;  ///< Mean edges between which the sides are fitted.

  bool fitted() const { return sides[0].fitted && sides[1].fitted; }
  /// Degrees between the means of both sides, convex positive.
  float turn() const { return sides[1].mean - sides[0].mean; }
  /// Degrees of it that lie at the place itself: between the two lines, 0 or of the turn's sign.
  float jump() const;
};

/// The profile across an edge. On a candidate the line is followed as the border test follows it
/// and what lies along it is pooled; its lines are fitted as the test fits them, between candidates
/// at least as strong, and leave the very jump and turn that the test noted for this place (which
/// it measured while weaker borders beside it were still there, and where noise is harsh on
/// filtered normals). Off the candidates nothing is tested: the profile goes across the way in
/// which the normals turn least, and has no lines. Only faces joined to the edge over sides count.
/// No dots on the border of the scan. Looks at the neighbourhood only.
JumpProfile profile_across(const Mesh& mesh, const CandidateGraph& candidates, EdgeId e,
                           const BorderTestOptions& options = {});

}  // namespace arris
