#include "core/mesh/build_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "core/mesh/cut_polygon.h"
#include "core/mesh/geometry.h"
#include "core/mesh/within_memory.h"

namespace arris {

namespace {

/// Angles in radians that differ by less are one.
constexpr double nearly_equal = 1e-9;

/// Side 3 f + k runs from corner k of face f to the next; corner 3 f + k has the same number.
using Side = std::uint32_t;

Side next_in_face(Side s) { return s % 3 == 2 ? s - 2 : s + 1; }
Side previous_in_face(Side s) { return s % 3 == 0 ? s + 2 : s - 1; }

void add_once(std::vector<std::uint32_t>& list, std::uint32_t value) {
  if (list.empty() || list.back() != value) list.push_back(value);
}

void sort_once(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

class Builder {
 public:
  Builder(std::vector<Point> points, const std::vector<std::uint64_t>& starts,
          const std::vector<VertexId>& corners, LoadReport& report, const Context& context)
      : points_(std::move(points)),
        starts_(starts),
        corners_(corners),
        polygon_count_(starts.empty() ? 0 : starts.size() - 1),
        report_(report),
        context_(context) {}

  Result<BuiltMesh> build() {
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (points_.size() >= most || corners_.size() >= most / 6)
      return fail(name() + " has more elements than 32-bit ids can number.");
    using Step = void (Builder::*)();
    constexpr std::pair<Step, double> steps[] = {
        {&Builder::find_non_finite, 0.02}, {&Builder::cut_into_triangles, 0.1},
        {&Builder::drop_duplicates, 0.2},  {&Builder::find_mates, 0.4},
        {&Builder::orient, 0.5},           {&Builder::split_vertices, 0.6},
    };
    for (const auto& [step, fraction] : steps) {
      (this->*step)();
      if (context_.cancelled()) return cancelled();
      if (triangles_.empty() && step != &Builder::find_non_finite) return fail_empty();
      context_.report(fraction, "building the mesh");
    }
    mates_ = {};
    Result<MeshPtr> mesh = Mesh::create(std::move(points_), std::move(triangles_));
    if (!mesh) return tl::unexpected(mesh.error());
    context_.report(0.95, "building the mesh");
    if (!describe(**mesh)) return cancelled();
    context_.report(1.0, "building the mesh");
    return BuiltMesh{std::move(*mesh), std::move(sources_)};
  }

 private:
  std::string name() const { return report_.file.empty() ? "The mesh" : report_.file; }

  tl::unexpected<Error> fail_empty() const {
    return fail(name() + " has no face that can be used: of " + std::to_string(polygon_count_) +
                ", " + std::to_string(report_.non_finite_faces.size()) +
                " have coordinates that are not finite and " +
                std::to_string(report_.degenerate_faces.size()) +
                " a repeated vertex or fewer than three corners.");
  }

  void find_non_finite() {
    for (VertexId v = 0; v < points_.size(); ++v)
      if (!points_[v].allFinite()) report_.non_finite_vertices.push_back(v);
  }

  void cut_into_triangles() {
    triangles_.reserve(polygon_count_);
    sources_.reserve(polygon_count_);
    const std::vector<std::uint32_t> first_like = find_repeated_polygons();
    std::vector<VertexId> corners;
    for (std::uint32_t k = 0; k < polygon_count_; ++k) {
      const std::span<const VertexId> polygon = this->polygon(k);
      if (!report_.non_finite_vertices.empty() &&
          std::any_of(polygon.begin(), polygon.end(),
                      [&](VertexId v) { return !points_[v].allFinite(); })) {
        if (polygon.size() > 3) report_.split_polygons.push_back(k);
        report_.non_finite_faces.push_back(k);
        continue;
      }
      // A corner named again beside itself, or the first again at the end, is one corner.
      corners.clear();
      for (const VertexId v : polygon)
        if (corners.empty() || corners.back() != v) corners.push_back(v);
      while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
      if (corners.size() > 3) report_.split_polygons.push_back(k);
      if (corners.size() < 3) {
        report_.degenerate_faces.push_back(k);
        continue;
      }
      if (corners.size() < polygon.size()) report_.repeated_corners.push_back(k);
      if (!first_like.empty() && first_like[k] != no_id) {
        // The back of another may be the side of a body that touches there: see find_needless().
        if (is_reverse_of(k, first_like[k]))
          add_turned(k, first_like[k]);
        else
          report_.duplicate_faces.push_back(k);
        continue;
      }
      const std::size_t before = triangles_.size();
      if (corners.size() == 3)
        triangles_.push_back({corners[0], corners[1], corners[2]});
      else if (cut_polygon(points_, corners, triangles_) == PolygonCut::crossed)
        report_.crossed_polygons.push_back(k);
      if (triangles_.size() == before) report_.degenerate_faces.push_back(k);
      sources_.resize(triangles_.size(), k);
    }
  }

  std::span<const VertexId> polygon(std::size_t k) const {
    return {corners_.data() + starts_[k], static_cast<std::size_t>(starts_[k + 1] - starts_[k])};
  }

  /// Of each polygon of more than three corners that has the vertices of an earlier one, the first
  /// such; no_id of all others. Their triangles alone would not tell, for the two may be cut along
  /// different diagonals. Empty where there are no large polygons.
  std::vector<std::uint32_t> find_repeated_polygons() const {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    for (std::uint32_t k = 0; k < polygon_count_; ++k) {
      if (polygon(k).size() <= 3) continue;
      std::uint64_t sum = polygon(k).size();  // the same in whatever order
      for (const VertexId v : polygon(k)) {
        std::uint64_t h = (v + 1) * 0x9E3779B97F4A7C15u;
        h = (h ^ (h >> 32)) * 0xD6E8FEB86659FD93u;
        sum += h ^ (h >> 29);
      }
      keys.emplace_back(sum, k);
    }
    if (keys.empty()) return {};
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> first_like(polygon_count_, no_id);
    const auto sorted = [&](std::uint32_t k) {
      std::vector<VertexId> vertices(polygon(k).begin(), polygon(k).end());
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    };
    for (std::size_t i = 0; i < keys.size();) {
      std::size_t end = i + 1;
      while (end < keys.size() && keys[end].first == keys[i].first) ++end;
      if (end - i > 1) {
        const std::vector<VertexId> first = sorted(keys[i].second);
        for (std::size_t j = i + 1; j < end; ++j)
          if (sorted(keys[j].second) == first) first_like[keys[j].second] = keys[i].second;
      }
      i = end;
    }
    return first_like;
  }

  /// Whether polygon k names the vertices of another in the opposite order.
  bool is_reverse_of(std::uint32_t k, std::uint32_t other) const {
    const std::span<const VertexId> a = polygon(other), b = polygon(k);
    const std::size_t n = a.size();
    const auto at = std::find(b.begin(), b.end(), a[0]);
    const std::size_t shift = static_cast<std::size_t>(at - b.begin());
    for (std::size_t i = 0; i < n; ++i)
      if (a[i] != b[(shift + n - i) % n]) return false;
    return true;
  }

  /// The triangles of an earlier polygon once more, turned over: the same cut seen from behind.
  void add_turned(std::uint32_t k, std::uint32_t other) {
    const auto [begin, end] = std::equal_range(sources_.begin(), sources_.end(), other);
    const auto first = begin - sources_.begin(), last = end - sources_.begin();
    for (auto i = first; i < last; ++i) {
      const auto [a, b, c] = triangles_[static_cast<std::size_t>(i)];
      triangles_.push_back({a, c, b});
    }
    sources_.resize(triangles_.size(), k);
  }

  void drop_duplicates() {
    struct Key {
      VertexId middle, largest;
      std::uint32_t face;
      bool operator<(const Key& other) const {
        if (middle != other.middle) return middle < other.middle;
        return largest != other.largest ? largest < other.largest : face < other.face;
      }
    };
    std::vector<std::uint32_t> cursor(points_.size() + 1, 0);
    for (const Triangle& t : triangles_) ++cursor[std::min({t[0], t[1], t[2]}) + 1];
    std::partial_sum(cursor.begin(), cursor.end(), cursor.begin());
    std::vector<Key> keys(triangles_.size());
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      Triangle t = triangles_[f];
      std::sort(t.begin(), t.end());
      keys[cursor[t[0]]++] = {t[1], t[2], f};
    }
    // Each cursor now stands where the keys of the next vertex begin.
    std::vector<std::uint32_t> dropped;
    std::vector<Wall> walls;
    for (std::size_t v = 0, begin = 0; v < points_.size(); begin = cursor[v++]) {
      std::sort(keys.begin() + begin, keys.begin() + cursor[v]);
      for (std::size_t i = begin, j = i; i < cursor[v]; i = j) {
        for (j = i + 1; j < cursor[v] && keys[j].middle == keys[i].middle &&
                        keys[j].largest == keys[i].largest;)
          ++j;
        if (j - i == 2 && are_opposite(triangles_[keys[i].face], triangles_[keys[i + 1].face]))
          walls.push_back({keys[i].face, keys[i + 1].face});
        else
          for (std::size_t k = i + 1; k < j; ++k) dropped.push_back(keys[k].face);
      }
    }
    drop(dropped);
    for (Wall& wall : walls)
      for (std::uint32_t& f : wall)
        f -= static_cast<std::uint32_t>(std::lower_bound(dropped.begin(), dropped.end(), f) -
                                        dropped.begin());
    if (!walls.empty()) {
      std::vector<std::uint32_t> needless = find_needless(walls);
      drop(needless);
    }
    sort_once(report_.duplicate_faces);
  }

  /// Two faces on the same vertices that look in opposite directions.
  using Wall = std::array<std::uint32_t, 2>;

  static bool are_opposite(const Triangle& a, Triangle b) {
    while (b[0] != a[0]) std::rotate(b.begin(), b.begin() + 1, b.end());
    return a[1] == b[2];
  }

  /// Takes faces out and tells of them; sorts the list.
  void drop(std::vector<std::uint32_t>& faces) {
    if (faces.empty()) return;
    std::sort(faces.begin(), faces.end());
    std::size_t kept = 0, next = 0;
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      if (next < faces.size() && faces[next] == f) {
        report_.duplicate_faces.push_back(sources_[f]);
        ++next;
        continue;
      }
      triangles_[kept] = triangles_[f];
      sources_[kept++] = sources_[f];
    }
    triangles_.resize(kept);
    sources_.resize(kept);
  }

