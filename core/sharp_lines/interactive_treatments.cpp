#include "core/sharp_lines/interactive_treatments.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "core/sharp_lines/candidate_walk.h"
#include "core/sharp_lines/cheapest_path.h"

namespace arris {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double veto_reach = 1.5;  // mean edges, document.md rule 6

/// Sharp edges of a document while a treatment adds to them.
class LocalEdges {
 public:
  LocalEdges(const Mesh& mesh, const SharpLines& lines) : mesh_(mesh), lines_(lines) {}

  bool is_sharp(EdgeId e) const {
    const auto changed = changes_.find(e);
    return changed != changes_.end() ? changed->second : lines_.is_sharp(e);
  }
  unsigned degree(VertexId v) const {
    unsigned count = 0;
    mesh_.for_ring(v, [&](HalfEdgeId h) { count += is_sharp(Mesh::edge_of(h)); });
    return count;
  }
  bool may_take(EdgeId e) const {
    return !region_ || (region_->contains(mesh_.edge(e)[0]) && region_->contains(mesh_.edge(e)[1]));
  }
  void take(EdgeId e) { changes_[e] = true; }
  void drop(EdgeId e) { changes_[e] = false; }
  void keep_to(const std::unordered_set<VertexId>& region) { region_ = &region; }

  LineChanges result(Origin origin) const {
    LineChanges result;
    for (const auto& [e, sharp] : changes_)
      if (sharp != lines_.is_sharp(e)) result.edges.emplace_back(e, sharp ? origin : Origin::none);
    std::sort(result.edges.begin(), result.edges.end());
    return result;
  }

 private:
  const Mesh& mesh_;
  const SharpLines& lines_;
  const std::unordered_set<VertexId>* region_ = nullptr;
  std::unordered_map<EdgeId, bool> changes_;
};

/// Vertices joined to `sources` by edges, all within `radius` of one of them.
std::unordered_set<VertexId> within(const Mesh& mesh, const std::vector<VertexId>& sources,
                                    double radius) {
  std::unordered_set<VertexId> reached;
  std::vector<std::pair<VertexId, VertexId>> front;  // with the source it is measured from
  for (const VertexId v : sources)
    if (v < mesh.vertex_count() && !mesh.is_isolated(v) && reached.insert(v).second)
      front.emplace_back(v, v);
  const double radius2 = radius * radius;
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto [v, source] = front[next];
    mesh.for_ring(v, [&, source = source](HalfEdgeId h) {
      const VertexId w = mesh.to(h);
      if (reached.contains(w)) return;
      VertexId nearest = source;
      double least = (mesh.point(w) - mesh.point(nearest)).squaredNorm();
      if (least > radius2)  // round a bend another source may be nearer
        for (const VertexId s : sources)
          if (const double d =
                  s < mesh.vertex_count() ? (mesh.point(w) - mesh.point(s)).squaredNorm() : least;
              d < least) {
            least = d;
            nearest = s;
          }
      if (least > radius2) return;
      reached.insert(w);
      front.emplace_back(w, nearest);
    });
  }
  return reached;
}

}  // namespace

LineChanges extend_line(const Mesh& mesh, const Curvatures& curvatures, const SharpLines& lines,
                        const Line& line, EndsToExtend ends, double angle, int candidates) {
  LocalEdges edges(mesh, lines);
  SharpLineOptions options;
  options.angle = angle;
  options.candidates = candidates;
  CandidateWalk<LocalEdges> walk(mesh, curvatures, options, edges);
  if (!line.closed) {
    for (const auto& [end, wanted] : {std::pair{line.vertices.front(), ends != EndsToExtend::last},
                                      std::pair{line.vertices.back(), ends != EndsToExtend::first}})
      // A loose end only: where lines meet, or at the border, a line has come to its end.
      if (wanted && !mesh.is_border(end) && edges.degree(end) == 1) walk.walk(end);
  }
  return edges.result(Origin::extended);
}

