#include "core/sharp_lines/sharp_lines.h"

#include "core/base/words.h"
#include "core/document/operations/chain.h"
#include "core/document/operations/operations.h"
#include "core/document/treatments/treatment.h"

namespace arris {

namespace {

Result<nlohmann::json> resolve_lines(const Document& document, const nlohmann::json& given) {
  // Defaults come from the scan: a simplified mesh has sharp angles everywhere and long edges.
  const Stage& base = document.opened;
  const Mesh& mesh = *base.mesh;
  const double longest = 1000.0 * mesh.diagonal();
  const SharpLineOptions defaults;
  ParameterReader reader("find_sharp_lines", given);
  const LineMethod method =
      reader.choice("method", "normal_jump", {"normal_jump", "walk"}) == "walk"
          ? LineMethod::walk
          : LineMethod::normal_jump;
  const bool has_angle = reader.has("angle") && !given["angle"].is_null();
  reader.real("angle", has_angle ? 0.0 : default_sharp_angle(mesh, *base.curvatures, method), 0.1,
              179.9);
  read_bounds(reader);
  reader.whole("candidates", defaults.candidates, 1, 32);
  reader.real("min_length", default_min_length(mesh, method), 0.0, longest);
  reader.whole("parallel_distance", defaults.parallel_distance, 0, 4);
  reader.real("bridge_gap", default_bridge_gap(mesh, method), 0.0, longest);
  // Corrections made by hand are done again on what is found.
  reader.flag("corrections", true);
  return reader.finish();
}

Result<Document> apply_lines(const Document& document, const nlohmann::json& parameters,
                             const Context& context) {
  Document result = document;
  outdate_after(result, "find_sharp_lines");
  // From the output of the steps before: an equilateralised mesh gives way.
  if (const auto changed =
          change_mesh(result, stage_before(document, "find_sharp_lines"), context.part(0.0, 0.1));
      !changed)
    return tl::unexpected<Error>(changed.error());
  result.find_sharp_lines = Step{parameters, false};
  if (const auto found = refind_lines(result, parameters, context.part(0.1, 1.0)); !found)
    return tl::unexpected<Error>(found.error());
  return result;
}

/// Version 1 knew the walk only.
nlohmann::json upgrade_lines(int, nlohmann::json parameters) {
  parameters["method"] = "walk";
  return parameters;
}

std::string words_of_lines(const nlohmann::json& parameters) {
  if (!parameters.contains("angle")) return "Find sharp lines";
  return "Find sharp lines, " + degrees_in_words(parameters["angle"].get<double>());
}

}  // namespace

const OperationKind find_sharp_lines_operation{
    "find_sharp_lines", "Find sharp lines", 2, resolve_lines, apply_lines,
    words_of_lines,     upgrade_lines};

}  // namespace arris
