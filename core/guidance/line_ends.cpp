#include "core/guidance/line_ends.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/guidance/path_search.h"

namespace arris {

LineEnds::LineEnds(const Mesh& mesh, const SharpLines& lines) : mesh_(mesh), lines_(lines) {
  for (const LinePtr& line : lines.lines) {
    const std::vector<VertexId>& path = line->vertices;
    for (const VertexId v : path) line_at_.try_emplace(v, line->id);  // lines come by id
    if (line->closed || path.size() < 2) continue;
    // Over a few edges, so that one crooked edge does not set the direction.
    const std::size_t last = path.size() - 1, back = std::min<std::size_t>(3, last);
    for (const auto& [end, inner] :
         {std::pair{path.front(), path[back]}, std::pair{path.back(), path[last - back]}}) {
      if (mesh.is_border(end)) continue;
      int sharp = 0;
      mesh.for_ring(end, [&](HalfEdgeId h) { sharp += lines.is_sharp(Mesh::edge_of(h)); });
      if (sharp == 1)
        loose_.push_back({end, line->id, (mesh.point(end) - mesh.point(inner)).normalized(),
                          line->convex(), line->length});
    }
  }
  std::sort(loose_.begin(), loose_.end(),
            [](const LooseEnd& a, const LooseEnd& b) { return a.vertex < b.vertex; });
}

bool LineEnds::is_loose(VertexId v) const {
  const auto found =
      std::lower_bound(loose_.begin(), loose_.end(), v,
                       [](const LooseEnd& end, VertexId x) { return end.vertex < x; });
  return found != loose_.end() && found->vertex == v;
}

std::uint32_t LineEnds::line_at(VertexId v) const {
  const auto found = line_at_.find(v);
  return found == line_at_.end() ? 0 : found->second;
}

std::unordered_map<VertexId, double> LineEnds::along_lines(const LooseEnd& end,
                                                           double reach) const {
  std::unordered_map<VertexId, double> result{{end.vertex, 0.0}};
  PathSearch search(mesh_);
  search.run(
      end.vertex, reach,
      [&](HalfEdgeId h) {
        return lines_.is_sharp(Mesh::edge_of(h)) ? mesh_.edge_length(Mesh::edge_of(h))
                                                 : std::numeric_limits<double>::infinity();
      },
      [&](VertexId v) {
        result[v] = search.length_to(v);
        return Visit::go_on;
      });
  return result;
}

}  // namespace arris
