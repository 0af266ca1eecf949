#include <cmath>
#include <limits>

#include "core/base/number_text.h"
#include "core/document/operations/operations.h"
#include "core/document/treatments/treatment.h"
#include "core/partitions/intervals.h"

namespace arris {

namespace {

constexpr const char* interval_form = "a list of intervals [min, max] with 0 <= min < max";

/// A missing upper end ("null") stands for no upper bound.
Result<nlohmann::json> resolve_partitions(const Document& document, const nlohmann::json& given) {
  ParameterReader reader("find_partitions", given);
  // Who names intervals means fronts.
  const bool has_intervals =
      given.contains("intervals") && given["intervals"].is_array() && !given["intervals"].empty();
  const PartitionMethod method = reader.choice("method", has_intervals ? "fronts" : "surfaces",
                                               {"surfaces", "fronts"}) == "surfaces"
                                     ? PartitionMethod::surfaces
                                     : PartitionMethod::fronts;
  reader.real("detail", 1.0, 0.05, 20.0);
  const Criterion criterion = reader.choice("criterion", "kabs", {"kabs", "ikabs"}) == "kabs"
                                  ? Criterion::kabs
                                  : Criterion::ikabs;
  const nlohmann::json intervals = reader.raw("intervals");
  if (intervals.is_null() || (intervals.is_array() && intervals.empty())) {
    nlohmann::json chosen = nlohmann::json::array();
    for (const CurvatureInterval& interval :
         default_intervals(*document.mesh, *document.shown_curvatures(), criterion, document.lines))
      chosen.push_back({interval.min, std::isfinite(interval.max) ? nlohmann::json(interval.max)
                                                                  : nlohmann::json()});
    reader.set("intervals", std::move(chosen));
  } else {
    bool good = intervals.is_array();
    if (good)
      for (const auto& interval : intervals) {
        good = good && interval.is_array() && interval.size() == 2 && interval[0].is_number() &&
               (interval[1].is_number() || interval[1].is_null()) &&
               std::isfinite(interval[0].get<double>()) && interval[0].get<double>() >= 0.0 &&
               (interval[1].is_null() || interval[1].get<double>() > interval[0].get<double>());
      }
    if (!good) reader.fault("intervals", interval_form);
    reader.set("intervals", intervals);
  }
  reader.whole("min_faces", default_min_faces(*document.mesh, method), 1,
               std::numeric_limits<std::int32_t>::max());
  reader.whole("fill_holes", default_fill_holes(*document.mesh), 0,
               std::numeric_limits<std::int32_t>::max());
  // Corrections made by hand are done again on what is found.
  reader.flag("corrections", true);
  return reader.finish();
}

Result<Document> apply_partitions(const Document& document, const nlohmann::json& parameters,
                                  const Context& context) {
  Document result = document;
  if (const auto found = refind_partitions(result, parameters, context); !found)
    return tl::unexpected<Error>(found.error());
  result.find_partitions = Step{parameters, false};
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

}  // namespace

const OperationKind find_partitions_operation{
    "find_partitions",   "Find partitions", 2, resolve_partitions, apply_partitions,
    words_of_partitions, upgrade_partitions};

}  // namespace arris
