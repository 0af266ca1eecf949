#include "core/partitions/area_borders.h"

#include <algorithm>
#include <cmath>
#include <map>
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
  std::vector<FaceId> along, next;
  std::vector<std::uint8_t> queued(table.size(), 0);
  for (FaceId f = 0; f < table.size(); ++f)
    for (const FaceId g : table.neighbours[f])
      if (g != no_id && labels[g] != labels[f] && !queued[f]) {
        queued[f] = 1;
        along.push_back(f);
      }
  for (int round = 0; round < options.rounds && !along.empty(); ++round) {
    next.clear();
    for (const FaceId f : along) queued[f] = 0;
    for (const FaceId f : along) {
      const auto price = [&](std::uint32_t area) {
        double border = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
          if (const FaceId g = table.neighbours[f][k]; g != no_id && labels[g] != area)
            border += static_cast<double>(edge_length[table.sides[f][k]]);
        return misfit(f, area) * static_cast<double>(table.faces[f].area / mean_face_area) +
               options.length * border;
      };
      const double now = price(labels[f]);
      double least = now - 1e-4;
      std::uint32_t best = labels[f];
      for (const FaceId g : table.neighbours[f])
        if (g != no_id && labels[g] != labels[f])
          if (const double other = price(labels[g]); other < least) {
            least = other;
            best = labels[g];
          }
      if (best == labels[f]) continue;
      labels[f] = best;
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

void join_specks(const FaceTable& table, const std::vector<float>& edge_length, std::uint32_t least,
                 std::vector<std::uint32_t>& labels) {
  struct Piece {
    FaceId first;
    std::uint32_t faces = 0, label = 0;
  };
  std::vector<std::uint32_t> piece_of(table.size(), no_id);
  std::vector<Piece> pieces;
  std::vector<FaceId> front;
  std::uint32_t areas = 0;
  for (FaceId first = 0; first < table.size(); ++first) {
    areas = std::max(areas, labels[first] + 1);
    if (piece_of[first] != no_id) continue;
    const auto number = static_cast<std::uint32_t>(pieces.size());
    piece_of[first] = number;
    front.assign(1, first);
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : table.neighbours[front[i]])
        if (g != no_id && piece_of[g] == no_id && labels[g] == labels[first]) {
          piece_of[g] = number;
          front.push_back(g);
        }
    pieces.push_back({first, static_cast<std::uint32_t>(front.size()), labels[first]});
  }
  // Smallest first, so that what they go to may be a speck no longer.
  std::vector<std::uint32_t> order;
  for (std::uint32_t k = 0; k < pieces.size(); ++k)
    if (pieces[k].faces < least) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return pieces[a].faces < pieces[b].faces;
  });
  for (const std::uint32_t k : order) {
    std::vector<FaceId> faces{pieces[k].first};
    const std::uint32_t label = labels[pieces[k].first];
    // The piece may have grown since by others that joined it.
    std::vector<FaceId> seen{pieces[k].first};
    std::map<FaceId, bool> in{{pieces[k].first, true}};
    std::map<std::uint32_t, float> beside;
    for (std::size_t i = 0; i < faces.size() && faces.size() < least; ++i)
      for (std::size_t s = 0; s < 3; ++s) {
        const FaceId g = table.neighbours[faces[i]][s];
        if (g == no_id) continue;
        if (labels[g] != label) {
          beside[labels[g]] += edge_length[table.sides[faces[i]][s]];
        } else if (in.emplace(g, true).second) {
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
  std::vector<std::uint32_t> number(table.size(), no_id);
  std::vector<std::uint32_t> result(table.size(), no_id);
  std::uint32_t count = 0;
  for (FaceId first = 0; first < table.size(); ++first) {
    if (result[first] != no_id) continue;
    result[first] = count;
    front.assign(1, first);
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : table.neighbours[front[i]])
        if (g != no_id && result[g] == no_id && labels[g] == labels[first]) {
          result[g] = count;
          front.push_back(g);
        }
    ++count;
  }
  labels = std::move(result);
}

}  // namespace arris
