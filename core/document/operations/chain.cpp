#include "core/document/operations/chain.h"

#include <algorithm>
#include <utility>

#include "core/simplification/working_mesh.h"

namespace arris {

Stage stage_before(const Document& document, std::string_view step) {
  const auto place = std::find(chain.begin(), chain.end(), step) - chain.begin();
  if (place > 1 && document.swapped.mesh) return document.swapped;
  if (place > 0 && document.simplified.mesh) return document.simplified;
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

void outdate_after(Document& document, std::string_view step) {
  const auto own = std::find(chain.begin(), chain.end(), step);
  const auto after = [&](std::string_view name) {
    return own == chain.end() || std::find(chain.begin(), chain.end(), name) > own;
  };
  for (const auto& [name, record] :
       {std::pair{"simplify", &document.simplify}, std::pair{"swap_edges", &document.swap_edges},
        std::pair{"find_sharp_lines", &document.find_sharp_lines},
        std::pair{"equilateralize", &document.equilateralize},
        std::pair{"smooth_curvature", &document.smooth_curvature},
        std::pair{"find_partitions", &document.find_partitions}})
    if (*record && after(name)) (*record)->out_of_date = true;
  if (after("simplify")) document.simplified = {};
  if (after("swap_edges")) document.swapped = {};
}

}  // namespace arris
