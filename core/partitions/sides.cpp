#include "core/partitions/sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "core/partitions/interactive_treatments.h"

namespace arris {

namespace {

/// What tells borderlines apart; see Boundary.
struct BorderSide {
  std::uint32_t beyond;  // partition; 0: none
  bool is_sharp, is_scan_border;
  bool operator==(const BorderSide&) const = default;
};

/// The borders of a division of a mesh.
class Borders {
 public:
  Borders(const Mesh& mesh, const SharpLines& lines, const Partitions& partitions)
      : mesh_(mesh), lines_(lines), partitions_(partitions) {}

  std::uint32_t label_of(HalfEdgeId h) const {
    const FaceId f = mesh_.face(h);
    return f == no_id ? 0u : partitions_.label(f);
  }
  bool is_border_of(std::uint32_t id, HalfEdgeId h) const {
    return label_of(h) == id && label_of(Mesh::opposite(h)) != id;
  }
  /// Whether all faces round the vertex belong to the partition.
  bool is_inner(std::uint32_t id, VertexId v) const {
    bool inner = true;
    mesh_.for_ring(v, [&](HalfEdgeId h) { inner = inner && label_of(h) == id; });
    return inner;
  }
  /// The border half-edge after h, round the faces of the partition on its left.
  HalfEdgeId following(HalfEdgeId h) const {
    const std::uint32_t id = label_of(h);
    HalfEdgeId next = mesh_.next(h);
    while (label_of(Mesh::opposite(next)) == id) next = mesh_.next(Mesh::opposite(next));
    return next;
  }
  BorderSide side_of(HalfEdgeId h) const {
    return {label_of(Mesh::opposite(h)), lines_.is_sharp(Mesh::edge_of(h)),
            mesh_.is_border_edge(Mesh::edge_of(h))};
  }
  /// Whether a chain of boundary edges ends at the vertex, whatever they lie between.
  bool is_extremity(VertexId v) const {
    if (lines_.is_cut(v)) return true;
    int count = 0;
    mesh_.for_ring(v, [&](HalfEdgeId h) {
      count += lines_.is_sharp(Mesh::edge_of(h)) || label_of(h) != label_of(Mesh::opposite(h));
    });
    return count != 2;
  }

 private:
  const Mesh& mesh_;
  const SharpLines& lines_;
  const Partitions& partitions_;
};

/// Turns of a loop at its vertices, with the noise of single edges taken out.
class Turns {
 public:
  Turns(const Mesh& mesh, const BorderLoop& loop, double window)
      : window_(std::min(window, loop.length / 8.0)) {
    for (const HalfEdgeId h : loop.half_edges) {
      steps_.push_back(mesh.point(mesh.to(h)) - mesh.point(mesh.from(h)));
      lengths_.push_back(steps_.back().norm());
    }
  }

  double window() const { return window_; }  ///< mm

  /// Degrees at the start of half-edge `place`. An arc turns twice as much over twice the window, a
  /// corner does not: what a window of no width would see is extrapolated. It is not believed
  /// beyond what the window itself sees, or zigzag would count twice.
  double at(std::size_t place) const {
    const double near = turn(place, window_);
    return std::min(near, 2.0 * near - turn(place, 2.0 * window_));
  }

 private:
  double turn(std::size_t place, double window) const {
    const Point ahead = direction(place, window, true), behind = direction(place, window, false);
    const double angle = std::atan2(behind.cross(ahead).norm(), behind.dot(ahead));
    return angle * 180.0 / std::numbers::pi;
  }
  /// Slope of the straight line fitted to the loop over a window on one side of a place: the mean
  /// of its tangent under the weight w(s) ~ s (window - s).
  Point direction(std::size_t place, double window, bool ahead) const {
    const auto weight_to = [&](double s) {
      const double t = s / window;
      return t >= 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t);
    };
    const std::size_t n = steps_.size();
    Point sum = Point::Zero();
    double s = 0.0;
    std::size_t k = place;
    for (std::size_t passed = 0; passed < n && s < window; ++passed) {
      if (!ahead) k = (k + n - 1) % n;
      const double length = lengths_[k];
      if (length > 0.0) sum += steps_[k] / length * (weight_to(s + length) - weight_to(s));
      s += length;
      if (ahead) k = (k + 1) % n;
    }
    return sum;
  }

  const double window_;
  std::vector<Point> steps_;
  std::vector<double> lengths_;
};

void find_corners(const Mesh& mesh, const Borders& borders, const SideOptions& options,
                  BorderLoop& loop) {
  struct Candidate {
    std::int64_t rank;  // a millionth of a degree: not the last digits decide between equal turns
    VertexId vertex;
    std::size_t place;
    bool is_extremity;
    double along;
  };
  const double edge = mesh.mean_edge_length();
  const Turns turns(mesh, loop, options.window * edge);
  std::vector<Candidate> candidates;
  const std::size_t n = loop.half_edges.size();
  double along = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const HalfEdgeId h = loop.half_edges[k], before = loop.half_edges[(k + n - 1) % n];
    const VertexId v = mesh.from(h);
    const bool changes = borders.side_of(before) != borders.side_of(h);
    const bool ends = changes || borders.is_extremity(v);
    const double turn = turns.at(k);
    if (changes || turn >= options.strong_turn || (ends && turn >= options.slight_turn)) {
      const double worth = turn + (ends ? options.strong_turn : 0.0);
      candidates.push_back({std::llround(worth * 1e6), v, k, ends, along});
    }
    along += mesh.edge_length(Mesh::edge_of(h));
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.rank != b.rank) return a.rank > b.rank;
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.place < b.place;
  });
  const double between_extremities = std::min(options.least_side * edge, turns.window());
  std::vector<Candidate> kept;
  for (const Candidate& candidate : candidates) {
    const bool is_one_of_them = std::ranges::any_of(kept, [&](const Candidate& other) {
      const double apart = std::abs(candidate.along - other.along);
      const double least =
          candidate.is_extremity && other.is_extremity ? between_extremities : turns.window();
      // Not a tie to be broken by the last digits: lattices are full of equal lengths.
      return std::min(apart, loop.length - apart) < least * (1.0 - 1e-9);
    });
    if (!is_one_of_them) kept.push_back(candidate);
  }
  for (const Candidate& candidate : kept) loop.corners.push_back(candidate.place);
  std::sort(loop.corners.begin(), loop.corners.end());
}

