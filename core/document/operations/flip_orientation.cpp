#include "core/document/operations/operations.h"
#include "core/document/operations/stages.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace arris {

namespace {

Result<Stage> flipped(const Stage& stage, const Context& context) {
  if (!stage.mesh) return Stage{};
  std::vector<Triangle> triangles = stage.mesh->triangles();
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  const auto points = stage.mesh->points();
  Result<MeshPtr> mesh = Mesh::create({points.begin(), points.end()}, std::move(triangles));
  if (!mesh) return tl::unexpected<Error>(mesh.error());
  Result<CurvaturesPtr> curvatures = compute_curvatures(**mesh, stage.curvatures->options, context);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  auto evidence = std::make_shared<const SharedLineEvidence>(*mesh, *curvatures);
  return Stage{std::move(*mesh), std::move(*curvatures), stage.zones, std::move(evidence)};
}

/// Faces and edges keep their numbers, so lines, zones and partitions stay: Kabs and IKabs do not
/// depend on the orientation. Convex becomes concave.
Result<Document> apply_flip(const Document& document, const nlohmann::json&,
                            const Context& context) {
  Document result = document;
  Stage current{document.mesh, document.curvatures, document.zones, document.evidence};
  std::vector<std::pair<MeshPtr, Stage>> done;  // outputs share meshes
  std::vector<Stage*> stages{&result.opened, &current};
  for (Stage& output : result.outputs) stages.push_back(&output);
  for (Stage* stage : stages) {
    const auto known = std::find_if(done.begin(), done.end(),
                                    [&](const auto& d) { return d.first == stage->mesh; });
    if (known != done.end()) {
      stage->mesh = known->second.mesh;
      stage->curvatures = known->second.curvatures;
      stage->evidence = known->second.evidence;
      continue;
    }
    const MeshPtr before = stage->mesh;
    Result<Stage> turned = flipped(*stage, context);
    if (!turned) return tl::unexpected<Error>(turned.error());
    *stage = std::move(*turned);
    done.emplace_back(before, *stage);
  }
  result.mesh = current.mesh;
  result.curvatures = current.curvatures;
  result.evidence = current.evidence;
  if (!document.lines.edges.empty())
    result.lines =
        relink_lines(*result.mesh, *line_measures(result), sharp_edges_on(document, *result.mesh),
                     document.lines, result.next_id);
  if (document.smoothed) {
    // Not smoothed anew: the lines may have changed since, and flipping twice must change nothing.
    auto turned = std::make_shared<Curvatures>(*document.smoothed);
    for (std::vector<double>* values : {&turned->h_area, &turned->h, &turned->ih1, &turned->ih2})
      for (double& value : *values) value = -value;
    turned->beta = result.curvatures->beta;
    turned->shape = result.curvatures->shape;
    result.smoothed = std::move(turned);
  }
  return result;
}

}  // namespace

std::vector<OperationKind> orientation_rows() {
  return {{.name = "flip_orientation",
           .title = "Flip orientation",
           .help = "Turns all faces over: convex becomes concave.",
           .apply = apply_flip}};
}

}  // namespace arris
