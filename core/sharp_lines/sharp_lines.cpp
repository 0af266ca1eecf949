#include "core/sharp_lines/sharp_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sharp_lines/automatic_treatments.h"

namespace arris {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The walk of section 6.1 over one mesh.
class Identification {
 public:
  Identification(const Mesh& mesh, const Curvatures& curvatures, const SharpLineOptions& options)
      : mesh_(mesh),
        curvatures_(curvatures),
        tv_ih_(options.angle * degree),
        tv_ik_(ikabs_of_straight_edge(tv_ih_)),
        candidates_(static_cast<std::size_t>(std::max(options.candidates, 1))),
        edges_(mesh.edge_count(), Origin::none),
        degree_(mesh.vertex_count(), 0) {}

  std::vector<Origin> run() {
    for (const VertexId seed : curvatures_.by_decreasing_ikabs) {  // Loop 1
      if (curvatures_.ikabs[seed] <= tv_ik_) break;
      if (degree_[seed] > 0) continue;
      if (!walk(seed)) walk(seed);
    }
    close();
    return std::move(edges_);
  }

 private:
  /// Loop 2: true when the walk came back to its seed.
  bool walk(VertexId seed) {
    VertexId v = seed;
    for (;;) {
      const HalfEdgeId h = candidate(v);
      if (h == no_id) return false;
      const VertexId next = mesh_.to(h);
      const bool on_line = degree_[next] > 0;
      take(h >> 1);
      if (on_line || mesh_.is_border(next)) return next == seed;
      v = next;
    }
  }

  void take(EdgeId e) {
    edges_[e] = Origin::found;
    ++degree_[mesh_.edge(e)[0]];
    ++degree_[mesh_.edge(e)[1]];
  }

  bool is_free(EdgeId e) const { return edges_[e] == Origin::none && !mesh_.is_border_edge(e); }

  /// True if edge e makes a triangle with two edges that are sharp already.
  bool makes_triangle(EdgeId e) const {
    for (const HalfEdgeId h : {2 * e, 2 * e + 1})
      if (mesh_.face(h) != no_id && edges_[mesh_.next(h) >> 1] != Origin::none &&
          edges_[mesh_.previous(h) >> 1] != Origin::none)
        return true;
    return false;
  }

  /// Figure 26: the candidate edge at v as an outgoing half-edge; no_id: there is none.
  HalfEdgeId candidate(VertexId v) {
    ring_.clear();
    mesh_.for_ring(v, [&](HalfEdgeId h) {
      if (is_free(h >> 1)) ring_.push_back(h);
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
      if (std::abs(curvatures_.beta[h >> 1]) <= tv_ih_) break;
      const double ikabs = curvatures_.ikabs[mesh_.to(h)];
      const bool better = best == no_id ? ikabs > best_ikabs
                                        : ikabs > best_ikabs ||
                                              (ikabs == best_ikabs && mesh_.to(h) < mesh_.to(best));
      if (!better || makes_triangle(h >> 1)) continue;
      best = h;
      best_ikabs = ikabs;
    }
    return best;
  }

  /// All vertices are on lines before all edges are: a free edge above TV_IH between two of them
  /// joins, the sharpest first.
  void close() {
    std::vector<EdgeId> open;
    for (EdgeId e = 0; e < edges_.size(); ++e)
      if (std::abs(curvatures_.beta[e]) > tv_ih_ && is_free(e) && degree_[mesh_.edge(e)[0]] > 0 &&
          degree_[mesh_.edge(e)[1]] > 0)
        open.push_back(e);
    std::sort(open.begin(), open.end(), [&](EdgeId a, EdgeId b) {
      const float x = std::abs(curvatures_.beta[a]), y = std::abs(curvatures_.beta[b]);
      return x != y ? x > y : a < b;
    });
    for (const EdgeId e : open)
      if (!makes_triangle(e)) take(e);
  }

  const Mesh& mesh_;
  const Curvatures& curvatures_;
  const double tv_ih_;
  const double tv_ik_;
  const std::size_t candidates_;
  std::vector<Origin> edges_;
  std::vector<std::uint16_t> degree_;  // sharp edges at each vertex
  std::vector<HalfEdgeId> ring_;
};

}  // namespace

std::vector<Origin> identify_sharp_edges(const Mesh& mesh, const Curvatures& curvatures,
                                         const SharpLineOptions& options) {
  return Identification(mesh, curvatures, options).run();
}

Result<std::vector<Origin>> find_sharp_edges(const Mesh& mesh, const Curvatures& curvatures,
                                             const SharpLineOptions& options,
                                             const Context& context) {
  context.report(0.0, "sharp lines");
  std::vector<Origin> edges = identify_sharp_edges(mesh, curvatures, options);
  if (context.cancelled()) return cancelled();
  context.report(0.5, "sharp lines");
  if (options.parallel_distance > 0)
    remove_parallel_lines(mesh, curvatures, options.parallel_distance, edges);
  if (context.cancelled()) return cancelled();
  context.report(0.8, "sharp lines");
  if (options.bridge_gap > 0.0) bridge_gaps(mesh, curvatures, options.bridge_gap, edges);
  if (options.min_length > 0.0) remove_short_lines(mesh, curvatures, options.min_length, edges);
  context.report(1.0, "sharp lines");
  return edges;
}

double angle_noise(const Curvatures& curvatures) {
  if (curvatures.beta.empty()) return 0.0;
  std::vector<float> sizes(curvatures.beta.size());
  std::transform(curvatures.beta.begin(), curvatures.beta.end(), sizes.begin(),
                 [](float b) { return std::abs(b); });
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle / degree;  // median of |x| to standard deviation of a Gaussian
}

double default_sharp_angle(const Mesh&, const Curvatures& curvatures) {
  return std::clamp(std::round(2.7 * angle_noise(curvatures)), 20.0, 60.0);
}

double default_min_length(const Mesh& mesh) { return 3.0 * mesh.mean_edge_length(); }

}  // namespace arris
