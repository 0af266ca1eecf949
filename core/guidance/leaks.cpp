#include "core/guidance/leaks.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/base/disjoint_sets.h"
#include "core/base/parallel.h"
#include "core/guidance/line_ends.h"
#include "core/guidance/path_search.h"
#include "core/mesh/geometry.h"
#include "core/partitions/border_kink.h"
#include "core/partitions/smallest_areas.h"
#include "core/sharp_lines/normal_noise.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Ways tried from one loose end, each to another line.
constexpr std::size_t most_ways = 3;
/// Gaps weighed against each other in one partition, the shortest first: bounds the quadratic part.
constexpr std::size_t most_gaps = 500;
/// In mean edge lengths: below this the length of a gap says more of the triangles than of the gap,
/// and the corner that a line leaves beside a single edge would score high.
constexpr double least_gap = 3.0;

struct Gap {
  std::uint32_t partition;
  double length;
  std::vector<VertexId> vertices;
  std::vector<EdgeId> edges;
};

/// Two regions that meet along edges of these gaps (sorted, at least one).
struct Link {
  std::uint32_t a, b;
  std::vector<std::uint32_t> gaps;
};

/// Gaps from one loose end through each of the large partitions it lies in.
std::vector<Gap> gaps_from(const Mesh& mesh, const SharpLines& lines, const Partitions& partitions,
                           const LineEnds& ends, const LooseEnd& end, double least_area,
                           double reach) {
  std::set<std::uint32_t> labels;
  mesh.for_ring(end.vertex, [&](HalfEdgeId h) {
    const Partition* partition =
        mesh.face(h) == no_id ? nullptr : partitions.find(partitions.label(mesh.face(h)));
    if (partition && partition->area >= least_area) labels.insert(partition->id);
  });
  std::vector<Gap> gaps;
  if (labels.empty()) return gaps;
  const auto along = ends.along_lines(end, LineEnds::detour * reach);
  PathSearch search(mesh);
  for (const std::uint32_t label : labels) {
    const auto in_partition = [&](HalfEdgeId h) {
      const FaceId f = mesh.face(h);
      return f != no_id && partitions.label(f) == label;
    };
    std::set<std::uint32_t> arrived;  // lines, 0 for the border
    search.run(
        end.vertex, reach,
        [&](HalfEdgeId h) {
          return !lines.is_sharp(Mesh::edge_of(h)) && !mesh.is_border_edge(Mesh::edge_of(h)) &&
                         (in_partition(h) || in_partition(Mesh::opposite(h)))
                     ? mesh.edge_length(Mesh::edge_of(h))
                     : infinite;
        },
        [&](VertexId v) {
          const std::uint32_t line = ends.line_at(v);
          if (line == 0 && !mesh.is_border(v)) return Visit::go_on;
          const double length = search.length_to(v);
          const auto round = along.find(v);
          if (round != along.end() && round->second < LineEnds::detour * length)
            return Visit::do_not_pass;
          if (!arrived.insert(line).second) return Visit::do_not_pass;
          Gap gap{label, length, {end.vertex}, {}};
          for (const HalfEdgeId h : search.path_to(v)) {
            gap.vertices.push_back(mesh.to(h));
            gap.edges.push_back(Mesh::edge_of(h));
          }
          gaps.push_back(std::move(gap));
          return arrived.size() < most_ways ? Visit::do_not_pass : Visit::finish;
        });
  }
  return gaps;
}

/// What closing some gaps parts.
struct Parted {
  Leak leak;
  std::vector<bool> beyond;  // per region of the partition: on the second side
};

