#pragma once

#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/lines.h"

namespace arris {

struct LeakOptions {
  double reach = 15.0;       ///< Longest gap looked for, in mean edge lengths of the mesh.
  double least_score = 2.0;  ///< Gaps that score less are not worth a look.
  double least_kink = 2.4;   ///< Degrees; below it one smooth surface runs on over the gap.
  std::size_t most = 200;    ///< Leaks returned.
};

/// A gap in the sharp lines through which the front of a partition may have run.
struct Leak {
  std::uint32_t partition = 0;
  std::vector<VertexId> path;  ///< From a loose end to a line, another loose end or the border.
  /// Shorter gaps that have to be closed as well; none where the first does it alone.
  std::vector<std::vector<VertexId>> others;
  double gap = 0.0;   ///< Length of all these paths, mm.
  double area = 0.0;  ///< Of the smaller side that is parted, mm^2.
  /// Degrees (rms) by which one smooth surface over both sides of a path misses more than one on
  /// each side, the noise taken off (core/partitions/border_kink.h); of the path where it is least.
  double kink = 0.0;
  /// area / gap^2 (gap counts as 3 mean edges at least), times 1/4 (least kink) to 1 (four times
  /// that and more).
  double score = 0.0;
};

/// Where fronts ran through gaps, the highest score first (ties: the lower vertices);
/// of the ways from one loose end through one partition only the best.
///
/// From each loose end in a partition of at least mean area: the shortest paths through faces of
/// the partition to other lines, loose ends or the border, as far as `reach`, unless the way
/// along the lines is not much longer. A path counts as a leak where it, or it and the gaps that
/// are shorter, part the partition in two, and where the two sides are not one smooth surface: what
/// the noise does not tell from one is none. Each region between lines and paths is flooded once,
/// so the time is that of one pass over the faces of large partitions plus what lies round loose
/// ends. Our addition. Errors: cancelled.
Result<std::vector<Leak>> find_leaks(const Mesh& mesh, const SharpLines& lines,
                                     const Partitions& partitions, const LeakOptions& options = {},
                                     const Context& context = {});

}  // namespace arris
