#include "core/sharp_lines/watershed.h"

#include <algorithm>
#include <numeric>

namespace arris {

FaceRegions watershed(const FaceTable& table, const std::vector<float>& height,
                      const std::vector<EdgeId>& order,
                      const std::vector<std::array<FaceId, 2>>& edge_faces,
                      const WatershedOptions& options) {
  const std::size_t faces = table.size();
  std::vector<FaceId> parent(faces);
  std::iota(parent.begin(), parent.end(), FaceId{0});
  const auto root = [&](FaceId f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
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
    FaceId a = root(edge_faces[e][0]), b = root(edge_faces[e][1]);
    if (a == b) continue;
    const auto stays = [&](const Basin& x) {
      return height[e] - x.floor > options.depth && x.area > least_area;
    };
    if (stays(basin[a]) && stays(basin[b])) continue;
    if (a > b) std::swap(a, b);
    parent[b] = a;
    basin[a] = {std::min(basin[a].floor, basin[b].floor), basin[a].area + basin[b].area};
  }
  FaceRegions result;
  result.of_face.assign(faces, no_id);
  for (FaceId f = 0; f < faces; ++f) {  // a root is the lowest face of its basin
    const FaceId r = root(f);
    if (r == f) result.of_face[f] = result.count++;
    result.of_face[f] = result.of_face[r];
  }
  return result;
}

void smooth_borders(const FaceTable& table, const std::vector<float>& edge_length, int rounds,
                    std::vector<std::uint32_t>& of_face) {
  std::vector<FaceId> along;
  std::vector<std::uint8_t> queued(table.size(), 0);
  for (FaceId f = 0; f < table.size(); ++f)
    for (const FaceId g : table.neighbours[f])
      if (g != no_id && of_face[g] != of_face[f] && !queued[f]) {
        queued[f] = 1;
        along.push_back(f);
      }
  std::vector<FaceId> next;
  for (int round = 0; round < rounds && !along.empty(); ++round) {
    next.clear();
    for (const FaceId f : along) queued[f] = 0;
    for (const FaceId f : along) {
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
      if (best == of_face[f] || most <= shared_with(of_face[f]) * 1.0001F) continue;
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

}  // namespace arris
