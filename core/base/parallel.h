#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

namespace arris {

/// Work on the indices [begin, end), without its type: so that the pool's own headers are compiled
/// once and not with each loop.
struct RangeWork {
  const void* body;
  void (*call)(const void* body, std::size_t begin, std::size_t end);
};

/// Splits [0, count) among the threads of the shared pool. See parallel_for().
void for_ranges(std::size_t count, std::size_t grain, RangeWork work);

/// Calls `body(i)` for i in [0, count) on the shared pool. Each call may write only what belongs to
/// its own i, so that the result is the same whatever the number of threads. `grain`: calls worth
/// one task; 1 where a single call is long.
template <class Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1024) {
  for_ranges(count, grain, {&body, [](const void* same, std::size_t begin, std::size_t end) {
                              const Body& each = *static_cast<const Body*>(same);
                              for (std::size_t i = begin; i != end; ++i) each(i);
                            }});
}

/// One T for each thread of the pool, made by the function given when the thread first asks for its
/// local(). For memory that calls of a body may reuse, not for results.
template <class T>
class PerThread {
 public:
  explicit PerThread(std::function<T()> make) : make_(std::move(make)) {}
  PerThread(const PerThread&) = delete;
  PerThread& operator=(const PerThread&) = delete;
  ~PerThread() {
    for (const Node* node = first_; node;) delete std::exchange(node, node->next);
  }

  T& local() {
    const std::thread::id mine = std::this_thread::get_id();
    for (Node* node = first_.load(std::memory_order_acquire); node; node = node->next)
      if (node->owner == mine) return node->value;
    Node* made = new Node{mine, make_(), first_.load(std::memory_order_relaxed)};
    while (!first_.compare_exchange_weak(made->next, made, std::memory_order_release,
                                         std::memory_order_relaxed)) {
    }
    return made->value;
  }

 private:
  /// As many as there are threads: a list is looked through sooner than a table.
  struct Node {
    std::thread::id owner;
    T value;
    Node* next;
  };
  std::function<T()> make_;
  std::atomic<Node*> first_{nullptr};
};

}  // namespace arris
