// simplify, swap_edges and equilateralize: the phases of figure 2 that change the mesh.

#include <algorithm>
#include <iterator>

#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/operations/stages.h"
#include "core/edge_swapping/equilateralize.h"
#include "core/edge_swapping/swap_edges.h"
#include "core/mesh/face_quality.h"
#include "core/simplification/noise.h"
#include "core/simplification/simplify.h"

namespace arris {

namespace {

/// The sharp edges that a step starting from `base` must leave alone.
ChunkedArray<Origin> locked_edges(const Document& document, const Mesh& base) {
  if (document.lines.edges.empty()) return {};
  return {sharp_edges_on(document, base), {}};
}

/// Takes the result of a phase over as the current mesh; `output` keeps it for the steps after.
Result<Document> take(const Document& document, const Stage& base, Prepared prepared, StepName step,
                      const nlohmann::json& parameters, const Context& context) {
  Document result = document;
  outdate_after(result, step);
  Stage stage{std::move(prepared.mesh), nullptr, std::move(prepared.zones), nullptr};
  if (stage.mesh->hash() == base.mesh->hash()) {  // nothing to do was found
    stage.mesh = base.mesh;
    stage.curvatures = base.curvatures;
    stage.evidence = base.evidence;
  }
  if (const auto changed = change_mesh(result, stage, context); !changed)
    return tl::unexpected<Error>(changed.error());
  result.zones = stage.zones;
  if (chain_steps[step.place].leaves_mesh)
    result.outputs[step.place] = {result.mesh, result.curvatures, result.zones, result.evidence};
  result.step(step) = Step{parameters, false};
  return result;
}

nlohmann::json zone_of_noise(const DefaultFrom& from) {
  return default_error_zone(*from.document.opened.mesh);
}
nlohmann::json edges_of_scan(const DefaultFrom& from) {
  return default_max_edge_length(*from.document.opened.mesh);
}
/// The area gives the truest normals (see StarCost), but is slow on the big stars that grow where
/// edges may have any length.
nlohmann::json affordable_cost(const DefaultFrom& from) {
  return from.resolved.at("max_edge_length").get<double>() > 0.0 ? "area" : "angle";
}

Result<Document> apply_simplify(const Document& document, const nlohmann::json& parameters,
                                const Context& context) {
  SimplifyOptions options;
  options.error_zone = parameters.at("error_zone").get<double>();
  options.max_edge_length = parameters.at("max_edge_length");
  options.target_vertices = parameters.at("target_vertices");
  const std::string cost = parameters.at("cost");
  options.cost = cost == "flat"    ? StarCost::flat
                 : cost == "angle" ? StarCost::angle
                                   : StarCost::area;
  // Again: from the current mesh, as section 4.1 allows later in the chain; found lines stay then.
  const Stage base = parameters.at("again") ? Stage{document.mesh, document.curvatures,
                                                    document.zones, document.evidence}
                                            : stage_before(document, "simplify");
  const ChunkedArray<Origin> locked =
      base.mesh == document.mesh ? locked_edges(document, *base.mesh) : ChunkedArray<Origin>();
  Result<Prepared> prepared =
      simplify(*base.mesh, base.zones, locked, options, context.part(0.0, 0.9));
  if (!prepared) return tl::unexpected<Error>(prepared.error());
  return take(document, base, std::move(*prepared), "simplify", parameters, context.part(0.9, 1.0));
}

std::string words_of_simplify(const nlohmann::json& parameters) {
  if (!parameters.contains("error_zone")) return "Simplify";
  return "Simplify within " + number_text(parameters.at("error_zone").get<double>(), 3);
}

Result<Document> apply_swap(const Document& document, const nlohmann::json& parameters,
                            const Context& context) {
  const Stage base = stage_before(document, "swap_edges");
  const ChunkedArray<Origin> locked =
      base.mesh == document.mesh ? locked_edges(document, *base.mesh) : ChunkedArray<Origin>();
  Result<Prepared> prepared =
      swap_edges(*base.mesh, base.zones, locked, {}, context.part(0.0, 0.9));
  if (!prepared) return tl::unexpected<Error>(prepared.error());
  return take(document, base, std::move(*prepared), "swap_edges", parameters,
              context.part(0.9, 1.0));
}

Result<Document> apply_equilateralize(const Document& document, const nlohmann::json& parameters,
                                      const Context& context) {
  const Stage base = stage_before(document, "equilateralize");
  Result<Prepared> prepared = equilateralize(
      *base.mesh, base.zones, locked_edges(document, *base.mesh), {}, context.part(0.0, 0.9));
  if (!prepared) return tl::unexpected<Error>(prepared.error());
  return take(document, base, std::move(*prepared), "equilateralize", parameters,
              context.part(0.9, 1.0));
}

std::size_t vertices_used(const Mesh& mesh) {
  std::size_t count = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) count += !mesh.is_isolated(v);
  return count;
}

std::string outcome_of_simplify(const Document& document) {
  const Stage& output = document.output("simplify");
  if (!output.mesh) return {};
  const double zone = document.step("simplify")->parameters.value("error_zone", 0.0);
  return grouped(vertices_used(*document.opened.mesh)) + " → " +
         counted(vertices_used(*output.mesh), "vertex", "vertices") + ", all within " +
         with_unit(number_text(zone, 3), length_unit_of(document));
}

/// What swapping made of one mesh.
std::string swaps_in_words(const Mesh& before, const Mesh& after) {
  std::vector<EdgeVertices> fresh;  // both lists are sorted
  std::set_difference(after.edges().begin(), after.edges().end(), before.edges().begin(),
                      before.edges().end(), std::back_inserter(fresh));
  constexpr double wide = 120.0;  // °
  const auto share = [&](const Mesh& mesh) {
    return fixed_text(100.0 * share_of_angles_above(mesh, wide), 1);
  };
  return counted(fresh.size(), "edge swapped", "edges swapped") +
         ", angles above 120°: " + share(before) + " → " + share(after) + " %";
}

std::string outcome_of_swap(const Document& document) {
  const Stage& output = document.output("swap_edges");
  return output.mesh ? swaps_in_words(*stage_before(document, "swap_edges").mesh, *output.mesh)
                     : std::string();
}

std::string outcome_of_equilateralize(const Document& document) {
  return document.step("equilateralize")->out_of_date
             ? std::string()
             : swaps_in_words(*stage_before(document, "equilateralize").mesh, *document.mesh);
}

}  // namespace

