#include "core/partitions/fill_areas.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace arris {

namespace {

struct Area {
  std::vector<FaceId> faces;
  std::optional<double> mean;  // of the criterion; none where no vertex has it
};

std::vector<Area> areas_of(const PartitionGround& ground, const std::vector<FaceId>& faces) {
  const Mesh& mesh = ground.mesh;
  const FrontRule rule = ground.rule();
  std::unordered_set<FaceId> open;
  for (const FaceId f : faces)
    if (ground.partitions.label(f) == 0) open.insert(f);
  std::vector<Area> areas;
  for (const FaceId start : faces) {
    if (open.erase(start) == 0) continue;
    Area area;
    area.faces.push_back(start);
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t next = 0; next < area.faces.size(); ++next) {
      const FaceId f = area.faces[next];
      for (const VertexId v : mesh.triangle(f))
        if (rule.is_regular(v)) {
          sum += ground.values[v];
          ++count;
        }
      HalfEdgeId h = mesh.face_half_edge(f);
      for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
        const FaceId g = mesh.face(Mesh::opposite(h));
        if (g != no_id && !ground.lines.is_sharp(h >> 1) && open.erase(g) != 0)
          area.faces.push_back(g);
      }
    }
    if (count > 0) area.mean = sum / static_cast<double>(count);
    std::sort(area.faces.begin(), area.faces.end());
    areas.push_back(std::move(area));
  }
  std::stable_sort(areas.begin(), areas.end(),
                   [](const Area& a, const Area& b) { return a.faces.size() < b.faces.size(); });
  return areas;
}

}  // namespace

FilledAreas fill_areas(const PartitionGround& ground, const std::vector<FaceId>& faces,
                       std::size_t most_faces) {
  const Mesh& mesh = ground.mesh;
  std::unordered_map<FaceId, std::uint32_t> given;
  const auto label_of = [&](FaceId f) {
    const auto it = given.find(f);
    return it != given.end() ? it->second : ground.partitions.label(f);
  };
  FilledAreas result;
  for (const Area& area : areas_of(ground, faces)) {
    if (area.faces.size() > most_faces) continue;
    std::map<std::uint32_t, double> borders;  // by id
    for (const FaceId f : area.faces) {
      HalfEdgeId h = mesh.face_half_edge(f);
      for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
        const FaceId g = mesh.face(Mesh::opposite(h));
        const std::uint32_t label = g == no_id ? 0 : label_of(g);
        if (label != 0 && !ground.lines.is_sharp(h >> 1))
          borders[label] += mesh.edge_length(h >> 1);
      }
    }
    std::uint32_t best = 0;
    bool best_fits = false;
    for (const auto& [id, length] : borders) {
      const Partition& partition = *ground.partitions.find(id);
      if (partition.locked) continue;
      const bool holds =
          area.mean && *area.mean >= partition.interval.min && *area.mean <= partition.interval.max;
      if (best != 0 && (best_fits != holds ? best_fits : length <= borders[best])) continue;
      best = id;
      best_fits = holds;
    }
    if (best == 0) {
      ++result.enclosed;
      continue;
    }
    for (const FaceId f : area.faces) {
      given[f] = best;
      result.labels.emplace_back(f, best);
    }
  }
  std::sort(result.labels.begin(), result.labels.end());
  return result;
}

}  // namespace arris
