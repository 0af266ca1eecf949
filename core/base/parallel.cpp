#include "core/base/parallel.h"

#include "core/base/vector_state.h"

#if defined(ARRIS_OWN_THREADS)
#include "core/base/own_threads.h"
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace arris {

void for_ranges(std::size_t count, [[maybe_unused]] std::size_t grain, RangeWork work) {
#if defined(ARRIS_OWN_THREADS)
  own_threads::for_ranges(
      count, [&](std::size_t begin, std::size_t end) { work.call(work.body, begin, end); });
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      clear_vector_state();
                      work.call(work.body, range.begin(), range.end());
                    });
#endif
}

}  // namespace arris
