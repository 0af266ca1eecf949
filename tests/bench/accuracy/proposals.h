#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/guidance/worklist.h"
#include "tests/bench/accuracy/kd_tree.h"
#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// How many proposals of one kind a worklist makes, and how many of them the truth agrees with.
struct ProposalCount {
  WorkKind kind = WorkKind::leak;
  std::size_t made = 0, right = 0;
};

struct ProposalOptions {
  double share = 0.6;  // of the length of the paths on which the truth must agree
  double reach = 2.0;  // mean edges of the scan: how near a path is to a true line
  // Mean edges: how far from its path a side is looked at. Of the half disc of this radius on one
  // side more than half lies beyond a true border at up to 0.4 of the radius, which is `reach`.
  double side_reach = 5.0;
};

/// Judges what a worklist proposes by the true curves and patches of a part. What depends on the
/// part alone is worked out once.
class ProposalJudge {
 public:
  explicit ProposalJudge(const Part& part, const ProposalOptions& options = {});

  /// Whether what the item proposes is right; absent for an item that proposes nothing of which the
  /// truth tells, on a part whose patches are not known, and beside surfaces too narrow for the
  /// scan to show, where lines count neither way.
  ///
  /// leak: all its paths are lines, and part two patches (see runs_along_lines() and
  /// parts_patches()). loose_end: its best continuation is a line.
  std::optional<bool> is_right(const Document& document, const WorkItem& item) const;

  /// The proposals of the document's worklist by kind, in the order of kinds; kinds without any are
  /// left out. Errors: those of worklist().
  Result<std::vector<ProposalCount>> count(const Document& document) const;

 private:
  using Paths = std::vector<std::vector<VertexId>>;  // on the document's mesh

  /// Whether the paths lie within `reach` of the places for `share` of their length.
  bool runs_along(const KdTree& places, double reach, double share, const Document& document,
                  const Paths& paths) const;
  /// Whether the paths lie on true curves, of any demand, or on borders of two true patches for
  /// enough of their length.
  bool runs_along_lines(const Document& document, const Paths& paths) const;
  /// Whether the two sides of the paths belong to different true patches for enough of their
  /// length. The faces within `side_reach` of the middle of an edge of a path, up to paths and
  /// lines, are on the side from which they are fewer faces away; a side belongs to the patch that
  /// has most of its area. The two faces at the edge alone would call for a path that meets the
  /// true border to the edge, which zigzags over the mesh as the path does.
  bool parts_patches(const Document& document, const Paths& paths) const;
  bool parts_patches_at(const Document& document, const std::vector<EdgeId>& walls, EdgeId e) const;
  std::uint32_t patch_of(const Document& document, FaceId face) const;

  const Part& part_;
  const ProposalOptions options_;
  const double mean_edge_;  // mm
  KdTree lines_;            // points of true curves and of borders between true patches
  KdTree centres_;          // of the faces of the scan
  KdTree narrow_;           // centres of the faces on surfaces too narrow to be seen
};

}  // namespace arris::accuracy
