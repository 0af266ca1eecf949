#include "core/mesh/build_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "core/mesh/within_memory.h"

namespace arris {

namespace {

/// Cross products this small beside the squared lengths they come from are rounding.
constexpr double rounding = 1e-12;

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
    Result<MeshPtr> mesh = Mesh::create(std::move(points_), std::move(triangles_));
    if (!mesh) return tl::unexpected(mesh.error());
    context_.report(0.95, "building the mesh");
    describe(**mesh);
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
    const std::vector<bool> repeated = find_repeated_polygons();
    for (std::uint32_t k = 0; k < polygon_count_; ++k) {
      const std::span<const VertexId> polygon = this->polygon(k);
      if (polygon.size() > 3) report_.split_polygons.push_back(k);
      if (!report_.non_finite_vertices.empty() &&
          std::any_of(polygon.begin(), polygon.end(),
                      [&](VertexId v) { return !points_[v].allFinite(); })) {
        report_.non_finite_faces.push_back(k);
        continue;
      }
      if (polygon.size() < 3) {
        report_.degenerate_faces.push_back(k);
        continue;
      }
      if (!repeated.empty() && repeated[k]) {
        report_.duplicate_faces.push_back(k);
        continue;
      }
      const std::size_t n = polygon.size(), tip = n == 3 ? 0 : fan_tip(polygon);
      for (std::size_t i = 1; i + 1 < n; ++i) {
        const Triangle t{polygon[tip], polygon[(tip + i) % n], polygon[(tip + i + 1) % n]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
          add_once(report_.degenerate_faces, k);
          continue;
        }
        triangles_.push_back(t);
        sources_.push_back(k);
      }
    }
  }

  std::span<const VertexId> polygon(std::size_t k) const {
    return {corners_.data() + starts_[k], static_cast<std::size_t>(starts_[k + 1] - starts_[k])};
  }

