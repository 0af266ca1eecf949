#include "core/curvature_smoothing/smooth_curvature.h"
#include "core/document/operations/operations.h"

#include <utility>
#include <vector>

namespace arris {

namespace {

Result<nlohmann::json> resolve_flip(const Document&, const nlohmann::json& given) {
  return ParameterReader("flip_orientation", given).finish();
}

/// Faces keep their numbers and sharp edges stay sharp; convex becomes concave. Partitions stay:
/// Kabs and IKabs do not depend on the orientation.
Result<Document> apply_flip(const Document& document, const nlohmann::json&,
                            const Context& context) {
  std::vector<Triangle> triangles = document.mesh->triangles();
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  const auto points = document.mesh->points();
  Result<MeshPtr> mesh = Mesh::create({points.begin(), points.end()}, std::move(triangles));
  if (!mesh) return tl::unexpected<Error>(mesh.error());
  Result<CurvaturesPtr> curvatures =
      compute_curvatures(**mesh, document.curvatures->options, context);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  Document result = document;
  result.mesh = std::move(*mesh);
  result.curvatures = std::move(*curvatures);
  if (!document.lines.edges.empty()) {
    std::vector<Origin> edges(result.mesh->edge_count());  // edges have the same numbers
    for (EdgeId e = 0; e < edges.size(); ++e) edges[e] = document.lines.edges[e];
    result.lines =
        relink_lines(*result.mesh, *result.curvatures, edges, document.lines, result.next_id);
  }
  if (result.smoothed) {
    SmoothCurvatureOptions options;
    options.passes = result.smooth_curvature->parameters.at("passes");
    Result<CurvaturesPtr> smoothed =
        smooth_curvatures(*result.mesh, *result.curvatures, result.lines, options, context);
    if (!smoothed) return tl::unexpected<Error>(smoothed.error());
    result.smoothed = std::move(*smoothed);
  }
  return result;
}

std::string gist_flip(const nlohmann::json&) { return ""; }

}  // namespace

const OperationKind flip_orientation_operation{"flip_orientation", "Flip orientation", 1,
                                               resolve_flip,       apply_flip,         gist_flip};

}  // namespace arris
