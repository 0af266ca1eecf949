#include "core/sharp_lines/lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "core/mesh/chains.h"

namespace arris {

namespace {

std::uint64_t edge_key(VertexId a, VertexId b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

/// Names a line among the others: the first two vertices of its path, which no other line has.
std::uint64_t first_edge(const std::vector<VertexId>& path) { return edge_key(path[0], path[1]); }

bool is_among(const std::vector<VertexId>& sorted, VertexId v) {
  return std::binary_search(sorted.begin(), sorted.end(), v);
}

template <class OriginOf>
std::vector<Line> link_lines(const Mesh& mesh, const Curvatures& curvatures,
                             const std::vector<EdgeId>& through, const OriginOf& origin_of,
                             const std::vector<VertexId>& cuts) {
  const std::vector<Chain> chains = link_chains(
      mesh, through, [&](EdgeId e) { return origin_of(e) != Origin::none; },
      [&](HalfEdgeId, HalfEdgeId next) {
        return cuts.empty() || !is_among(cuts, mesh.from(next));
      });
  std::vector<Line> lines;
  lines.reserve(chains.size());
  for (const Chain& chain : chains) {
    Line line;
    line.origin = Origin::none;
    line.vertices = chain.vertices(mesh);
    line.closed = chain.closed;
    double turn = 0.0;
    for (const HalfEdgeId h : chain.half_edges) {
      const double length = mesh.edge_length(Mesh::edge_of(h));
      line.length += length;
      turn += length * curvatures.beta[Mesh::edge_of(h)];
      line.origin = std::max(line.origin, origin_of(Mesh::edge_of(h)));
    }
    if (line.length > 0.0) line.mean_angle = turn / line.length * 180.0 / std::numbers::pi;
    lines.push_back(std::move(line));
  }
  return lines;
}

/// Gives `lines` the ids and locks that follow from `old`, new ids to the rest, and adds them to
/// `kept` (in order of ids); a line that did not change stays the same object.
void number_lines(const Mesh& mesh, std::vector<Line> lines, const std::vector<LinePtr>& old,
                  std::uint32_t& next_id, std::vector<LinePtr>& kept) {
  std::unordered_map<std::uint64_t, std::uint32_t> old_line;
  for (std::uint32_t k = 0; k < old.size(); ++k) {
    const std::vector<VertexId>& path = old[k]->vertices;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) old_line[edge_key(path[i], path[i + 1])] = k;
  }
  // (shared length, old line, new line) of every pair that shares an edge.
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> shared;
  std::unordered_map<std::uint32_t, double> overlap;
  for (std::uint32_t j = 0; j < lines.size() && !old_line.empty(); ++j) {
    overlap.clear();
    double locked = 0.0;
    const std::vector<VertexId>& path = lines[j].vertices;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      if (const auto it = old_line.find(edge_key(path[i], path[i + 1])); it != old_line.end()) {
        const double length = (mesh.point(path[i + 1]) - mesh.point(path[i])).norm();
        overlap[it->second] += length;
        if (old[it->second]->locked) locked += length;
      }
    lines[j].locked = locked > 0.5 * lines[j].length;
    for (const auto& [k, length] : overlap) shared.emplace_back(length, k, j);
  }
  std::sort(shared.begin(), shared.end(), [](const auto& a, const auto& b) {
    return std::get<0>(a) != std::get<0>(b)   ? std::get<0>(a) > std::get<0>(b)
           : std::get<1>(a) != std::get<1>(b) ? std::get<1>(a) < std::get<1>(b)
                                              : std::get<2>(a) < std::get<2>(b);
  });
  std::vector<bool> taken(old.size(), false);
  std::vector<const LinePtr*> successor_of(lines.size(), nullptr);
  for (const auto& [length, k, j] : shared) {
    if (taken[k] || successor_of[j]) continue;
    taken[k] = true;
    successor_of[j] = &old[k];
    lines[j].id = old[k]->id;
  }
  const std::size_t before = kept.size();
  for (std::uint32_t j = 0; j < lines.size(); ++j) {
    if (lines[j].id == 0) lines[j].id = next_id++;
    if (successor_of[j] && **successor_of[j] == lines[j])
      kept.push_back(*successor_of[j]);
    else
      kept.push_back(std::make_shared<const Line>(std::move(lines[j])));
  }
  const auto by_id = [](const LinePtr& a, const LinePtr& b) { return a->id < b->id; };
  const auto middle = kept.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(middle, kept.end(), by_id);
  std::inplace_merge(kept.begin(), middle, kept.end(), by_id);
}

}  // namespace

bool SharpLines::is_cut(VertexId v) const { return is_among(cuts, v); }

const Line* SharpLines::find(std::uint32_t id) const {
  const auto found =
      std::lower_bound(lines.begin(), lines.end(), id,
                       [](const LinePtr& line, std::uint32_t x) { return line->id < x; });
  return found != lines.end() && (*found)->id == id ? found->get() : nullptr;
}

std::vector<HalfEdgeId> sharp_edges_at(const Mesh& mesh, const SharpLines& lines, VertexId v) {
  std::vector<HalfEdgeId> result;
  mesh.for_ring(v, [&](HalfEdgeId h) {
    if (lines.is_sharp(Mesh::edge_of(h))) result.push_back(h);
  });
  return result;
}

bool is_on_line(const Mesh& mesh, const SharpLines& lines, VertexId v) {
  bool found = false;
  mesh.for_ring(v, [&](HalfEdgeId h) { found = found || lines.is_sharp(Mesh::edge_of(h)); });
  return found;
}

std::vector<HalfEdgeId> half_edges_of(const Mesh& mesh, const std::vector<VertexId>& path) {
  std::vector<HalfEdgeId> result;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i] >= mesh.vertex_count()) continue;
    mesh.for_ring(path[i], [&](HalfEdgeId h) {
      if (mesh.to(h) == path[i + 1]) result.push_back(h);
    });
  }
  return result;
}

