#pragma once

#include <vector>

#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// Parts made by code whose truth is exact: each scanned shape at three densities, and blurred as
/// by an optic, with four levels of noise (Gaussian along the normal, in mean edges); and clean CAD
/// tessellations, on which a line must run along the very edge. Named SHAPE-SAMPLING-nNOISE
/// ("chamfer_3-fine-n0.1", "box-blurred-n0.05") and cad_*.
/// The same call gives the same cases.
std::vector<Case> generated_cases();

}  // namespace arris::accuracy
