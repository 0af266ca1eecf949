#include "core/partitions/four_sided_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <span>
#include <unordered_map>

#include "core/partitions/interactive_treatments.h"

namespace arris {

namespace {

using Cost = std::uint64_t;  // in millionths of a mean edge
constexpr Cost no_cost = std::numeric_limits<Cost>::max() / 8;
constexpr double cost_unit = 1e6;
/// An edge as far from the straight line as that is long costs so many times more.
constexpr double away_from_straight = 4.0;

using Node = std::uint32_t;

/// The inside of a partition as a graph: a node for each vertex inside, and one for each place of
/// the border, so that a vertex at which the border touches itself is as many nodes as places.
class InsideGraph {
 public:
  InsideGraph(const PartitionGround& ground, const Curvatures& curvatures, std::uint32_t id,
              const std::vector<FaceId>& faces, const Outline& outline, double curvature_weight,
              const Context& context)
      : mesh_(ground.mesh), context_(context) {
    for (const BorderLoop& loop : outline.loops) {
      loop_start_.push_back(static_cast<Node>(vertices_.size()));
      for (const HalfEdgeId h : loop.half_edges) vertices_.push_back(mesh_.from(h));
    }
    border_nodes_ = static_cast<Node>(vertices_.size());
    const auto own = [&](HalfEdgeId h) {
      const FaceId f = mesh_.face(h);
      return f != no_id && ground.partitions.label(f) == id;
    };
    // Which place of the border each half-edge out of a border vertex into the inside starts from.
    std::unordered_map<HalfEdgeId, Node> place_of;
    std::unordered_map<VertexId, Node> inside;
    Node place = 0;
    for (const BorderLoop& loop : outline.loops)
      for (const HalfEdgeId first : loop.half_edges) {
        inside[mesh_.from(first)] = no_id;
        for (HalfEdgeId h = Mesh::opposite(mesh_.previous(first)); own(h);
             h = Mesh::opposite(mesh_.previous(h)))
          place_of[h] = place;
        ++place;
      }
    struct Link {
      Node from, to;
      HalfEdgeId by;
    };
    std::vector<Link> links;
    const auto node_of = [&](HalfEdgeId out) -> Node {
      const VertexId v = mesh_.from(out);
      const auto [it, fresh] = inside.try_emplace(v, static_cast<Node>(vertices_.size()));
      if (fresh) vertices_.push_back(v);
      return it->second != no_id ? it->second : place_of.at(out);
    };
    for (const FaceId f : faces) {
      for (const HalfEdgeId h : mesh_.sides(f)) {
        if ((h & 1) != 0 || !own(Mesh::opposite(h)) || ground.lines.is_sharp(Mesh::edge_of(h)))
          continue;
        const Node a = node_of(h), b = node_of(Mesh::opposite(h));
        links.push_back({a, b, h});
        links.push_back({b, a, Mesh::opposite(h)});
      }
    }
    std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
      return a.from != b.from ? a.from < b.from : a.by < b.by;
    });
    starts_.assign(vertices_.size() + 1, 0);
    for (const Link& link : links) ++starts_[link.from + 1];
    for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
    const double unit = cost_unit / mesh_.mean_edge_length();
    const auto bend_at = [&](Node k) { return std::sqrt(curvatures.kabs[vertices_[k]]); };
    for (const Link& link : links) {
      const double length = mesh_.edge_length(link.by >> 1);
      const double change = (bend_at(link.to) - bend_at(link.from)) * length;
      // Undefined on the border. Squared, so that noise does not send a cut round every bump.
      const double unevenness = std::isnan(change) ? 0.0 : std::min(change * change, 1.0);
      // At least 1: only where a path starts does it cost nothing.
      const double cost = length * unit * (1.0 + curvature_weight * unevenness);
      arcs_.push_back(
          {link.to, static_cast<Cost>(std::max<std::int64_t>(std::llround(cost), 1)), length});
    }
    // A sharp line inside is not to be crossed, at its vertices either.
    closed_.assign(vertices_.size(), false);
    if (!ground.lines.edges.empty())
      for (Node k = border_nodes_; k < vertices_.size(); ++k)
        closed_[k] = !sharp_edges_at(mesh_, ground.lines, vertices_[k]).empty();
    reached_.resize(vertices_.size());
  }

