#include "core/sharp_lines/cheapest_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>
#include <unordered_set>

namespace arris {

std::vector<VertexId> cheapest_path(const Mesh& mesh, const Curvatures& curvatures,
                                    const std::vector<VertexId>& sources,
                                    const std::vector<VertexId>& targets, const PathCost& cost,
                                    double reach, const std::function<bool(EdgeId)>& may_use) {
  struct Reached {
    double price, length;
    VertexId from;
    bool done = false;
  };
  // A*: no edge costs less than `least` of its length, so that much of the straight way to the
  // targets is certain; for many targets, of the way to the box round them.
  const std::unordered_set<VertexId> wanted(targets.begin(), targets.end());
  Eigen::AlignedBox3d box;
  for (const VertexId v : targets) box.extend(mesh.point(v));
  const auto ahead = [&](VertexId v) {
    return cost.least * std::sqrt(box.squaredExteriorDistance(mesh.point(v)));
  };
  std::unordered_map<VertexId, Reached> reached;
  using Entry = std::pair<double, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const VertexId v : sources) {
    reached[v] = {0.0, 0.0, no_id};
    queue.push({ahead(v), v});
  }
  VertexId end = no_id;
  while (!queue.empty()) {
    const VertexId v = queue.top().second;
    queue.pop();
    Reached& here = reached[v];
    if (here.done) continue;
    here.done = true;
    if (wanted.contains(v)) {
      end = v;
      break;
    }
    const double price = here.price, length = here.length;
    mesh.for_ring(v, [&](HalfEdgeId h) {
      const EdgeId e = h >> 1;
      if (mesh.is_border_edge(e) || !may_use(e)) return;
      const double edge = mesh.edge_length(e);
      if (length + edge > reach) return;
      const double sharp = std::abs(curvatures.beta[e]) / cost.angle;
      const double next = price + edge * (cost.least + (1.0 - cost.least) * std::exp(-sharp));
      const VertexId w = mesh.to(h);
      const auto [it, fresh] = reached.try_emplace(w, Reached{next, length + edge, v});
      if (!fresh) {
        if (it->second.done || next > it->second.price ||
            (next == it->second.price && v >= it->second.from))
          return;
        it->second = {next, length + edge, v};
      }
      queue.push({next + ahead(w), w});
    });
  }
  std::vector<VertexId> path;
  for (VertexId v = end; v != no_id; v = reached[v].from) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace arris
