#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/chunked_array.h"
#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"
#include "core/simplification/error_zones.h"
#include "core/simplification/star_triangulation.h"

namespace arris {

struct SimplifyOptions {
  /// Radius of the error zones, mm. Absent: that of the zones handed in, or default_error_zone() of
  /// the mesh where there are none. A vertex already removed keeps a larger radius it had.
  std::optional<double> error_zone;
  std::vector<double> radii;          // one radius per vertex instead, mm; empty: one for all
  double max_edge_length = 0.0;       // no new edge longer than this, mm (4.1); 0: no limit
  StarCost cost = StarCost::angle;    // by measurement: see StarCost
  std::uint64_t target_vertices = 0;  // stop when so many are left; 0: go on to the end
};

/// Simplification inside error zones (section 4.1, method.md 2).
///
/// Takes out vertices, never moves one, in order of increasing Kabs (free-border vertices by the
/// square of the curvature of the border), and triangulates the star anew. Every initial vertex
/// stays within its radius of the surface, every vertex of the free border within its radius of the
/// border. Topology and orientation are kept; vertices on `sharp` edges stay. A vertex is refused
/// when a new edge exists already or is longer than the limit, a new face is degenerate, a new or
/// bordering |beta| is above 120 degrees and above the largest before, its star has more than 16
/// corners, or a zone meets no new face; it is tried again when its star changes.
///
/// `zones`: of `mesh`; null: every vertex starts as its own. `sharp`: per edge of `mesh`, or empty.
/// The same arguments give the same bytes. Errors: zones, radii or edges of another mesh, a length
/// that is negative or not finite, cancelled.
Result<Prepared> simplify(const Mesh& mesh, const ErrorZonesPtr& zones,
                          const ChunkedArray<Origin>& sharp, const SimplifyOptions& options = {},
                          const Context& context = {});

/// Zones to go on with: `zones`, or those of the start with default_error_zone() for null. Errors:
/// zones of another mesh.
Result<ErrorZonesPtr> zones_or_start(const Mesh& mesh, const ErrorZonesPtr& zones);

}  // namespace arris
