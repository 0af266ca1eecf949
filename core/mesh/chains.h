#pragma once

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// A path of half-edges, each starting where the one before ends.
struct Chain {
  std::vector<HalfEdgeId> half_edges;
  bool closed = false;

  /// The vertices passed; a closed chain repeats its first vertex at the end.
  std::vector<VertexId> vertices(const Mesh& mesh) const {
    std::vector<VertexId> result;
    result.reserve(half_edges.size() + 1);
    if (!half_edges.empty()) result.push_back(mesh.from(half_edges.front()));
    for (const HalfEdgeId h : half_edges) result.push_back(mesh.to(h));
    return result;
  }
};

/// Marks on edges: a bit each, or a hash set where so few are meant that the bits cost more.
class EdgeMarks {
 public:
  EdgeMarks(const Mesh& mesh, std::size_t expected) {
    constexpr std::size_t few = 256;
    if (expected > mesh.edge_count() / few) dense_.resize(mesh.edge_count(), false);
  }
  bool has(EdgeId e) const { return dense_.empty() ? sparse_.contains(e) : dense_[e]; }
  void mark(EdgeId e) {
    if (dense_.empty())
      sparse_.insert(e);
    else
      dense_[e] = true;
  }

 private:
  std::vector<bool> dense_;
  std::unordered_set<EdgeId> sparse_;
};

/// Links a set of edges into chains: each edge is in exactly one chain; a chain goes on through a
/// vertex that has exactly two edges of the set, where `continues(h, next)` also agrees (`h` ends
/// and `next` starts at the vertex). Chains come in the order of their lowest edge id; an open
/// chain runs from its end with the lower vertex id, a closed one (no cut anywhere) starts at its
/// lowest vertex towards the lower neighbour; so the result does not depend on how the set came
/// about.
///
/// `edges`: increasing edge ids, of the set or of a part of it: the chains through these are made.
/// `in_set(e)`: whether edge e is in the set. The cost follows the chains, not the mesh.
template <class InSet, class Continues>
std::vector<Chain> link_chains(const Mesh& mesh, const std::vector<EdgeId>& edges,
                               const InSet& in_set, const Continues& continues) {
  // The one other edge of the set at the end of h, as a half-edge; no_id at an extremity.
  const auto successor = [&](HalfEdgeId h) {
    HalfEdgeId found = no_id;
    int count = 0;
    mesh.for_ring(mesh.to(h), [&](HalfEdgeId out) {
      if (!in_set(Mesh::edge_of(out))) return;
      ++count;
      if (Mesh::edge_of(out) != Mesh::edge_of(h)) found = out;
    });
    return count == 2 && continues(h, found) ? found : no_id;
  };

  std::vector<Chain> chains;
  EdgeMarks linked(mesh, edges.size());
  for (const EdgeId e : edges) {
    if (linked.has(e)) continue;
    Chain chain;
    HalfEdgeId h = 2 * e;
    while (h != no_id && !linked.has(Mesh::edge_of(h))) {
      linked.mark(Mesh::edge_of(h));
      chain.half_edges.push_back(h);
      h = successor(h);
    }
    chain.closed = h != no_id && (Mesh::edge_of(h)) == e;
    if (!chain.closed) {
      const std::size_t ahead = chain.half_edges.size();
      for (h = successor(2 * e + 1); h != no_id && !linked.has(Mesh::edge_of(h));
           h = successor(h)) {
        linked.mark(Mesh::edge_of(h));
        chain.half_edges.push_back(Mesh::opposite(h));
      }
      const auto middle = chain.half_edges.begin() + static_cast<std::ptrdiff_t>(ahead);
      std::reverse(middle, chain.half_edges.end());
      std::rotate(chain.half_edges.begin(), middle, chain.half_edges.end());
    }
    std::vector<HalfEdgeId>& path = chain.half_edges;
    const auto reverse = [&] {
      std::reverse(path.begin(), path.end());
      for (HalfEdgeId& x : path) x = Mesh::opposite(x);
    };
    if (chain.closed) {
      std::size_t lowest = 0;
      for (std::size_t k = 1; k < path.size(); ++k)
        if (mesh.from(path[k]) < mesh.from(path[lowest])) lowest = k;
      const VertexId ahead = mesh.to(path[lowest]);
      const VertexId behind = mesh.from(path[(lowest + path.size() - 1) % path.size()]);
      std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(lowest), path.end());
      if (behind < ahead) reverse();
    } else {
      const VertexId first = mesh.from(path.front()), last = mesh.to(path.back());
      if (last < first || (last == first && mesh.from(path.back()) < mesh.to(path.front())))
        reverse();
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace arris
