#include "core/sharp_lines/exact_creases.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/chains.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

/// Whether about an edge there are enough edges without any angle.
bool is_clean(const Mesh& mesh, const std::vector<float>& beta, EdgeId e,
              const ExactCreaseOptions& options) {
  int flat = 0, all = 0;
  for (const VertexId v : mesh.edge(e))
    mesh.for_ring(v, [&](HalfEdgeId h) {
      const EdgeId other = h >> 1;
      if (other == e || mesh.is_border_edge(other)) return;
      ++all;
      flat += std::abs(beta[other]) * in_degrees<float> <= options.flat;
    });
  // Two faces alone have nothing about them that could be noisy.
  return static_cast<float>(flat) >= options.flat_share * static_cast<float>(all);
}

/// Share of the edges within two rings of an edge that have no angle.
double flat_share_about(const Mesh& mesh, const std::vector<float>& beta, EdgeId e, float flat) {
  int count = 0, all = 0;
  for (const VertexId v : mesh.edge(e))
    mesh.for_ring(v, [&](HalfEdgeId out) {
      mesh.for_ring(mesh.to(out), [&](HalfEdgeId h) {
        ++all;
        count += !mesh.is_border_edge(h >> 1) && std::abs(beta[h >> 1]) * in_degrees<float> <= flat;
      });
    });
  return static_cast<double>(count) / all;
}

/// Whether the windows about an edge are fit to judge it: its faces are about as large as most, and
/// most of what surrounds it is flat, so that it is not the whole of a small part that they see.
bool has_windows(const Mesh& mesh, const FaceTable& table, EdgeId e, double flat_share) {
  constexpr double least_length = 0.4, most_length = 2.5;
  constexpr double least_share = 0.15;
  constexpr std::size_t least_faces = 500;
  if (table.size() < least_faces || flat_share < least_share) return false;
  for (const FaceId f : mesh.edge_faces(e))
    for (const EdgeId side : table.sides[f]) {
      const double length = mesh.edge_length(side) / table.unit;
      if (length < least_length || length > most_length) return false;
    }
  return true;
}

}  // namespace

std::vector<BorderEdge> find_exact_creases(const Mesh& mesh, const std::vector<float>& beta,
                                           const FaceTable& table, const NormalJump& jump,
                                           const ExactCreaseOptions& options) {
  std::vector<std::uint8_t> is_crease(mesh.edge_count(), 0);
  parallel_for(is_crease.size(), [&](std::size_t i) {
    const EdgeId e = static_cast<EdgeId>(i);
    is_crease[i] = std::abs(beta[i]) * in_degrees<float> >= options.least_angle &&
                   !mesh.is_border_edge(e) && is_clean(mesh, beta, e, options);
  });
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < is_crease.size(); ++e)
    if (is_crease[e]) edges.push_back(e);
  // Whole chains are judged, since a window at a corner says little.
  const std::vector<Chain> chains = link_chains(
      mesh, edges, [&](EdgeId e) { return is_crease[e] != 0; },
      [](HalfEdgeId, HalfEdgeId) { return true; });
  for (const Chain& chain : chains) {
    double judged = 0.0, agreed = 0.0, length = 0.0;
    for (const HalfEdgeId h : chain.half_edges) {
      const EdgeId e = h >> 1;
      const double own = mesh.edge_length(e) / table.unit;
      length += own;
      if (!has_windows(mesh, table, e, flat_share_about(mesh, beta, e, options.flat))) continue;
      judged += own;
      const float angle = std::abs(beta[e]) * in_degrees<float>;
      if (angle > options.most_facet || jump.at_edge[e] >= options.least_jump * angle)
        agreed += own;
    }
    if (judged > 0.2 * length && agreed < 0.5 * judged)
      for (const HalfEdgeId h : chain.half_edges) is_crease[h >> 1] = 0;
  }
  std::vector<BorderEdge> result;
  std::vector<EdgeId> group;
  for (const EdgeId start : edges) {
    if (is_crease[start] != 1) continue;
    group.assign(1, start);
    is_crease[start] = 2;
    double length = 0.0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      length += mesh.edge_length(group[k]) / table.unit;
      for (const VertexId v : mesh.edge(group[k]))
        mesh.for_ring(v, [&](HalfEdgeId h) {
          if (is_crease[h >> 1] != 1) return;
          is_crease[h >> 1] = 2;
          group.push_back(h >> 1);
        });
    }
    if (length < options.least_length) continue;
    // Where corners are cut, as a scan cuts them, most edges turn by a part of the jump only.
    double judged = 0.0, beyond = 0.0, flat = 0.0;
    for (const EdgeId e : group) {
      const double share = flat_share_about(mesh, beta, e, options.flat);
      flat += share / static_cast<double>(group.size());
      if (!has_windows(mesh, table, e, share)) continue;
      judged += mesh.edge_length(e);
      if (jump.at_edge[e] > options.most_jump * std::abs(beta[e]) * in_degrees<float>)
        beyond += mesh.edge_length(e);
    }
    // On a noisy scan an edge may look clean by chance, but not with all that surrounds it.
    if (beyond > options.most_beyond * judged || flat < options.group_flat_share) continue;
    for (const EdgeId e : group) {
      const float angle = beta[e] * in_degrees<float>;
      result.push_back({e, std::abs(angle), {angle, angle, std::abs(angle)}, true});
    }
  }
  std::sort(result.begin(), result.end(),
            [](const BorderEdge& a, const BorderEdge& b) { return a.edge < b.edge; });
  return result;
}

std::vector<BorderEdge> merge_creases(const Mesh& mesh, const std::vector<BorderEdge>& borders,
                                      std::vector<BorderEdge> creases) {
  if (creases.empty()) return borders;
  constexpr int rings = 2;
  const std::vector<std::uint8_t> near = vertices_near(mesh, creases, 0.0F, rings);
  for (const BorderEdge& border : borders) {
    const EdgeVertices& ends = mesh.edge(border.edge);
    if (!near[ends[0]] && !near[ends[1]]) creases.push_back(border);
  }
  std::sort(creases.begin(), creases.end(),
            [](const BorderEdge& a, const BorderEdge& b) { return a.edge < b.edge; });
  return creases;
}

}  // namespace arris
