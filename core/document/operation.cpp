#include "core/document/operation.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/document/document.h"
#include "core/document/operations/operations.h"
#include "core/document/perform.h"
#include "core/document/treatments/treatment.h"

namespace arris {

namespace {

constexpr const char* name_key = "operation";
constexpr const char* version_key = "version";
constexpr std::string_view open_name = "open";

}  // namespace

std::span<const OperationKind> operation_table() {
  // The files in which rows stand; a row more is listed nowhere else.
  static const std::vector<OperationKind> table = [] {
    std::vector<OperationKind> rows;
    for (const auto group :
         {open_rows, unit_rows, orientation_rows, delete_faces_rows, preparation_rows,
          find_lines_rows, smooth_curvature_rows, find_partitions_rows, line_treatment_rows,
          partition_treatment_rows, area_treatment_rows, correction_rows}) {
      std::vector<OperationKind> own = group();
      std::move(own.begin(), own.end(), std::back_inserter(rows));
    }
    return rows;
  }();
  return table;
}

const OperationKind* find_operation(std::string_view name) {
  for (const OperationKind& kind : operation_table())
    if (kind.name == name) return &kind;
  return nullptr;
}

const Parameter* OperationKind::find(std::string_view parameter) const {
  const auto found = std::ranges::find(parameters, parameter, &Parameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

Result<nlohmann::json> OperationKind::resolve(const Document& document,
                                              const nlohmann::json& given) const {
  if (ready)
    if (const auto is_ready = ready(document); !is_ready)
      return tl::unexpected<Error>(is_ready.error());
  nlohmann::json meant = given;
  if (understood) {
    Result<nlohmann::json> said = understood(document, given);
    if (!said) return said;
    meant = std::move(*said);
  }
  ParameterReader reader(name, document, meant);
  reader.read(parameters);
  if (complete && reader.good()) complete(reader);
  return reader.finish();
}

Result<Operation> Operation::from_json(const nlohmann::json& json) {
  if (!json.is_object() || !json.contains(name_key) || !json[name_key].is_string())
    return fail("This is not an operation: expected an object with a text \"operation\".");
  Operation operation;
  operation.name = json[name_key];
  if (!find_operation(operation.name)) {
    std::string names;
    for (const OperationKind& kind : operation_table())
      names += (names.empty() ? "" : ", ") + std::string(kind.name);
    return fail("There is no operation '" + operation.name + "'; there are " + names + ".");
  }
  operation.parameters = json;
  operation.parameters.erase(name_key);
  return operation;
}

Result<Operation> Operation::parse(std::string_view text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return fail("This is not JSON.");
  return from_json(json);
}

nlohmann::json Operation::to_json() const {
  nlohmann::json json = parameters;
  json[name_key] = name;
  return json;
}

Result<Operation> resolve(const Document& document, const Operation& operation) {
  const OperationKind* kind = find_operation(operation.name);
  if (!kind) return fail("There is no operation '" + operation.name + "'.");
  if (document.empty() && kind->name != open_name)
    return fail(operation.name + ": no part is open.");
  nlohmann::json parameters = operation.parameters;
  if (const auto version = parameters.find(version_key); version != parameters.end()) {
    const std::int64_t stored = version->is_number_integer() ? version->get<std::int64_t>() : 0;
    if (stored >= 1 && stored < kind->version && kind->upgrade)
      parameters = kind->upgrade(static_cast<int>(stored), std::move(parameters));
    else if (stored != kind->version)
      return fail(operation.name + ": its version is " + version->dump() + ", this build knows " +
                  std::to_string(kind->version) + ".");
    parameters.erase(version_key);
  }
  Result<nlohmann::json> resolved = kind->resolve(document, parameters);
  if (!resolved) return tl::unexpected<Error>(resolved.error());
  (*resolved)[version_key] = kind->version;
  return Operation{operation.name, std::move(*resolved)};
}

Result<Performed> perform(const Document& document, const Operation& operation,
                          const Context& context) {
  return perform(document, operation, nullptr, context);
}

Result<Performed> perform(const Document& document, const Operation& operation,
                          const FileSource* files, const Context& context) {
  Result<Operation> complete = resolve(document, operation);
  if (!complete) return tl::unexpected<Error>(complete.error());
  const OperationKind& kind = *find_operation(complete->name);
  const bool opens = kind.name == open_name;
  nlohmann::json parameters = complete->parameters;
  parameters.erase(version_key);
  Result<Document> result = opens        ? open_scan_of(document, parameters, files, context)
                            : kind.treat ? apply_treatment(kind, document, parameters, context)
                                         : kind.apply(document, parameters, context);
  if (!result) return tl::unexpected<Error>(result.error());
  Document& after = *result;
  // Treatments carry the boundaries on by what they touch; whatever else changed them did not.
  if (after.mesh && after.boundaries == document.boundaries && !after.is_divided_as(document))
    after.boundaries = std::make_shared<const Boundaries>(
        derive_boundaries(*after.mesh, *after.curvatures, after.lines, after.partitions));
  if (opens) complete->parameters["hash"] = result->scan->report.content_hash;
  return Performed{std::move(*complete), std::move(*result)};
}

Result<Document> apply(const Document& document, const Operation& operation,
                       const Context& context) {
  Result<Performed> performed = perform(document, operation, context);
  if (!performed) return tl::unexpected<Error>(performed.error());
  return std::move(performed->document);
}

std::string describe(const Operation& operation) {
  const OperationKind* kind = find_operation(operation.name);
  if (!kind) return operation.name;
  if (!kind->words) return std::string(kind->title);
  // Rows of a session that opened from its snapshot were not run here: they may hold anything.
  try {
    return kind->words(operation.parameters);
  } catch (const nlohmann::json::exception&) {
    return std::string(kind->title);
  }
}

}  // namespace arris
