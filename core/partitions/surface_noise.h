#pragma once

#include <vector>

#include "core/partitions/surface_fit.h"

namespace arris {

/// How the samples of each set scatter about the surface they are of, from those sets that have
/// enough: medians, so that sets which are several surfaces do not count. `least`: not below it.
SurfaceNoise noise_of(const std::vector<std::vector<SurfaceSample>>& samples,
                      const SurfaceNoise& least);

}  // namespace arris
