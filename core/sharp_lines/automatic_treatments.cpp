#include "core/sharp_lines/automatic_treatments.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <unordered_map>

namespace arris {

namespace {

/// Two lines count as side by side where their directions differ by less than 45 degrees.
constexpr double least_cosine = 0.7071;
/// A rounded sharp line spreads its exterior angle over the lines that double it; when two lines
/// together turn more than this (degrees), each is a line of its own: the two rims of a thin wall.
constexpr double most_turn = 150.0;
/// "Over most of its length": this share of the weaker line's vertices.
constexpr double most_of_length = 0.8;

void erase_line(const Mesh& mesh, const Line& line, std::vector<Origin>& edges) {
  for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
    edges[*mesh.find_edge(line.vertices[i], line.vertices[i + 1])] = Origin::none;
}

/// Direction of a line at its i-th vertex, not normalised.
Point direction_at(const Mesh& mesh, const Line& line, std::size_t i) {
  const std::vector<VertexId>& path = line.vertices;
  const std::size_t before = i > 0 ? i - 1 : line.closed ? path.size() - 2 : i;
  const std::size_t after = i + 1 < path.size() ? i + 1 : line.closed ? 1 : i;
  return mesh.point(path[after]) - mesh.point(path[before]);
}

double strength(const Line& line) { return std::abs(line.mean_angle) * line.length; }

/// One round of remove_parallel_lines(); true if a line went.
bool remove_parallel_round(const Mesh& mesh, const Curvatures& curvatures, int distance,
                           std::vector<Origin>& edges) {
  const std::vector<Line> lines = derive_lines(mesh, curvatures, edges);
  // The lines through each vertex: (vertex, line, place on it), sorted.
  struct Place {
    VertexId vertex;
    std::uint32_t line, index;
  };
  std::vector<Place> places;
  std::vector<bool> on_line(mesh.vertex_count(), false);
  for (std::uint32_t k = 0; k < lines.size(); ++k)
    for (std::uint32_t i = 0; i < lines[k].vertices.size(); ++i) {
      places.push_back({lines[k].vertices[i], k, i});
      on_line[lines[k].vertices[i]] = true;
    }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex
           : a.line != b.line   ? a.line < b.line
                                : a.index < b.index;
  });
  const auto places_of = [&](VertexId v) {
    return std::equal_range(places.begin(), places.end(), Place{v, 0, 0},
                            [](const Place& a, const Place& b) { return a.vertex < b.vertex; });
  };

  std::vector<std::uint32_t> order(lines.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double x = strength(lines[a]), y = strength(lines[b]);
    return x != y ? x < y : a > b;
  });
  std::vector<std::uint32_t> rank(lines.size());
  for (std::uint32_t r = 0; r < order.size(); ++r) rank[order[r]] = r;

  const double most_width = 1.5 * distance * mesh.mean_edge_length();
  std::vector<bool> gone(lines.size(), false);
  bool any = false;
  std::vector<VertexId> near;
  std::vector<std::uint32_t> seen(mesh.vertex_count(), 0);
  std::uint32_t stamp = 0;
  for (const std::uint32_t k : order) {
    const Line& line = lines[k];
    std::size_t beside = 0;
    double width = 0.0;
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      const VertexId v = line.vertices[i];
      const Point along = direction_at(mesh, line, i);
      near.assign(1, v);
      seen[v] = ++stamp;
      double nearest = most_width;
      bool found = false;
      std::size_t begin = 0;
      for (int ring = 0; ring <= distance; ++ring) {
        const std::size_t end = near.size();
        for (std::size_t n = begin; n < end; ++n) {
          const VertexId w = near[n];
          if (on_line[w])
            for (auto [it, last] = places_of(w); it != last; ++it) {
              const Line& other = lines[it->line];
              if (it->line == k || gone[it->line] || rank[it->line] < rank[k] ||
                  other.convex() != line.convex() ||
                  std::abs(other.mean_angle) + std::abs(line.mean_angle) > most_turn)
                continue;
              const Point theirs = direction_at(mesh, other, it->index);
              if (std::abs(along.dot(theirs)) < least_cosine * along.norm() * theirs.norm())
                continue;
              const double apart = (mesh.point(w) - mesh.point(v)).norm();
              if (apart > nearest) continue;
              nearest = apart;
              found = true;
            }
          if (ring < distance)
            mesh.for_ring(w, [&](HalfEdgeId h) {
              const VertexId x = mesh.to(h);
              if (seen[x] == stamp) return;
              seen[x] = stamp;
              near.push_back(x);
            });
        }
        begin = end;
      }
      if (!found) continue;
      ++beside;
      width += nearest;
    }
    if (beside == 0 || beside < most_of_length * line.vertices.size()) continue;
    // Shorter than the strip is wide: side by side says nothing (the edges of a small cube).
    if (line.length < 1.5 * width / beside) continue;
    gone[k] = true;
    any = true;
    erase_line(mesh, line, edges);
  }
  return any;
}

}  // namespace

