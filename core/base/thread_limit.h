#pragma once

#include <cstddef>

#if defined(ARRIS_OWN_THREADS)
#include "core/base/own_threads.h"
#else
#include <tbb/global_control.h>
#endif

namespace arris {

/// As long as it lives, parallel_for() and its like use at most so many threads.
class ThreadLimit {
 public:
#if defined(ARRIS_OWN_THREADS)
  explicit ThreadLimit(std::size_t threads) : before_(own_threads::limit.exchange(threads)) {}
  ~ThreadLimit() { own_threads::limit = before_; }
#else
  explicit ThreadLimit(std::size_t threads)
      : control_(tbb::global_control::max_allowed_parallelism, threads) {}
#endif
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
#if defined(ARRIS_OWN_THREADS)
  std::size_t before_;
#else
  tbb::global_control control_;
#endif
};

}  // namespace arris
