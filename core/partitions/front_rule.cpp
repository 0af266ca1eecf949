#include "core/partitions/front_rule.h"

#include <cmath>

#include "core/base/parallel.h"

namespace arris {

void FrontRule::count_all_votes() {
  std::vector<std::uint8_t> regular(mesh_.vertex_count()), votes(mesh_.face_count());
  parallel_for(regular.size(),
               [&](std::size_t v) { regular[v] = decides(static_cast<VertexId>(v)); });
  parallel_for(votes.size(), [&](std::size_t f) {
    const Triangle& t = mesh_.triangle(static_cast<FaceId>(f));
    votes[f] = static_cast<std::uint8_t>(regular[t[0]] + regular[t[1]] + regular[t[2]]);
  });
  regular_ = std::move(regular);
  votes_ = std::move(votes);
}

bool FrontRule::decides(VertexId v) const {
  if (mesh_.is_isolated(v) || mesh_.is_border(v) || std::isnan(values_[v])) return false;
  return lines_.edges.empty() || !is_on_line(mesh_, lines_, v);
}

FaceId FrontRule::across_longest(FaceId f) const {
  FaceId across = no_id;
  double longest = -1.0;
  for (const HalfEdgeId h : mesh_.sides(f)) {
    const EdgeId e = Mesh::edge_of(h);
    if (lines_.is_sharp(e) || mesh_.is_border_edge(e)) continue;
    if (const double length = mesh_.edge_length(e); length > longest) {
      longest = length;
      across = mesh_.face(Mesh::opposite(h));
    }
  }
  return across;
}

}  // namespace arris
