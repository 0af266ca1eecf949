#include "core/document/operations/operations.h"
#include "core/mesh/length_unit.h"

namespace arris {

namespace {

// set_unit: {unit: "mm"}; "unknown" takes back what was said, or what a file says wrongly.

Result<nlohmann::json> resolve_set_unit(const Document&, const nlohmann::json& given) {
  ParameterReader reader("set_unit", given);
  const std::optional<LengthUnit> unit = find_length_unit(reader.text("unit", ""));
  if (!unit) reader.fault("unit", length_unit_keys());
  if (unit) reader.set("unit", info_of(*unit).key);
  return reader.finish();
}

Result<Document> apply_set_unit(const Document& document, const nlohmann::json& parameters,
                                const Context&) {
  const LengthUnit unit = *find_length_unit(parameters.at("unit").get<std::string>());
  if (unit == length_unit_of(document))
    return nothing_to_do("set_unit: the unit is " + std::string(info_of(unit).name) + " already.");
  Document result = document;
  result.unit = unit;
  return result;
}

std::string words_of_set_unit(const nlohmann::json& parameters) {
  const auto unit = find_length_unit(parameters.value("unit", ""));
  return !unit                          ? "Unit"
         : *unit == LengthUnit::unknown ? "Unit unknown"
                                        : "Unit " + std::string(info_of(*unit).name);
}

}  // namespace

const OperationKind set_unit_operation{"set_unit",       "Unit",         1,
                                       resolve_set_unit, apply_set_unit, words_of_set_unit};

}  // namespace arris
