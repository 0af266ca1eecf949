#include "core/sharp_lines/watershed.h"

#include <algorithm>

#include "core/base/disjoint_sets.h"

namespace arris {

FaceRegions watershed(const FaceTable& table, const std::vector<float>& height,
                      const std::vector<EdgeId>& order,
                      const std::vector<std::array<FaceId, 2>>& edge_faces,
                      const WatershedOptions& options) {
  const std::size_t faces = table.size();
  DisjointSets basins(faces);
  struct Basin {
    float floor, area;
  };
  std::vector<Basin> basin(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    basin[f] = {1e9F, table.faces[f].area};
    for (std::size_t k = 0; k < 3; ++k)
      if (table.neighbours[f][k] != no_id)
        basin[f].floor = std::min(basin[f].floor, height[table.sides[f][k]]);
  }
  const float least_area = options.area * mean_face_area;
  for (const EdgeId e : order) {
    FaceId a = basins.find(edge_faces[e][0]), b = basins.find(edge_faces[e][1]);
    if (a == b) continue;
    const auto stays = [&](const Basin& x) {
      return height[e] - x.floor > options.depth && x.area > least_area;
    };
    if (stays(basin[a]) && stays(basin[b])) continue;
    if (a > b) std::swap(a, b);
    basins.join(a, b);
    basin[a] = {std::min(basin[a].floor, basin[b].floor), basin[a].area + basin[b].area};
  }
  FaceRegions result;
  result.of_face.assign(faces, no_id);
  for (FaceId f = 0; f < faces; ++f) {  // a root is the lowest face of its basin
    const FaceId r = basins.find(f);
    if (r == f) result.of_face[f] = result.count++;
    result.of_face[f] = result.of_face[r];
  }
  return result;
}

void smooth_borders(const FaceTable& table, const std::vector<float>& edge_length, int rounds,
                    std::vector<std::uint32_t>& of_face) {
  sweep_borders(table, rounds, of_face, [&](FaceId f) {
    const auto shared_with = [&](std::uint32_t region) {
      float length = 0.0F;
      for (std::size_t k = 0; k < 3; ++k)
        if (const FaceId g = table.neighbours[f][k]; g != no_id && of_face[g] == region)
          length += edge_length[table.sides[f][k]];
      return length;
    };
    float most = 0.0F;
    std::uint32_t best = of_face[f];
    for (const FaceId g : table.neighbours[f])
      if (g != no_id && of_face[g] != of_face[f])
        if (const float length = shared_with(of_face[g]); length > most) {
          most = length;
          best = of_face[g];
        }
    return most > shared_with(of_face[f]) * 1.0001F ? best : of_face[f];
  });
}

FaceRegions connected_regions(const FaceTable& table, const std::vector<std::uint32_t>& labels) {
  FaceRegions result{std::vector<std::uint32_t>(table.size(), no_id), 0};
  std::vector<FaceId> front;
  const auto flood = [&](const auto& admits) {
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : table.neighbours[front[i]])
        if (g != no_id && result.of_face[g] == no_id && admits(front[i], g)) {
          result.of_face[g] = result.of_face[front[i]];
          front.push_back(g);
        }
  };
  for (FaceId first = 0; first < table.size(); ++first) {
    if (labels[first] == no_id || result.of_face[first] != no_id) continue;
    result.of_face[first] = result.count++;
    front.assign(1, first);
    flood([&](FaceId f, FaceId g) { return labels[f] == labels[g]; });
  }
  front.clear();
  for (FaceId f = 0; f < table.size(); ++f)
    if (result.of_face[f] != no_id) front.push_back(f);
  const auto any = [](FaceId, FaceId) { return true; };
  flood(any);
  for (FaceId first = 0; first < table.size(); ++first) {
    if (result.of_face[first] != no_id) continue;
    result.of_face[first] = result.count++;
    front.assign(1, first);
    flood(any);
  }
  return result;
}

}  // namespace arris
