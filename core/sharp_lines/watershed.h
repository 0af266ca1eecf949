#pragma once

#include <cstdint>
#include <vector>

#include "core/sharp_lines/face_table.h"

namespace arris {

/// Regions of faces, by number from 0 in the order of their lowest face.
struct FaceRegions {
  std::vector<std::uint32_t> of_face;
  std::uint32_t count = 0;
};

struct WatershedOptions {
  float depth = 2.0F;  // degrees by which a basin must lie below the pass to a neighbour to stay
  float area = 12.0F;  // and its least area, in equilateral faces of the mean edge
};

/// Area of an equilateral face of the mean edge, in squares of it: a "face" as a measure of area.
inline constexpr float mean_face_area = 0.4330127F;

/// Floods the faces over edges by increasing `height` (degrees, per edge): two basins that are both
/// deep and large enough stay apart where they meet, so that region borders run along the crests of
/// the height. `order`: the inner edges by increasing height (edges_by_height()).
FaceRegions watershed(const FaceTable& table, const std::vector<float>& height,
                      const std::vector<EdgeId>& order,
                      const std::vector<std::array<FaceId, 2>>& edge_faces,
                      const WatershedOptions& options);

/// A face with two sides on the border towards the same region is a tooth: it changes over where
/// that makes the border shorter. `rounds`: at most; one round looks at the faces along borders.
void smooth_borders(const FaceTable& table, const std::vector<float>& edge_length, int rounds,
                    std::vector<std::uint32_t>& of_face);

}  // namespace arris
