#include "core/sharp_lines/lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_map>

#include "core/mesh/chains.h"

namespace arris {

namespace {

std::uint64_t edge_key(VertexId a, VertexId b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

}  // namespace

const Line* SharpLines::find(std::uint32_t id) const {
  const auto found =
      std::lower_bound(lines.begin(), lines.end(), id,
                       [](const LinePtr& line, std::uint32_t x) { return line->id < x; });
  return found != lines.end() && (*found)->id == id ? found->get() : nullptr;
}

std::vector<Line> derive_lines(const Mesh& mesh, const Curvatures& curvatures,
                               const std::vector<Origin>& edges) {
  std::vector<EdgeId> sharp;
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (edges[e] != Origin::none) sharp.push_back(e);
  const std::vector<Chain> chains = link_chains(
      mesh, sharp, [&](EdgeId e) { return edges[e] != Origin::none; },
      [](HalfEdgeId, HalfEdgeId) { return true; });
  std::vector<Line> lines;
  lines.reserve(chains.size());
  for (const Chain& chain : chains) {
    Line line;
    line.vertices = chain.vertices(mesh);
    line.closed = chain.closed;
    double turn = 0.0;
    for (const HalfEdgeId h : chain.half_edges) {
      const double length = mesh.edge_length(h >> 1);
      line.length += length;
      turn += length * curvatures.beta[h >> 1];
      line.origin = std::max(line.origin, edges[h >> 1]);
    }
    if (line.length > 0.0) line.mean_angle = turn / line.length * 180.0 / std::numbers::pi;
    lines.push_back(std::move(line));
  }
  return lines;
}

SharpLines relink_lines(const Mesh& mesh, const Curvatures& curvatures,
                        const std::vector<Origin>& edges, const SharpLines& previous,
                        std::uint32_t& next_id) {
  std::vector<Line> lines = derive_lines(mesh, curvatures, edges);

  std::unordered_map<std::uint64_t, std::uint32_t> old_line;
  for (std::uint32_t k = 0; k < previous.lines.size(); ++k) {
    const std::vector<VertexId>& path = previous.lines[k]->vertices;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) old_line[edge_key(path[i], path[i + 1])] = k;
  }
  // (shared length, old line, new line) of every pair that shares an edge.
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> shared;
  std::unordered_map<std::uint32_t, double> overlap;
  for (std::uint32_t j = 0; j < lines.size() && !old_line.empty(); ++j) {
    overlap.clear();
    const std::vector<VertexId>& path = lines[j].vertices;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      if (const auto it = old_line.find(edge_key(path[i], path[i + 1])); it != old_line.end())
        overlap[it->second] += (mesh.point(path[i + 1]) - mesh.point(path[i])).norm();
    for (const auto& [k, length] : overlap) shared.emplace_back(length, k, j);
  }
  std::sort(shared.begin(), shared.end(), [](const auto& a, const auto& b) {
    return std::get<0>(a) != std::get<0>(b)   ? std::get<0>(a) > std::get<0>(b)
           : std::get<1>(a) != std::get<1>(b) ? std::get<1>(a) < std::get<1>(b)
                                              : std::get<2>(a) < std::get<2>(b);
  });
  std::vector<bool> taken(previous.lines.size(), false);
  std::vector<const LinePtr*> successor_of(lines.size(), nullptr);
  for (const auto& [length, k, j] : shared) {
    if (taken[k] || successor_of[j]) continue;
    taken[k] = true;
    successor_of[j] = &previous.lines[k];
    lines[j].id = previous.lines[k]->id;
  }

  SharpLines result;
  result.edges = ChunkedArray<Origin>(edges, previous.edges);
  result.lines.reserve(lines.size());
  for (std::uint32_t j = 0; j < lines.size(); ++j) {
    if (lines[j].id == 0) lines[j].id = next_id++;
    if (successor_of[j] && **successor_of[j] == lines[j])
      result.lines.push_back(*successor_of[j]);
    else
      result.lines.push_back(std::make_shared<const Line>(std::move(lines[j])));
  }
  std::sort(result.lines.begin(), result.lines.end(),
            [](const LinePtr& a, const LinePtr& b) { return a->id < b->id; });
  return result;
}

}  // namespace arris
