#include "tests/bench/accuracy/turning.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/mesh/chains.h"

namespace arris::accuracy {

namespace {

bool is_closed(const Polyline& chain) { return chain.size() > 2 && chain.front() == chain.back(); }

double length_of(const Polyline& chain) {
  double length = 0.0;
  for (std::size_t k = 1; k < chain.size(); ++k) length += (chain[k] - chain[k - 1]).norm();
  return length;
}

/// Radians; segments without length have no direction and are passed over.
double turn_of(const Polyline& chain) {
  std::vector<Point> directions;
  for (std::size_t k = 1; k < chain.size(); ++k)
    if (const Point along = chain[k] - chain[k - 1]; along.norm() > 0.0)
      directions.push_back(along.normalized());
  if (is_closed(chain) && !directions.empty()) directions.push_back(directions.front());
  double turn = 0.0;
  for (std::size_t k = 1; k < directions.size(); ++k)
    turn += std::atan2(directions[k - 1].cross(directions[k]).norm(),
                       directions[k - 1].dot(directions[k]));
  return turn;
}

Polyline smoothed(Polyline chain, int rounds) {
  const bool closed = is_closed(chain);
  for (int round = 0; round < rounds; ++round) {
    Polyline next = chain;
    for (std::size_t k = 1; k + 1 < chain.size(); ++k)
      next[k] = (chain[k - 1] + chain[k] + chain[k + 1]) / 3.0;
    if (closed)
      next.front() = next.back() = (chain[chain.size() - 2] + chain.front() + chain[1]) / 3.0;
    chain = std::move(next);
  }
  return chain;
}

}  // namespace

Turning turning_of(const std::vector<Polyline>& chains, double mean_edge,
                   const TurningOptions& options) {
  double turn = 0.0, length = 0.0, smoothed_turn = 0.0, smoothed_length = 0.0;
  for (const Polyline& chain : chains) {
    if (chain.size() < options.least_edges + 1) continue;
    turn += turn_of(chain);
    length += length_of(chain);
    const Polyline smooth = smoothed(chain, options.rounds);
    smoothed_turn += turn_of(smooth);
    smoothed_length += length_of(smooth);
  }
  if (length < options.least_length * mean_edge || !(smoothed_length > 0.0)) return {};
  const double degrees = mean_edge * 180.0 / std::numbers::pi;
  return {degrees * turn / length, degrees * smoothed_turn / smoothed_length};
}

std::vector<EdgeId> edges_between(const Mesh& mesh, const std::vector<std::uint32_t>& labels,
                                  std::uint32_t none) {
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.is_border_edge(e)) continue;
    const auto [left, right] = mesh.edge_faces(e);
    if (labels[left] != labels[right] && labels[left] != none && labels[right] != none)
      edges.push_back(e);
  }
  return edges;
}

std::vector<Polyline> chains_of(const Mesh& mesh, const std::vector<EdgeId>& edges) {
  std::vector<Polyline> result;
  const auto in_set = [&](EdgeId e) { return std::ranges::binary_search(edges, e); };
  const auto goes_on = [](HalfEdgeId, HalfEdgeId) { return true; };
  for (const Chain& chain : link_chains(mesh, edges, in_set, goes_on)) {
    Polyline line;
    for (const VertexId v : chain.vertices(mesh)) line.push_back(mesh.point(v));
    result.push_back(std::move(line));
  }
  return result;
}

}  // namespace arris::accuracy
