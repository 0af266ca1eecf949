#include "core/document/treatments/treatments.h"

#include <algorithm>
#include <array>

namespace arris {

namespace {

using nlohmann::json;

// lock: {lines: [ids], partitions: [ids], locked: true}

Result<json> resolve_lock(const Document& document, const json& given) {
  json complete = given;
  for (const char* name : {"lines", "partitions"})
    if (!complete.contains(name)) complete[name] = json::array();
  ParameterReader reader("lock", complete);
  if (!complete["lines"].empty())
    read_lines(reader, document, "lines", "paths", true);
  else
    reader.set("lines", reader.raw("lines"));
  reader.raw("paths");
  read_partitions(reader, document, "partitions", "anchors", true, true);
  reader.flag("locked", true);
  if (complete["lines"].empty() && complete["partitions"].empty())
    reader.fault("lines", "a line or a partition at least");
  return reader.finish();
}

Result<Document> apply_lock(const Document& document, const json& parameters, const Context&) {
  Document result = document;
  const bool locked = parameters.at("locked");
  const auto set = [&](auto& elements, const json& wanted) {
    for (const std::uint32_t id : ids_of(wanted))
      for (auto& element : elements)
        if (element->id == id && element->locked != locked) {
          auto changed = *element;
          changed.locked = locked;
          element = std::make_shared<const decltype(changed)>(std::move(changed));
        }
  };
  set(result.lines.lines, parameters.at("lines"));
  set(result.partitions.partitions, parameters.at("partitions"));
  // Boundaries know nothing of locks; they stay the very same.
  result.boundaries = std::make_shared<const Boundaries>(*document.boundaries);
  return result;
}

std::string words_of_lock(const json& parameters) {
  const bool lines = !parameters.value("lines", json::array()).empty();
  const bool partitions = !parameters.value("partitions", json::array()).empty();
  return std::string(parameters.value("locked", true) ? "Lock " : "Unlock ") +
         (lines ? targets_in_words(parameters, "line", "lines") : "") +
         (lines && partitions ? " and " : "") +
         (partitions ? targets_in_words(parameters, "partition", "partitions") : "");
}

// lift_correction: {correction: id}: as if it had never been made

Result<json> resolve_lift(const Document& document, const json& given) {
  ParameterReader reader("lift_correction", given);
  if (!reader.has("correction")) reader.fault("correction", "the id of a correction");
  const auto id = reader.whole("correction", 0, 0, no_id);
  if (std::none_of(document.corrections.begin(), document.corrections.end(),
                   [&](const CorrectionPtr& c) { return c->id == id; }))
    reader.fault("correction", "the id of a correction in the list");
  return reader.finish();
}

Result<Document> apply_lift(const Document& document, const json& parameters,
                            const Context& context) {
  Document result = document;
  const std::uint32_t id = parameters.at("correction");
  const auto place = std::find_if(result.corrections.begin(), result.corrections.end(),
                                  [&](const CorrectionPtr& c) { return c->id == id; });
  const Operation lifted = (*place)->operation;
  result.corrections.erase(place);
  const auto last_run = [](const std::optional<Step>& step) {
    return step ? std::optional<json>(step->parameters) : std::nullopt;
  };
  const Treatment& treatment = *find_treatment(lifted.name);
  if (treatment.belongs(lifted.parameters, Round::after_lines))
    if (const auto done = refind_lines(result, last_run(document.find_sharp_lines), context); !done)
      return tl::unexpected<Error>(done.error());
  if (treatment.belongs(lifted.parameters, Round::after_partitions))
    if (const auto done = refind_partitions(result, last_run(document.find_partitions), context);
        !done)
      return tl::unexpected<Error>(done.error());
  return result;
}

std::string words_of_lift(const json& parameters) {
  return parameters.contains("correction") ? "Lift correction " + parameters["correction"].dump()
                                           : "Lift correction";
}

}  // namespace

std::span<const Treatment* const> all_treatments() {
  static const std::array<const Treatment*, 19> treatments{&delete_lines_treatment,
                                                           &extend_line_treatment,
                                                           &trim_line_treatment,
                                                           &split_line_treatment,
                                                           &merge_lines_treatment,
                                                           &draw_line_treatment,
                                                           &reroute_line_treatment,
                                                           &recompute_lines_treatment,
                                                           &connect_partitions_treatment,
                                                           &extend_partition_treatment,
                                                           &remove_partitions_treatment,
                                                           &remove_small_partitions_treatment,
                                                           &fill_unassigned_treatment,
                                                           &restart_partitions_treatment,
                                                           &recompute_partitions_treatment,
                                                           &split_partition_treatment,
                                                           &split_to_four_sides_treatment,
                                                           &paint_partition_treatment,
                                                           &smooth_boundaries_treatment};
  return treatments;
}

const OperationKind lock_operation{"lock", "Lock", 1, resolve_lock, apply_lock, words_of_lock};
const OperationKind lift_correction_operation{"lift_correction", "Lift correction", 1,
                                              resolve_lift,      apply_lift,        words_of_lift};

}  // namespace arris