/// The gaps of one partition and the regions (between lines and gaps) they part it into.
class PartedPartition {
 public:
  PartedPartition(std::vector<Gap> gaps, double floor) : gaps_(std::move(gaps)), least_gap_(floor) {
    std::sort(gaps_.begin(), gaps_.end(), [](const Gap& x, const Gap& y) {
      return x.length != y.length ? x.length < y.length : x.vertices < y.vertices;
    });
    // Two loose ends that find each other find one gap.
    std::set<std::pair<VertexId, VertexId>> known;
    std::erase_if(gaps_, [&](const Gap& gap) {
      return !known.insert(std::minmax(gap.vertices.front(), gap.vertices.back())).second;
    });
    if (gaps_.size() > most_gaps) gaps_.resize(most_gaps);
    for (std::uint32_t g = 0; g < gaps_.size(); ++g)
      for (const EdgeId e : gaps_[g].edges) gaps_at_[e].push_back(g);
  }

  bool is_gap(EdgeId e) const { return gaps_at_.contains(e); }
  std::uint32_t region_count() const { return static_cast<std::uint32_t>(areas_.size()); }
  void add_region(double area) { areas_.push_back(area); }
  /// `region_of(f)`: the region of a face; no_id outside the partition.
  template <class RegionOf>
  void link(const Mesh& mesh, const RegionOf& region_of) {
    links_of_.resize(gaps_.size());
    for (std::uint32_t g = 0; g < gaps_.size(); ++g)
      for (const EdgeId e : gaps_[g].edges) {
        const std::vector<std::uint32_t>& here = gaps_at_.at(e);
        if (here.front() != g) continue;
        const auto [left, right] = mesh.edge_faces(e);
        const std::uint32_t a = region_of(left), b = region_of(right);
        if (a == no_id || b == no_id || a == b) continue;
        for (const std::uint32_t other : here)
          links_of_[other].push_back(static_cast<std::uint32_t>(links_.size()));
        links_.push_back({a, b, here});
      }
  }

  std::vector<Parted> parted() const {
    std::vector<Parted> result;
    for (std::uint32_t g = 0; g < gaps_.size(); ++g)
      if (std::optional<Parted> parted = weigh(g)) result.push_back(std::move(*parted));
    return result;
  }

 private:
  /// Closes gap g and those that are shorter. Where that parts the two sides of g, opens again,
  /// the longest first, what does not join them: the gaps that stay closed part the partition in
  /// two. Where g alone does it, all others open again.
  std::optional<Parted> weigh(std::uint32_t g) const {
    DisjointSets groups(areas_.size());
    for (const Link& link : links_)
      if (link.gaps.front() > g) groups.join(link.a, link.b);
    const auto parting = std::ranges::find_if(links_of_[g], [&](std::uint32_t l) {
      return groups.find(links_[l].a) != groups.find(links_[l].b);
    });
    if (parting == links_of_[g].end()) return std::nullopt;
    const std::uint32_t one = links_[*parting].a, two = links_[*parting].b;
    std::vector<bool> closed(gaps_.size(), false);
    std::fill_n(closed.begin(), g + 1, true);
    std::vector<std::uint32_t> kept{g};
    for (std::uint32_t other = g; other-- > 0;) {
      closed[other] = false;
      // The links of a gap open all at once, or not at all.
      std::vector<std::pair<std::uint32_t, std::uint32_t>> opening;
      for (const std::uint32_t l : links_of_[other])
        if (std::ranges::none_of(links_[l].gaps, [&](std::uint32_t k) { return closed[k]; }))
          opening.emplace_back(groups.find(links_[l].a), groups.find(links_[l].b));
      if (joins(opening, groups.find(one), groups.find(two))) {
        closed[other] = true;
        kept.push_back(other);
      } else {
        for (const auto& [a, b] : opening) groups.join(a, b);
      }
    }
    Parted parted{{}, std::vector<bool>(areas_.size())};
    double first = 0.0, second = 0.0;
    for (std::uint32_t r = 0; r < areas_.size(); ++r) {
      parted.beyond[r] = groups.find(r) != groups.find(one);
      (parted.beyond[r] ? second : first) += areas_[r];
    }
    Leak& leak = parted.leak;
    leak.partition = gaps_[g].partition;
    leak.path = gaps_[g].vertices;
    for (const std::uint32_t k : kept) leak.gap += gaps_[k].length;
    for (std::size_t k = 1; k < kept.size(); ++k) leak.others.push_back(gaps_[kept[k]].vertices);
    leak.area = std::min(first, second);
    const double floored = std::max(leak.gap, least_gap_);
    leak.score = leak.area / (floored * floored);
    return parted;
  }

