#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/vector_state.h"

namespace arris {

/// Calls `body(i)` for i in [0, count) on the shared pool. Each call may write only what belongs to
/// its own i, so that the result is the same whatever the number of threads. `grain`: calls worth
/// one task; 1 where a single call is long.
template <class Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1024) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      clear_vector_state();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

}  // namespace arris