  /// The second faces of the walls, but for those between two closed bodies that touch there and
  /// have other faces besides: two blocks one on the other. The two sides of a sheet are not such.
  std::vector<std::uint32_t> find_needless(const std::vector<Wall>& walls) {
    find_mates();
    const std::vector<std::uint32_t> bodies = find_bodies();
    std::vector<bool> open(triangles_.size(), false), is_wall(triangles_.size(), false),
        has_others(triangles_.size(), false);
    for (const Wall& wall : walls) is_wall[wall[0]] = is_wall[wall[1]] = true;
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      for (Side s = 3 * f; s < 3 * f + 3; ++s)
        if (mates_[s] == no_id) open[bodies[f]] = true;
      if (!is_wall[f]) has_others[bodies[f]] = true;
    }
    std::vector<std::uint32_t> needless;
    for (const auto& [f, g] : walls) {
      const std::uint32_t a = bodies[f], b = bodies[g];
      if (a == b || open[a] || open[b] || !has_others[a] || !has_others[b]) needless.push_back(g);
    }
    mates_.clear();
    paired_.clear();
    report_.non_manifold_edges.clear();
    report_.paired_edges.clear();
    return needless;
  }

  VertexId start(Side s) const { return triangles_[s / 3][s % 3]; }
  VertexId end(Side s) const { return start(next_in_face(s)); }
  EdgeVertices edge(Side s) const {
    return {std::min(start(s), end(s)), std::max(start(s), end(s))};
  }

