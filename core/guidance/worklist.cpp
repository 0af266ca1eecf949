#include "core/guidance/worklist.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/words.h"
#include "core/guidance/leaks.h"
#include "core/guidance/line_ends.h"
#include "core/guidance/path_search.h"
#include "core/mesh/geometry.h"
#include "core/partitions/four_sided_cuts.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

namespace {

/// A flat edge costs a continuation this many times what a sharp one of its length does.
constexpr double flat_cost = 4.0;
/// A walk straight on takes edges down to this share of TV_IH, and turns by 60 degrees at most.
constexpr double walk_share = 0.5, walk_cosine = 0.5;
/// By the normal jump a way on is one where it is as sharp as this share of TV_IH in the mean; and
/// where there is none, a line just stops where it is sharper than this many times TV_IH over its
/// last mean edges: all others fade out, which is no fault.
constexpr double least_sharpness = 0.4, abrupt = 1.5, abrupt_edges = 3.0;
/// Places looked at from one loose end, the cheapest first.
constexpr std::size_t most_arrivals = 8;

/// The vertices that span a set: those farthest out along each axis.
std::vector<VertexId> extremes(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<VertexId> result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(vertices.begin(), vertices.end(), [&](VertexId a, VertexId b) {
          const double x = mesh.point(a)[axis], y = mesh.point(b)[axis];
          return x != y ? x < y : a < b;
        });
    if (low != vertices.end()) result.insert(result.end(), {*low, *high});
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Orders the items of one kind and keeps the first `most`.
void keep_largest(std::vector<WorkItem>& items, std::size_t most) {
  std::sort(items.begin(), items.end(), [](const WorkItem& a, const WorkItem& b) {
    if (a.extent != b.extent) return a.extent > b.extent;
    const VertexId x = *std::ranges::min_element(a.vertices);
    const VertexId y = *std::ranges::min_element(b.vertices);
    if (x != y) return x < y;
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.partitions < b.partitions;
  });
  if (items.size() > most) items.resize(most);
}

/// Ranks the ways on from one loose end.
class Continuations {
 public:
  Continuations(const Mesh& mesh, const Curvatures& curvatures, const SharpLines& lines,
                const LineEnds& ends, double angle, double reach)
      : mesh_(mesh),
        curvatures_(curvatures),
        lines_(lines),
        ends_(ends),
        angle_(angle),
        reach_(reach) {}

  std::vector<Continuation> from(const LooseEnd& end, std::size_t most) const {
    const auto along = ends_.along_lines(end, LineEnds::detour * reach_);
    std::vector<Continuation> found;
    PathSearch search(mesh_);
    std::set<std::uint32_t> arrived;
    std::size_t arrivals = 0;
    search.run(
        end.vertex, reach_,
        [&](HalfEdgeId h) {
          if (!is_open(h >> 1)) return std::numeric_limits<double>::infinity();
          const double flat = 1.0 - sharpness(h >> 1, end);
          return mesh_.edge_length(h >> 1) * (1.0 + (flat_cost - 1.0) * flat);
        },
        [&](VertexId v) {
          const std::uint32_t line = ends_.line_at(v);
          if (line == 0 && !mesh_.is_border(v)) return Visit::go_on;
          const auto round = along.find(v);
          if (round != along.end() && round->second < LineEnds::detour * search.length_to(v))
            return Visit::do_not_pass;
          // One arrival at each line, and at each loose end whatever came first.
          const bool fresh = arrived.insert(line).second;
          if (!fresh && !ends_.is_loose(v)) return Visit::do_not_pass;
          found.push_back(judged(end, search.path_to(v), true));
          return ++arrivals < most_arrivals ? Visit::do_not_pass : Visit::finish;
        });
    if (std::vector<HalfEdgeId> walk = straight_on(end); !walk.empty()) {
      const VertexId last = mesh_.to(walk.back());
      const bool arrives = ends_.line_at(last) != 0 || mesh_.is_border(last);
      Continuation way = judged(end, walk, arrives);
      if (std::ranges::none_of(
              found, [&](const Continuation& other) { return other.vertices == way.vertices; }))
        found.push_back(std::move(way));
    }
    std::sort(found.begin(), found.end(), [](const Continuation& a, const Continuation& b) {
      return a.score != b.score ? a.score > b.score : a.vertices < b.vertices;
    });
    if (found.size() > most) found.resize(most);
    return found;
  }

 private:
  bool is_open(EdgeId e) const { return !lines_.is_sharp(e) && !mesh_.is_border_edge(e); }

  /// How far an edge looks like the line going on: |IHe| against TV_IH, 0 to 1; 0 for the other
  /// sign.
  double sharpness(EdgeId e, const LooseEnd& end) const {
    const double beta = end.convex ? curvatures_.beta[e] : -curvatures_.beta[e];
    return std::clamp(beta / angle_, 0.0, 1.0);
  }

  Continuation judged(const LooseEnd& end, const std::vector<HalfEdgeId>& path,
                      bool arrives) const {
    Continuation way;
    way.vertices.push_back(end.vertex);
    double sharp = 0.0;
    for (const HalfEdgeId h : path) {
      way.vertices.push_back(mesh_.to(h));
      const double length = mesh_.edge_length(h >> 1);
      way.length += length;
      sharp += length * sharpness(h >> 1, end);
    }
    way.arrives = arrives;
    const VertexId last = way.vertices.back();
    way.line = ends_.line_at(last);
    if (way.length > 0.0) sharp /= way.length;
    way.sharpness = sharp;
    const std::size_t steps = std::min<std::size_t>(3, path.size());
    const Point start = (mesh_.point(way.vertices[steps]) - mesh_.point(end.vertex)).normalized();
    const double straight = (1.0 + end.ahead.dot(start)) / 2.0;
    const double worth = ends_.is_loose(last)    ? 1.0
                         : way.line != 0         ? 0.8
                         : mesh_.is_border(last) ? 0.7
                                                 : 0.5;
    way.score = worth * straight * (0.2 + 0.8 * sharp) / (1.0 + way.length / reach_);
    return way;
  }

  /// From a loose end along the sharpest edges ahead, as far as they are above a share of TV_IH.
  std::vector<HalfEdgeId> straight_on(const LooseEnd& end) const {
    std::vector<HalfEdgeId> path;
    std::set<VertexId> passed{end.vertex};
    Point ahead = end.ahead;
    VertexId v = end.vertex;
    for (double length = 0.0;;) {
      HalfEdgeId best = no_id;
      double best_worth = 0.0;
      mesh_.for_ring(v, [&](HalfEdgeId h) {
        if (!is_open(h >> 1) || passed.contains(mesh_.to(h))) return;
        const double turn = ahead.dot((mesh_.point(mesh_.to(h)) - mesh_.point(v)).normalized());
        const double beta = (end.convex ? 1.0 : -1.0) * curvatures_.beta[h >> 1];
        if (turn < walk_cosine || beta <= walk_share * angle_) return;
        const double worth = beta * turn;
        if (worth < best_worth ||
            (worth == best_worth && best != no_id && mesh_.to(h) > mesh_.to(best)))
          return;
        best = h;
        best_worth = worth;
      });
      if (best == no_id) return path;
      length += mesh_.edge_length(best >> 1);
      if (length > reach_) return path;
      path.push_back(best);
      v = mesh_.to(best);
      passed.insert(v);
      if (ends_.line_at(v) != 0 || mesh_.is_border(v)) return path;
      // The direction over three edges, as zigzag is what lines on a lattice do.
      const VertexId back =
          path.size() >= 3 ? mesh_.from(path[path.size() - 3]) : mesh_.from(path.front());
      ahead = (mesh_.point(v) - mesh_.point(back)).normalized();
    }
  }

  const Mesh& mesh_;
  const Curvatures& curvatures_;
  const SharpLines& lines_;
  const LineEnds& ends_;
  const double angle_;  // TV_IH, radians
  const double reach_;  // mm
};

/// Whether a line that was found just stops while its jump is still well above TV_IH, or was drawn
/// by hand.
bool stops_sharp(const Document& document, const Curvatures& measures, const LooseEnd& end,
                 double angle) {
  const Mesh& mesh = *document.mesh;
  std::vector<VertexId> path = document.lines.find(end.line)->vertices;
  if (path.front() != end.vertex) std::ranges::reverse(path);
  double length = 0.0, turn = 0.0;
  for (const HalfEdgeId h : half_edges_of(mesh, path)) {
    if (length == 0.0 && document.lines.edges[h >> 1] != Origin::found) return true;
    length += mesh.edge_length(h >> 1);
    turn += mesh.edge_length(h >> 1) * std::abs(measures.beta[h >> 1]);
    if (length > abrupt_edges * mesh.mean_edge_length()) break;
  }
  return turn > abrupt * angle * length;
}

std::vector<WorkItem> loose_end_items(const Document& document, const WorklistOptions& options) {
  const Mesh& mesh = *document.mesh;
  const LineEnds ends(mesh, document.lines);
  std::vector<WorkItem> items;
  for (const LooseEnd& end : ends.loose()) {
    WorkItem item;
    item.kind = WorkKind::loose_end;
    item.size = end.length;
    item.extent = end.length;
    item.vertices = {end.vertex};
    item.lines = {end.line};
    items.push_back(std::move(item));
  }
  const LengthUnit unit = length_unit_of(document);
  const Result<LineEvidencePtr> evidence = line_evidence_of(document);
  const bool by_jump = evidence && *evidence;
  keep_largest(items, options.most_per_kind);
  const std::size_t with_ways = by_jump ? items.size() : options.most_with_ways;
  const double angle =
      (document.step("find_sharp_lines")
           ? document.step("find_sharp_lines")->parameters.at("angle").get<double>()
           : default_sharp_angle(mesh, *document.curvatures, LineMethod::walk)) *
      std::numbers::pi / 180.0;
  const CurvaturesPtr measures = line_measures(document);
  const double reach = options.reach * mesh.mean_edge_length();
  const Continuations continuations(mesh, *measures, document.lines, ends, angle, reach);
  parallel_for(
      items.size(),
      [&](std::size_t k) {
        WorkItem& item = items[k];
        const auto end = std::ranges::find_if(
            ends.loose(), [&](const LooseEnd& e) { return e.vertex == item.vertices[0]; });
        item.sentence = "Line " + std::to_string(end->line) + " (" +
                        length_in_words(end->length, unit) + ") just stops";
        if (k >= with_ways) {
          item.sentence += ".";
          return;
        }
        item.continuations = continuations.from(*end, options.most_continuations);
        if (by_jump) {
          std::erase_if(item.continuations,
                        [](const Continuation& way) { return way.sharpness < least_sharpness; });
          if (item.continuations.empty()) {
            // Without a sentence it is left out.
            item.sentence =
                stops_sharp(document, *measures, *end, angle)
                    ? item.sentence + ", sharp to its end; nothing sharp goes on from there."
                    : "";
            return;
          }
        }
        if (item.continuations.empty()) {
          item.sentence += "; there is no way on within " + length_in_words(reach, unit) + ".";
          return;
        }
        const Continuation& best = item.continuations.front();
        item.sentence += "; the best way on runs " + length_in_words(best.length, unit) +
                         (best.line != 0 ? " to line " + std::to_string(best.line)
                          : best.arrives ? std::string(" to the border")
                                         : std::string(" and fades out")) +
                         ".";
        if (best.line != 0 && best.line != end->line) item.lines.push_back(best.line);
      },
      4);
  std::erase_if(items, [](const WorkItem& item) { return item.sentence.empty(); });
  return items;
}

Result<std::vector<WorkItem>> leak_items(const Document& document, const WorklistOptions& options,
                                         const Context& context) {
  LeakOptions leak_options;
  leak_options.reach = options.reach;
  leak_options.most = options.most_per_kind;
  const Result<std::vector<Leak>> leaks =
      find_leaks(*document.mesh, document.lines, document.partitions, leak_options, context);
  if (!leaks) return tl::unexpected<Error>(leaks.error());
  const LineEnds ends(*document.mesh, document.lines);
  const LengthUnit unit = length_unit_of(document);
  std::vector<WorkItem> items;
  for (const Leak& leak : *leaks) {
    WorkItem item;
    item.kind = WorkKind::leak;
    item.size = leak.score;
    item.extent = std::sqrt(leak.area);
    item.paths = leak.others;
    item.paths.insert(item.paths.begin(), leak.path);
    for (const std::vector<VertexId>& path : item.paths)
      item.vertices.insert(item.vertices.end(), path.begin(), path.end());
    item.partitions = {leak.partition};
    std::set<std::uint32_t> beside;
    for (const VertexId v : item.vertices)
      if (const std::uint32_t line = ends.line_at(v); line != 0) beside.insert(line);
    item.lines.assign(beside.begin(), beside.end());
    const std::size_t gaps = item.paths.size();
    item.sentence = "Partition " + std::to_string(leak.partition) + " runs through " +
                    (gaps == 1 ? std::string("a gap") : std::to_string(gaps) + " gaps") + " of " +
                    length_in_words(leak.gap, unit) + (gaps == 1 ? "" : " in all") +
                    " into another " + area_in_words(leak.area, unit) + ".";
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<WorkItem> unassigned_items(const Document& document) {
  const Mesh& mesh = *document.mesh;
  const LengthUnit unit = length_unit_of(document);
  std::vector<WorkItem> items;
  std::vector<bool> seen(mesh.face_count(), false);
  std::vector<FaceId> front;
  std::vector<VertexId> corners;
  for (FaceId start = 0; start < mesh.face_count(); ++start) {
    if (seen[start] || document.partitions.label(start) != 0) continue;
    front.assign(1, start);
    corners.clear();
    seen[start] = true;
    WorkItem item;
    std::set<std::uint32_t> beside;
    for (std::size_t next = 0; next < front.size(); ++next) {
      item.size += face_area(mesh, front[next]);
      HalfEdgeId h = mesh.face_half_edge(front[next]);
      for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
        corners.push_back(mesh.from(h));
        const FaceId f = mesh.face(Mesh::opposite(h));
        if (f == no_id || document.lines.is_sharp(h >> 1)) continue;
        if (const std::uint32_t label = document.partitions.label(f); label != 0) {
          beside.insert(label);
        } else if (!seen[f]) {
          seen[f] = true;
          front.push_back(f);
        }
      }
    }
    item.kind = WorkKind::unassigned_area;
    item.extent = std::sqrt(item.size);
    item.face = start;
    item.vertices = extremes(mesh, corners);
    item.partitions.assign(beside.begin(), beside.end());
    item.sentence = area_in_words(item.size, unit) + " (" + std::to_string(front.size()) +
                    (front.size() == 1 ? " face" : " faces") + ") in no partition.";
    items.push_back(std::move(item));
  }
  return items;
}

/// What the borderlines of a partition add up to.
struct BorderExtent {
  double length = 0.0;
  std::vector<VertexId> vertices;
};

Result<void> add_boundary_items(const Document& document, const WorklistOptions& options,
                                const Context& context, std::vector<WorkItem>& undefined,
                                std::vector<WorkItem>& slivers) {
  const Mesh& mesh = *document.mesh;
  const LengthUnit unit = length_unit_of(document);
  std::unordered_map<std::uint32_t, BorderExtent> extents;
  for (const BoundaryPtr& derived : *document.boundaries) {
    const Boundary& boundary = *derived;
    for (const std::uint32_t id : {boundary.left, boundary.right}) {
      if (id == 0 || boundary.left == boundary.right) continue;
      BorderExtent& extent = extents[id];
      extent.length += boundary.length;
      extent.vertices.insert(extent.vertices.end(), boundary.vertices.begin(),
                             boundary.vertices.end());
    }
    if (boundary.type != BoundaryType::undefined) continue;
    WorkItem item;
    item.kind = WorkKind::undefined_boundary;
    item.size = boundary.length;
    item.extent = boundary.length;
    item.partitions = {std::max(boundary.left, boundary.right)};
    item.sentence = "Partition " + std::to_string(item.partitions[0]) + " ends over " +
                    length_in_words(boundary.length, unit) + " where no other begins.";
    item.vertices = boundary.vertices;
    undefined.push_back(std::move(item));
  }
  for (const PartitionPtr& partition : document.partitions.partitions) {
    const auto found = extents.find(partition->id);
    if (found == extents.end()) continue;
    const BorderExtent& extent = found->second;
    // A strip of width w and length l, l >> w, has the area w l and the outline 2 l.
    const double width = 2.0 * partition->area / extent.length;
    const double length = extent.length / 2.0;
    if (width >= options.sliver_width * mesh.mean_edge_length() ||
        length <= options.sliver_ratio * width)
      continue;
    WorkItem item;
    item.kind = WorkKind::sliver;
    item.size = length / width;
    item.extent = length;
    item.partitions = {partition->id};
    item.vertices = extremes(mesh, extent.vertices);
    item.sentence = "Partition " + std::to_string(partition->id) + " is only about " +
                    length_in_words(width, unit) + " wide over " + length_in_words(length, unit) +
                    ".";
    slivers.push_back(std::move(item));
  }
  if (slivers.empty()) return {};
  // A strip that one surface explains is a fillet or a rim, not what is left of something.
  Partitions narrow{document.partitions.labels, {}};
  for (const WorkItem& item : slivers)
    narrow.partitions.push_back(*std::ranges::lower_bound(document.partitions.partitions,
                                                          item.partitions[0], {}, &Partition::id));
  const Result<std::vector<PartitionSurface>> surfaces =
      fit_partition_surfaces(mesh, document.lines, narrow, context);
  if (!surfaces) return tl::unexpected<Error>(surfaces.error());
  std::vector<WorkItem> kept;
  for (std::size_t k = 0; k < slivers.size(); ++k)
    if ((*surfaces)[k].surface.type == SurfaceType::free) kept.push_back(std::move(slivers[k]));
  slivers = std::move(kept);
  return {};
}

/// Partitions that no four-sided patch covers.
std::vector<WorkItem> many_border_items(const Document& document, const WorklistOptions& options) {
  const Mesh& mesh = *document.mesh;
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  const std::vector<Outline> outlines = outlines_of(mesh, document.lines, document.partitions);
  std::vector<WorkItem> items;
  std::vector<VertexId> vertices;
  for (std::size_t k = 0; k < partitions.size(); ++k) {
    const Outline& outline = outlines[k];
    const std::size_t sides = outline.sides();
    if (outline.loops.size() <= 1 &&
        sides <= static_cast<std::size_t>(std::max(options.most_borderlines, 0)))
      continue;
    WorkItem item;
    item.kind = WorkKind::many_borders;
    item.size = static_cast<double>(sides);
    item.extent = std::sqrt(partitions[k]->area);
    item.partitions = {partitions[k]->id};
    vertices.clear();
    for (const BorderLoop& loop : outline.loops)
      for (const HalfEdgeId h : loop.half_edges) vertices.push_back(mesh.from(h));
    item.vertices = extremes(mesh, vertices);
    item.sentence = "Partition " + std::to_string(partitions[k]->id) + " has " + outline.text() +
                    (partitions[k]->locked ? "; it is locked." : ".");
    items.push_back(std::move(item));
  }
  return items;
}

}  // namespace

std::string_view name_of(WorkKind kind) {
  static constexpr std::array<std::string_view, 6> names{
      "leak", "loose_end", "unassigned_area", "undefined_boundary", "sliver", "many_borders"};
  return names[static_cast<std::size_t>(kind)];
}

Result<std::vector<WorkItem>> worklist(const Document& document, const WorklistOptions& options,
                                       const Context& context) {
  context.report(0.0, "worklist");
  std::vector<WorkItem> result;
  if (document.empty()) return result;
  const bool parted = !document.partitions.partitions.empty();
  std::vector<WorkItem> leaks, loose, unassigned, undefined, many, slivers;
  if (parted) {
    Result<std::vector<WorkItem>> found = leak_items(document, options, context.part(0.0, 0.5));
    if (!found) return found;
    leaks = std::move(*found);
  }
  if (context.cancelled()) return cancelled();
  loose = loose_end_items(document, options);
  if (context.cancelled()) return cancelled();
  context.report(0.6, "worklist");
  if (parted) {
    unassigned = unassigned_items(document);
    if (context.cancelled()) return cancelled();
    context.report(0.8, "worklist");
    if (const auto done =
            add_boundary_items(document, options, context.part(0.8, 0.85), undefined, slivers);
        !done)
      return tl::unexpected<Error>(done.error());
    many = many_border_items(document, options);
  }
  const double small = std::min(options.small_edges * document.mesh->mean_edge_length(),
                                options.small_share * document.mesh->diagonal());
  for (std::vector<WorkItem>* items : {&leaks, &loose, &unassigned, &undefined, &slivers}) {
    keep_largest(*items, options.most_per_kind);
    for (WorkItem& item : *items) item.small = item.extent < small;
    std::move(items->begin(), items->end(), std::back_inserter(result));
  }
  std::stable_partition(result.begin(), result.end(),
                        [](const WorkItem& item) { return !item.small; });
  keep_largest(many, options.most_per_kind);
  std::move(many.begin(), many.end(), std::back_inserter(result));
  context.report(1.0, "worklist");
  return result;
}

bool is_left(const WorkItem& item) { return item.kind != WorkKind::many_borders; }

Result<WorkItem> with_cuts(const Document& document, WorkItem item, const Context& context) {
  if (item.kind != WorkKind::many_borders) return item;
  const Partition& partition = *document.partitions.find(item.partitions[0]);
  if (partition.locked) return item;
  const Result<FourSidedPlan> plan =
      four_sided_cuts(*document.mesh, *document.curvatures, document.lines, document.partitions,
                      partition, {}, context);
  if (!plan) return tl::unexpected<Error>(plan.error());
  double length = 0.0;
  for (const FourSidedCut& cut : plan->cuts) {
    item.paths.insert(item.paths.end(), cut.strokes.begin(), cut.strokes.end());
    length += cut.length;
  }
  item.sentence.pop_back();  // the full stop
  const std::size_t cuts = item.paths.size();
  const LengthUnit unit = length_unit_of(document);
  if (cuts > 0)
    item.sentence += "; " +
                     (cuts == 1 ? std::string("a cut of ") + length_in_words(length, unit)
                                : std::to_string(cuts) + " cuts of " +
                                      length_in_words(length, unit) + " in all") +
                     (plan->obstacle.empty() ? " would leave no piece with more than four"
                                             : " would leave fewer");
  if (!plan->obstacle.empty())
    item.sentence += (cuts > 0 ? ", but not four: " : "; no cut is proposed: ") + plan->obstacle;
  item.sentence += ".";
  return item;
}

}  // namespace arris
