#include "core/document/operation_schema.h"

#include <string>

#include "core/document/operation.h"

namespace arris {

namespace {

using nlohmann::json;

json list_of(json items, std::size_t least) {
  json list{{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) list["minItems"] = least;
  return list;
}

json schema_of(const Parameter& parameter) {
  const json id{{"type", "integer"}, {"minimum", 0}};
  const json interval{{"type", "array"},
                      {"prefixItems", json::array({json{{"type", "number"}, {"minimum", 0}},
                                                   json{{"type", {"number", "null"}}}})},
                      {"minItems", 2},
                      {"maxItems", 2}};
  switch (parameter.kind) {
    case ParameterKind::real:
      if (parameter.unit == unit_of_part) return {{"type", "number"}, {"minimum", parameter.least}};
      return {{"type", "number"}, {"minimum", parameter.least}, {"maximum", parameter.most}};
    case ParameterKind::whole:
      return {{"type", "integer"},
              {"minimum", static_cast<std::int64_t>(parameter.least)},
              {"maximum", static_cast<std::int64_t>(parameter.most)}};
    case ParameterKind::choice: {
      json keys = json::array();
      for (const ParameterChoice& choice : parameter.choices) keys.push_back(choice.key);
      return {{"enum", keys}};
    }
    case ParameterKind::flag:
      return {{"type", "boolean"}};
    case ParameterKind::text:
      return {{"type", "string"}};
    case ParameterKind::interval:
      return interval;
    case ParameterKind::intervals:
      return list_of(interval, 0);
    case ParameterKind::line:
    case ParameterKind::partition:
    case ParameterKind::vertex:
      return id;
    case ParameterKind::lines:
    case ParameterKind::partitions:
    case ParameterKind::path:
      return list_of(id, parameter.count);
    case ParameterKind::paths:
      return list_of(list_of(id, 2), 1);
    case ParameterKind::region:
      return {{"type", "object"},
              {"properties",
               {{"vertices", list_of(id, 1)}, {"radius", {{"type", "number"}, {"minimum", 0}}}}},
              {"required", {"vertices", "radius"}},
              {"additionalProperties", false}};
    case ParameterKind::other:
      break;
  }
  return json::object();
}

json schema_of(const OperationKind& kind) {
  json properties{{"operation", {{"const", kind.name}}},
                  {"version", {{"type", "integer"}, {"minimum", 1}, {"maximum", kind.version}}}};
  json required = json::array({"operation"});
  json alternatives = json::array();
  for (const Parameter& parameter : kind.parameters) {
    json& own = properties[std::string(parameter.name)] = schema_of(parameter);
    std::string text(parameter.help);
    if (!parameter.form.empty()) text += " Expected: " + std::string(parameter.form) + ".";
    if (!parameter.otherwise.from().empty())
      text += " By default: " + std::string(parameter.otherwise.from()) + ".";
    own["description"] = text;
    if (!parameter.unit.empty()) own["unit"] = parameter.unit;
    if (!parameter.otherwise.constant().is_null()) own["default"] = parameter.otherwise.constant();
    if (!parameter.anchors.empty())
      properties[std::string(parameter.anchors)] = {
          {"type", "array"}, {"description", "Where they are; filled in when it is done."}};
    if (!parameter.one_of.empty())
      alternatives.push_back({{"required", json::array({parameter.name})}});
    else if (!parameter.optional && !parameter.derived && !parameter.otherwise.there() &&
             !kind.understood)
      required.push_back(parameter.name);
  }
  json schema{{"type", "object"},
              {"title", kind.title},
              {"description", kind.help},
              {"properties", properties},
              {"required", required}};
  if (!alternatives.empty()) schema["oneOf"] = alternatives;
  // What an operation may also be given as is not in the table.
  if (!kind.understood) schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

json operation_schema() {
  json operations = json::array();
  for (const OperationKind& kind : operation_table()) operations.push_back(schema_of(kind));
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "An operation of Arris"},
          {"oneOf", operations}};
}

}  // namespace arris
