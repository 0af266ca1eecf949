#include "core/curvature_smoothing/smooth_curvature.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/parallel.h"

namespace arris {

namespace {

/// The two-ring of a vertex without what lies on lines or the border, each vertex once.
void two_ring(const Mesh& mesh, const std::vector<std::uint8_t>& regular, VertexId v,
              std::vector<VertexId>& ring) {
  ring.clear();
  const auto add = [&](VertexId w) {
    if (w != v && regular[w] && std::find(ring.begin(), ring.end(), w) == ring.end())
      ring.push_back(w);
  };
  mesh.for_ring(v, [&](HalfEdgeId h) { add(mesh.to(h)); });
  const std::size_t first = ring.size();
  for (std::size_t k = 0; k < first; ++k)
    mesh.for_ring(ring[k], [&](HalfEdgeId h) { add(mesh.to(h)); });
}

}  // namespace

Result<CurvaturesPtr> smooth_curvatures(const Mesh& mesh, const Curvatures& curvatures,
                                        const SharpLines& lines,
                                        const SmoothCurvatureOptions& options,
                                        const Context& context) {
  const std::size_t n = mesh.vertex_count();
  std::vector<std::uint8_t> regular(n);
  parallel_for(n, [&](std::size_t i) {
    const VertexId v = static_cast<VertexId>(i);
    bool off = !mesh.is_isolated(v) && !mesh.is_border(v);
    if (off && !lines.edges.empty())
      mesh.for_ring(v, [&](HalfEdgeId h) { off = off && !lines.is_sharp(h >> 1); });
    regular[i] = off;
  });

  auto result = std::make_shared<Curvatures>(curvatures);
  const auto fields = [](Curvatures& c) {
    return std::array{&c.k, &c.h, &c.kabs, &c.ih1, &c.ih2, &c.ik1, &c.ik2, &c.ikabs};
  };
  Curvatures before;
  for (int pass = 0; pass < options.passes; ++pass) {
    if (context.cancelled()) return cancelled();
    context.report(static_cast<double>(pass) / options.passes, "curvature smoothing");
    const auto from = fields(before), to = fields(*result);
    for (std::size_t f = 0; f < from.size(); ++f) *from[f] = *to[f];
    parallel_for(n, [&](std::size_t i) {
      if (!regular[i]) return;
      static thread_local std::vector<VertexId> ring;
      const VertexId v = static_cast<VertexId>(i);
      two_ring(mesh, regular, v, ring);
      std::array<double, 8> sum{};
      double weights = 0.0, largest = 0.0;
      for (const VertexId w : ring) {
        const double distance = (mesh.point(w) - mesh.point(v)).norm();
        if (!(distance > 0.0)) continue;
        const double weight = 1.0 / distance;
        largest = std::max(largest, weight);
        weights += weight;
        for (std::size_t f = 0; f < from.size(); ++f) sum[f] += weight * (*from[f])[w];
      }
      if (weights == 0.0) return;
      for (std::size_t f = 0; f < from.size(); ++f)
        (*to[f])[i] = (sum[f] + largest * (*from[f])[i]) / (weights + largest);
    });
  }
  context.report(1.0, "curvature smoothing");
  return CurvaturesPtr(std::move(result));
}

}  // namespace arris