void remove_parallel_lines(const Mesh& mesh, const Curvatures& curvatures, int distance,
                           std::vector<Origin>& edges) {
  // Lines that lost a neighbour at their end link up and are stronger together, so look again.
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round)
    if (!remove_parallel_round(mesh, curvatures, distance, edges)) return;
}

void bridge_gaps(const Mesh& mesh, const Curvatures& curvatures, double gap,
                 std::vector<Origin>& edges) {
  const std::vector<Line> lines = derive_lines(mesh, curvatures, edges);
  std::vector<std::uint8_t> degree(mesh.vertex_count(), 0);
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (edges[e] != Origin::none)
      for (const VertexId v : mesh.edge(e))
        if (degree[v] < 3) ++degree[v];
  // Loose ends with the direction in which their line leaves off.
  struct End {
    Point ahead;
    bool convex;
  };
  std::unordered_map<VertexId, End> ends;
  for (const Line& line : lines) {
    if (line.closed) continue;
    const std::size_t last = line.vertices.size() - 1, back = std::min<std::size_t>(3, last);
    for (const auto& [end, inner] : {std::pair{line.vertices.front(), line.vertices[back]},
                                     std::pair{line.vertices.back(), line.vertices[last - back]}})
      if (degree[end] == 1 && !mesh.is_border(end))
        ends[end] = {(mesh.point(end) - mesh.point(inner)).normalized(), line.convex()};
  }
  struct Bridge {
    double length;
    VertexId a, b;
    std::vector<EdgeId> path;
  };
  std::vector<Bridge> bridges;
  std::vector<VertexId> sources;
  for (const auto& [v, end] : ends) sources.push_back(v);
  std::sort(sources.begin(), sources.end());
  using Entry = std::pair<double, VertexId>;
  for (const VertexId a : sources) {
    // Dijkstra within `gap` of the end.
    std::unordered_map<VertexId, std::pair<double, HalfEdgeId>> reached{{a, {0.0, no_id}}};
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.push({0.0, a});
    while (!queue.empty()) {
      const auto [length, v] = queue.top();
      queue.pop();
      if (length > reached[v].first) continue;
      if (v != a && degree[v] > 0) {
        const auto other = ends.find(v);
        const Point across = (mesh.point(v) - mesh.point(a)).normalized();
        if (v > a && other != ends.end() && other->second.convex == ends[a].convex &&
            ends[a].ahead.dot(across) > least_cosine &&
            other->second.ahead.dot(across) < -least_cosine) {
          Bridge bridge{length, a, v, {}};
          for (VertexId w = v; w != a;) {
            const HalfEdgeId h = reached[w].second;
            bridge.path.push_back(h >> 1);
            w = mesh.from(h);
          }
          bridges.push_back(std::move(bridge));
        }
        continue;  // never through another line
      }
      mesh.for_ring(v, [&, length = length](HalfEdgeId h) {
        if (mesh.is_border_edge(h >> 1) || edges[h >> 1] != Origin::none) return;
        const double further = length + mesh.edge_length(h >> 1);
        if (further > gap) return;
        const auto [it, fresh] = reached.try_emplace(mesh.to(h), further, h);
        if (!fresh && further >= it->second.first) return;
        it->second = {further, h};
        queue.push({further, mesh.to(h)});
      });
    }
  }
  std::sort(bridges.begin(), bridges.end(), [](const Bridge& x, const Bridge& y) {
    return x.length != y.length ? x.length < y.length : std::pair{x.a, x.b} < std::pair{y.a, y.b};
  });
  for (const Bridge& bridge : bridges) {
    if (degree[bridge.a] != 1 || degree[bridge.b] != 1) continue;
    for (const EdgeId e : bridge.path) edges[e] = Origin::merged;
    ++degree[bridge.a];
    ++degree[bridge.b];
  }
}

void remove_short_lines(const Mesh& mesh, const Curvatures& curvatures, double min_length,
                        std::vector<Origin>& edges) {
  const std::vector<Line> lines = derive_lines(mesh, curvatures, edges);
  // Lines that share a vertex make one group.
  std::vector<std::uint32_t> group(lines.size());
  std::iota(group.begin(), group.end(), 0u);
  const auto root = [&](std::uint32_t k) {
    while (group[k] != k) k = group[k] = group[group[k]];
    return k;
  };
  std::unordered_map<VertexId, std::uint32_t> first_at;
  for (std::uint32_t k = 0; k < lines.size(); ++k)
    for (const VertexId v : {lines[k].vertices.front(), lines[k].vertices.back()}) {
      const auto [it, fresh] = first_at.try_emplace(v, k);
      if (!fresh) group[std::max(root(k), root(it->second))] = std::min(root(k), root(it->second));
    }
  std::vector<double> length(lines.size(), 0.0);
  for (std::uint32_t k = 0; k < lines.size(); ++k) length[root(k)] += lines[k].length;
  for (std::uint32_t k = 0; k < lines.size(); ++k)
    if (length[root(k)] < min_length) erase_line(mesh, lines[k], edges);
}

}  // namespace arris
