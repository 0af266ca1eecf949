#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/vector_state.h"

/// What core/base/parallel.h and its like give, on plain std::threads: for the thread sanitizer
/// (CMake option ARRIS_OWN_THREADS), which cannot follow Debian's oneTBB, since that is not
/// instrumented. Slow, and in smaller pieces than a user's program, so that races come about on
/// small meshes too.
namespace arris::own_threads {

/// Threads at most, the caller's among them. More than most test machines have cores, so that the
/// system switches between them anywhere.
inline std::atomic<std::size_t> limit{4};

/// Calls `work(k)` for k in [0, count); side by side unless called from such work.
template <class Work>
void run(std::size_t count, const Work& work) {
  static thread_local bool within = false;
  // Relaxed: who takes a piece learns nothing of the other pieces, as under oneTBB.
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    const bool before = std::exchange(within, true);
    clear_vector_state();
    for (std::size_t k = 0; (k = next.fetch_add(1, std::memory_order_relaxed)) < count;) work(k);
    within = before;
  };
  const std::size_t threads = within ? 1 : std::min(limit.load(), count);
  std::vector<std::jthread> others;
  for (std::size_t k = 1; k < threads; ++k) others.emplace_back(take);
  take();
}

template <class Work>
void for_ranges(std::size_t count, const Work& work) {
  const std::size_t pieces = std::min(count, 4 * limit.load());
  run(pieces, [&](std::size_t k) { work(k * count / pieces, (k + 1) * count / pieces); });
}

template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
  constexpr std::ptrdiff_t pieces = 4;
  const std::ptrdiff_t size = last - first;
  const auto at = [&](std::ptrdiff_t k) { return first + k * size / pieces; };
  run(static_cast<std::size_t>(pieces), [&](std::size_t k) {
    const auto piece = static_cast<std::ptrdiff_t>(k);
    std::sort(at(piece), at(piece + 1), less);
  });
  for (std::ptrdiff_t k = 2; k <= pieces; ++k) std::inplace_merge(first, at(k - 1), at(k), less);
}

}  // namespace arris::own_threads