  /// Joins the sides of each edge that has just two faces, and then those of edges with more where
  /// they can be told to belong to different bodies.
  void find_mates() {
    struct Entry {
      VertexId far_vertex;
      Side side;
    };
    const Side side_count = static_cast<Side>(3 * triangles_.size());
    mates_.assign(side_count, no_id);
    std::vector<std::uint32_t> cursor(points_.size() + 1, 0);
    for (Side s = 0; s < side_count; ++s) ++cursor[edge(s)[0] + 1];
    std::partial_sum(cursor.begin(), cursor.end(), cursor.begin());
    std::vector<Entry> entries(side_count);
    for (Side s = 0; s < side_count; ++s) {
      const EdgeVertices e = edge(s);
      entries[cursor[e[0]]++] = {e[1], s};
    }
    std::vector<std::vector<Side>> crowded;  // the sides of each edge with more than two
    for (std::size_t v = 0, begin = 0; v < points_.size(); begin = cursor[v++]) {
      const std::size_t end = cursor[v];
      std::sort(entries.begin() + begin, entries.begin() + end, [](const Entry& a, const Entry& b) {
        return a.far_vertex != b.far_vertex ? a.far_vertex < b.far_vertex : a.side < b.side;
      });
      for (std::size_t i = begin; i < end;) {
        std::size_t j = i + 1;
        while (j < end && entries[j].far_vertex == entries[i].far_vertex) ++j;
        if (j - i == 2) {
          join(entries[i].side, entries[i + 1].side);
        } else if (j - i > 2) {
          report_.non_manifold_edges.push_back({static_cast<VertexId>(v), entries[i].far_vertex});
          crowded.emplace_back();
          for (std::size_t k = i; k < j; ++k) crowded.back().push_back(entries[k].side);
        }
        i = j;
      }
    }
    if (!crowded.empty()) part_bodies(crowded);
  }

