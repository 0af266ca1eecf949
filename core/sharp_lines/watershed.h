#pragma once

#include <algorithm>
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

/// Looks at the faces along the borders of regions, round after round, at most `rounds`:
/// `choose(f)` gives the region that face f is to be of, its own where it stays. After the first
/// round only the neighbours of faces that changed are looked at.
template <class Choose>
void sweep_borders(const FaceTable& table, int rounds, std::vector<std::uint32_t>& of_face,
                   const Choose& choose) {
  std::vector<FaceId> along, next;
  std::vector<std::uint8_t> queued(table.size(), 0);
  for (FaceId f = 0; f < table.size(); ++f)
    for (const FaceId g : table.neighbours[f])
      if (g != no_id && of_face[g] != of_face[f] && !queued[f]) {
        queued[f] = 1;
        along.push_back(f);
      }
  for (int round = 0; round < rounds && !along.empty(); ++round) {
    next.clear();
    for (const FaceId f : along) queued[f] = 0;
    for (const FaceId f : along) {
      const std::uint32_t best = choose(f);
      if (best == of_face[f]) continue;
      of_face[f] = best;
      for (const FaceId g : table.neighbours[f])
        if (g != no_id && !queued[g]) {
          queued[g] = 1;
          next.push_back(g);
        }
    }
    std::sort(next.begin(), next.end());
    along.swap(next);
  }
}

/// Connected faces of one label, numbered from 0; faces without one (no_id) go to what is nearest,
/// and are regions of their own where nothing is.
FaceRegions connected_regions(const FaceTable& table, const std::vector<std::uint32_t>& labels);

}  // namespace arris