  /// Whether the pairs of groups connect `from` with `to`.
  static bool joins(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                    std::uint32_t from, std::uint32_t to) {
    std::vector<std::uint32_t> reached{from};
    const auto has = [&](std::uint32_t k) {
      return std::ranges::find(reached, k) != reached.end();
    };
    for (std::size_t next = 0; next < reached.size(); ++next)
      for (const auto& [a, b] : pairs)
        for (const auto& [here, there] : {std::pair{a, b}, std::pair{b, a}})
          if (here == reached[next] && !has(there)) reached.push_back(there);
    return has(to);
  }

  std::vector<Gap> gaps_;  // by increasing length
  const double least_gap_;
  std::unordered_map<EdgeId, std::vector<std::uint32_t>> gaps_at_;
  std::vector<double> areas_;  // of regions
  std::vector<Link> links_;
  std::vector<std::vector<std::uint32_t>> links_of_;  // per gap
};

/// Measures how far the two sides of gaps are from one smooth surface.
class Kinks {
 public:
  Kinks(const Mesh& mesh, const SharpLines& lines)
      : mesh_(mesh),
        table_(table_between_lines(mesh, lines)),
        banded_(faces_beside_lines(mesh, lines, table_, {})),
        noise_(normal_noise(mesh, table_)),
        window_(table_) {}

  double over(const Leak& leak, const std::function<int(FaceId)>& side_of) {
    double least = over(leak.path, side_of);
    for (const std::vector<VertexId>& path : leak.others)
      least = std::min(least, over(path, side_of));
    return least;
  }

 private:
  double over(const std::vector<VertexId>& path, const std::function<int(FaceId)>& side_of) {
    const BorderSums sums = measure_path(mesh_, table_, half_edges_of(mesh_, path), side_of,
                                         banded_, options_, window_);
    return static_cast<double>(
        clear_kink(sums, options_, noise_, std::numeric_limits<float>::infinity()));
  }

  const Mesh& mesh_;
  const FaceTable table_;
  const std::vector<std::uint8_t> banded_;
  const float noise_;
  const BorderKinkOptions options_;
  FaceWindow window_;
};

}  // namespace

