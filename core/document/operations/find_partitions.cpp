#include <cmath>

#include "core/base/number_text.h"
#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/treatments/treatment.h"
#include "core/partitions/intervals.h"

namespace arris {

namespace {

PartitionMethod partition_method_in(const nlohmann::json& parameters) {
  return parameters.at("method") == "surfaces" ? PartitionMethod::surfaces
                                               : PartitionMethod::fronts;
}

/// Who names intervals means fronts.
nlohmann::json default_method(const DefaultFrom& from) {
  const auto given = from.given.find("intervals");
  return given != from.given.end() && given->is_array() && !given->empty() ? "fronts" : "surfaces";
}

nlohmann::json intervals_of_part(const DefaultFrom& from) {
  const Document& document = from.document;
  const Criterion criterion =
      from.resolved.at("criterion") == "kabs" ? Criterion::kabs : Criterion::ikabs;
  nlohmann::json chosen = nlohmann::json::array();
  for (const CurvatureInterval& interval :
       default_intervals(*document.mesh, *document.shown_curvatures(), criterion, document.lines))
    chosen.push_back({interval.min, std::isfinite(interval.max) ? nlohmann::json(interval.max)
                                                                : nlohmann::json()});
  return chosen;
}

nlohmann::json least_faces(const DefaultFrom& from) {
  return default_min_faces(*from.document.mesh, partition_method_in(from.resolved));
}

nlohmann::json speck_faces(const DefaultFrom& from) {
  return default_fill_holes(*from.document.mesh);
}

Result<Document> apply_partitions(const Document& document, const nlohmann::json& parameters,
                                  const Context& context) {
  Document result = document;
  if (const auto found = refind_partitions(result, parameters, context); !found)
    return tl::unexpected<Error>(found.error());
  result.step("find_partitions") = Step{parameters, false};
  return result;
}

/// Version 1 knew fronts only.
nlohmann::json upgrade_partitions(int, nlohmann::json parameters) {
  parameters["method"] = "fronts";
  return parameters;
}

std::string words_of_partitions(const nlohmann::json& parameters) {
  const std::string text = "Find partitions";
  if (parameters.value("method", "fronts") == "surfaces")
    return text + ", detail " + number_text(parameters.value("detail", 1.0), 3);
  std::string intervals;
  if (const auto given = parameters.find("intervals");
      given != parameters.end() && given->is_array())
    for (const auto& interval : *given)
      intervals += (intervals.empty() ? " " : ", ") + interval_in_words(interval_of(interval));
  return text + ", " + (parameters.value("criterion", "kabs") == "kabs" ? "Kabs" : "IKabs") +
         intervals;
}

std::string outcome_of_partitions(const Document& document) {
  return counted(document.partitions.partitions.size(), "partition", "partitions") + ", " +
         fixed_text(100.0 * assigned_share(document), 1) + " % of the area";
}

}  // namespace

std::vector<OperationKind> find_partitions_rows() {
  const std::vector<Parameter> parameters{
      {.name = "method",
       .kind = ParameterKind::choice,
       .label = "Method",
       .help = "Surfaces: areas that one plane, sphere, cylinder, cone, torus or free-form surface "
               "explains within the noise. Fronts: the paper's, under intervals of curvature.",
       .choices = {{"surfaces", "Fitted surfaces"}, {"fronts", "Fronts of curvature (paper)"}},
       .otherwise = {"surfaces, or fronts where intervals are given", default_method},
       .option = "partitions"},
      {.name = "detail",
       .kind = ParameterKind::real,
       .label = "Detail",
       .help = "From few large partitions to many small ones; 1 is what the noise of the scan "
               "allows to tell apart. The partitions follow the slider.",
       .least = 0.05,
       .most = 20.0,
       .otherwise = 1.0,
       .method = "surfaces",
       .logarithmic = true,
       .option = "detail"},
      {.name = "criterion",
       .kind = ParameterKind::choice,
       .label = "Criterion",
       .help = "Kabs on dense meshes, its invariant IKabs on sparse ones.",
       .choices = {{"kabs", "Kabs"}, {"ikabs", "IKabs"}},
       .otherwise = "kabs",
       .method = "fronts",
       .option = "criterion"},
      {.name = "intervals",
       .kind = ParameterKind::intervals,
       .label = "Intervals",
       .help = "Curvature intervals Kmin – Kmax, run one after the other over what is left.",
       .otherwise = {"from the distribution of the criterion", intervals_of_part},
       .method = "fronts",
       .option = "interval"},
      {.name = "min_faces",
       .kind = ParameterKind::whole,
       .label = "Least faces",
       .help = "Smaller partitions are not kept; those of surfaces join the one beside them.",
       .unit = "faces",
       .least = 1,
       .most = most_faces,
       .otherwise = {"from the number of faces of the part", least_faces},
       .by_method = true,
       .option = "min-faces"},
      {.name = "fill_holes",
       .kind = ParameterKind::whole,
       .label = "Fill under",
       .help = "Unassigned areas with fewer faces join the partition around them; 0 fills none.",
       .unit = "faces",
       .most = most_faces,
       .otherwise = {"from the number of faces of the part", speck_faces},
       .method = "fronts",
       .option = "fill-holes"},
      {.name = "corrections",
       .kind = ParameterKind::flag,
       .help = "Whether corrections made by hand are done again on what is found.",
       .otherwise = true}};
  return {{.name = "find_partitions",
           .title = "Find partitions",
           .help = "Splits the part into areas that one surface explains, or into areas of slowly "
                   "varying curvature by the paper's fronts (section 7).",
           .version = 2,
           .parameters = parameters,
           .apply = apply_partitions,
           .words = words_of_partitions,
           .upgrade = upgrade_partitions,
           .outcome = outcome_of_partitions}};
}

}  // namespace arris
