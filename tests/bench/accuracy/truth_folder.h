#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// The cases of a folder:
///
/// - truth/NAME.ply with NAME.labels (a line per face: surface, patch, ...) and the curves of its
///   part, PART_curves.json, where NAME is PART_scan, PART_cad or, for another kind of scan,
///   PART_KIND_scan; of a PART_cad, curves along which the
///   tessellation does not bend count neither way: their jump was stated wrongly;
/// - pairs/NAME_Noisy with NAME_Original, or NAME_n1 with NAME_gt: the same connectivity, the clean
///   one tells which edges are sharp (above 35 degrees);
/// - controls/*: parts without any sharp line.
///
/// Errors: no such folder, no case in it.
Result<std::vector<Case>> folder_cases(const std::string& folder);

}  // namespace arris::accuracy
