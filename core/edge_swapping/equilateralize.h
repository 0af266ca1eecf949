#pragma once

#include "core/edge_swapping/swap_engine.h"

namespace arris {

/// The equilateralisation of section 4.3: swaps edges as long as that lowers the largest of the six
/// angles of the two faces (eq. 19), inside the error zones. Each swap lowers the descending list
/// of all angles of the mesh, so it ends, and a second run does nothing. Border and `sharp` edges
/// stay.
///
/// `zones`: of `mesh`; null: every vertex is its own zone. `sharp`: per edge, or empty. Errors:
/// zones or sharp edges of another mesh, cancelled.
Result<Prepared> equilateralize(const Mesh& mesh, const ErrorZonesPtr& zones,
                                const ChunkedArray<Origin>& sharp, const SwapOptions& options = {},
                                const Context& context = {});

}  // namespace arris
