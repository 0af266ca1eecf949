#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/simplification/working_mesh.h"

namespace arris {

/// What is common to both kinds of swap.
struct SwapOptions {
  /// Called for each swap with the value of the cost function before and after it: the sum of five
  /// |beta| in radians, or minus the cosine of the largest of six angles. For tests.
  std::function<void(double before, double after)> observe;
};

/// Two faces that share an edge, and the two they would become. The edge runs from `a`, the smaller
/// id, to `b`; `c` is left of it, `d` right. After the swap the faces are a, d, c and d, b, c.
struct SwapCase {
  VertexId a, b, c, d;
  FaceId left, right;
  WorkingMesh::SideId ad, db, bc, ca;  ///< The outer sides.
  Point new_left, new_right;           ///< Unit normals of a, d, c and of d, b, c.
};

/// Swaps edges of `mesh` until no edge is left to swap (sections 4.2 and 4.3, method.md 3).
///
/// An edge is swapped when it is neither on the free border nor sharp, its faces unfolded are a
/// convex quadrangle, the new edge does not exist, neither new face is degenerate, none of the five
/// |beta| becomes a flip (above 120 degrees and above the largest before), `gain` says so, and each
/// zone of the two faces meets one of the new ones.
class SwapEngine {
 public:
  struct Values {
    double before, after;
    bool better;
  };
  /// The cost function of a case before and after the swap, and whether to swap.
  using Cost = Values (*)(const WorkingMesh&, const SwapCase&);

  /// `wide`: after a swap the outer edges of the adjacent faces are tried again, too.
  SwapEngine(WorkingMesh& mesh, Cost cost, bool wide);
  /// Returns the number of swaps. Errors: cancelled.
  Result<std::uint64_t> run(const SwapOptions& options, const Context& context);

 private:
  using SideId = WorkingMesh::SideId;
  bool try_swap(SideId side, const SwapOptions& options);
  bool is_flip(const SwapCase& s) const;
  bool zones_fit(const SwapCase& s);
  void swap(const SwapCase& s);
  void enqueue(SideId side);

  WorkingMesh& mesh_;
  Cost cost_;
  bool wide_;
  std::vector<SideId> queue_;
  std::vector<std::uint8_t> queued_;
  std::vector<VertexId> zones_;
  std::vector<std::uint8_t> answering_;
};

/// Both phases from values to values. Errors: zones or sharp edges of another mesh, cancelled.
Result<Prepared> run_swaps(const Mesh& mesh, const ErrorZonesPtr& zones,
                           const ChunkedArray<Origin>& sharp, SwapEngine::Cost cost, bool wide,
                           const SwapOptions& options, const Context& context, const char* phase);

}  // namespace arris
