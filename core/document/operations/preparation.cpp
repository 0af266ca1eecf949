// simplify, swap_edges and equilateralize: the phases of figure 2 that change the mesh.

#include "core/base/number_text.h"
#include "core/document/operations/chain.h"
#include "core/document/operations/operations.h"
#include "core/edge_swapping/equilateralize.h"
#include "core/edge_swapping/swap_edges.h"
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
Result<Document> take(const Document& document, const Stage& base, Prepared prepared,
                      std::string_view step, std::optional<Step> Document::*record,
                      Stage Document::*output, const nlohmann::json& parameters,
                      const Context& context) {
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
  if (output) result.*output = {result.mesh, result.curvatures, result.zones, result.evidence};
  result.*record = Step{parameters, false};
  return result;
}

Result<nlohmann::json> resolve_simplify(const Document& document, const nlohmann::json& given) {
  const double longest = 1000.0 * document.mesh->diagonal();
  ParameterReader reader("simplify", given);
  const bool has_zone = reader.has("error_zone") && !given["error_zone"].is_null();
  reader.real("error_zone", has_zone ? 0.0 : default_error_zone(*document.opened.mesh), 0.0,
              longest);
  const double edge =
      reader.real("max_edge_length", default_max_edge_length(*document.opened.mesh), 0.0, longest);
  // The area gives the truest normals (see StarCost), but is slow on the big stars that grow where
  // edges may have any length.
  reader.choice("cost", edge > 0.0 ? "area" : "angle", {"flat", "angle", "area"});
  reader.whole("target_vertices", 0, 0, 0x7FFFFFFF);
  reader.flag("again", false);
  return reader.finish();
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
  return take(document, base, std::move(*prepared), "simplify", &Document::simplify,
              &Document::simplified, parameters, context.part(0.9, 1.0));
}

std::string words_of_simplify(const nlohmann::json& parameters) {
  if (!parameters.contains("error_zone")) return "Simplify";
  return "Simplify within " + number_text(parameters["error_zone"].get<double>(), 3);
}

Result<nlohmann::json> resolve_swap(const Document&, const nlohmann::json& given) {
  return ParameterReader("swap_edges", given).finish();
}

Result<Document> apply_swap(const Document& document, const nlohmann::json& parameters,
                            const Context& context) {
  const Stage base = stage_before(document, "swap_edges");
  const ChunkedArray<Origin> locked =
      base.mesh == document.mesh ? locked_edges(document, *base.mesh) : ChunkedArray<Origin>();
  Result<Prepared> prepared =
      swap_edges(*base.mesh, base.zones, locked, {}, context.part(0.0, 0.9));
  if (!prepared) return tl::unexpected<Error>(prepared.error());
  return take(document, base, std::move(*prepared), "swap_edges", &Document::swap_edges,
              &Document::swapped, parameters, context.part(0.9, 1.0));
}

Result<nlohmann::json> resolve_equilateralize(const Document&, const nlohmann::json& given) {
  return ParameterReader("equilateralize", given).finish();
}

Result<Document> apply_equilateralize(const Document& document, const nlohmann::json& parameters,
                                      const Context& context) {
  const Stage base = stage_before(document, "equilateralize");
  Result<Prepared> prepared = equilateralize(
      *base.mesh, base.zones, locked_edges(document, *base.mesh), {}, context.part(0.0, 0.9));
  if (!prepared) return tl::unexpected<Error>(prepared.error());
  return take(document, base, std::move(*prepared), "equilateralize", &Document::equilateralize,
              nullptr, parameters, context.part(0.9, 1.0));
}

std::string words_of_swap(const nlohmann::json&) { return "Swap edges"; }
std::string words_of_equilateralize(const nlohmann::json&) { return "Equilateralise"; }

}  // namespace

const OperationKind simplify_operation{"simplify",       "Simplify",     1,
                                       resolve_simplify, apply_simplify, words_of_simplify};
const OperationKind swap_edges_operation{"swap_edges", "Swap edges", 1,
                                         resolve_swap, apply_swap,   words_of_swap};
const OperationKind equilateralize_operation{
    "equilateralize",       "Equilateralise",     1,
    resolve_equilateralize, apply_equilateralize, words_of_equilateralize};

}  // namespace arris
