#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// What a PathSearch does with a vertex it has come to.
enum class Visit : std::uint8_t { go_on, do_not_pass, finish };

/// Cheapest paths along edges from one vertex, within a reach (Dijkstra). Takes memory and time for
/// the vertices it reaches only. Equal costs: the lower vertex first.
class PathSearch {
 public:
  explicit PathSearch(const Mesh& mesh) : mesh_(mesh) {}

  /// `cost(h)`: of half-edge h, above 0; infinite where it cannot be taken. `visit(v)` is called
  /// once for each vertex other than `from`, by increasing cost. Paths longer than `reach` (mm) are
  /// not followed.
  template <class Cost, class OnVertex>
  void run(VertexId from, double reach, const Cost& cost, const OnVertex& visit) {
    reached_.clear();
    reached_[from] = {0.0, 0.0, no_id};
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.emplace(0.0, from);
    while (!queue.empty()) {
      const auto [so_far, v] = queue.top();
      queue.pop();
      const Reached here = reached_[v];
      if (so_far > here.cost) continue;
      if (v != from) {
        const Visit verdict = visit(v);
        if (verdict == Visit::finish) return;
        if (verdict == Visit::do_not_pass) continue;
      }
      mesh_.for_ring(v, [&, so_far = so_far](HalfEdgeId h) {
        const double length = here.length + mesh_.edge_length(h >> 1);
        if (length > reach) return;
        const double further = so_far + cost(h);
        const auto [it, fresh] = reached_.try_emplace(mesh_.to(h), no_path);
        if (!(further < it->second.cost)) return;
        it->second = {further, length, h};
        queue.emplace(further, mesh_.to(h));
      });
    }
  }

  /// Of the last run; infinite for what it has not reached.
  double length_to(VertexId v) const {
    const auto found = reached_.find(v);
    return found == reached_.end() ? no_path.length : found->second.length;
  }
  /// The half-edges of the path of the last run to v, from its start.
  std::vector<HalfEdgeId> path_to(VertexId v) const {
    std::vector<HalfEdgeId> path;
    for (HalfEdgeId h = reached_.at(v).by; h != no_id; h = reached_.at(mesh_.from(h)).by)
      path.push_back(h);
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  using Entry = std::pair<double, VertexId>;
  struct Reached {
    double cost, length;
    HalfEdgeId by;
  };
  static constexpr Reached no_path{std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::infinity(), no_id};

  const Mesh& mesh_;
  std::unordered_map<VertexId, Reached> reached_;
};

}  // namespace arris