  void join(Side a, Side b) {
    mates_[a] = b;
    mates_[b] = a;
  }

  /// Joins the sides of edges with more than two faces in pairs where each pair encloses a wedge of
  /// its own: two blocks that touch along an edge stay two closed blocks.
  void part_bodies(const std::vector<std::vector<Side>>& crowded) {
    const std::vector<std::uint32_t> bodies = find_bodies();
    for (std::size_t k = 0; k < crowded.size(); ++k) {
      const std::vector<Side> ring = in_turn(crowded[k]);
      if (ring.empty()) continue;
      if (!pair_by_body(ring, bodies) && !pair_by_wedge(ring)) continue;
      report_.paired_edges.push_back(report_.non_manifold_edges[k]);
      paired_.push_back(ring);
    }
  }

  /// Of each face, the first face that edges with two faces connect it with.
  std::vector<std::uint32_t> find_bodies() const {
    std::vector<std::uint32_t> body(triangles_.size(), no_id), queue;
    for (std::uint32_t seed = 0; seed < body.size(); ++seed) {
      if (body[seed] != no_id) continue;
      body[seed] = seed;
      queue.assign(1, seed);
      for (std::size_t at = 0; at < queue.size(); ++at)
        for (Side s = 3 * queue[at]; s < 3 * queue[at] + 3; ++s)
          if (mates_[s] != no_id && body[mates_[s] / 3] == no_id) {
            body[mates_[s] / 3] = seed;
            queue.push_back(mates_[s] / 3);
          }
    }
    return body;
  }

  bool runs_forward(Side s) const { return start(s) < end(s); }

