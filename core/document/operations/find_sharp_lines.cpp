#include "core/sharp_lines/sharp_lines.h"

#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/operations/stages.h"
#include "core/document/treatments/treatment.h"

namespace arris {

namespace {

// Defaults come from the scan: a simplified mesh has sharp angles everywhere and long edges.

LineMethod line_method_in(const nlohmann::json& parameters) {
  return parameters.at("method") == "walk" ? LineMethod::walk : LineMethod::normal_jump;
}

nlohmann::json sharp_angle_of_scan(const DefaultFrom& from) {
  const Stage& scan = from.document.opened;
  return default_sharp_angle(*scan.mesh, *scan.curvatures, line_method_in(from.resolved));
}
nlohmann::json length_of_noise(const DefaultFrom& from) {
  return default_min_length(*from.document.opened.mesh, line_method_in(from.resolved));
}
nlohmann::json gap_of_noise(const DefaultFrom& from) {
  return default_bridge_gap(*from.document.opened.mesh, line_method_in(from.resolved));
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
  result.step("find_sharp_lines") = Step{parameters, false};
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
  return "Find sharp lines, " + degrees_in_words(parameters.at("angle").get<double>());
}

std::string outcome_of_lines(const Document& document) {
  double length = 0.0;
  for (const LinePtr& line : document.lines.lines) length += line->length;
  return counted(document.lines.lines.size(), "line", "lines") + ", " +
         length_in_words(length, length_unit_of(document));
}

}  // namespace

std::vector<Parameter> kinds_of_edges() {
  return {{.name = "max_angle",
           .kind = ParameterKind::real,
           .label = "Angle up to",
           .help = "Greatest angle across a sharp line; 180: no upper bound.",
           .unit = "°",
           .least = 0.1,
           .most = 180.0,
           .otherwise = SharpLineOptions().max_angle,
           .option = "max-angle"},
          {.name = "convexity",
           .kind = ParameterKind::choice,
           .label = "Edges",
           .help = "Which edges may be sharp.",
           .choices = {{"any", "Both"}, {"convex", "Convex"}, {"concave", "Concave"}},
           .otherwise = "any",
           .option = "convexity"},
          {.name = "candidates",
           .kind = ParameterKind::whole,
           .label = "Candidates",
           .help = "Edges kept at a vertex by the candidate rule (figure 26); 3 suits most parts.",
           .least = 1,
           .most = 32,
           .otherwise = SharpLineOptions().candidates,
           .method = "walk",
           .option = "candidates"}};
}

std::vector<OperationKind> find_lines_rows() {
  std::vector<Parameter> parameters{
      {.name = "method",
       .kind = ParameterKind::choice,
       .label = "Method",
       .help =
           "Normal jump: lines between regions across which the mean normal jumps; it stands "
           "the noise of scans. Walk: the paper's way along edges, by exterior angle and IKabs; "
           "for simplified meshes.",
       .choices = {{"normal_jump", "Normal jump"}, {"walk", "Walk along edges (paper)"}},
       .otherwise = "normal_jump",
       .option = "method"},
      {.name = "angle",
       .kind = ParameterKind::real,
       .label = "Angle TV_IH",
       .help = "Least angle across a sharp line: the jump of the normals, or by the walk the "
               "exterior angle of an edge, from which TV_IK follows.",
       .unit = "°",
       .least = 0.1,
       .most = 179.9,
       .otherwise = {"from the noise of the scan", sharp_angle_of_scan},
       .by_method = true,
       .option = "sharp-angle"}};
  const std::vector<Parameter> of_edges = kinds_of_edges();
  parameters.insert(parameters.end(), of_edges.begin(), of_edges.end());
  parameters.insert(
      parameters.end(),
      {{.name = "min_length",
        .kind = ParameterKind::real,
        .label = "Least length",
        .help = "Isolated lines shorter than this are removed; 0 keeps them.",
        .unit = unit_of_part,
        .most = longest_length,
        .otherwise = {"from the length of the scan's edges", length_of_noise},
        .by_method = true,
        .option = "min-length"},
       {.name = "parallel_distance",
        .kind = ParameterKind::whole,
        .label = "Parallel within",
        .help = "Of two parallel lines of one sign this many edges apart the weaker is removed; 0 "
                "keeps both.",
        .unit = "edges",
        .most = 4,
        .otherwise = SharpLineOptions().parallel_distance,
        .method = "walk",
        .option = "parallel-distance"},
       {.name = "bridge_gap",
        .kind = ParameterKind::real,
        .label = "Bridge gaps",
        .help = "Loose ends with at most this distance between them are joined; 0 joins none.",
        .unit = unit_of_part,
        .most = longest_length,
        .otherwise = {"from the length of the scan's edges", gap_of_noise},
        .by_method = true,
        .option = "bridge-gap"},
       {.name = "corrections",
        .kind = ParameterKind::flag,
        .help = "Whether corrections made by hand are done again on what is found.",
        .otherwise = true}});
  return {{.name = "find_sharp_lines",
           .title = "Find sharp lines",
           .help = "Finds the sharp lines of the part: where its mean normal jumps, or by the "
                   "paper's walk along edges (section 6).",
           .version = 2,
           .parameters = std::move(parameters),
           .apply = apply_lines,
           .words = words_of_lines,
           .upgrade = upgrade_lines,
           .outcome = outcome_of_lines}};
}

}  // namespace arris
