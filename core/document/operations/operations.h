#pragma once

#include <vector>

#include "core/base/file_source.h"
#include "core/document/document.h"
#include "core/document/operation.h"

/// The rows of the operation table, by the file in which they stand.
namespace arris {

std::vector<OperationKind> open_rows();
std::vector<OperationKind> unit_rows();
std::vector<OperationKind> orientation_rows();
std::vector<OperationKind> delete_faces_rows();
std::vector<OperationKind> preparation_rows();
std::vector<OperationKind> find_lines_rows();
std::vector<OperationKind> smooth_curvature_rows();
std::vector<OperationKind> find_partitions_rows();
std::vector<OperationKind> line_treatment_rows();
std::vector<OperationKind> partition_treatment_rows();
std::vector<OperationKind> area_treatment_rows();
std::vector<OperationKind> correction_rows();

/// What the row "open" does, with the file taken from `files` where its content is known by a hash;
/// null: it is where it was.
Result<Document> open_scan_of(const Document& document, const nlohmann::json& parameters,
                              const FileSource* files, const Context& context);

}  // namespace arris
