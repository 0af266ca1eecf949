#pragma once

#include "core/edge_swapping/swap_engine.h"

namespace arris {

/// The smoothing of section 4.2: swaps edges as long as that lowers the sum of |beta| over the edge
/// and the four edges round its two faces (eq. 17 and 18), inside the error zones. Each swap lowers
/// the sum over the whole mesh, so it ends, and a second run does nothing. Border and `sharp` edges
/// stay.
///
/// `zones`: of `mesh`; null: every vertex is its own zone. `sharp`: per edge, or empty. Errors:
/// zones or sharp edges of another mesh, cancelled.
Result<Prepared> swap_edges(const Mesh& mesh, const ErrorZonesPtr& zones,
                            const ChunkedArray<Origin>& sharp, const SwapOptions& options = {},
                            const Context& context = {});

/// What swap_edges() makes smaller: the sum of |beta| over all edges, radians.
double total_bending(const Mesh& mesh);

}  // namespace arris
