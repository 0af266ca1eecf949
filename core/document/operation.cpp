#include "core/document/operation.h"

#include <array>

#include "core/document/document.h"
#include "core/document/operations/operations.h"
#include "core/document/perform.h"
#include "core/document/treatments/treatments.h"

namespace arris {

namespace {

constexpr const char* name_key = "operation";
constexpr const char* version_key = "version";

}  // namespace

std::span<const OperationKind> operation_table() {
  static const std::array<OperationKind, 31> table{open_operation,
                                                   set_unit_operation,
                                                   flip_orientation_operation,
                                                   delete_faces_operation,
                                                   simplify_operation,
                                                   swap_edges_operation,
                                                   find_sharp_lines_operation,
                                                   delete_lines_operation,
                                                   extend_line_operation,
                                                   trim_line_operation,
                                                   split_line_operation,
                                                   merge_lines_operation,
                                                   draw_line_operation,
                                                   reroute_line_operation,
                                                   recompute_lines_operation,
                                                   equilateralize_operation,
                                                   smooth_curvature_operation,
                                                   find_partitions_operation,
                                                   connect_partitions_operation,
                                                   extend_partition_operation,
                                                   remove_partitions_operation,
                                                   remove_small_partitions_operation,
                                                   fill_unassigned_operation,
                                                   restart_partitions_operation,
                                                   recompute_partitions_operation,
                                                   split_partition_operation,
                                                   split_to_four_sides_operation,
                                                   paint_partition_operation,
                                                   smooth_boundaries_operation,
                                                   lock_operation,
                                                   lift_correction_operation};
  return table;
}

const OperationKind* find_operation(std::string_view name) {
  for (const OperationKind& kind : operation_table())
    if (kind.name == name) return &kind;
  return nullptr;
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
  if (document.empty() && kind != find_operation("open"))
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
  nlohmann::json parameters = complete->parameters;
  parameters.erase(version_key);
  Result<Document> result =
      complete->name == open_operation.name
          ? open_scan_of(document, parameters, files, context)
          : find_operation(complete->name)->apply(document, parameters, context);
  if (!result) return tl::unexpected<Error>(result.error());
  Document& after = *result;
  // Treatments carry the boundaries on by what they touch; whatever else changed them did not.
  if (after.mesh && after.boundaries == document.boundaries && !after.is_divided_as(document))
    after.boundaries = std::make_shared<const Boundaries>(
        derive_boundaries(*after.mesh, *after.curvatures, after.lines, after.partitions));
  if (complete->name == open_operation.name)
    complete->parameters["hash"] = result->scan->report.content_hash;
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
  return kind->words(operation.parameters);
}

}  // namespace arris