/// The loop through a border half-edge; its half-edges are marked as seen.
template <class MarkSeen>
BorderLoop loop_through(const Mesh& mesh, const Borders& borders, HalfEdgeId first,
                        const SideOptions& options, const MarkSeen& mark_seen) {
  BorderLoop loop;
  HalfEdgeId h = first;
  do {
    mark_seen(h);
    loop.half_edges.push_back(h);
    loop.length += mesh.edge_length(Mesh::edge_of(h));
    h = borders.following(h);
  } while (h != first);
  find_corners(mesh, borders, options, loop);
  return loop;
}

/// Orders the loops and counts the handles from Euler's number. The border counts as many vertices
/// as edges, since a vertex that it touches twice belongs to two fans of faces.
void complete(const Mesh& mesh, Outline& outline, std::size_t faces, std::size_t inner_vertices) {
  const auto rank = [&](const BorderLoop& loop) {
    return std::pair(std::llround(-loop.length / mesh.mean_edge_length() * 1e6),
                     loop.half_edges.front());
  };
  std::ranges::sort(outline.loops, {}, rank);
  std::size_t border = 0;
  for (const BorderLoop& loop : outline.loops) border += loop.half_edges.size();
  const auto twice_euler = 2 * static_cast<std::int64_t>(inner_vertices) +
                           static_cast<std::int64_t>(border) - static_cast<std::int64_t>(faces);
  const std::int64_t euler = twice_euler / 2;
  outline.handles =
      static_cast<std::uint32_t>((2 - static_cast<std::int64_t>(outline.loops.size()) - euler) / 2);
}

}  // namespace

std::size_t Outline::sides() const {
  std::size_t sum = 0;
  for (const BorderLoop& loop : loops) sum += loop.sides();
  return sum;
}

std::string Outline::text() const {
  const auto counted = [](std::size_t n, const std::string& what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  const std::string own = counted(sides(), "side");
  return loops.size() <= 1 ? own : own + " and " + counted(loops.size() - 1, "hole");
}

Outline outline_of(const Mesh& mesh, const SharpLines& lines, const Partitions& partitions,
                   const Partition& partition, const SideOptions& options) {
  return outline_of(mesh, lines, partitions, partition.id, faces_of(mesh, partitions, partition),
                    options);
}

Outline outline_of(const Mesh& mesh, const SharpLines& lines, const Partitions& partitions,
                   std::uint32_t id, const std::vector<FaceId>& faces, const SideOptions& options) {
  const Borders borders(mesh, lines, partitions);
  std::vector<HalfEdgeId> border;
  std::size_t inner_vertices = 0;
  for (const FaceId f : faces) {
    for (const HalfEdgeId h : mesh.sides(f)) {
      if (borders.is_border_of(id, h)) border.push_back(h);
      // Each vertex is met once by the half-edge that stands for it.
      if (mesh.half_edge(mesh.from(h)) == h) inner_vertices += borders.is_inner(id, mesh.from(h));
    }
  }
  std::sort(border.begin(), border.end());
  Outline outline;
  std::unordered_set<HalfEdgeId> seen;
  for (const HalfEdgeId h : border)
    if (!seen.contains(h))
      outline.loops.push_back(
          loop_through(mesh, borders, h, options, [&](HalfEdgeId x) { seen.insert(x); }));
  complete(mesh, outline, faces.size(), inner_vertices);
  return outline;
}

std::vector<Outline> outlines_of(const Mesh& mesh, const SharpLines& lines,
                                 const Partitions& partitions, const SideOptions& options) {
  std::vector<Outline> outlines(partitions.partitions.size());
  if (outlines.empty()) return outlines;
  std::unordered_map<std::uint32_t, std::size_t> place;
  for (std::size_t k = 0; k < outlines.size(); ++k) place[partitions.partitions[k]->id] = k;
  const Borders borders(mesh, lines, partitions);
  std::vector<bool> seen(2 * mesh.edge_count(), false);
  for (HalfEdgeId h = 0; h < 2 * mesh.edge_count(); ++h) {
    const std::uint32_t id = borders.label_of(h);
    if (id == 0 || seen[h] || !borders.is_border_of(id, h)) continue;
    outlines[place.at(id)].loops.push_back(
        loop_through(mesh, borders, h, options, [&](HalfEdgeId x) { seen[x] = true; }));
  }
  std::vector<std::size_t> inner(outlines.size(), 0);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(v)) continue;
    const std::uint32_t id = borders.label_of(mesh.half_edge(v));
    if (id != 0 && borders.is_inner(id, v)) ++inner[place.at(id)];
  }
  for (std::size_t k = 0; k < outlines.size(); ++k)
    complete(mesh, outlines[k], partitions.partitions[k]->faces, inner[k]);
  return outlines;
}

double four_sided_share(const Partitions& partitions, const std::vector<Outline>& outlines) {
  double all = 0.0, four_sided = 0.0;
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const double area = partitions.partitions[k]->area;
    all += area;
    if (outlines[k].is_four_sided()) four_sided += area;
  }
  return all > 0.0 && std::isfinite(all) ? four_sided / all : 0.0;
}

}  // namespace arris
