#pragma once

#include <cstdint>
#include <vector>

#include "core/partitions/surface_fit.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

struct AreaBorderOptions {
  int rounds = 12;      // over the faces beside borders
  double most = 6.0;    // misfit of a face to a surface, limited to this
  double free = 1.4;    // misfit of any face to an area without a surface
  double length = 1.2;  // misfit that a mean edge of border is worth
};

/// Moves the borders between areas that are no lines to where the two surfaces meet, and makes them
/// short: face after face goes over to the area beside it that it agrees with better, a mean edge
/// of border counting as much as some misfit.
///
/// `table` has no neighbours over sharp edges. `surfaces`: of each area; type free: none explains
/// it. `noise`: of a face. `banded`: per face, 1 where a line rounds it: its shape says nothing.
void settle_borders(const FaceTable& table, const std::vector<float>& edge_length,
                    const std::vector<FittedSurface>& surfaces, const SurfaceNoise& noise,
                    const std::vector<std::uint8_t>& banded, const AreaBorderOptions& options,
                    std::vector<std::uint32_t>& labels);

/// Pieces under `least` faces go to the neighbour over the longest border; one without neighbours
/// stays. Then each piece of an area is an area of its own, numbered from 0 by its lowest face.
void join_specks(const FaceTable& table, const std::vector<float>& edge_length, std::uint32_t least,
                 std::vector<std::uint32_t>& labels);

}  // namespace arris
