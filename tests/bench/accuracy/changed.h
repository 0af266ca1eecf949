#pragma once

#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/document/document.h"
#include "core/partitions/area_tree.h"
#include "core/sharp_lines/line_evidence.h"
#include "tests/bench/accuracy/part.h"

/// The default method with other options than its own, and how results become what is scored.
namespace arris::accuracy {

/// The document as `open` leaves it.
Result<Document> opened(const ScanPtr& scan);

/// The lines of a document; as edges only where its mesh is the scan's.
void add_lines(const Document& document, Found& found);
/// The lines along edges of the scan's mesh.
void add_lines(const Mesh& mesh, const Curvatures& curvatures, const std::vector<Origin>& edges,
               Found& found);

/// Lines; the threshold follows from the options as it does by default.
Result<Found> changed_lines(
    const ScanPtr& scan,
    const std::function<void(LineEvidenceOptions&, LineChoiceOptions&)>& change);
/// Partitions, between the lines of the default.
Result<Found> changed_areas(const ScanPtr& scan,
                            const std::function<void(AreaTreeOptions&)>& change);

}  // namespace arris::accuracy
