#include "core/partitions/boundaries.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "core/mesh/chains.h"

namespace arris {

namespace {

struct Sides {
  BoundaryType type;
  std::uint32_t left, right;
  bool operator==(const Sides&) const = default;
};

std::uint64_t pair_key(VertexId a, VertexId b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

/// Which edges are boundaries, and of what kind.
class Typing {
 public:
  Typing(const Mesh& mesh, const Division& division) : mesh_(mesh), division_(division) {}

  bool is_boundary(EdgeId e) const {
    return division_.lines.is_sharp(e) || label_of(2 * e) != label_of(2 * e + 1);
  }
  Sides sides_of(HalfEdgeId h) const {
    const std::uint32_t left = label_of(h), right = label_of(Mesh::opposite(h));
    const BoundaryType type = division_.lines.is_sharp(Mesh::edge_of(h)) ? BoundaryType::c0
                              : mesh_.is_border_edge(Mesh::edge_of(h))   ? BoundaryType::border
                              : left != 0 && right != 0                  ? BoundaryType::gn
                                                                         : BoundaryType::undefined;
    return {type, left, right};
  }
  /// Chains through `edges` (ascending, all of them boundaries).
  std::vector<Chain> link(const std::vector<EdgeId>& edges) const {
    return link_chains(
        mesh_, edges, [&](EdgeId e) { return is_boundary(e); },
        [&](HalfEdgeId h, HalfEdgeId next) {
          return sides_of(h) == sides_of(next) && !division_.lines.is_cut(mesh_.from(next));
        });
  }

 private:
  std::uint32_t label_of(HalfEdgeId h) const {
    const FaceId f = mesh_.face(h);
    return f == no_id ? 0u : division_.partitions.label(f);
  }

  const Mesh& mesh_;
  const Division& division_;
};

Boundary make_boundary(const Mesh& mesh, const Curvatures& curvatures, const Typing& typing,
                       const Chain& chain,
                       const std::unordered_map<std::uint64_t, std::uint32_t>& line_of) {
  Boundary boundary;
  const Sides sides = typing.sides_of(chain.half_edges.front());
  boundary.type = sides.type;
  boundary.left = sides.left;
  boundary.right = sides.right;
  boundary.vertices = chain.vertices(mesh);
  boundary.closed = chain.closed;
  if (sides.type == BoundaryType::c0)
    boundary.line = line_of.at(pair_key(boundary.vertices[0], boundary.vertices[1]));
  double turn = 0.0;
  for (const HalfEdgeId h : chain.half_edges) {
    const double length = mesh.edge_length(Mesh::edge_of(h));
    boundary.length += length;
    turn += length * curvatures.beta[Mesh::edge_of(h)];
    boundary.lowest_edge = std::min(boundary.lowest_edge, Mesh::edge_of(h));
  }
  if (boundary.length > 0.0)
    boundary.mean_angle = turn / boundary.length * 180.0 / std::numbers::pi;
  return boundary;
}

void add_edges_of(const Line& line, std::unordered_map<std::uint64_t, std::uint32_t>& line_of) {
  for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
    line_of[pair_key(line.vertices[i], line.vertices[i + 1])] = line.id;
}

}  // namespace

std::string_view name_of(BoundaryType type) {
  static constexpr std::array<std::string_view, 4> names{"C0", "Gn", "undefined", "border"};
  return names[static_cast<std::size_t>(type)];
}

Boundaries derive_boundaries(const Mesh& mesh, const Curvatures& curvatures,
                             const SharpLines& lines, const Partitions& partitions) {
  const Division division{lines, partitions};
  const Typing typing(mesh, division);
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (typing.is_boundary(e)) edges.push_back(e);
  std::unordered_map<std::uint64_t, std::uint32_t> line_of;  // sharp edge to line
  for (const LinePtr& line : lines.lines) add_edges_of(*line, line_of);
  Boundaries boundaries;
  for (const Chain& chain : typing.link(edges))
    boundaries.push_back(
        std::make_shared<const Boundary>(make_boundary(mesh, curvatures, typing, chain, line_of)));
  return boundaries;
}

Boundaries update_boundaries(const Mesh& mesh, const Curvatures& curvatures,
                             const Boundaries& boundaries, const Division& before,
                             const Division& after, const std::vector<EdgeId>& touched) {
  const Typing old_typing(mesh, before), new_typing(mesh, after);
  // Chains change only where they pass a vertex of a touched edge.
  std::vector<VertexId> vertices;
  for (const EdgeId e : touched)
    vertices.insert(vertices.end(), mesh.edge(e).begin(), mesh.edge(e).end());
  // Lines that are not the same object, by id: gone, new or changed.
  std::unordered_map<std::uint64_t, std::uint32_t> line_of;
  std::unordered_set<std::uint32_t> changed_lines;
  auto old_line = before.lines.lines.begin();
  auto new_line = after.lines.lines.begin();
  while (old_line != before.lines.lines.end() || new_line != after.lines.lines.end()) {
    const bool only_old =
        new_line == after.lines.lines.end() ||
        (old_line != before.lines.lines.end() && (*old_line)->id < (*new_line)->id);
    const bool only_new =
        !only_old && (old_line == before.lines.lines.end() || (*new_line)->id < (*old_line)->id);
    if (!only_old && !only_new && *old_line == *new_line) {
      ++old_line;
      ++new_line;
      continue;
    }
    if (!only_new) changed_lines.insert((*old_line++)->id);
    if (!only_old) {
      // Its ends too: a new cut, or a line that begins there now, parts chains.
      for (const VertexId v : {(*new_line)->vertices.front(), (*new_line)->vertices.back()})
        vertices.push_back(v);
      add_edges_of(**new_line++, line_of);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<EdgeId> old_edges, new_edges;
  for (const VertexId v : vertices)
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (old_typing.is_boundary(Mesh::edge_of(h))) old_edges.push_back(Mesh::edge_of(h));
      if (new_typing.is_boundary(Mesh::edge_of(h))) new_edges.push_back(Mesh::edge_of(h));
    });
  for (std::vector<EdgeId>* edges : {&old_edges, &new_edges}) {
    std::sort(edges->begin(), edges->end());
    edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
  }
  const auto lowest = [](const Chain& chain) {
    EdgeId least = no_id;
    for (const HalfEdgeId h : chain.half_edges) least = std::min(least, Mesh::edge_of(h));
    return least;
  };
  std::unordered_set<EdgeId> gone;  // by lowest edge
  for (const Chain& chain : old_typing.link(old_edges)) gone.insert(lowest(chain));

  Boundaries result;
  result.reserve(boundaries.size());
  for (const BoundaryPtr& boundary : boundaries) {
    if (gone.contains(boundary->lowest_edge)) continue;
    if (boundary->line != 0 && changed_lines.contains(boundary->line)) {
      const auto line = line_of.find(pair_key(boundary->vertices[0], boundary->vertices[1]));
      if (line != line_of.end() && line->second != boundary->line) {
        Boundary renamed = *boundary;
        renamed.line = line->second;
        result.push_back(std::make_shared<const Boundary>(std::move(renamed)));
        continue;
      }
    }
    result.push_back(boundary);
  }
  // Lines that did not change but whose boundaries are made anew.
  const std::vector<Chain> chains = new_typing.link(new_edges);
  std::unordered_set<std::uint64_t> missing;
  for (const Chain& chain : chains) {
    const HalfEdgeId h = chain.half_edges.front();
    const std::uint64_t key = pair_key(mesh.from(h), mesh.to(h));
    if (after.lines.is_sharp(Mesh::edge_of(h)) && !line_of.contains(key)) missing.insert(key);
  }
  if (!missing.empty()) {
    std::vector<EdgeId> edges;
    for (const Chain& chain : chains) edges.push_back(chain.half_edges.front() >> 1);
    for (const std::uint32_t id : lines_through(mesh, after.lines, edges))
      add_edges_of(*after.lines.find(id), line_of);
  }
  for (const Chain& chain : chains)
    result.push_back(std::make_shared<const Boundary>(
        make_boundary(mesh, curvatures, new_typing, chain, line_of)));
  std::sort(result.begin(), result.end(), [](const BoundaryPtr& a, const BoundaryPtr& b) {
    return a->lowest_edge < b->lowest_edge;
  });
  return result;
}

}  // namespace arris
