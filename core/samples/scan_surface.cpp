#include "core/samples/scan_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace arris {

namespace {

using Eigen::Vector2d;

/// Twice the area of a, b, c; positive when they turn to the left.
double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool in_circle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
  const Vector2d u = a - p, v = b - p, w = c - p;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), ww = w.squaredNorm();
  const double determinant = u.x() * (v.y() * ww - vv * w.y()) - u.y() * (v.x() * ww - vv * w.x()) +
                             uu * (v.x() * w.y() - v.y() * w.x());
  return determinant > 1e-12 * (uu + vv + ww) * (uu + vv + ww);
}

/// Cells of one size over a box.
class Cells {
 public:
  Cells(const Vector2d& low, const Vector2d& high, double size)
      : low_(low),
        size_(size),
        columns_(static_cast<int>((high.x() - low.x()) / size) + 1),
        rows_(static_cast<int>((high.y() - low.y()) / size) + 1) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t count() const { return static_cast<std::size_t>(columns_) * rows_; }
  double size() const { return size_; }
  int column(const Vector2d& p) const { return place(p.x() - low_.x(), columns_); }
  int row(const Vector2d& p) const { return place(p.y() - low_.y(), rows_); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * columns_ + column;
  }
  std::size_t index(const Vector2d& p) const { return index(column(p), row(p)); }
  Vector2d corner(int column, int row) const { return low_ + size_ * Vector2d(column, row); }

 private:
  int place(double offset, int count) const {
    return std::clamp(static_cast<int>(offset / size_), 0, count - 1);
  }

  Vector2d low_;
  double size_;
  int columns_, rows_;
};

/// Poisson-disc sampling by dart throwing, the distance measured in space. Steep cells get as many
/// more darts as they hold more surface.
std::vector<Point> throw_darts(const HeightField& field, double spacing, Random& random) {
  constexpr int rounds = 30;  // leaves gaps that take another point at under 1 % of the vertices
  const Cells cells(field.low, field.high, spacing);
  const auto lift = [&](const Vector2d& p) { return Point(p.x(), p.y(), field.height(p)); };
  std::vector<double> darts(cells.count());
  for (int row = 0; row < cells.rows(); ++row)
    for (int column = 0; column < cells.columns(); ++column) {
      constexpr int probes = 4;
      double stretch = 1.0;
      for (int j = 0; j <= probes; ++j)
        for (int i = 0; i < probes; ++i) {
          const double step = spacing / probes;
          const Vector2d along = cells.corner(column, row) + step * Vector2d(i, j);
          const Vector2d across = cells.corner(column, row) + step * Vector2d(j, i);
          for (const auto& [from, to] : {std::pair(along, Vector2d(along + Vector2d(step, 0.0))),
                                         std::pair(across, Vector2d(across + Vector2d(0.0, step)))})
            stretch = std::max(stretch, (lift(to) - lift(from)).norm() / step);
        }
      darts[cells.index(column, row)] = stretch;
    }

  std::vector<Point> points;
  std::vector<std::vector<VertexId>> held(cells.count());
  const auto fits = [&](const Point& p, int column, int row) {
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, cells.rows() - 1); ++j)
      for (int i = std::max(column - 1, 0); i <= std::min(column + 1, cells.columns() - 1); ++i)
        for (const VertexId v : held[cells.index(i, j)])
          if ((points[v] - p).squaredNorm() < spacing * spacing) return false;
    return true;
  };
  for (int round = 0; round < rounds; ++round)
    for (int row = 0; row < cells.rows(); ++row)
      for (int column = 0; column < cells.columns(); ++column) {
        const std::size_t cell = cells.index(column, row);
        for (int n = static_cast<int>(darts[cell] + random.uniform()); n > 0; --n) {
          const double x = random.uniform(), y = random.uniform();
          const Point p = lift(cells.corner(column, row) + spacing * Vector2d(x, y));
          if (!fits(p, column, row)) continue;
          held[cell].push_back(static_cast<VertexId>(points.size()));
          points.push_back(p);
        }
      }
  return points;
}

