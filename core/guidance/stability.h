#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

/// What one threshold gives.
struct StabilityPoint {
  double threshold = 0.0;  ///< TV_IH in degrees, or Kmax in the unit of the criterion.
  std::size_t count = 0;   ///< Lines, or partitions.
  double size = 0.0;  ///< Total length of the lines, mm; or share of the area assigned, 0 to 1.
  bool operator==(const StabilityPoint&) const = default;
};

/// How many lines or partitions each threshold gives, by increasing threshold.
struct StabilityCurve {
  std::vector<StabilityPoint> points;
  bool logarithmic = false;       ///< Stretches are measured in the logarithm of the threshold.
  double trivial = 0.0;           ///< Sizes below this are next to nothing,
  std::size_t trivial_count = 0;  ///< and so are counts up to this.
  /// The threshold that the part itself suggests; 0: none. A stretch that ends below half of it, or
  /// begins above twice it, is not about what the part shows.
  double usual = 0.0;
  bool operator==(const StabilityCurve&) const = default;
};

/// A stretch of a curve over which the count hardly changes.
struct Plateau {
  double from = 0.0, to = 0.0;  ///< Thresholds, both of them points of the curve.
  double middle = 0.0;          ///< The suggested place to stop.
  bool operator==(const Plateau&) const = default;
};

/// Lines and their total length after find_sharp_edges() under `options` for each TV_IH.
/// `thresholds`: degrees, 0 to 180, any order; empty: `count` of them evenly from 1.5 times the
/// noise of the mesh (30 degrees at most) to its sharpest edge (120 at most). One
/// find_sharp_edges() per threshold, in parallel; `evidence` as there. Errors: cancelled.
Result<StabilityCurve> line_stability(const Mesh& mesh, const Curvatures& curvatures,
                                      const LineEvidence* evidence, const SharpLineOptions& options,
                                      std::vector<double> thresholds = {}, std::size_t count = 24,
                                      const Context& context = {});

/// Partitions of at least options.min_faces and the share of the area they cover for each single
/// interval [least, Kmax], where `least` is the lower end of the first of options.intervals (0
/// where there is none), bare areas with options.bare_areas. Holes are not filled. `thresholds`:
/// Kmax, any order; empty: `count` of them, evenly in the logarithm over the middle of the
/// distribution of `values` (the criterion per vertex) off lines and border. For one interval the
/// partitions are the components of the passing faces, so that all thresholds together take about
/// as long as one propagation. Errors: cancelled.
Result<StabilityCurve> partition_stability(const Mesh& mesh, const std::vector<double>& values,
                                           const SharpLines& lines, const PartitionOptions& options,
                                           std::vector<double> thresholds = {},
                                           std::size_t count = 24, const Context& context = {});

/// The widest stretch over which the count changes least: of the stretches of three points and
/// more over which it changes by 25 % at most, the one with the largest width * exp(-4 |log of
/// largest to smallest count|) * mean size, so that twice the width is worth a change by 19 % and a
/// stretch over which half as much is found half as much. Left out are stretches far from the usual
/// threshold, the trivial ends: points with next to nothing found (for lines in all shorter than
/// half the diagonal; for partitions a single one, or 5 % of the area) and, where others remain,
/// those up to where the count has fallen to half its peak (noise). Nothing where there is no such
/// stretch: many noisy scans have none.
std::optional<Plateau> plateau(const StabilityCurve& curve);

}  // namespace arris
