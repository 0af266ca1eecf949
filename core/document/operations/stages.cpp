#include "core/document/operations/stages.h"

#include <utility>

#include "core/simplification/working_mesh.h"

namespace arris {

Stage stage_before(const Document& document, StepName step) {
  for (std::size_t k = step.place; k-- > 0;)
    if (document.outputs[k].mesh) return document.outputs[k];
  return document.opened;
}

std::vector<Origin> sharp_edges_on(const Document& document, const Mesh& mesh) {
  return carry_sharp_edges(*document.mesh, document.lines.edges, mesh);
}

Result<void> change_mesh(Document& document, Stage stage, const Context& context) {
  if (stage.mesh == document.mesh) return {};
  if (!stage.curvatures) {
    Result<CurvaturesPtr> curvatures =
        compute_curvatures(*stage.mesh, document.curvatures->options, context);
    if (!curvatures) return tl::unexpected<Error>(curvatures.error());
    stage.curvatures = std::move(*curvatures);
  }
  if (!stage.evidence)
    stage.evidence = std::make_shared<const SharedLineEvidence>(stage.mesh, stage.curvatures);
  std::vector<Origin> edges;
  if (!document.lines.edges.empty()) edges = sharp_edges_on(document, *stage.mesh);
  document.mesh = std::move(stage.mesh);
  document.curvatures = std::move(stage.curvatures);
  document.evidence = std::move(stage.evidence);
  if (!edges.empty())
    document.lines = relink_lines(*document.mesh, *line_measures(document), edges, document.lines,
                                  document.next_id);
  document.zones = std::move(stage.zones);
  document.smoothed = nullptr;
  document.partitions = {};
  return {};
}

namespace {

void outdate_from(Document& document, std::size_t first) {
  for (std::size_t k = first; k < chain_steps.size(); ++k) {
    if (document.steps[k]) document.steps[k]->out_of_date = true;
    document.outputs[k] = {};
  }
}

}  // namespace

void outdate_after(Document& document, StepName step) { outdate_from(document, step.place + 1); }
void outdate_all(Document& document) { outdate_from(document, 0); }

}  // namespace arris