std::vector<OperationKind> preparation_rows() {
  return {
      {.name = "simplify",
       .title = "Simplify",
       .help =
           "Removes vertices inside error zones, which takes out the noise (section 4.1). Every "
           "vertex of the scan stays within the zone's radius of the surface. Part of the "
           "paper's flow; lines by the normal jump do without.",
       .parameters =
           {{.name = "error_zone",
             .kind = ParameterKind::real,
             .label = "Error zone",
             .help = "Radius of the sphere round each vertex of the scan that the surface has to "
                     "meet.",
             .unit = unit_of_part,
             .most = longest_length,
             .otherwise = {"three times the noise of the scan", zone_of_noise},
             .option = "error-zone"},
            {.name = "max_edge_length",
             .kind = ParameterKind::real,
             .label = "Longest edge",
             .help = "No new edge becomes longer than this, so that flat areas stay populated; 0: "
                     "no limit.",
             .unit = unit_of_part,
             .most = longest_length,
             .otherwise = {"from the length of the scan's edges", edges_of_scan},
             .option = "max-edge"},
            {.name = "cost",
             .kind = ParameterKind::choice,
             .help = "How stars are triangulated: the flattest, the least sharp, the least area.",
             .choices = {{"flat", "Flat"}, {"angle", "Angle"}, {"area", "Area"}},
             .otherwise = {"area where edges have a limit, else angle", affordable_cost},
             .option = "cost"},
            {.name = "target_vertices",
             .kind = ParameterKind::whole,
             .help = "It stops when so many vertices are left; 0: when no more can go.",
             .unit = "vertices",
             .most = 0x7FFFFFFF,
             .otherwise = 0,
             .option = "target"},
            {.name = "again",
             .kind = ParameterKind::flag,
             .help = "From the current mesh, as section 4.1 allows later in the chain; found lines "
                     "stay then.",
             .otherwise = false}},
       .apply = apply_simplify,
       .words = words_of_simplify,
       .outcome = outcome_of_simplify},
      {.name = "swap_edges",
       .title = "Swap edges",
       .help = "Swaps edges, inside the error zones, so that sharp lines run along edges (section "
               "4.2).",
       .apply = apply_swap,
       .outcome = outcome_of_swap},
      {.name = "equilateralize",
       .title = "Equilateralise",
       .help = "Swaps edges, inside the error zones, so that faces are nearly equilateral (section "
               "4.3). Sharp lines stay.",
       .apply = apply_equilateralize,
       .outcome = outcome_of_equilateralize}};
}

}  // namespace arris
