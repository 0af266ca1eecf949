#include "core/document/operations/operations.h"
#include "core/mesh/length_unit.h"

namespace arris {

namespace {

bool accepts_unit(nlohmann::json& value, const Document&) {
  const std::optional<LengthUnit> unit = find_length_unit(value.get<std::string>());
  if (unit) value = info_of(*unit).key;
  return unit.has_value();
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

std::vector<OperationKind> unit_rows() {
  static const std::string keys = length_unit_keys();
  return {{.name = "set_unit",
           .title = "Unit",
           .help = "Says what lengths of the scan are in; nothing is computed with it.",
           .parameters = {{.name = "unit",
                           .kind = ParameterKind::text,
                           .help = "\"unknown\" takes back what was said, or what a file says "
                                   "wrongly.",
                           .form = keys,
                           .accepts = accepts_unit}},
           .apply = apply_set_unit,
           .words = words_of_set_unit}};
}

}  // namespace arris
