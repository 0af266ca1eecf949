#include "core/partitions/area_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/parallel.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

namespace {

/// How badly a face agrees with the surface of an area, limited.
double misfit_of(const AreaGround& ground, const AreaBorderOptions& options, FaceId f,
                 std::uint32_t area) {
  if (ground.banded[f]) return 0.0;
  const Surface& surface = ground.surfaces[area].surface;
  if (surface.type == SurfaceType::free) return options.free;
  const FaceTable::Face& face = ground.table.faces[f];
  const Surface::At at = surface.at(face.centre.cast<double>());
  const double d = at.distance / ground.noise.distance;
  const double turn = std::max(0.0, 2.0 * (1.0 - at.normal.dot(face.normal.cast<double>())));
  return std::min(options.most,
                  0.5 * (d * d + turn / (2.0 * ground.noise.angle * ground.noise.angle)));
}

/// The faces round each of some, and how much they count.
struct Windows {
  struct Part {
    FaceId face;
    float weight;
  };
  std::vector<std::vector<Part>> of;
};

Windows windows_about(const FaceTable& table, const std::vector<FaceId>& faces, float spread) {
  Windows windows;
  windows.of.resize(faces.size());
  PerThread<FaceWindow> locals([&] { return FaceWindow(table); });
  const float falling = 0.5F / (spread * spread);
  parallel_for(
      faces.size(),
      [&](std::size_t k) {
        const FaceTable::Face& middle = table.faces[faces[k]];
        for (const FaceId g :
             locals.local().grow(std::array{faces[k]}, middle.centre, 2.2F * spread)) {
          const float distance2 = (table.faces[g].centre - middle.centre).squaredNorm();
          windows.of[k].push_back({g, table.faces[g].area * std::exp(-falling * distance2)});
        }
      },
      256);
  return windows;
}

}  // namespace

void settle_borders(const AreaGround& ground, const AreaBorderOptions& options,
                    std::vector<std::uint32_t>& labels) {
  const FaceTable& table = ground.table;
  sweep_borders(table, options.rounds, labels, [&](FaceId f) {
    const auto price = [&](std::uint32_t area) {
      double border = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        if (const FaceId g = table.neighbours[f][k]; g != no_id && labels[g] != area)
          border += static_cast<double>(ground.edge_length[table.sides[f][k]]);
      return misfit_of(ground, options, f, area) *
                 static_cast<double>(table.faces[f].area / mean_face_area) +
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

void straighten_borders(const AreaGround& ground, const AreaBorderOptions& options,
                        std::vector<std::uint32_t>& labels) {
  const FaceTable& table = ground.table;
  std::vector<EdgeId> borders;
  for (FaceId f = 0; f < table.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (const FaceId g = table.neighbours[f][k]; g != no_id && f < g && labels[f] != labels[g])
        borders.push_back(table.sides[f][k]);
  const std::vector<float> distance = distances_from(ground.mesh, table, borders, options.reach);
  std::vector<FaceId> near;
  for (FaceId f = 0; f < table.size(); ++f)
    if (distance[f] < options.reach) near.push_back(f);
  const Windows windows = windows_about(table, near, options.spread);
  std::vector<std::uint32_t> next(near.size());
  for (int round = 0; round < options.straightenings; ++round) {
    parallel_for(
        near.size(),
        [&](std::size_t k) {
          const FaceId f = near[k];
          std::vector<std::pair<std::uint32_t, double>> shares;
          double all = 0.0;
          for (const Windows::Part& part : windows.of[k]) {
            const std::uint32_t label = labels[part.face];
            auto share = std::ranges::find(shares, label, &std::pair<std::uint32_t, double>::first);
            if (share == shares.end()) share = shares.insert(share, {label, 0.0});
            share->second += static_cast<double>(part.weight);
            all += static_cast<double>(part.weight);
          }
          next[k] = labels[f];
          if (shares.size() < 2) return;
          double best = -1e9;
          for (const auto& [label, share] : shares) {
            double worth = options.straight * share / all - misfit_of(ground, options, f, label);
            if (label == labels[f]) worth += 1e-4;
            if (worth > best || (worth == best && label < next[k])) {
              best = worth;
              next[k] = label;
            }
          }
        },
        256);
    bool changed = false;
    for (std::size_t k = 0; k < near.size(); ++k) {
      changed = changed || labels[near[k]] != next[k];
      labels[near[k]] = next[k];
    }
    if (!changed) break;
  }
  smooth_borders(table, ground.edge_length, options.teeth, labels);
}

void keep_largest_pieces(const FaceTable& table, const std::vector<float>& edge_length,
                         std::vector<std::uint32_t>& labels) {
  // Only to pieces that stay, so that each round leaves fewer: one among others that go waits.
  for (;;) {
    const FaceRegions pieces = connected_regions(table, labels);
    struct Piece {
      std::uint32_t label;
      float area = 0.0F;
    };
    std::vector<Piece> piece(pieces.count);
    std::map<std::uint32_t, std::uint32_t> largest;  // by label
    for (FaceId f = 0; f < table.size(); ++f) {
      piece[pieces.of_face[f]].label = labels[f];
      piece[pieces.of_face[f]].area += table.faces[f].area;
    }
    for (std::uint32_t k = 0; k < pieces.count; ++k) {
      const auto [entry, fresh] = largest.try_emplace(piece[k].label, k);
      if (!fresh && piece[k].area > piece[entry->second].area) entry->second = k;
    }
    if (largest.size() == pieces.count) return;
    std::map<std::uint32_t, std::map<std::uint32_t, float>> beside;  // of pieces that go
    for (FaceId f = 0; f < table.size(); ++f) {
      const std::uint32_t own = pieces.of_face[f];
      if (largest.at(labels[f]) == own) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (const FaceId g = table.neighbours[f][k];
            g != no_id && largest.at(labels[g]) == pieces.of_face[g])
          beside[own][labels[g]] += edge_length[table.sides[f][k]];
    }
    if (beside.empty()) return;
    std::vector<std::uint32_t> to(pieces.count, no_id);
    for (const auto& [own, lengths] : beside) {
      to[own] = lengths.begin()->first;
      for (const auto& [label, length] : lengths)
        if (length > lengths.at(to[own])) to[own] = label;
    }
    for (FaceId f = 0; f < table.size(); ++f)
      if (to[pieces.of_face[f]] != no_id) labels[f] = to[pieces.of_face[f]];
  }
}

}  // namespace arris
