#pragma once

#include <string>

#include "core/base/result.h"
#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// Writes the part as a truth folder has it: scan.ply, scan_curves.json and, where patches are
/// known, scan.labels (of a part made by code the patch stands for the surface, too: score.py then
/// leaves narrow ones out, which Scorer does not). Errors: the folder or a file cannot be written.
Result<void> save_part(const std::string& folder, const Part& part);

/// Writes lines.obj and, where partitions were looked for, scan_partitions.ply. Errors: as above.
Result<void> save_found(const std::string& folder, const Part& part, const Found& found);

}  // namespace arris::accuracy