  /// The sides of one edge in the order in which their faces stand round it, counter-clockwise seen
  /// against its direction from the smaller vertex to the larger. Of faces that coincide those come
  /// first that run forward: they end a wedge. Empty for an odd number, too many, or a face whose
  /// direction rounding hides.
  std::vector<Side> in_turn(const std::vector<Side>& sides) const {
    constexpr std::size_t most = 32;  // that touch along one edge
    if (sides.size() % 2 != 0 || sides.size() > most) return {};
    const Point origin = points_[edge(sides[0])[0]];
    const Point along = (points_[edge(sides[0])[1]] - origin).normalized();
    struct Face {
      double angle;
      Side side;
    };
    std::vector<Face> faces;
    Point x = Point::Zero();
    for (const Side s : sides) {
      const Point to_tip = points_[start(previous_in_face(s))] - origin;
      const Point away = to_tip - to_tip.dot(along) * along;
      // Also false where a length is not finite or 0.
      if (!(away.norm() > 1e-9 * to_tip.norm())) return {};
      if (faces.empty()) x = away.normalized();
      const Point y = along.cross(x);
      double angle = std::atan2(away.dot(y), away.dot(x));
      if (angle < -nearly_equal) angle += 2.0 * std::numbers::pi;
      faces.push_back({angle, s});
    }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
      return a.angle != b.angle ? a.angle < b.angle : a.side < b.side;
    });
    for (std::size_t i = 0; i < faces.size();) {
      std::size_t j = i + 1;
      while (j < faces.size() && faces[j].angle - faces[i].angle <= nearly_equal) ++j;
      std::stable_sort(faces.begin() + i, faces.begin() + j, [&](const Face& a, const Face& b) {
        return runs_forward(a.side) > runs_forward(b.side);
      });
      i = j;
    }
    std::vector<Side> ring;
    for (const Face& face : faces) ring.push_back(face.side);
    return ring;
  }

  /// Where each body has two faces at the edge, one beside the other. Also right for bodies that
  /// are inside out.
  bool pair_by_body(const std::vector<Side>& ring, const std::vector<std::uint32_t>& bodies) {
    const std::size_t n = ring.size();
    const auto body = [&](std::size_t i) { return bodies[ring[i % n] / 3]; };
    const std::size_t first = body(0) == body(1) ? 0 : 1;
    for (std::size_t i = first; i < n + first; i += 2)
      if (body(i) != body(i + 1) || (n > 2 && body(i) == body(i + 2))) return false;
    for (std::size_t i = first; i < n + first; i += 2) join(ring[i % n], ring[(i + 1) % n]);
    return true;
  }

  /// Where faces look away from the wedge behind them and from each other in turn: behind a face
  /// that runs backward the body begins, and it ends at the next that runs forward.
  bool pair_by_wedge(const std::vector<Side>& ring) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i)
      if (runs_forward(ring[i]) == runs_forward(ring[(i + 1) % n])) return false;
    for (std::size_t i = runs_forward(ring[0]) ? 1 : 0; i < n; i += 2)
      join(ring[i], ring[(i + 1) % n]);
    return true;
  }

  static Side turned_side(Side s) { return s - s % 3 + (2 - s % 3); }

  /// Turns the minority of each component; where that cannot agree, the mates are parted.
  void orient() {
    enum : char { unseen, as_is, turned };
    std::vector<char> state(triangles_.size(), unseen);
    std::vector<std::uint32_t> queue;
    queue.reserve(triangles_.size());
    bool any_turned = false;
    for (std::uint32_t seed = 0; seed < triangles_.size(); ++seed) {
      if (state[seed] != unseen) continue;
      const std::size_t first = queue.size();
      state[seed] = as_is;
      queue.push_back(seed);
      std::size_t turned_count = 0;
      for (std::size_t at = first; at < queue.size(); ++at) {
        const std::uint32_t f = queue[at];
        turned_count += state[f] == turned;
        for (Side s = 3 * f; s < 3 * f + 3; ++s) {
          const Side mate = mates_[s];
          if (mate == no_id) continue;
          const bool agree = start(s) != start(mate);
          const char wanted = agree == (state[f] == as_is) ? as_is : turned;
          char& found = state[mate / 3];
          if (found == unseen) {
            found = wanted;
            queue.push_back(mate / 3);
          } else if (found != wanted) {
            report_.unorientable_edges.push_back(edge(s));
            mates_[s] = mates_[mate] = no_id;
          }
        }
      }
      if (2 * turned_count > queue.size() - first)
        for (std::size_t at = first; at < queue.size(); ++at)
          state[queue[at]] = state[queue[at]] == turned ? as_is : turned;
      else if (turned_count == 0)
        continue;
      any_turned = true;
    }
    std::sort(report_.unorientable_edges.begin(), report_.unorientable_edges.end());
    if (!any_turned) return;

    // Turning (a, b, c) into (a, c, b) makes side k side 2 - k.
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      if (state[f] == turned) {
        std::swap(triangles_[f][1], triangles_[f][2]);
        std::swap(mates_[3 * f], mates_[3 * f + 2]);
        add_once(report_.turned_faces, sources_[f]);
      }
      for (Side s = 3 * f; s < 3 * f + 3; ++s)
        if (mates_[s] != no_id && state[mates_[s] / 3] == turned)
          mates_[s] = turned_side(mates_[s]);
    }
    for (std::vector<Side>& sides : paired_)
      for (Side& s : sides)
        if (state[s / 3] == turned) s = turned_side(s);
  }

  /// Gives every fan of faces round a vertex a vertex of its own.
  ///
  /// A fan here is what mates join: a ring, or a row with one unmated side of the vertex at either
  /// end. Hence no edge that was not paired can be left with more than two faces, or with two that
  /// run the same way: its sides have no mates (those with mates are two and agree), and a row has
  /// but two ends, one leaving the vertex, one arriving. A body that touches itself along a single
  /// edge may hold both pairs of it in one fan at either end; such edges are paired otherwise or
  /// cut open after all. So Mesh::create() takes whatever comes out.
  void split_vertices() {
    if (paired_.empty()) return split_fans();
    const std::vector<Triangle> triangles = triangles_;
    const std::size_t vertex_count = points_.size();
    // First such edges are paired the other way, where that parts them; what is cut open makes
    // finer fans, so that no pair that was apart comes together.
    for (const bool other_way : {true, false}) {
      split_fans();
      std::vector<std::size_t> wrong;
      for (std::size_t k = 0; k < paired_.size(); ++k)
        if (shares_vertices(paired_[k])) wrong.push_back(k);
      if (wrong.empty()) return;
      triangles_ = triangles;
      points_.resize(vertex_count);
      report_.copies.clear();
      for (std::size_t i = wrong.size(); i-- > 0;)
        if (!other_way || !pair_other_way(paired_[wrong[i]])) cut_open(wrong[i]);
    }
    split_fans();
  }

  /// Whether two sides of an edge that was paired run from one vertex to another.
  bool shares_vertices(const std::vector<Side>& sides) const {
    std::vector<std::array<VertexId, 2>> runs;
    for (const Side s : sides) runs.push_back({start(s), end(s)});
    std::sort(runs.begin(), runs.end());
    return std::adjacent_find(runs.begin(), runs.end()) != runs.end();
  }

  /// `ring` is in_turn(); each side gets its neighbour on the other side for a mate, if they agree.
  bool pair_other_way(const std::vector<Side>& ring) {
    const std::size_t n = ring.size(), first = mates_[ring[0]] == ring[1] ? 1 : 0;
    for (std::size_t i = 0; i < n; ++i)
      if (mates_[ring[i]] == no_id || start(ring[i]) != end(ring[(i + 1) % n])) return false;
    for (std::size_t i = first; i < n + first; i += 2) join(ring[i % n], ring[(i + 1) % n]);
    return true;
  }

  void cut_open(std::size_t pair) {
    for (const Side s : paired_[pair]) {
      if (mates_[s] != no_id) mates_[mates_[s]] = no_id;
      mates_[s] = no_id;
    }
    report_.paired_edges.erase(report_.paired_edges.begin() + static_cast<std::ptrdiff_t>(pair));
    paired_.erase(paired_.begin() + static_cast<std::ptrdiff_t>(pair));
  }

  void split_fans() {
    const std::size_t vertex_count = points_.size();
    std::vector<bool> done(3 * triangles_.size(), false), taken(vertex_count, false);
    for (Side first = 0; first < done.size(); ++first) {
      if (done[first]) continue;
      const VertexId old_id = start(first);
      VertexId id = old_id;
      if (taken[old_id]) {
        id = static_cast<VertexId>(points_.size());
        points_.push_back(Point(points_[old_id]));
        report_.copies.push_back(old_id);
      }
      taken[old_id] = true;
      const auto take = [&](Side corner) {
        done[corner] = true;
        triangles_[corner / 3][corner % 3] = id;
      };
      take(first);
      for (Side s = first; mates_[s] != no_id;) {
        s = next_in_face(mates_[s]);
        if (done[s]) break;
        take(s);
      }
      for (Side s = mates_[previous_in_face(first)]; s != no_id && !done[s];
           s = mates_[previous_in_face(s)])
        take(s);
    }
    report_.non_manifold_vertices = report_.copies;
    sort_once(report_.non_manifold_vertices);
  }

  /// Now and then: tells how far it is, and whether it goes on.
  bool goes_on(std::size_t done, std::size_t of, double from, double to) const {
    constexpr std::size_t pause = std::size_t{1} << 15;
    if (done % pause != 0) return true;
    context_.report(from + (to - from) * static_cast<double>(done) / static_cast<double>(of),
                    "building the mesh");
    return !context_.cancelled();
  }

  /// Fills in what is true of the mesh that came out. False: cancelled.
  bool describe(const Mesh& mesh) {
    report_.vertices = mesh.vertex_count();
    report_.faces = mesh.face_count();
    report_.edges = mesh.edge_count();
    report_.border_edges = mesh.border_edge_count();
    for (VertexId v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.is_isolated(v)) report_.isolated_vertices.push_back(v);
    report_.euler_number =
        static_cast<std::int64_t>(mesh.vertex_count() - report_.isolated_vertices.size()) -
        static_cast<std::int64_t>(mesh.edge_count()) + static_cast<std::int64_t>(mesh.face_count());

    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      if (!goes_on(f, mesh.face_count(), 0.95, 0.97)) return false;
      const auto& [a, b, c] = mesh.triangle(f);
      const Point ab = mesh.point(b) - mesh.point(a), ac = mesh.point(c) - mesh.point(a);
      const double longest =
          std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
      if (ab.cross(ac).norm() <= cross_rounding * longest)
        add_once(report_.zero_area_faces, sources_[f]);
    }

    std::vector<bool> seen(2 * mesh.edge_count(), false);
    for (HalfEdgeId h = 0; h < seen.size(); ++h) {
      if (seen[h] || mesh.face(h) != no_id) continue;
      ++report_.border_loops;
      for (HalfEdgeId at = h; !seen[at]; at = mesh.next(at)) seen[at] = true;
    }

    const Point centre = 0.5 * (mesh.box_min() + mesh.box_max());
    std::vector<bool> reached(mesh.face_count(), false);
    std::vector<FaceId> queue;
    queue.reserve(mesh.face_count());
    double volume = 0.0;
    for (FaceId seed = 0; seed < mesh.face_count(); ++seed) {
      if (reached[seed]) continue;
      ++report_.components;
      double part = 0.0;
      bool closed = true;
      reached[seed] = true;
      queue.assign(1, seed);
      for (std::size_t at = 0; at < queue.size(); ++at) {
        if (!goes_on(at + 1, mesh.face_count(), 0.97, 1.0)) return false;
        const auto& [a, b, c] = mesh.triangle(queue[at]);
        part +=
            (mesh.point(a) - centre).dot((mesh.point(b) - centre).cross(mesh.point(c) - centre)) /
            6.0;
        for (const HalfEdgeId h : mesh.sides(queue[at])) {
          const FaceId neighbour = mesh.face(Mesh::opposite(h));
          if (neighbour == no_id) {
            closed = false;
          } else if (!reached[neighbour]) {
            reached[neighbour] = true;
            queue.push_back(neighbour);
          }
        }
      }
      if (closed) volume += part;
    }
    report_.looks_inside_out = volume < -cross_rounding * std::pow(mesh.diagonal(), 3);
    return true;
  }

  std::vector<Point> points_;
  const std::vector<std::uint64_t>& starts_;
  const std::vector<VertexId>& corners_;
  std::size_t polygon_count_;
  LoadReport& report_;
  const Context& context_;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> sources_;     // polygon of each triangle
  std::vector<Side> mates_;                // the side across, no_id where there is none
  std::vector<std::vector<Side>> paired_;  // the sides of each of report_.paired_edges
};

}  // namespace

Result<BuiltMesh> build_mesh(std::vector<Point> points, const std::vector<std::uint64_t>& starts,
                             const std::vector<VertexId>& corners, LoadReport& report,
                             const Context& context) {
  LoadReport fresh;
  fresh.file = report.file;
  fresh.format = report.format;
  fresh.content_hash = report.content_hash;
  fresh.file_bytes = report.file_bytes;
  fresh.welded_corners = report.welded_corners;
  fresh.unit = report.unit;
  fresh.notes = report.notes;
  fresh.file_vertices = points.size();
  fresh.file_faces = starts.empty() ? 0 : starts.size() - 1;
  report = std::move(fresh);
  return within_memory(report.file.empty() ? "The mesh" : report.file, [&] {
    return Builder(std::move(points), starts, corners, report, context).build();
  });
}

}  // namespace arris
