#include "core/partitions/area_borders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace arris {

void settle_borders(const FaceTable& table, const std::vector<float>& edge_length,
                    const std::vector<FittedSurface>& surfaces, const SurfaceNoise& noise,
                    const std::vector<std::uint8_t>& banded, const AreaBorderOptions& options,
                    std::vector<std::uint32_t>& labels) {
  const auto misfit = [&](FaceId f, std::uint32_t area) {
    if (banded[f]) return 0.0;
    const Surface& surface = surfaces[area].surface;
    if (surface.type == SurfaceType::free) return options.free;
    const Surface::At at = surface.at(table.faces[f].centre.cast<double>());
    const double d = at.distance / noise.distance;
    const double turn =
        std::max(0.0, 2.0 * (1.0 - at.normal.dot(table.faces[f].normal.cast<double>())));
    return std::min(options.most, 0.5 * (d * d + turn / (2.0 * noise.angle * noise.angle)));
  };
  sweep_borders(table, options.rounds, labels, [&](FaceId f) {
    const auto price = [&](std::uint32_t area) {
      double border = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        if (const FaceId g = table.neighbours[f][k]; g != no_id && labels[g] != area)
          border += static_cast<double>(edge_length[table.sides[f][k]]);
      return misfit(f, area) * static_cast<double>(table.faces[f].area / mean_face_area) +
             options.length * border;
    };
    double least = price(labels[f]) - 1e-4;
    std::uint32_t best = labels[f];
    for (const FaceId g : table.neighbours[f])
      if (g != no_id && labels[g] != labels[f])
        if (const double other = price(labels[g]); other < least) {
          least = other;
          best = labels[g];
        }
    return best;
  });
}

void join_specks(const FaceTable& table, const std::vector<float>& edge_length, std::uint32_t least,
                 std::vector<std::uint32_t>& labels) {
  const FaceRegions pieces = connected_regions(table, labels);
  std::vector<std::uint32_t> faces_of(pieces.count, 0), order;
  std::vector<FaceId> first_of(pieces.count, no_id);
  for (FaceId f = 0; f < table.size(); ++f) {
    ++faces_of[pieces.of_face[f]];
    first_of[pieces.of_face[f]] = std::min(first_of[pieces.of_face[f]], f);
  }
  // Smallest first, so that what they go to may be a speck no longer.
  for (std::uint32_t k = 0; k < pieces.count; ++k)
    if (faces_of[k] < least) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return faces_of[a] < faces_of[b]; });
  for (const std::uint32_t k : order) {
    // The piece may have grown since by others that joined it.
    std::vector<FaceId> faces{first_of[k]};
    std::set<FaceId> in{first_of[k]};
    const std::uint32_t label = labels[first_of[k]];
    std::map<std::uint32_t, float> beside;
    for (std::size_t i = 0; i < faces.size() && faces.size() < least; ++i)
      for (std::size_t s = 0; s < 3; ++s) {
        const FaceId g = table.neighbours[faces[i]][s];
        if (g == no_id) continue;
        if (labels[g] != label) {
          beside[labels[g]] += edge_length[table.sides[faces[i]][s]];
        } else if (in.insert(g).second) {
          faces.push_back(g);
        }
      }
    if (faces.size() >= least || beside.empty()) continue;
    std::uint32_t best = beside.begin()->first;
    for (const auto& [other, length] : beside)
      if (length > beside[best]) best = other;
    for (const FaceId f : faces) labels[f] = best;
  }
  // Each piece that is left is an area of its own.
  labels = connected_regions(table, labels).of_face;
}

}  // namespace arris