std::vector<Line> derive_lines(const Mesh& mesh, const Curvatures& curvatures,
                               const std::vector<Origin>& edges,
                               const std::vector<VertexId>& cuts) {
  std::vector<EdgeId> sharp;
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (edges[e] != Origin::none) sharp.push_back(e);
  return link_lines(
      mesh, curvatures, sharp, [&](EdgeId e) { return edges[e]; }, cuts);
}

SharpLines relink_lines(const Mesh& mesh, const Curvatures& curvatures,
                        const std::vector<Origin>& edges, const SharpLines& previous,
                        std::uint32_t& next_id) {
  SharpLines result;
  result.edges = ChunkedArray<Origin>(edges, previous.edges);
  for (const VertexId v : previous.cuts)
    if (sharp_edges_at(mesh, result, v).size() == 2) result.cuts.push_back(v);
  number_lines(mesh, derive_lines(mesh, curvatures, edges, result.cuts), previous.lines, next_id,
               result.lines);
  return result;
}

SharpLines edit_lines(const Mesh& mesh, const Curvatures& curvatures, const SharpLines& previous,
                      const LineChanges& changes, std::uint32_t& next_id) {
  SharpLines result = previous;
  if (result.edges.empty()) result.edges = ChunkedArray<Origin>(mesh.edge_count(), Origin::none);
  std::vector<VertexId> touched = changes.new_cuts;
  for (const auto& [e, origin] : changes.edges) {
    if (result.edges[e] == origin) continue;
    result.edges.set(e, origin);
    touched.insert(touched.end(), mesh.edge(e).begin(), mesh.edge(e).end());
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());

  for (const VertexId v : changes.new_cuts)
    if (!result.is_cut(v))
      result.cuts.insert(std::upper_bound(result.cuts.begin(), result.cuts.end(), v), v);
  std::erase_if(result.cuts, [&](VertexId v) {
    return std::binary_search(touched.begin(), touched.end(), v) &&
           sharp_edges_at(mesh, result, v).size() != 2;
  });

  // The lines through the touched vertices, before and after.
  std::vector<EdgeId> old_edges, new_edges;
  for (const VertexId v : touched)
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (previous.is_sharp(Mesh::edge_of(h))) old_edges.push_back(Mesh::edge_of(h));
      if (result.is_sharp(Mesh::edge_of(h))) new_edges.push_back(Mesh::edge_of(h));
    });
  for (std::vector<EdgeId>* edges : {&old_edges, &new_edges}) {
    std::sort(edges->begin(), edges->end());
    edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
  }
  std::unordered_set<std::uint64_t> gone;
  for (const Line& line : link_lines(
           mesh, curvatures, old_edges, [&](EdgeId e) { return previous.edges[e]; }, previous.cuts))
    gone.insert(first_edge(line.vertices));
  std::vector<LinePtr> old;
  std::erase_if(result.lines, [&](const LinePtr& line) {
    const bool goes = gone.contains(first_edge(line->vertices));
    if (goes) old.push_back(line);
    return goes;
  });
  std::vector<Line> fresh = link_lines(
      mesh, curvatures, new_edges, [&](EdgeId e) { return result.edges[e]; }, result.cuts);
  // In the order of relink_lines(): by their lowest edge.
  const auto lowest = [&](const Line& line) {
    EdgeId least = no_id;
    for (const HalfEdgeId h : half_edges_of(mesh, line.vertices))
      least = std::min(least, Mesh::edge_of(h));
    return least;
  };
  std::sort(fresh.begin(), fresh.end(),
            [&](const Line& a, const Line& b) { return lowest(a) < lowest(b); });
  number_lines(mesh, std::move(fresh), old, next_id, result.lines);
  return result;
}

std::vector<std::uint32_t> lines_through(const Mesh& mesh, const SharpLines& lines,
                                         const std::vector<EdgeId>& edges) {
  std::vector<EdgeId> sharp;
  for (const EdgeId e : edges)
    if (lines.is_sharp(e)) sharp.push_back(e);
  std::sort(sharp.begin(), sharp.end());
  sharp.erase(std::unique(sharp.begin(), sharp.end()), sharp.end());
  std::unordered_map<std::uint64_t, double> length;  // by the first edge of the line
  const std::vector<Chain> chains = link_chains(
      mesh, sharp, [&](EdgeId e) { return lines.is_sharp(e); },
      [&](HalfEdgeId, HalfEdgeId next) { return !lines.is_cut(mesh.from(next)); });
  for (const Chain& chain : chains) {
    double sum = 0.0;
    for (const HalfEdgeId h : chain.half_edges)
      if (std::binary_search(sharp.begin(), sharp.end(), Mesh::edge_of(h)))
        sum += mesh.edge_length(Mesh::edge_of(h));
    length[first_edge(chain.vertices(mesh))] = sum;
  }
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const LinePtr& line : lines.lines)
    if (const auto it = length.find(first_edge(line->vertices)); it != length.end())
      found.emplace_back(-it->second, line->id);
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> ids;
  for (const auto& [negative, id] : found) ids.push_back(id);
  return ids;
}

}  // namespace arris