Result<std::vector<VertexId>> bridge_between(const Mesh& mesh, const Curvatures& curvatures,
                                             const SharpLines& lines, const Line& a, const Line& b,
                                             double angle) {
  std::vector<VertexId> ends[2];
  for (const Line* line : {&a, &b}) {
    for (const VertexId v : {line->vertices.front(), line->vertices.back()})
      if (!line->closed && !mesh.is_border(v) && sharp_edges_at(mesh, lines, v).size() == 1)
        ends[line == &b].push_back(v);
    if (ends[line == &b].empty())
      return fail("Line " + std::to_string(line->id) +
                  " has no loose end to merge at: it is closed, or ends at other lines or the "
                  "border.");
  }
  double straight = std::numeric_limits<double>::infinity();
  for (const VertexId v : ends[0])
    for (const VertexId w : ends[1])
      straight = std::min(straight, (mesh.point(v) - mesh.point(w)).norm());
  // Not through other lines: they would be parted.
  const auto may_pass = [&](VertexId v) {
    return sharp_edges_at(mesh, lines, v).empty() ||
           std::find(ends[0].begin(), ends[0].end(), v) != ends[0].end() ||
           std::find(ends[1].begin(), ends[1].end(), v) != ends[1].end();
  };
  constexpr double detour = 4.0;
  std::vector<VertexId> path = cheapest_path(
      mesh, curvatures, ends[0], ends[1], {angle * degree},
      detour * straight + mesh.mean_edge_length(), [&](EdgeId e) {
        return !lines.is_sharp(e) && may_pass(mesh.edge(e)[0]) && may_pass(mesh.edge(e)[1]);
      });
  if (path.size() < 2)
    return fail("Lines " + std::to_string(a.id) + " and " + std::to_string(b.id) +
                " cannot be merged: no path that meets no other line joins their ends within four "
                "times the straight way.");
  return path;
}

Result<std::vector<VertexId>> path_through(const Mesh& mesh, const Curvatures& curvatures,
                                           const std::vector<VertexId>& points, double angle,
                                           const std::function<bool(EdgeId)>& may_use) {
  if (points.size() < 2) return fail("A line needs two points at least.");
  for (const VertexId v : points)
    if (v >= mesh.vertex_count() || mesh.is_isolated(v))
      return fail("One of the points is not on the working mesh any more: click it anew.");
  std::vector<VertexId> path{points.front()};
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    if (points[k] == points[k + 1]) continue;
    const std::vector<VertexId> stretch =
        cheapest_path(mesh, curvatures, {points[k]}, {points[k + 1]}, {angle * degree},
                      std::numeric_limits<double>::infinity(), may_use);
    if (stretch.empty())
      return fail(
          "No way leads over the mesh from one point to the next: they lie on loose pieces of the "
          "part, or what may not be crossed lies between them.");
    path.insert(path.end(), stretch.begin() + 1, stretch.end());
  }
  if (path.size() < 2) return fail("A line needs two different points.");
  return path;
}

LineChanges add_path(const Mesh& mesh, const SharpLines& lines, const std::vector<VertexId>& path,
                     Origin origin) {
  LineChanges changes;
  for (const HalfEdgeId h : half_edges_of(mesh, path))
    if (!lines.is_sharp(Mesh::edge_of(h)) && !mesh.is_border_edge(Mesh::edge_of(h)))
      changes.edges.emplace_back(Mesh::edge_of(h), origin);
  return changes;
}

LineChanges remove_path(const Mesh& mesh, const SharpLines& lines,
                        const std::vector<VertexId>& path) {
  LineChanges changes;
  for (const HalfEdgeId h : half_edges_of(mesh, path))
    if (lines.is_sharp(Mesh::edge_of(h)))
      changes.edges.emplace_back(Mesh::edge_of(h), Origin::none);
  return changes;
}

std::vector<EdgeId> found_near(const Mesh& mesh, const SharpLines& lines,
                               const std::vector<VertexId>& path) {
  std::unordered_set<EdgeId> own;
  for (const HalfEdgeId h : half_edges_of(mesh, path)) own.insert(Mesh::edge_of(h));
  const std::unordered_set<VertexId> zone =
      within(mesh, path, veto_reach * mesh.mean_edge_length());
  std::vector<EdgeId> found;
  for (const VertexId v : zone)
    mesh.for_ring(v, [&](HalfEdgeId h) {
      const EdgeId e = Mesh::edge_of(h);
      if (mesh.to(h) > v && zone.contains(mesh.to(h)) && !own.contains(e) && lines.is_sharp(e) &&
          lines.edges[e] == Origin::found)
        found.push_back(e);
    });
  std::sort(found.begin(), found.end());
  return found;
}

VertexId nearest_on(const Mesh& mesh, const Line& line, const Point& point) {
  return *std::min_element(line.vertices.begin(), line.vertices.end(), [&](VertexId a, VertexId b) {
    return (mesh.point(a) - point).squaredNorm() < (mesh.point(b) - point).squaredNorm();
  });
}

