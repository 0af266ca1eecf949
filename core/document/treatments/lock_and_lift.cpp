// What is approved, and what is taken back: not corrections themselves.

#include <algorithm>

#include "core/document/operations/operations.h"
#include "core/document/treatments/treatment.h"

namespace arris {

namespace {

using nlohmann::json;

void complete_lock(ParameterReader& reader) {
  if (reader.resolved("lines").empty() && reader.resolved("partitions").empty())
    reader.fault("lines", "a line or a partition at least");
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

bool is_correction(json& value, const Document& document) {
  return value.is_number_unsigned() &&
         std::any_of(document.corrections.begin(), document.corrections.end(),
                     [&](const CorrectionPtr& c) { return c->id == value; });
}

/// As if it had never been made.
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
  const OperationKind& treatment = *find_operation(lifted.name);
  if (treatment.belongs(lifted.parameters, Round::after_lines))
    if (const auto done =
            refind_lines(result, last_run(document.step("find_sharp_lines")), context);
        !done)
      return tl::unexpected<Error>(done.error());
  if (treatment.belongs(lifted.parameters, Round::after_partitions))
    if (const auto done =
            refind_partitions(result, last_run(document.step("find_partitions")), context);
        !done)
      return tl::unexpected<Error>(done.error());
  return result;
}

std::string words_of_lift(const json& parameters) {
  return parameters.contains("correction") ? "Lift correction " + parameters["correction"].dump()
                                           : "Lift correction";
}

}  // namespace

std::vector<OperationKind> correction_rows() {
  return {{.name = "lock",
           .title = "Lock",
           .help = "Approves lines and partitions: no finding changes them any more.",
           .parameters = {{.name = "lines",
                           .kind = ParameterKind::lines,
                           .help = "The lines that are meant.",
                           .count = 0,
                           .otherwise = Default::empty_list(),
                           .may_be_locked = true,
                           .anchors = "paths"},
                          {.name = "partitions",
                           .kind = ParameterKind::partitions,
                           .help = "The partitions that are meant.",
                           .count = 0,
                           .otherwise = Default::empty_list(),
                           .may_be_locked = true,
                           .anchors = "anchors"},
                          {.name = "locked",
                           .kind = ParameterKind::flag,
                           .help = "False takes the approval back.",
                           .otherwise = true}},
           .apply = apply_lock,
           .words = words_of_lock,
           .complete = complete_lock},
          {.name = "lift_correction",
           .title = "Lift correction",
           .help = "Takes a correction back, as if it had never been made.",
           .parameters = {{.name = "correction",
                           .help = "Its id.",
                           .form = "the id of a correction in the list",
                           .accepts = is_correction}},
           .apply = apply_lift,
           .words = words_of_lift}};
}

}  // namespace arris
