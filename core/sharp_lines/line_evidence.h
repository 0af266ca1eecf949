#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/candidate_graph.h"
#include "core/sharp_lines/crest.h"
#include "core/sharp_lines/exact_creases.h"
#include "core/sharp_lines/line_regions.h"
#include "core/sharp_lines/normal_jump.h"
#include "core/sharp_lines/normal_noise.h"
#include "core/sharp_lines/tight_tubes.h"

namespace arris {

/// Each idea can be switched off, to measure what it buys (tests/bench/accuracy).
struct LineEvidenceOptions {
  NormalJumpOptions jump;
  TightTubeOptions tight_tubes;
  LineRegionOptions regions;
  ExactCreaseOptions creases;
  CrestOptions crests;
  NormalFilterOptions filter{2, 0.5F};  // rounds for harsh noise
  float threshold = 27.0F;              // degrees, where the noise is ordinary
  float clear = 1.6F;                   // times that, for a line that parts no regions
  float harsh = 12.0F;          // degrees of normal noise from which normals are filtered first
  float ordinary = 11.0F;       // degrees of normal noise up to which thresholds stay as they are,
  float rise = 0.7F;            // how much they rise for each degree beyond that,
  float most_rise = 9.0F;       // and at most;
  float first_cut_rise = 0.8F;  // the first cut of the regions rises by this share of that
  bool exact = true;            // creases of places without noise by their own angle
  bool tubes = true;            // walls of small holes and pins are regions from the start
  bool open = true;             // lines that part no regions, along crests of the jump
};

/// Threshold in degrees for this much normal noise, degrees.
double jump_threshold(float noise, const LineEvidenceOptions& options = {});
/// Degrees that a line which parts no regions has to reach somewhere.
double clear_jump(float noise, const LineEvidenceOptions& options = {});

/// All that tells a sharp line on one mesh and does not depend on the threshold.
struct LineEvidence {
  float noise = 0.0F;  ///< normal_noise(), degrees.
  /// Per edge, signed degrees, convex positive: the jump of the normals across it. On a border
  /// between regions it is the one of the border, pooled along it.
  std::vector<float> jump;
  CandidateGraph candidates;
  /// The jump in the place of IHe and the IKabs that follows from it, for what walks along lines
  /// or follows them by either (beta, ikabs and by_decreasing_ikabs alone are filled).
  CurvaturesPtr measures;

  std::size_t bytes() const;
};

using LineEvidencePtr = std::shared_ptr<const LineEvidence>;

/// Works it all out. The same bytes whatever the number of threads; nothing depends on the unit or
/// the place of the part. Errors: cancelled.
Result<LineEvidencePtr> gather_line_evidence(const Mesh& mesh, const Curvatures& curvatures,
                                             const LineEvidenceOptions& options = {},
                                             const Context& context = {});

/// The evidence on one mesh, worked out when it is first asked for and shared by all snapshots that
/// have this mesh. It follows from the mesh, so that it makes no difference who asks first.
class SharedLineEvidence {
 public:
  SharedLineEvidence(MeshPtr mesh, CurvaturesPtr curvatures)
      : mesh_(std::move(mesh)), curvatures_(std::move(curvatures)) {}

  /// Errors: cancelled.
  Result<LineEvidencePtr> get(const Context& context = {}) const;
  /// Null where nobody has asked yet. Never waits.
  LineEvidencePtr known() const { return known_.load(); }
  std::size_t bytes() const;

 private:
  MeshPtr mesh_;
  CurvaturesPtr curvatures_;
  mutable std::mutex working_;
  mutable std::atomic<LineEvidencePtr> known_;
};

using SharedLineEvidencePtr = std::shared_ptr<const SharedLineEvidence>;

}  // namespace arris