Result<std::vector<Leak>> find_leaks(const Mesh& mesh, const SharpLines& lines,
                                     const Partitions& partitions, const LeakOptions& options,
                                     const Context& context) {
  context.report(0.0, "leaks");
  std::vector<Leak> leaks;
  if (partitions.partitions.empty() || lines.lines.empty()) return leaks;
  double mean_area = 0.0;
  for (const PartitionPtr& partition : partitions.partitions) mean_area += partition->area;
  mean_area /= static_cast<double>(partitions.partitions.size());
  const double least_area = mean_area * (1.0 - 1e-9);  // so that equal ones all count

  const LineEnds ends(mesh, lines);
  const double reach = options.reach * mesh.mean_edge_length();
  std::vector<std::vector<Gap>> found(ends.loose().size());
  parallel_for(
      found.size(),
      [&](std::size_t k) {
        if (!context.cancelled())
          found[k] = gaps_from(mesh, lines, partitions, ends, ends.loose()[k], least_area, reach);
      },
      16);
  if (context.cancelled()) return cancelled();
  context.report(0.5, "leaks");

  std::vector<std::vector<Gap>> gaps_in(partitions.partitions.size());
  std::unordered_map<std::uint32_t, std::uint32_t> place_of;  // of a partition in the list
  for (std::uint32_t k = 0; k < gaps_in.size(); ++k) place_of[partitions.partitions[k]->id] = k;
  for (std::vector<Gap>& gaps : found)
    for (Gap& gap : gaps) gaps_in[place_of[gap.partition]].push_back(std::move(gap));

  // Partitions share no face, so one array of regions serves them all.
  std::vector<std::uint32_t> region_of(mesh.face_count(), no_id);
  std::vector<FaceId> front;
  std::unordered_map<std::uint32_t, PartedPartition> parted;  // by id
  for (std::uint32_t k = 0; k < gaps_in.size(); ++k)
    if (!gaps_in[k].empty())
      parted.try_emplace(partitions.partitions[k]->id, std::move(gaps_in[k]),
                         least_gap * mesh.mean_edge_length());
  for (FaceId start = 0; start < mesh.face_count() && !parted.empty(); ++start) {
    if (start % 65536 == 0 && context.cancelled()) return cancelled();
    const std::uint32_t label = partitions.label(start);
    if (label == 0 || region_of[start] != no_id) continue;
    const auto entry = parted.find(label);
    if (entry == parted.end()) continue;
    PartedPartition& parts = entry->second;
    double region = 0.0;
    const std::uint32_t number = parts.region_count();
    front.assign(1, start);
    region_of[start] = number;
    for (std::size_t next = 0; next < front.size(); ++next) {
      const FaceId f = front[next];
      region += face_area(mesh, f);
      HalfEdgeId h = mesh.face_half_edge(f);
      for (int corner = 0; corner < 3; ++corner, h = mesh.next(h)) {
        const FaceId other = mesh.face(Mesh::opposite(h));
        if (other == no_id || region_of[other] != no_id || partitions.label(other) != label ||
            lines.is_sharp(Mesh::edge_of(h)) || parts.is_gap(Mesh::edge_of(h)))
          continue;
        region_of[other] = number;
        front.push_back(other);
      }
    }
    parts.add_region(region);
  }
  context.report(0.8, "leaks");
  std::optional<Kinks> kinks;
  for (const PartitionPtr& partition : partitions.partitions) {
    const auto entry = parted.find(partition->id);
    if (entry == parted.end()) continue;
    if (context.cancelled()) return cancelled();
    const auto region = [&](FaceId f) {
      return f == no_id || partitions.label(f) != partition->id ? no_id : region_of[f];
    };
    entry->second.link(mesh, region);
    for (Parted& found_here : entry->second.parted()) {
      Leak& leak = found_here.leak;
      if (leak.score < options.least_score) continue;
      if (!kinks) kinks.emplace(mesh, lines);
      leak.kink = kinks->over(leak, [&](FaceId f) {
        const std::uint32_t r = region(f);
        return r == no_id ? 2 : found_here.beyond[r] ? 1 : 0;
      });
      if (leak.kink < options.least_kink) continue;
      leak.score *= std::min(leak.kink / (4.0 * options.least_kink), 1.0);
      if (leak.score >= options.least_score) leaks.push_back(std::move(leak));
    }
  }
  std::sort(leaks.begin(), leaks.end(), [](const Leak& a, const Leak& b) {
    if (a.score != b.score) return a.score > b.score;
    return a.path != b.path ? a.path < b.path : a.partition < b.partition;
  });
  // A loose end that a better leak closes already is no place for another.
  std::set<std::pair<std::uint32_t, VertexId>> used;
  std::erase_if(leaks, [&](const Leak& leak) {
    if (used.contains({leak.partition, leak.path.front()})) return true;
    used.insert({leak.partition, leak.path.front()});
    for (const std::vector<VertexId>& path : leak.others)
      used.insert({leak.partition, path.front()});
    return false;
  });
  if (leaks.size() > options.most) leaks.resize(options.most);
  context.report(1.0, "leaks");
  return leaks;
}

}  // namespace arris
