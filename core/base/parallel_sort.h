#pragma once

#include <functional>

#if defined(ARRIS_OWN_THREADS)
#include "core/base/own_threads.h"
#else
#include <tbb/parallel_sort.h>
#endif

namespace arris {

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

}  // namespace arris