  /// Where cuts to a place of the border end: there, or where that lies in one face only, an ear
  /// without an edge inside, at the nearest places beside it that have one. None: there is none
  /// near.
  std::vector<Node> doors(std::size_t loop, std::size_t place) const {
    const std::size_t size =
        (loop + 1 < loop_start_.size() ? loop_start_[loop + 1] : border_nodes_) - loop_start_[loop];
    constexpr std::size_t most_beside = 2;
    for (std::size_t beside = 0; beside <= std::min(most_beside, size / 2); ++beside) {
      std::vector<Node> nodes;
      for (const std::size_t k : {(place + beside) % size, (place + size - beside) % size})
        if (opens(node(loop, k)) && (nodes.empty() || nodes.back() != node(loop, k)))
          nodes.push_back(node(loop, k));
      if (!nodes.empty()) return nodes;
    }
    return {};
  }

  /// Cheapest paths from nodes of the border, until `done(node of the border)`.
  template <class Done>
  void search(const std::vector<Node>& from, const Done& done) {
    const auto as_it_is = [](Node, Cost cost) { return cost; };
    run(from, as_it_is, done);
  }
  /// The cheapest path between two nodes of the border that also keeps to the straight line between
  /// them: on a lattice many paths are equally short, and most of them have a kink. Empty: none.
  std::vector<Node> straight_path(Node from, Node to) {
    const Point start = mesh_.point(vertices_[from]);
    const Point along = mesh_.point(vertices_[to]) - start;
    const double length = along.norm();
    if (!(length > 0.0)) return {};
    const auto straightened = [&](Node k, Cost cost) {
      const Point offset = mesh_.point(vertices_[k]) - start;
      const double t = std::clamp(offset.dot(along) / (length * length), 0.0, 1.0);
      const double away = (offset - t * along).norm() / length;
      return static_cast<Cost>(
          std::llround(static_cast<double>(cost) * (1.0 + away_from_straight * away)));
    };
    run(
        {from}, straightened, [&](Node k) { return k == to; }, to);
    return has_reached(to) ? path_to(to) : std::vector<Node>();
  }
  bool has_reached(Node k) const { return reached_[k].done; }
  Cost cost_to(Node k) const { return reached_[k].done ? reached_[k].cost : no_cost; }
  double length_to(Node k) const { return reached_[k].length; }  ///< mm
  std::vector<Node> path_to(Node k) const {
    std::vector<Node> path;
    for (; k != no_id; k = reached_[k].by) path.push_back(k);
    std::reverse(path.begin(), path.end());
    return path;
  }

  Node node(std::size_t loop, std::size_t place) const {
    return loop_start_[loop] + static_cast<Node>(place);
  }
  VertexId vertex(Node k) const { return vertices_[k]; }
  std::vector<VertexId> vertices(const std::vector<Node>& path) const {
    std::vector<VertexId> result;
    for (const Node k : path) result.push_back(vertices_[k]);
    return result;
  }
  double length(const std::vector<VertexId>& path) const {
    double sum = 0.0;
    for (std::size_t k = 1; k < path.size(); ++k)
      sum += (mesh_.point(path[k]) - mesh_.point(path[k - 1])).norm();
    return sum;
  }

 private:
  struct Reached {
    Cost cost = no_cost;
    double length = 0.0;
    Node by = no_id;
    bool done = false;
  };
  struct Arc {
    Node to;
    Cost cost;
    double length;
  };

  bool opens(Node k) const {
    for (std::size_t arc = starts_[k]; arc < starts_[k + 1]; ++arc)
      if (!closed_[arcs_[arc].to]) return true;
    return false;
  }