std::pair<VertexId, VertexId> stretch_round(const Mesh& mesh, const Line& line, VertexId at,
                                            double distance) {
  const std::vector<VertexId>& path = line.vertices;
  const auto place = std::find(path.begin(), path.end(), at) - path.begin();
  constexpr std::ptrdiff_t least_edges = 2;
  const auto walk = [&](std::ptrdiff_t step) {
    double length = 0.0;
    std::ptrdiff_t k = place;
    const std::ptrdiff_t end = step < 0 ? 0 : static_cast<std::ptrdiff_t>(path.size()) - 1;
    while (k != end && (std::abs(k - place) < least_edges || length < 2.0 * distance)) {
      length += (mesh.point(path[static_cast<std::size_t>(k + step)]) -
                 mesh.point(path[static_cast<std::size_t>(k)]))
                    .norm();
      k += step;
    }
    return path[static_cast<std::size_t>(k)];
  };
  return {walk(-1), walk(1)};
}

std::unordered_set<VertexId> vertices_of(const Mesh& mesh, const BrushedRegion& region) {
  return within(mesh, region.stroke, region.radius);
}

LineChanges recompute_region(const Mesh& mesh, const Curvatures& curvatures,
                             const LineEvidence* evidence, const SharpLines& lines,
                             const std::unordered_set<VertexId>& region,
                             const SharpLineOptions& options) {
  LocalEdges edges(mesh, lines);
  edges.keep_to(region);
  std::vector<EdgeId> inside;
  std::vector<VertexId> seeds;
  for (const VertexId v : region) {
    if (!mesh.is_border(v)) seeds.push_back(v);
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (mesh.to(h) > v && region.contains(mesh.to(h))) inside.push_back(Mesh::edge_of(h));
    });
  }
  std::sort(inside.begin(), inside.end());
  std::sort(seeds.begin(), seeds.end(), [&](VertexId a, VertexId b) {
    return curvatures.ikabs[a] != curvatures.ikabs[b] ? curvatures.ikabs[a] > curvatures.ikabs[b]
                                                      : a < b;
  });
  std::unordered_set<EdgeId> locked;
  std::vector<EdgeId> sharp;
  for (const EdgeId e : inside)
    if (lines.is_sharp(e)) sharp.push_back(e);
  for (const std::uint32_t id : lines_through(mesh, lines, sharp))
    if (const Line& line = *lines.find(id); line.locked)
      for (const HalfEdgeId h : half_edges_of(mesh, line.vertices)) locked.insert(Mesh::edge_of(h));
  for (const EdgeId e : sharp)
    if (lines.edges[e] == Origin::found && !locked.contains(e)) edges.drop(e);

  if (options.method == LineMethod::normal_jump) {
    SharpLineOptions all = options;
    all.min_length = 0.0;  // what is isolated is decided below, with the lines that stay
    for (const EdgeId e : choose_sharp_edges(mesh, *evidence, all))
      if (edges.may_take(e)) edges.take(e);
  } else {
    CandidateWalk<LocalEdges> walk(mesh, curvatures, options, edges);
    walk.run(seeds);
    walk.close(inside);
  }

  // Isolated new lines that are too short: groups of new edges that touch nothing else.
  LineChanges changes = edges.result(Origin::found);
  std::unordered_set<EdgeId> fresh;
  for (const auto& [e, origin] : changes.edges)
    if (origin != Origin::none) fresh.insert(e);
  std::unordered_set<EdgeId> seen, too_short;
  for (const EdgeId start : inside) {
    if (!edges.is_sharp(start) || seen.contains(start)) continue;
    std::vector<EdgeId> group{start};
    seen.insert(start);
    bool isolated = true;
    double length = 0.0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      length += mesh.edge_length(group[k]);
      isolated = isolated && !locked.contains(group[k]) &&
                 (fresh.contains(group[k]) || lines.edges[group[k]] == Origin::found);
      for (const VertexId v : mesh.edge(group[k]))
        mesh.for_ring(v, [&](HalfEdgeId h) {
          if (!edges.is_sharp(Mesh::edge_of(h)) || seen.contains(Mesh::edge_of(h))) return;
          if (!edges.may_take(Mesh::edge_of(h))) {
            isolated = false;
            return;
          }
          seen.insert(Mesh::edge_of(h));
          group.push_back(Mesh::edge_of(h));
        });
    }
    if (isolated && length < options.min_length) too_short.insert(group.begin(), group.end());
  }
  for (const EdgeId e : too_short) edges.drop(e);
  return edges.result(Origin::found);
}

}  // namespace arris
