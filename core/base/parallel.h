#pragma once

#include <cstddef>
#include <functional>

#if defined(ARRIS_OWN_THREADS)
#include "core/base/own_threads.h"
#else
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#endif

#include "core/base/vector_state.h"

namespace arris {

/// Calls `body(i)` for i in [0, count) on the shared pool. Each call may write only what belongs to
/// its own i, so that the result is the same whatever the number of threads. `grain`: calls worth
/// one task; 1 where a single call is long.
template <class Body>
void parallel_for(std::size_t count, const Body& body, [[maybe_unused]] std::size_t grain = 1024) {
#if defined(ARRIS_OWN_THREADS)
  own_threads::parallel_for(count, body);
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      clear_vector_state();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
#endif
}

/// Sorts on the shared pool. No two elements may be equal under `less` unless it does not matter
/// which comes first: the order of equals is not the same each time.
template <class Iterator, class Less = std::less<>>
void parallel_sort(Iterator first, Iterator last, const Less& less = {}) {
#if defined(ARRIS_OWN_THREADS)
  own_threads::parallel_sort(first, last, less);
#else
  tbb::parallel_sort(first, last, less);
#endif
}

/// One T for each thread of the pool, made by the function given when the thread first asks for its
/// local(). For memory that calls of a body may reuse, not for results.
#if defined(ARRIS_OWN_THREADS)
template <class T>
using PerThread = own_threads::PerThread<T>;
#else
template <class T>
using PerThread = tbb::enumerable_thread_specific<T>;
#endif

}  // namespace arris
