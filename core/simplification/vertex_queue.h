#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// Vertices by increasing key, ties by id; a key may change while its vertex waits. A heap of four
/// children with the place of each vertex.
class VertexQueue {
 public:
  explicit VertexQueue(std::size_t vertices) : place_(vertices, no_id) {}

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  bool contains(VertexId v) const { return place_[v] != no_id; }

  /// Puts v in, or gives it another key.
  void set(VertexId v, double key) {
    if (!contains(v)) {
      heap_.push_back({key, v});
      rise(heap_.size() - 1, {key, v});
      return;
    }
    const std::size_t i = place_[v];
    const Entry entry{key, v};
    if (entry.before(heap_[i]))
      rise(i, entry);
    else
      sink(i, entry);
  }

  VertexId pop() {
    const VertexId v = heap_[0].vertex;
    place_[v] = no_id;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sink(0, last);
    return v;
  }

 private:
  struct Entry {
    double key;
    VertexId vertex;
    bool before(const Entry& other) const {
      return key != other.key ? key < other.key : vertex < other.vertex;
    }
  };

  void put(std::size_t i, const Entry& entry) {
    heap_[i] = entry;
    place_[entry.vertex] = static_cast<std::uint32_t>(i);
  }
  void rise(std::size_t i, const Entry& entry) {
    while (i > 0 && entry.before(heap_[(i - 1) / 4])) {
      put(i, heap_[(i - 1) / 4]);
      i = (i - 1) / 4;
    }
    put(i, entry);
  }
  void sink(std::size_t i, const Entry& entry) {
    for (;;) {
      const std::size_t first = 4 * i + 1;
      if (first >= heap_.size()) break;
      std::size_t least = first;
      for (std::size_t k = first + 1; k < first + 4 && k < heap_.size(); ++k)
        if (heap_[k].before(heap_[least])) least = k;
      if (!heap_[least].before(entry)) break;
      put(i, heap_[least]);
      i = least;
    }
    put(i, entry);
  }

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;
};

}  // namespace arris