  /// `towards`: the one node that is looked for; what is certain of the way to it, the straight
  /// one, leads the search (A*).
  template <class Weigh, class Done>
  void run(const std::vector<Node>& sources, const Weigh& weigh, const Done& done,
           Node towards = no_id) {
    const double unit = cost_unit / mesh_.mean_edge_length() * (1.0 - 1e-9);
    const auto ahead = [&](Node k) {
      if (towards == no_id) return Cost{0};
      const Point way = mesh_.point(vertices_[towards]) - mesh_.point(vertices_[k]);
      return static_cast<Cost>(way.norm() * unit);
    };
    for (const Node k : touched_) reached_[k] = {};
    touched_ = sources;
    using Entry = std::pair<Cost, Node>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Node k : sources) {
      reached_[k] = {0, 0.0, no_id, false};
      queue.emplace(ahead(k), k);
    }
    for (std::size_t visited = 0; !queue.empty(); ++visited) {
      if (visited % 4096 == 0 && context_.cancelled()) return;
      const Node k = queue.top().second;
      queue.pop();
      if (reached_[k].done) continue;
      reached_[k].done = true;
      const Cost cost = reached_[k].cost;
      if (cost > 0 && k < border_nodes_) {
        if (done(k)) return;
        continue;
      }
      for (std::size_t arc = starts_[k]; arc < starts_[k + 1]; ++arc) {
        const auto& [to, more, length] = arcs_[arc];
        Reached& there = reached_[to];
        if (there.done || closed_[to]) continue;
        const Cost next = cost + weigh(to, more);
        if (next > there.cost || (next == there.cost && k >= there.by)) continue;
        if (there.cost == no_cost) touched_.push_back(to);
        there = {next, reached_[k].length + length, k, false};
        queue.emplace(next + ahead(to), to);
      }
    }
  }

  const Mesh& mesh_;
  const Context& context_;
  std::vector<VertexId> vertices_;  // of the nodes; those of the border come first
  std::vector<Node> loop_start_;
  Node border_nodes_ = 0;
  std::vector<std::size_t> starts_;
  std::vector<Arc> arcs_;
  std::vector<bool> closed_;
  std::vector<Reached> reached_;
  std::vector<Node> touched_;
};

/// Lengths along a loop.
class Arcs {
 public:
  Arcs(const Mesh& mesh, const BorderLoop& loop) : length_(loop.length) {
    double s = 0.0;
    for (const HalfEdgeId h : loop.half_edges) {
      along_.push_back(s);
      s += mesh.edge_length(Mesh::edge_of(h));
    }
  }
  /// The shorter way between two places.
  double between(std::size_t a, std::size_t b) const {
    const double apart = std::abs(along_[a] - along_[b]);
    return std::min(apart, length_ - apart);
  }
  double length() const { return length_; }
  /// `count` places evenly along the loop.
  std::vector<std::size_t> spread(std::size_t count) const {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < count; ++k) {
      const double wanted = length_ * (static_cast<double>(k) + 1e-6) / static_cast<double>(count);
      const auto next = std::upper_bound(along_.begin(), along_.end(), wanted);
      places.push_back(static_cast<std::size_t>(next - along_.begin()) - 1);
    }
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

 private:
  const double length_;
  std::vector<double> along_;
};

/// A cut that may be made, as nodes of the graph.
struct Candidate {
  Cost cost;
  std::vector<Node> path;
  std::pair<VertexId, VertexId> ends;
  bool operator<(const Candidate& other) const {
    return cost != other.cost ? cost < other.cost : path < other.path;
  }
};

using EndPairs = std::set<std::pair<VertexId, VertexId>>;

