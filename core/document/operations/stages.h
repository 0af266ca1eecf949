#pragma once

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/document/document.h"

/// From what a step of the chain starts, and what it leaves behind (document.md, rule 3).
namespace arris {

/// The output that `step` starts from: of the last step before it that has one.
Stage stage_before(const Document& document, StepName step);

/// Makes `stage` the current mesh (its curvatures are computed where it has none). Sharp edges that
/// the new mesh still has inside stay and the lines are linked again; smoothed curvatures and
/// partitions go. Nothing happens where it is the current mesh already. Errors: cancelled.
Result<void> change_mesh(Document& document, Stage stage, const Context& context);

/// The sharp edges of the document on another mesh with the same vertices, as far as it has them
/// inside.
std::vector<Origin> sharp_edges_on(const Document& document, const Mesh& mesh);

/// Marks what comes after `step` as out of date and drops the outputs of
/// later steps that change the mesh.
void outdate_after(Document& document, StepName step);
/// The same for all steps: the scan itself is another one.
void outdate_all(Document& document);

}  // namespace arris
