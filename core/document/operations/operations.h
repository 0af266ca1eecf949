#pragma once

#include "core/base/file_source.h"
#include "core/document/document.h"
#include "core/document/operation.h"
#include "core/document/parameters.h"

/// The rows of the operation table, one file each.
namespace arris {

extern const OperationKind open_operation;
/// What open_operation does, with the file taken from `files` where its content is known by a hash;
/// null: it is where it was.
Result<Document> open_scan_of(const Document& document, const nlohmann::json& parameters,
                              const FileSource* files, const Context& context);
extern const OperationKind set_unit_operation;
extern const OperationKind flip_orientation_operation;
extern const OperationKind delete_faces_operation;
extern const OperationKind find_sharp_lines_operation;
extern const OperationKind smooth_curvature_operation;
extern const OperationKind find_partitions_operation;

extern const OperationKind simplify_operation;
extern const OperationKind swap_edges_operation;
extern const OperationKind equilateralize_operation;

}  // namespace arris
