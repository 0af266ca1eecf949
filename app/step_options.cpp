#include "app/step_options.h"

#include <charconv>
#include <cmath>

#include "core/base/number_text.h"

namespace arris {

namespace {

using nlohmann::json;

/// The whole text as a number; nothing where it is none.
template <class Number>
std::optional<Number> number_in(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "MIN:MAX", "MIN:" or ":MAX" as [min, max]; max null for none.
std::optional<json> interval_in(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const std::string low = text.substr(0, colon), high = text.substr(colon + 1);
  const auto min = low.empty() ? 0.0 : number_in<double>(low);
  const auto max = high.empty() ? 0.0 : number_in<double>(high);
  if (!min || !max || !std::isfinite(*min) || !std::isfinite(*max) || *min < 0.0 ||
      (!high.empty() && *max <= *min))
    return std::nullopt;
  return json{*min, high.empty() ? json() : json(*max)};
}

/// What is typed as a value of the parameter; nothing where it cannot be one.
std::optional<json> value_in(const Parameter& parameter, const std::string& text) {
  const bool is_length = parameter.unit == unit_of_part;
  switch (parameter.kind) {
    case ParameterKind::real: {
      const auto value = number_in<double>(text);
      if (!value || !std::isfinite(*value) || *value < parameter.least ||
          (!is_length && *value > parameter.most))
        return std::nullopt;
      return *value;
    }
    case ParameterKind::whole: {
      const auto value = number_in<std::int64_t>(text);
      if (!value || static_cast<double>(*value) < parameter.least ||
          static_cast<double>(*value) > parameter.most)
        return std::nullopt;
      return *value;
    }
    case ParameterKind::choice:
      for (const ParameterChoice& choice : parameter.choices)
        if (choice.key == text) return text;
      return std::nullopt;
    case ParameterKind::intervals:
      return interval_in(text);
    default:
      return text;
  }
}

/// "{surfaces,fronts}", "NUMBER in [0.1 - 179.9]"
std::string type_of(const Parameter& parameter) {
  const bool whole = parameter.kind == ParameterKind::whole;
  if (parameter.kind == ParameterKind::choice) {
    std::string keys;
    for (const ParameterChoice& choice : parameter.choices)
      keys += (keys.empty() ? "{" : ",") + std::string(choice.key);
    return keys + "}";
  }
  if (parameter.kind == ParameterKind::intervals) return "MIN:MAX";
  if (parameter.unit == unit_of_part) return "LENGTH";
  if (parameter.most >= static_cast<double>(most_faces)) return whole ? "N" : "NUMBER";
  return (whole ? "N in [" : "NUMBER in [") + number_text(parameter.least) + " - " +
         number_text(parameter.most) + "]";
}

std::string help_of(const Parameter& parameter, const std::string& note) {
  std::string help(parameter.help);
  if (!help.ends_with('.')) help += '.';
  if (parameter.kind == ParameterKind::intervals)
    help += " MIN or MAX may be left out; may be repeated.";
  if (!parameter.otherwise.from().empty())
    help += " By default: " + std::string(parameter.otherwise.from()) + ".";
  if (!note.empty()) help += " " + note + ".";
  return help;
}

std::string expected(const Parameter& parameter) {
  return parameter.kind == ParameterKind::intervals ? "MIN:MAX with 0 <= MIN < MAX"
                                                    : form_of(parameter);
}

}  // namespace

StepOptions::StepOptions(CLI::App& command, std::string_view operation, const std::string& note) {
  for (const Parameter& parameter : find_operation(operation)->parameters) {
    if (parameter.option.empty()) continue;
    Entry& entry = entries_.emplace_back(Entry{&parameter, nullptr, {}, {}});
    const std::string name = "--" + std::string(parameter.option), help = help_of(parameter, note);
    if (parameter.kind == ParameterKind::intervals)
      entry.option =
          command.add_option(name, entry.texts, help)->take_all()->allow_extra_args(false);
    else
      entry.option = command.add_option(name, entry.text, help);
    entry.option->type_name(type_of(parameter));
    entry.option->check([&parameter](const std::string& text) {
      return value_in(parameter, text) ? std::string()
                                       : "'" + text + "' is not " + expected(parameter);
    });
  }
}

json StepOptions::given() const {
  json parameters = json::object();
  for (const Entry& entry : entries_) {
    if (!*entry.option) continue;
    json& own = parameters[std::string(entry.parameter->name)];
    if (entry.parameter->kind == ParameterKind::intervals)
      for (const std::string& text : entry.texts) own.push_back(*value_in(*entry.parameter, text));
    else
      own = *value_in(*entry.parameter, entry.text);
  }
  return parameters;
}

const CLI::Option* StepOptions::first() const {
  for (const Entry& entry : entries_)
    if (*entry.option) return entry.option;
  return nullptr;
}

std::optional<StepOptions::Stray> StepOptions::stray(std::string_view method) const {
  for (const Entry& entry : entries_)
    if (*entry.option && !entry.parameter->method.empty() && entry.parameter->method != method)
      return Stray{entry.option, entry.parameter->method};
  return std::nullopt;
}

}  // namespace arris
