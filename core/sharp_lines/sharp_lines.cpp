#include "core/sharp_lines/sharp_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/sharp_lines/automatic_treatments.h"
#include "core/sharp_lines/candidate_walk.h"

namespace arris {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Sharp edges of a whole mesh while they are identified.
class WholeMesh {
 public:
  explicit WholeMesh(const Mesh& mesh)
      : mesh_(mesh), edges_(mesh.edge_count(), Origin::none), degree_(mesh.vertex_count(), 0) {}

  bool is_sharp(EdgeId e) const { return edges_[e] != Origin::none; }
  bool may_take(EdgeId) const { return true; }
  unsigned degree(VertexId v) const { return degree_[v]; }
  void take(EdgeId e) {
    edges_[e] = Origin::found;
    for (const VertexId v : mesh_.edge(e)) ++degree_[v];
  }
  std::vector<Origin> result() { return std::move(edges_); }

 private:
  const Mesh& mesh_;
  std::vector<Origin> edges_;
  std::vector<std::uint16_t> degree_;
};

}  // namespace

std::vector<Origin> identify_sharp_edges(const Mesh& mesh, const Curvatures& curvatures,
                                         const SharpLineOptions& options) {
  WholeMesh edges(mesh);
  CandidateWalk<WholeMesh> walk(mesh, curvatures, options, edges);
  walk.run(curvatures.by_decreasing_ikabs);
  std::vector<EdgeId> all(mesh.edge_count());
  std::iota(all.begin(), all.end(), EdgeId{0});
  walk.close(std::move(all));
  return edges.result();
}

std::vector<EdgeId> choose_sharp_edges(const Mesh& mesh, const LineEvidence& evidence,
                                       const SharpLineOptions& options) {
  const double unit = mesh.mean_edge_length() > 0.0 ? mesh.mean_edge_length() : 1.0;
  LineChoiceOptions choice;
  choice.angle = static_cast<float>(options.angle);
  choice.max_angle = static_cast<float>(options.max_angle);
  choice.convex = options.convexity != Convexity::concave;
  choice.concave = options.convexity != Convexity::convex;
  choice.clear_slit = static_cast<float>(clear_jump(evidence.noise));
  choice.gap = static_cast<float>(options.bridge_gap / unit);
  choice.least_group = static_cast<float>(options.min_length / unit);
  return evidence.candidates.choose(choice);
}

Result<std::vector<Origin>> find_sharp_edges(const Mesh& mesh, const Curvatures& curvatures,
                                             const LineEvidence* evidence,
                                             const SharpLineOptions& options,
                                             const Context& context) {
  context.report(0.0, "sharp lines");
  if (options.method == LineMethod::normal_jump) {
    std::vector<Origin> edges(mesh.edge_count(), Origin::none);
    for (const EdgeId e : choose_sharp_edges(mesh, *evidence, options)) edges[e] = Origin::found;
    context.report(1.0, "sharp lines");
    return edges;
  }
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

double default_sharp_angle(const Mesh& mesh, const Curvatures& curvatures, LineMethod method) {
  if (method == LineMethod::normal_jump)
    return std::round(jump_threshold(normal_noise(mesh, FaceTable(mesh))));
  return std::clamp(std::round(2.5 * angle_noise(curvatures)), 20.0, 60.0);
}

double default_min_length(const Mesh& mesh, LineMethod method) {
  return (method == LineMethod::normal_jump ? 6.0 : 3.0) * mesh.mean_edge_length();
}

double default_bridge_gap(const Mesh& mesh, LineMethod method) {
  return method == LineMethod::normal_jump ? 4.0 * mesh.mean_edge_length() : 0.0;
}

}  // namespace arris