/// A triangulation of the plane under insertion and swaps, inside one large triangle whose corners
/// are the vertices after the given ones.
class Triangulation {
 public:
  Triangulation(const std::vector<Point>& points, const Cells& cells)
      : space_(points), cells_(cells), hints_(cells.count(), none) {
    plane_.reserve(points.size() + 3);
    for (const Point& p : points) plane_.push_back(p.head<2>());
    const Vector2d centre =
        cells.corner(0, 0) + cells.size() / 2.0 * Vector2d(cells.columns(), cells.rows());
    const double reach = 20.0 * cells.size() * std::max(cells.columns(), cells.rows());
    for (const Vector2d& direction : {Vector2d(-1, -1), Vector2d(1, -1), Vector2d(0, 1)})
      plane_.push_back(centre + reach * direction);
    const auto n = static_cast<VertexId>(points.size());
    faces_.push_back({{n, n + 1, n + 2}, {none, none, none}});
    for (VertexId v = 0; v < n; ++v) insert(v);
  }

  struct Face {
    Triangle corners;
    std::array<FaceId, 3> beyond;  ///< The face across the side opposite to each corner.
  };
  static constexpr FaceId none = no_id;

  const std::vector<Face>& faces() const { return faces_; }
  bool is_real(FaceId f) const {
    return std::ranges::all_of(faces_[f].corners, [&](VertexId v) { return v < space_.size(); });
  }

  /// Swaps sides while that makes the largest of the six angles in space smaller. Ends: each swap
  /// lowers the descending list of all angles.
  void equalise_angles() {
    swap_while([&](const Quad& q) {
      return std::max(largest_angle(q.a, q.b, q.d), largest_angle(q.a, q.d, q.c)) <
             std::max(largest_angle(q.a, q.b, q.c), largest_angle(q.d, q.c, q.b)) - 1e-9;
    });
  }

  /// Swaps sides while that brings them clearly nearer to the surface, by more than `least`, which
  /// fills notches in sharp edges. Ends: each swap lowers the sum of the distances of all sides.
  void approach(const HeightField& field, double least) {
    constexpr double widest = 2.9;  // radians
    const auto off = [&](VertexId v, VertexId w) {
      const Point middle = (space_[v] + space_[w]) / 2.0;
      const auto height = [&](double x, double y) {
        return field.height(middle.head<2>() + Vector2d(x, y));
      };
      constexpr double h = 0.01;  // mm
      const double slope_x = (height(h, 0) - height(-h, 0)) / (2.0 * h);
      const double slope_y = (height(0, h) - height(0, -h)) / (2.0 * h);
      return std::abs(height(0, 0) - middle.z()) / Point(slope_x, slope_y, 1.0).norm();
    };
    swap_while([&](const Quad& q) {
      const double now = off(q.b, q.c);
      return now > least && off(q.a, q.d) < now - least && largest_angle(q.a, q.b, q.d) < widest &&
             largest_angle(q.a, q.d, q.c) < widest;
    });
  }

 private:
  int corner_beyond(FaceId f, int k) const {
    const Face& other = faces_[faces_[f].beyond[k]];
    return static_cast<int>(std::ranges::find(other.beyond, f) - other.beyond.begin());
  }

  void relink(FaceId f, FaceId from, FaceId to) {
    if (f != none) *std::ranges::find(faces_[f].beyond, from) = to;
  }

  /// Face a, b, c with a at corner k and its neighbour d, c, b become a, b, d and a, d, c.
  void swap(FaceId f, int k) {
    const FaceId g = faces_[f].beyond[k];
    const int m = corner_beyond(f, k);
    const Face first = faces_[f], second = faces_[g];
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3, m1 = (m + 1) % 3, m2 = (m + 2) % 3;
    const VertexId a = first.corners[k], b = first.corners[k1], c = first.corners[k2];
    const VertexId d = second.corners[m];
    faces_[f] = {{a, b, d}, {second.beyond[m1], g, first.beyond[k2]}};
    faces_[g] = {{a, d, c}, {second.beyond[m2], first.beyond[k1], f}};
    relink(second.beyond[m1], g, f);
    relink(first.beyond[k1], f, g);
  }

