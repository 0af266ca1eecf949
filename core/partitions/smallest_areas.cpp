#include "core/partitions/smallest_areas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/disjoint_sets.h"
#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/sharp_lines/region_joining.h"

namespace arris {

namespace {

/// HeightHistogram has bins of 2.5 degrees: kinks are a tenth of that.
constexpr float finer = 10.0F;

}  // namespace

FaceTable table_between_lines(const Mesh& mesh, const SharpLines& lines) {
  FaceTable table(mesh);
  parallel_for(table.size(), [&](std::size_t f) {
    for (std::size_t k = 0; k < 3; ++k)
      if (lines.is_sharp(table.sides[f][k])) table.neighbours[f][k] = no_id;
  });
  return table;
}

std::vector<std::uint8_t> faces_beside_lines(const Mesh& mesh, const SharpLines& lines,
                                             const FaceTable& table,
                                             const SmallestAreaOptions& options) {
  std::vector<EdgeId> sharp;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (lines.is_sharp(e)) sharp.push_back(e);
  const std::vector<float> distance = distances_from(mesh, table, sharp, options.band);
  std::vector<std::uint8_t> beside(table.size());
  for (FaceId f = 0; f < table.size(); ++f) beside[f] = std::isfinite(distance[f]);
  // Rings about the faces that vote: what they do not reach is narrow.
  std::vector<std::uint8_t> rings(table.size(), 0);
  std::vector<FaceId> front;
  for (FaceId f = 0; f < table.size(); ++f)
    if (!beside[f]) {
      rings[f] = 1;
      front.push_back(f);
    }
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (rings[front[i]] > options.narrow_rings) break;
    for (const FaceId g : table.neighbours[front[i]])
      if (g != no_id && rings[g] == 0) {
        rings[g] = static_cast<std::uint8_t>(rings[front[i]] + 1);
        front.push_back(g);
      }
  }
  for (FaceId f = 0; f < table.size(); ++f)
    if (rings[f] == 0 && distance[f] > options.narrow_band) beside[f] = 0;
  return beside;
}

FaceRegions renumbered(std::vector<std::uint32_t> labels, std::size_t most) {
  FaceRegions result{std::move(labels), 0};
  std::vector<std::uint32_t> number(most, no_id);
  for (std::uint32_t& label : result.of_face) {
    if (number[label] == no_id) number[label] = result.count++;
    label = number[label];
  }
  return result;
}

FaceRegions smallest_areas(const Mesh& mesh, const FaceTable& table,
                           const std::vector<std::uint8_t>& banded, const CurvatureKinks& kinks,
                           const std::vector<float>& edge_length,
                           const SmallestAreaOptions& options) {
  std::vector<std::array<FaceId, 2>> edge_faces(mesh.edge_count(), {no_id, no_id});
  std::vector<EdgeId> order;
  for (FaceId f = 0; f < table.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const FaceId g = table.neighbours[f][k];
      if (g == no_id || g < f || banded[f] || banded[g]) continue;
      edge_faces[table.sides[f][k]] = {f, g};
      order.push_back(table.sides[f][k]);
    }
  parallel_sort(order.begin(), order.end(), [&](EdgeId a, EdgeId b) {
    return kinks.at_edge[a] != kinks.at_edge[b] ? kinks.at_edge[a] < kinks.at_edge[b] : a < b;
  });
  FaceRegions regions = watershed(table, kinks.at_edge, order, edge_faces, options.watershed);
  std::vector<float> areas(regions.count, 0.0F);
  for (FaceId f = 0; f < table.size(); ++f) areas[regions.of_face[f]] += table.faces[f].area;
  RegionJoining<HeightHistogram> joining(std::move(areas));
  for (const EdgeId e : order) {
    const std::uint32_t a = regions.of_face[edge_faces[e][0]],
                        b = regions.of_face[edge_faces[e][1]];
    if (a != b) joining.border(a, b).add(finer * kinks.at_edge[e], edge_length[e]);
  }
  DisjointSets joined(regions.count);
  const float least_area = options.first_area * mean_face_area;
  joining.run(
      finer * options.first_cut,
      [&](const HeightHistogram& heights, std::uint32_t a, std::uint32_t b) {
        const float cost = heights.quantile(options.first_quantile);
        const float smaller = std::min(joining.area(a), joining.area(b));
        return smaller < least_area ? cost * smaller / least_area : cost;
      },
      [&](const auto& join, const HeightHistogram&) { joined.join(join.gone, join.into); });
  for (std::uint32_t& r : regions.of_face) r = joined.find(r);

  // What lies beside lines, ring by ring.
  std::vector<FaceId> front;
  std::vector<std::uint8_t> open(banded);
  for (FaceId f = 0; f < table.size(); ++f)
    if (!open[f] &&
        std::ranges::any_of(table.neighbours[f], [&](FaceId g) { return g != no_id && open[g]; }))
      front.push_back(f);
  const auto flood = [&] {
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : table.neighbours[front[i]])
        if (g != no_id && open[g]) {
          open[g] = 0;
          regions.of_face[g] = regions.of_face[front[i]];
          front.push_back(g);
        }
    front.clear();
  };
  flood();
  for (FaceId f = 0; f < table.size(); ++f)
    if (open[f]) {
      open[f] = 0;
      front.push_back(f);
      flood();
    }
  return renumbered(std::move(regions.of_face), table.size());
}

}  // namespace arris