  /// Marks polygons of more than three corners with the vertices of an earlier one. Their triangles
  /// alone would not tell, for the two may be cut along different diagonals.
  std::vector<bool> find_repeated_polygons() const {
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
    std::vector<bool> repeated(polygon_count_, false);
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
          repeated[keys[j].second] = sorted(keys[j].second) == first;
      }
      i = end;
    }
    return repeated;
  }

  /// The corner from which a fan has no triangle that is flipped, or better none without area.
  std::size_t fan_tip(std::span<const VertexId> polygon) const {
    const std::size_t n = polygon.size();
    const auto doubled_area = [&](std::size_t a, std::size_t b, std::size_t c) -> Point {
      const Point& origin = points_[polygon[a % n]];
      return (points_[polygon[b % n]] - origin).cross(points_[polygon[c % n]] - origin);
    };
    Point normal = Point::Zero();
    for (std::size_t i = 1; i + 1 < n; ++i) normal += doubled_area(0, i, i + 1);
    const double least = rounding * normal.squaredNorm();
    std::size_t fair = n;
    // Looking at every corner of a huge polygon would take the square of its size.
    const std::size_t tries = std::min(n, 8 + (std::size_t{1} << 16) / n);
    for (std::size_t tip = 0; tip < tries; ++tip) {
      double worst = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i + 1 < n && worst >= -least; ++i)
        worst = std::min(worst, doubled_area(tip, tip + i, tip + i + 1).dot(normal));
      if (worst > least) return tip;
      if (worst >= -least && fair == n) fair = tip;
    }
    return fair == n ? 0 : fair;
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
    for (std::size_t v = 0, begin = 0; v < points_.size(); begin = cursor[v++]) {
      std::sort(keys.begin() + begin, keys.begin() + cursor[v]);
      for (std::size_t i = begin + 1; i < cursor[v]; ++i)
        if (keys[i].middle == keys[i - 1].middle && keys[i].largest == keys[i - 1].largest)
          dropped.push_back(keys[i].face);
    }
    if (dropped.empty()) return;
    std::sort(dropped.begin(), dropped.end());
    std::size_t kept = 0, next = 0;
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      if (next < dropped.size() && dropped[next] == f) {
        report_.duplicate_faces.push_back(sources_[f]);
        ++next;
        continue;
      }
      triangles_[kept] = triangles_[f];
      sources_[kept++] = sources_[f];
    }
    triangles_.resize(kept);
    sources_.resize(kept);
    sort_once(report_.duplicate_faces);
  }

  VertexId start(Side s) const { return triangles_[s / 3][s % 3]; }
  VertexId end(Side s) const { return start(next_in_face(s)); }
  EdgeVertices edge(Side s) const {
    return {std::min(start(s), end(s)), std::max(start(s), end(s))};
  }

  /// Joins the sides of each edge that has just two faces.
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
    for (std::size_t v = 0, begin = 0; v < points_.size(); begin = cursor[v++]) {
      const std::size_t end = cursor[v];
      std::sort(entries.begin() + begin, entries.begin() + end, [](const Entry& a, const Entry& b) {
        return a.far_vertex != b.far_vertex ? a.far_vertex < b.far_vertex : a.side < b.side;
      });
      for (std::size_t i = begin; i < end;) {
        std::size_t j = i + 1;
        while (j < end && entries[j].far_vertex == entries[i].far_vertex) ++j;
        if (j - i == 2) {
          mates_[entries[i].side] = entries[i + 1].side;
          mates_[entries[i + 1].side] = entries[i].side;
        } else if (j - i > 2) {
          report_.non_manifold_edges.push_back({static_cast<VertexId>(v), entries[i].far_vertex});
        }
        i = j;
      }
    }
  }

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
          mates_[s] = mates_[s] - mates_[s] % 3 + (2 - mates_[s] % 3);
    }
  }

  /// Gives every fan of faces round a vertex a vertex of its own.
  ///
  /// A fan here is what mates join: a ring, or a row with one unmated side of the vertex at either
  /// end. Hence no edge can be left with more than two faces, or with two that run the same way:
  /// its sides have no mates (those with mates are two and agree), and a row has but two ends, one
  /// leaving the vertex, one arriving. So Mesh::create() takes whatever comes out.
  void split_vertices() {
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
    mates_ = {};
    report_.non_manifold_vertices = report_.copies;
    sort_once(report_.non_manifold_vertices);
  }

  /// Fills in what is true of the mesh that came out.
  void describe(const Mesh& mesh) {
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
      const auto& [a, b, c] = mesh.triangle(f);
      const Point ab = mesh.point(b) - mesh.point(a), ac = mesh.point(c) - mesh.point(a);
      const double longest =
          std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
      if (ab.cross(ac).norm() <= rounding * longest) add_once(report_.zero_area_faces, sources_[f]);
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
        const auto& [a, b, c] = mesh.triangle(queue[at]);
        part +=
            (mesh.point(a) - centre).dot((mesh.point(b) - centre).cross(mesh.point(c) - centre)) /
            6.0;
        HalfEdgeId h = mesh.face_half_edge(queue[at]);
        for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
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
    report_.looks_inside_out = volume < -rounding * std::pow(mesh.diagonal(), 3);
  }

  std::vector<Point> points_;
  const std::vector<std::uint64_t>& starts_;
  const std::vector<VertexId>& corners_;
  std::size_t polygon_count_;
  LoadReport& report_;
  const Context& context_;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> sources_;  // polygon of each triangle
  std::vector<Side> mates_;             // the side across, no_id where there is none
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
  fresh.file_vertices = points.size();
  fresh.file_faces = starts.empty() ? 0 : starts.size() - 1;
  report = std::move(fresh);
  return within_memory(report.file.empty() ? "The mesh" : report.file, [&] {
    return Builder(std::move(points), starts, corners, report, context).build();
  });
}

}  // namespace arris