  FaceId locate(const Vector2d& p) const {
    FaceId f = hints_[cells_.index(p)];
    if (f == none) f = last_;
    for (std::size_t step = 0; step < faces_.size(); ++step) {
      const Face& face = faces_[f];
      int out = -1;
      for (int k = 0; k < 3 && out < 0; ++k)
        if (turn(plane_[face.corners[(k + 1) % 3]], plane_[face.corners[(k + 2) % 3]], p) < 0.0)
          out = k;
      if (out < 0 || face.beyond[out] == none) break;
      f = face.beyond[out];
    }
    return f;
  }

  void insert(VertexId v) {
    const Vector2d p = plane_[v];
    const FaceId f = locate(p);
    const auto g = static_cast<FaceId>(faces_.size()), h = g + 1;
    const auto [a, b, c] = faces_[f].corners;
    const auto [beyond_a, beyond_b, beyond_c] = faces_[f].beyond;
    faces_[f] = {{v, b, c}, {beyond_a, g, h}};
    faces_.push_back({{v, c, a}, {beyond_b, h, f}});
    faces_.push_back({{v, a, b}, {beyond_c, f, g}});
    relink(beyond_b, f, g);
    relink(beyond_c, f, h);
    std::vector<FaceId> suspects{f, g, h};
    while (!suspects.empty()) {  // v is always corner 0
      const FaceId s = suspects.back();
      suspects.pop_back();
      const FaceId other = faces_[s].beyond[0];
      if (other == none) continue;
      const Triangle& t = faces_[s].corners;
      const VertexId opposite = faces_[other].corners[corner_beyond(s, 0)];
      if (!in_circle(plane_[t[0]], plane_[t[1]], plane_[t[2]], plane_[opposite])) continue;
      swap(s, 0);
      suspects.push_back(s);
      suspects.push_back(other);
    }
    hints_[cells_.index(p)] = last_ = f;
  }

