#include "core/partitions/boundaries.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <unordered_map>

#include "core/mesh/chains.h"

namespace arris {

namespace {

struct Sides {
  BoundaryType type;
  std::uint32_t left, right;
  bool operator==(const Sides&) const = default;
};

}  // namespace

std::string_view name_of(BoundaryType type) {
  static constexpr std::array<std::string_view, 4> names{"C0", "Gn", "undefined", "border"};
  return names[static_cast<std::size_t>(type)];
}

std::vector<Boundary> derive_boundaries(const Mesh& mesh, const Curvatures& curvatures,
                                        const SharpLines& lines, const Partitions& partitions) {
  const auto label_of = [&](HalfEdgeId h) {
    const FaceId f = mesh.face(h);
    return f == no_id ? 0u : partitions.label(f);
  };
  std::vector<bool> in_set(mesh.edge_count(), false);
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (lines.is_sharp(e) || label_of(2 * e) != label_of(2 * e + 1)) {
      in_set[e] = true;
      edges.push_back(e);
    }
  const auto sides_of = [&](HalfEdgeId h) {
    const std::uint32_t left = label_of(h), right = label_of(Mesh::opposite(h));
    const BoundaryType type = lines.is_sharp(h >> 1)        ? BoundaryType::c0
                              : mesh.is_border_edge(h >> 1) ? BoundaryType::border
                              : left != 0 && right != 0     ? BoundaryType::gn
                                                            : BoundaryType::undefined;
    return Sides{type, left, right};
  };
  const std::vector<Chain> chains = link_chains(
      mesh, edges, [&](EdgeId e) { return in_set[e]; },
      [&](HalfEdgeId h, HalfEdgeId next) { return sides_of(h) == sides_of(next); });

  std::unordered_map<std::uint64_t, std::uint32_t> line_of;  // sharp edge to line
  const auto key = [](VertexId a, VertexId b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
  };
  for (const LinePtr& line : lines.lines)
    for (std::size_t i = 0; i + 1 < line->vertices.size(); ++i)
      line_of[key(line->vertices[i], line->vertices[i + 1])] = line->id;

  std::vector<Boundary> boundaries;
  boundaries.reserve(chains.size());
  for (const Chain& chain : chains) {
    Boundary boundary;
    const Sides sides = sides_of(chain.half_edges.front());
    boundary.type = sides.type;
    boundary.left = sides.left;
    boundary.right = sides.right;
    boundary.vertices = chain.vertices(mesh);
    boundary.closed = chain.closed;
    if (sides.type == BoundaryType::c0)
      boundary.line = line_of[key(boundary.vertices[0], boundary.vertices[1])];
    double turn = 0.0;
    for (const HalfEdgeId h : chain.half_edges) {
      const double length = mesh.edge_length(h >> 1);
      boundary.length += length;
      turn += length * curvatures.beta[h >> 1];
    }
    if (boundary.length > 0.0)
      boundary.mean_angle = turn / boundary.length * 180.0 / std::numbers::pi;
    boundaries.push_back(std::move(boundary));
  }
  return boundaries;
}

}  // namespace arris