/// What a cut with these ends costs; no_cost for one that runs along the border.
Cost weighed(Cost path_cost, double length, double arc, const FourSidedOptions& options) {
  const double ratio = length / arc;
  if (!(ratio <= options.longest)) return no_cost;
  const double q = ratio * ratio;
  return static_cast<Cost>(
      std::llround(static_cast<double>(path_cost) * (1.0 + options.balance * q / (1.0 - q))));
}

/// The path of the last search to a node.
Candidate candidate(const InsideGraph& graph, Node end, Cost cost) {
  Candidate result{cost, graph.path_to(end), {}};
  result.ends = std::minmax(graph.vertex(result.path.front()), graph.vertex(result.path.back()));
  return result;
}

/// The cheapest decomposition of a disc into pieces of three or four sides by cuts between corners.
class CornerCuts {
 public:
  CornerCuts(const Mesh& mesh, InsideGraph& graph, const BorderLoop& loop,
             const FourSidedOptions& options)
      : n_(loop.corners.size()), cuts_(n_ * n_) {
    const Arcs arcs(mesh, loop);
    std::unordered_map<Node, std::size_t> corner_of;
    std::vector<std::vector<Node>> doors;
    for (std::size_t k = 0; k < n_; ++k) {
      doors.push_back(graph.doors(0, loop.corners[k]));
      for (const Node door : doors.back()) corner_of.try_emplace(door, k);
    }
    constexpr std::size_t more = 4;
    for (const std::size_t partners : {options.partners, more * options.partners, n_}) {
      for (std::size_t i = 0; i < n_; ++i) {
        std::size_t found = 0;
        graph.search(doors[i], [&](Node k) {
          const auto corner = corner_of.find(k);
          if (corner == corner_of.end()) return false;
          const std::size_t j = corner->second;
          if (i == j || are_neighbours(i, j)) return false;
          std::optional<Candidate>& cut = cuts_[std::min(i, j) * n_ + std::max(i, j)];
          if (!cut)
            cut = candidate(graph, k,
                            weighed(graph.cost_to(k), graph.length_to(k),
                                    arcs.between(loop.corners[i], loop.corners[j]), options));
          return ++found >= partners;
        });
      }
      if (partners >= n_ || solve({})) return;
    }
  }

