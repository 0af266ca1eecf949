#pragma once

#include <vector>

#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// Centres of the faces on surfaces whose every part lies within the part's tolerance of their
/// border: too narrow for the scan to show. Empty where the surfaces are not known.
std::vector<Point> narrow_centres(const Part& part);

}  // namespace arris::accuracy