  double largest_angle(VertexId a, VertexId b, VertexId c) const {
    const auto angle = [&](VertexId at, VertexId to, VertexId from) {
      const Point u = space_[to] - space_[at], v = space_[from] - space_[at];
      return std::atan2(u.cross(v).norm(), u.dot(v));
    };
    return std::max({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
  }

  /// Faces a, b, c and d, c, b, whose side b-c may become a-d.
  struct Quad {
    VertexId a, b, c, d;
  };

  /// Sweeps over the faces until no side is to be swapped; looks again only where something
  /// changed.
  template <class IsBetter>
  void swap_while(const IsBetter& is_better) {
    constexpr double least_turn = 1e-6;  // mm^2; no faces that are next to vertical or folded
    std::vector<char> fresh(faces_.size(), 1);
    for (bool changed = true; changed;) {
      changed = false;
      for (FaceId f = 0; f < faces_.size(); ++f) {
        if (!fresh[f]) continue;
        fresh[f] = 0;
        for (int k = 0; k < 3; ++k) {
          const FaceId g = faces_[f].beyond[k];
          if (g == none || !is_real(f) || !is_real(g)) continue;
          const Triangle& t = faces_[f].corners;
          const Quad q{t[k], t[(k + 1) % 3], t[(k + 2) % 3],
                       faces_[g].corners[corner_beyond(f, k)]};
          if (turn(plane_[q.a], plane_[q.b], plane_[q.d]) < least_turn ||
              turn(plane_[q.a], plane_[q.d], plane_[q.c]) < least_turn || !is_better(q))
            continue;
          swap(f, k);
          changed = true;
          for (const FaceId touched : {f, g}) {
            fresh[touched] = 1;
            for (const FaceId beyond : faces_[touched].beyond)
              if (beyond != none) fresh[beyond] = 1;
          }
        }
      }
    }
  }

  const std::vector<Point>& space_;
  const Cells& cells_;
  std::vector<FaceId> hints_;  ///< Per cell the face to start a search from.
  FaceId last_ = 0;            ///< The one to start from elsewhere.
  std::vector<Vector2d> plane_;
  std::vector<Face> faces_;
};

/// Faces that cannot be reached from `start` over faces whose mark is `mark` get the other mark.
void keep_reached(const Triangulation& triangulation, std::vector<char>& marks, char mark,
                  FaceId start) {
  std::vector<char> reached(marks.size(), 0);
  std::vector<FaceId> front{start};
  reached[start] = 1;
  while (!front.empty()) {
    const FaceId f = front.back();
    front.pop_back();
    for (const FaceId g : triangulation.faces()[f].beyond)
      if (g != Triangulation::none && !reached[g] && marks[g] == mark) {
        reached[g] = 1;
        front.push_back(g);
      }
  }
  for (FaceId f = 0; f < marks.size(); ++f)
    if (marks[f] == mark && !reached[f]) marks[f] = !mark;
}

/// Takes the faces away at which kept faces meet in a vertex only; true if there were any.
bool cut_pinches(const Triangulation& triangulation, std::vector<char>& kept,
                 std::size_t vertex_count) {
  const auto& faces = triangulation.faces();
  std::vector<std::uint32_t> ends(vertex_count, 0);  // border sides at each vertex: 2 per fan
  for (FaceId f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      if (!kept[f] || (faces[f].beyond[k] != Triangulation::none && kept[faces[f].beyond[k]]))
        continue;
      ++ends[faces[f].corners[(k + 1) % 3]];
      ++ends[faces[f].corners[(k + 2) % 3]];
    }
  bool changed = false;
  for (FaceId f = 0; f < faces.size(); ++f)
    if (kept[f] && std::ranges::any_of(faces[f].corners, [&](VertexId v) { return ends[v] > 2; })) {
      kept[f] = 0;
      changed = true;
    }
  return changed;
}

}  // namespace

ScannedSurface scan_height_field(const HeightField& field, double spacing, std::uint64_t seed) {
  Random random(seed);
  // Beyond the edge of what is wanted, so that the border cuts through well-shaped faces.
  HeightField wider = field;
  wider.low -= Vector2d::Constant(4.0 * spacing);
  wider.high += Vector2d::Constant(4.0 * spacing);
  const std::vector<Point> darts = throw_darts(wider, spacing, random);
  const Cells cells(wider.low, wider.high, 2.0 * spacing);
  Triangulation triangulation(darts, cells);
  triangulation.equalise_angles();
  triangulation.approach(wider, 0.15 * spacing);

  const auto& faces = triangulation.faces();
  std::vector<char> kept(faces.size(), 0);
  FaceId outer = 0, middle = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (FaceId f = 0; f < faces.size(); ++f) {
    if (!triangulation.is_real(f)) {
      outer = f;
      continue;
    }
    const Triangle& t = faces[f].corners;
    const Vector2d centre = (darts[t[0]] + darts[t[1]] + darts[t[2]]).head<2>() / 3.0;
    kept[f] = field.inside(centre);
    const double distance = (centre - (field.low + field.high) / 2.0).squaredNorm();
    if (kept[f] && distance < nearest) {
      nearest = distance;
      middle = f;
    }
  }
  do {
    keep_reached(triangulation, kept, 0, outer);
    keep_reached(triangulation, kept, 1, middle);
  } while (cut_pinches(triangulation, kept, darts.size()));

  std::vector<char> used(darts.size(), 0);
  for (FaceId f = 0; f < faces.size(); ++f)
    if (kept[f])
      for (const VertexId v : faces[f].corners) used[v] = 1;
  std::vector<VertexId> order;
  for (VertexId v = 0; v < darts.size(); ++v)
    if (used[v]) order.push_back(v);
  std::ranges::sort(order, [&](VertexId a, VertexId b) {
    const Vector2d p = darts[a].head<2>(), q = darts[b].head<2>();
    const int row_p = cells.row(p), row_q = cells.row(q);
    return row_p != row_q ? row_p < row_q : p.x() != q.x() ? p.x() < q.x() : a < b;
  });
  ScannedSurface result;
  std::vector<VertexId> number(darts.size(), no_id);
  for (const VertexId v : order) {
    number[v] = static_cast<VertexId>(result.points.size());
    result.points.push_back(darts[v]);
  }
  for (FaceId f = 0; f < faces.size(); ++f) {
    if (!kept[f]) continue;
    Triangle t;
    for (int k = 0; k < 3; ++k) t[k] = number[faces[f].corners[k]];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.triangles.push_back(t);
  }
  std::ranges::sort(result.triangles);
  return result;
}

}  // namespace arris