  /// The cuts of the cheapest decomposition without the `banned` ones, the cheapest first; empty
  /// where there is none.
  std::vector<Candidate> best(const EndPairs& banned) {
    std::vector<Candidate> result;
    if (solve(banned)) collect(0, n_ - 1, result);
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  bool are_neighbours(std::size_t i, std::size_t j) const {
    const std::size_t apart = i < j ? j - i : i - j;
    return apart <= 1 || apart == n_ - 1;
  }
  std::size_t at(std::size_t i, std::size_t j) const { return i * n_ + j; }
  /// Of corner i to corner j as a side of a piece, with all beyond it.
  Cost side(std::size_t i, std::size_t j) const { return j == i + 1 ? 0 : side_[at(i, j)]; }

  /// For i < j: what it costs to part the corners i to j, on the side of a piece over (i, j).
  bool solve(const EndPairs& banned) {
    side_.assign(n_ * n_, no_cost);
    inner_.assign(n_ * n_, no_cost);
    two_.assign(n_ * n_, no_cost);
    two_by_.assign(n_ * n_, 0);
    three_by_.assign(n_ * n_, 0);  // 0: the piece is a triangle
    for (std::size_t apart = 2; apart < n_; ++apart)
      for (std::size_t i = 0; i + apart < n_; ++i) {
        const std::size_t j = i + apart;
        for (std::size_t k = i + 1; k < j; ++k) {
          const Cost cost = std::min(side(i, k) + side(k, j), no_cost);
          if (cost < two_[at(i, j)]) {
            two_[at(i, j)] = cost;
            two_by_[at(i, j)] = k;
          }
        }
        inner_[at(i, j)] = two_[at(i, j)];
        for (std::size_t k = i + 1; k + 1 < j; ++k) {
          const Cost cost = std::min(side(i, k) + two_[at(k, j)], no_cost);
          // Four sides rather than three where they cost the same.
          if (cost < inner_[at(i, j)] ||
              (cost == inner_[at(i, j)] && cost < no_cost && three_by_[at(i, j)] == 0)) {
            inner_[at(i, j)] = cost;
            three_by_[at(i, j)] = k;
          }
        }
        const std::optional<Candidate>& cut = cuts_[at(i, j)];
        if (cut && cut->cost < no_cost && !banned.contains(cut->ends))
          side_[at(i, j)] = std::min(cut->cost + inner_[at(i, j)], no_cost);
      }
    return inner_[at(0, n_ - 1)] < no_cost;
  }

  void collect(std::size_t i, std::size_t j, std::vector<Candidate>& result) const {
    const auto collect_side = [&](std::size_t a, std::size_t b) {
      if (b == a + 1) return;
      result.push_back(*cuts_[at(a, b)]);
      collect(a, b, result);
    };
    std::size_t from = i;
    if (const std::size_t k = three_by_[at(i, j)]; k != 0) {
      collect_side(i, k);
      from = k;
    }
    const std::size_t middle = two_by_[at(from, j)];
    collect_side(from, middle);
    collect_side(middle, j);
  }

  const std::size_t n_;
  std::vector<std::optional<Candidate>> cuts_;  // by (i, j), i < j
  std::vector<Cost> side_, inner_, two_;
  std::vector<std::size_t> two_by_, three_by_;
};

/// Cuts of a disc from a corner to a point of a side that does not end there, the cheapest first:
/// for what no cut between corners parts.
std::vector<Candidate> side_cuts(const Mesh& mesh, InsideGraph& graph, const BorderLoop& loop,
                                 const FourSidedOptions& options) {
  const Arcs arcs(mesh, loop);
  const std::size_t n = loop.corners.size();
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < n; ++i) {
    graph.search(graph.doors(0, loop.corners[i]), [](Node) { return false; });
    // The best end on each side.
    for (std::size_t side = 0; side < n; ++side) {
      // Pieces of that many sides, of n + 3 in all: no use where one of them has n again.
      const std::size_t sides = (side + n - i) % n + 2;
      if (sides < 4 || sides > n - 1) continue;
      Cost least = no_cost;
      Node best = no_id;
      const std::size_t size = loop.half_edges.size();
      for (std::size_t k = (loop.corners[side] + 1) % size; k != loop.corners[(side + 1) % n];
           k = (k + 1) % size) {
        const Node end = graph.node(0, k);
        if (!graph.has_reached(end) || graph.cost_to(end) == 0) continue;
        const Cost cost = weighed(graph.cost_to(end), graph.length_to(end),
                                  arcs.between(loop.corners[i], k), options);
        if (cost >= least) continue;
        least = cost;
        best = end;
      }
      if (best != no_id) result.push_back(candidate(graph, best, least));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Two paths from the outer loop to the hole.
struct HoleCuts {
  std::array<std::size_t, 2> to;  // places on the hole
  std::array<std::vector<Node>, 2> paths;
};

/// Pairs of cuts between the outer loop and the next longest one, the cheapest first.
std::vector<HoleCuts> hole_cuts(const Mesh& mesh, InsideGraph& graph, const Outline& outline,
                                const FourSidedOptions& options) {
  const std::array<Arcs, 2> arcs{Arcs(mesh, outline.loops[0]), Arcs(mesh, outline.loops[1])};
  struct End {
    std::size_t place;
    bool is_corner;
  };
  std::array<std::vector<End>, 2> ends;
  for (std::size_t loop = 0; loop < 2; ++loop) {
    const std::vector<std::size_t>& corners = outline.loops[loop].corners;
    const std::size_t step = (corners.size() + options.hole_ends - 1) / options.hole_ends;
    for (std::size_t k = 0; k < corners.size(); k += step)
      for (const Node door : graph.doors(loop, corners[k]))
        ends[loop].push_back({door - graph.node(loop, 0), true});
    // Corners may all lie on one side of the loop.
    for (const std::size_t place : arcs[loop].spread(options.hole_ends / 2))
      if (!std::binary_search(corners.begin(), corners.end(), place))
        ends[loop].push_back({place, false});
  }
  struct Way {
    std::size_t from, to;
    double cost;
  };
  std::vector<Way> ways;
  for (const End& from : ends[0]) {
    graph.search({graph.node(0, from.place)}, [](Node) { return false; });
    for (const End& to : ends[1]) {
      const Node end = graph.node(1, to.place);
      if (!graph.has_reached(end)) continue;
      // An end beside the corners makes one corner more for both pieces, to be cut off again.
      constexpr double beside_corners = 2.0;
      double cost = static_cast<double>(graph.cost_to(end));
      if (!from.is_corner && outline.loops[0].corners.size() >= 2) cost *= beside_corners;
      if (!to.is_corner && outline.loops[1].corners.size() >= 2) cost *= beside_corners;
      ways.push_back({from.place, to.place, cost});
    }
  }
  struct Pair {
    Cost cost;
    std::size_t a, b;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < ways.size(); ++a)
    for (std::size_t b = a + 1; b < ways.size(); ++b) {
      if (ways[a].from == ways[b].from || ways[a].to == ways[b].to) continue;
      const double outer = arcs[0].between(ways[a].from, ways[b].from) / arcs[0].length();
      const double inner = arcs[1].between(ways[a].to, ways[b].to) / arcs[1].length();
      // Half the loop each is even; a tenth of it costs five times as much.
      const double cost =
          (ways[a].cost + ways[b].cost) * (1.0 + options.balance * (0.25 / (outer * inner) - 1.0));
      pairs.push_back({static_cast<Cost>(std::llround(cost)), a, b});
    }
  std::sort(pairs.begin(), pairs.end());
  std::vector<HoleCuts> result;
  constexpr std::size_t most = 8, most_looked_at = 32;
  for (std::size_t k = 0; k < pairs.size() && k < most_looked_at && result.size() < most; ++k) {
    HoleCuts cuts;
    const std::array<const Way*, 2> two{&ways[pairs[k].a], &ways[pairs[k].b]};
    for (std::size_t way = 0; way < 2; ++way) {
      cuts.to[way] = two[way]->to;
      cuts.paths[way] =
          graph.straight_path(graph.node(0, two[way]->from), graph.node(1, two[way]->to));
    }
    const auto& [one, other] = cuts.paths;
    if (!one.empty() && !other.empty() && std::ranges::find_first_of(one, other) == one.end())
      result.push_back(std::move(cuts));
  }
  return result;
}

/// Cuts one partition on a copy of the partitions, and keeps what makes it better.
class Planner {
 public:
  Planner(const Mesh& mesh, const Curvatures& curvatures, const SharpLines& lines,
          const Partitions& partitions, const Partition& partition, const FourSidedOptions& options,
          const Context& context)
      : mesh_(mesh),
        curvatures_(curvatures),
        lines_(lines),
        options_(options),
        context_(context),
        now_(partitions),
        next_id_(now_.partitions.back()->id + 1) {
    faces_[partition.id] = faces_of(mesh, partitions, partition);
    outlines_[partition.id] = outline(now_, partition.id, faces_[partition.id]);
    open_.push_back(partition.id);
  }

  Result<FourSidedPlan> plan() {
    do {
      while (!open_.empty()) {
        if (context_.cancelled()) return cancelled();
        const std::uint32_t id = open_.back();
        open_.pop_back();
        if (!outlines_.at(id).is_four_sided() && !cut(id)) given_up_.insert(id);
      }
      // A cut that ends in a side of another piece gave that one a corner more.
      for (auto& [id, own] : outlines_) {
        own = outline(now_, id, faces_[id]);
        if (!own.is_four_sided() && !given_up_.contains(id)) open_.push_back(id);
      }
    } while (!open_.empty());
    if (context_.cancelled()) return cancelled();
    for (const std::uint32_t id : given_up_)
      if (const Outline& own = outlines_.at(id); !own.is_four_sided() && plan_.obstacle.empty())
        plan_.obstacle = why_not(own);
    return std::move(plan_);
  }

 private:
  /// How far from four sides: first handles and holes, then sides too many.
  using Excess = std::pair<std::size_t, std::size_t>;
  static Excess excess_of(const Outline& outline) {
    const std::size_t sides = outline.sides();
    return {outline.handles + (outline.loops.empty() ? 1 : outline.loops.size() - 1),
            sides > 4 ? sides - 4 : 0};
  }

  /// Means of partitions are of no interest here, so that any values do.
  PartitionGround ground() const { return {mesh_, curvatures_.kabs, lines_, now_}; }
  Outline outline(const Partitions& partitions, std::uint32_t id,
                  const std::vector<FaceId>& faces) const {
    return outline_of(mesh_, lines_, partitions, id, faces, options_.sides);
  }

  static std::string why_not(const Outline& outline) {
    if (outline.loops.empty()) return "it is closed: there is no border to cut from";
    if (outline.handles > 0)
      return "it goes round a handle, which no cut from border to border parts";
    return "no way through the inside leads from one corner to another without running along the "
           "border or meeting a sharp line";
  }

  /// True where at least one cut was made.
  bool cut(std::uint32_t id) {
    if (outlines_.at(id).loops.empty() || outlines_.at(id).handles > 0) return false;
    const Outline own = outlines_.at(id);
    InsideGraph graph(ground(), curvatures_, id, faces_.at(id), own, options_.curvature, context_);
    if (own.loops.size() > 1) {
      for (const HoleCuts& pair : hole_cuts(mesh_, graph, own, options_))
        if (try_cut(joined(graph, own.loops[1], pair))) return true;
      return false;
    }
    CornerCuts corners(mesh_, graph, own.loops[0], options_);
    EndPairs banned;
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
      const std::vector<Candidate> found = corners.best(banned);
      if (found.empty()) break;
      std::set<Node> used;
      bool any = false;
      for (const Candidate& way : found) {
        // Those that meet others inside are found again within the pieces.
        bool meets = false;
        if (try_paths(graph, way.path, used, meets))
          any = true;
        else if (!meets)
          banned.insert(way.ends);
      }
      if (any) return true;
    }
    constexpr std::size_t most_side_cuts = 8;
    const std::vector<Candidate> to_sides = side_cuts(mesh_, graph, own.loops[0], options_);
    for (std::size_t k = 0; k < std::min(most_side_cuts, to_sides.size()); ++k) {
      std::set<Node> used;
      bool meets = false;
      if (try_paths(graph, to_sides[k].path, used, meets)) return true;
    }
    return false;
  }

  /// Cuts straight, or else along the cheapest path. `used`: nodes inside that cuts run through
  /// already; `meets`: whether a path was left out for one of them.
  bool try_paths(InsideGraph& graph, const std::vector<Node>& cheapest, std::set<Node>& used,
                 bool& meets) {
    std::vector<std::vector<Node>> paths{graph.straight_path(cheapest.front(), cheapest.back()),
                                         cheapest};
    if (paths[0] == paths[1]) paths.pop_back();
    for (const std::vector<Node>& path : paths) {
      if (path.empty()) continue;
      const std::span inside(path.begin() + 1, path.end() - 1);
      if (std::ranges::any_of(inside, [&](Node k) { return used.contains(k); })) {
        meets = true;
      } else if (try_cut(single(graph, path))) {
        used.insert(inside.begin(), inside.end());
        return true;
      }
    }
    return false;
  }

  FourSidedCut single(const InsideGraph& graph, const std::vector<Node>& path) const {
    FourSidedCut result;
    result.path = graph.vertices(path);
    result.strokes = {result.path};
    result.length = graph.length(result.path);
    return result;
  }

  FourSidedCut joined(const InsideGraph& graph, const BorderLoop& hole,
                      const HoleCuts& pair) const {
    FourSidedCut result;
    for (const std::vector<Node>& path : pair.paths) {
      result.strokes.push_back(graph.vertices(path));
      result.length += graph.length(result.strokes.back());
    }
    result.path = result.strokes[0];
    const std::size_t size = hole.half_edges.size();
    for (std::size_t k = pair.to[0]; k != pair.to[1]; k = (k + 1) % size)
      result.path.push_back(mesh_.to(hole.half_edges[k]));
    result.path.insert(result.path.end(), result.strokes[1].rbegin() + 1, result.strokes[1].rend());
    return result;
  }

  bool try_cut(FourSidedCut cut) {
    const std::uint32_t id = partition_along(mesh_, now_, cut.path);
    const auto known = outlines_.find(id);
    if (known == outlines_.end()) return false;
    const Partition* piece = now_.find(id);
    const Result<std::vector<FaceId>> part = cut_off(ground(), *piece, cut.path);
    if (!part) return false;
    Partition fresh;
    std::uint32_t next_id = next_id_;
    fresh.id = next_id++;
    fresh.criterion = piece->criterion;
    fresh.interval = piece->interval;
    FaceLabels labels;
    for (const FaceId f : *part) labels.emplace_back(f, fresh.id);
    EditedPartitions edited = edit_partitions(ground(), labels, {fresh}, next_id);
    // Whatever was parted keeps the faces with its label.
    std::map<std::uint32_t, std::vector<FaceId>> faces;
    for (const FaceId f : faces_.at(id)) faces[edited.partitions.label(f)].push_back(f);
    std::map<std::uint32_t, Outline> pieces;
    Excess after{0, 0};
    for (const auto& [k, own] : faces) {
      pieces[k] = outline(edited.partitions, k, own);
      const Excess excess = excess_of(pieces[k]);
      after.first += excess.first;
      after.second += excess.second;
    }
    if (!(after < excess_of(known->second))) return false;
    now_ = std::move(edited.partitions);
    next_id_ = next_id;
    for (auto& [k, own] : pieces) {
      outlines_[k] = std::move(own);
      faces_[k] = std::move(faces[k]);
      if (std::ranges::find(open_, k) == open_.end()) open_.push_back(k);
    }
    plan_.cuts.push_back(std::move(cut));
    return true;
  }

  const Mesh& mesh_;
  const Curvatures& curvatures_;
  const SharpLines& lines_;
  const FourSidedOptions& options_;
  const Context& context_;
  Partitions now_;
  std::uint32_t next_id_;
  std::map<std::uint32_t, Outline> outlines_;           // of the pieces
  std::map<std::uint32_t, std::vector<FaceId>> faces_;  // of the pieces, ascending
  std::vector<std::uint32_t> open_;
  std::set<std::uint32_t> given_up_;
  FourSidedPlan plan_;
};

}  // namespace

std::uint32_t partition_along(const Mesh& mesh, const Partitions& partitions,
                              const std::vector<VertexId>& path) {
  if (path.size() < 2) return 0;
  const auto e = mesh.find_edge(path[0], path[1]);
  if (!e) return 0;
  const auto faces = mesh.edge_faces(*e);
  if (faces[0] == no_id || faces[1] == no_id) return 0;
  const std::uint32_t label = partitions.label(faces[0]);
  return label == partitions.label(faces[1]) ? label : 0;
}

Result<FourSidedPlan> four_sided_cuts(const Mesh& mesh, const Curvatures& curvatures,
                                      const SharpLines& lines, const Partitions& partitions,
                                      const Partition& partition, const FourSidedOptions& options,
                                      const Context& context) {
  return Planner(mesh, curvatures, lines, partitions, partition, options, context).plan();
}

}  // namespace arris
