#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

/// The walk of section 6.1 (figure 26) and its closing pass, over any store of sharp edges.
///
/// `Edges` holds the set that grows: `is_sharp(e)`, `degree(v)` (sharp edges at v), `take(e)`, and
/// `may_take(e)` for the part of the mesh the walk keeps to.
template <class Edges>
class CandidateWalk {
 public:
  CandidateWalk(const Mesh& mesh, const Curvatures& curvatures, const SharpLineOptions& options,
                Edges& edges)
      : mesh_(mesh),
        curvatures_(curvatures),
        options_(options),
        tv_ik_(ikabs_of_straight_edge(options.angle * std::numbers::pi / 180.0)),
        candidates_(static_cast<std::size_t>(std::max(options.candidates, 1))),
        edges_(edges) {}

  double tv_ik() const { return tv_ik_; }

  /// Loop 2 from v on: until there is no candidate, or a line or the border is reached. True when
  /// it came back to v.
  bool walk(VertexId seed) {
    VertexId v = seed;
    for (;;) {
      const HalfEdgeId h = candidate(v);
      if (h == no_id) return false;
      const VertexId next = mesh_.to(h);
      const bool on_line = edges_.degree(next) > 0;
      edges_.take(Mesh::edge_of(h));
      if (on_line || mesh_.is_border(next)) return next == seed;
      v = next;
    }
  }

  /// Loop 1 over vertices in decreasing IKabs.
  template <class Seeds>
  void run(const Seeds& seeds) {
    for (const VertexId seed : seeds) {
      if (curvatures_.ikabs[seed] <= tv_ik_) break;
      if (edges_.degree(seed) > 0) continue;
      if (!walk(seed)) walk(seed);
    }
  }

  /// All vertices are on lines before all edges are: of `open` (ascending), a free edge above TV_IH
  /// between two of them joins, the sharpest first.
  void close(std::vector<EdgeId> open) {
    std::erase_if(open, [&](EdgeId e) {
      return !may_be_sharp(curvatures_.beta[e], options_) || !is_free(e) ||
             edges_.degree(mesh_.edge(e)[0]) == 0 || edges_.degree(mesh_.edge(e)[1]) == 0;
    });
    std::sort(open.begin(), open.end(), [&](EdgeId a, EdgeId b) {
      const float x = std::abs(curvatures_.beta[a]), y = std::abs(curvatures_.beta[b]);
      return x != y ? x > y : a < b;
    });
    for (const EdgeId e : open)
      if (!makes_triangle(e)) edges_.take(e);
  }

 private:
  bool is_free(EdgeId e) const {
    return !edges_.is_sharp(e) && !mesh_.is_border_edge(e) && edges_.may_take(e);
  }

  /// True if edge e makes a triangle with two edges that are sharp already.
  bool makes_triangle(EdgeId e) const {
    for (const HalfEdgeId h : {2 * e, 2 * e + 1})
      if (mesh_.face(h) != no_id && edges_.is_sharp(mesh_.next(h) >> 1) &&
          edges_.is_sharp(mesh_.previous(h) >> 1))
        return true;
    return false;
  }

  /// Figure 26: the candidate edge at v as an outgoing half-edge; no_id: there is none.
  HalfEdgeId candidate(VertexId v) {
    ring_.clear();
    mesh_.for_ring(v, [&](HalfEdgeId h) {
      if (is_free(Mesh::edge_of(h))) ring_.push_back(h);
    });
    const std::size_t kept = std::min(candidates_, ring_.size());
    std::partial_sort(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(kept), ring_.end(),
                      [&](HalfEdgeId a, HalfEdgeId b) {
                        const float x = std::abs(curvatures_.beta[a >> 1]);
                        const float y = std::abs(curvatures_.beta[b >> 1]);
                        return x != y ? x > y : mesh_.to(a) < mesh_.to(b);
                      });
    HalfEdgeId best = no_id;
    double best_ikabs = tv_ik_;
    for (std::size_t k = 0; k < kept; ++k) {
      const HalfEdgeId h = ring_[k];
      if (!may_be_sharp(curvatures_.beta[Mesh::edge_of(h)], options_)) continue;
      const double ikabs = curvatures_.ikabs[mesh_.to(h)];
      const bool better = best == no_id ? ikabs > best_ikabs
                                        : ikabs > best_ikabs ||
                                              (ikabs == best_ikabs && mesh_.to(h) < mesh_.to(best));
      if (!better || makes_triangle(Mesh::edge_of(h))) continue;
      best = h;
      best_ikabs = ikabs;
    }
    return best;
  }

  const Mesh& mesh_;
  const Curvatures& curvatures_;
  const SharpLineOptions options_;
  const double tv_ik_;
  const std::size_t candidates_;
  Edges& edges_;
  std::vector<HalfEdgeId> ring_;
};

}  // namespace arris
