#pragma once

#include "core/document/document.h"
#include "core/document/operation.h"
#include "core/document/parameters.h"

/// The rows of the operation table, one file each.
namespace arris {

extern const OperationKind open_operation;
extern const OperationKind flip_orientation_operation;
extern const OperationKind delete_faces_operation;
extern const OperationKind find_sharp_lines_operation;
extern const OperationKind smooth_curvature_operation;
extern const OperationKind find_partitions_operation;

/// Replaces the mesh of `document`. Sharp edges that the new mesh still has inside stay, the lines
/// are linked again; partitions go; both steps are out of date. Ids of vertices must be the same in
/// both.
Result<void> change_mesh(Document& document, MeshPtr mesh, const Context& context);

}  // namespace arris
