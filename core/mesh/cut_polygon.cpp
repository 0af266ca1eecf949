#include "core/mesh/cut_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

#include "core/mesh/geometry.h"

namespace arris {

namespace {

using Flat = Eigen::Vector2d;

double turn(const Flat& a, const Flat& b, const Flat& c) {
  const Flat ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

/// The corner from which a fan has no triangle that is flipped or without area.
std::optional<std::size_t> fan_tip(std::span<const Point> points, std::span<const VertexId> polygon,
                                   const Point& normal) {
  const std::size_t n = polygon.size();
  const double least = cross_rounding * normal.squaredNorm();
  // Looking at every corner of a huge polygon would take the square of its size.
  const std::size_t tries = std::min(n, 8 + (std::size_t{1} << 16) / n);
  for (std::size_t tip = 0; tip < tries; ++tip) {
    const Point& origin = points[polygon[tip]];
    bool fair = true;
    for (std::size_t i = 1; i + 1 < n && fair; ++i)
      fair = (points[polygon[(tip + i) % n]] - origin)
                 .cross(points[polygon[(tip + i + 1) % n]] - origin)
                 .dot(normal) > least;
    if (fair) return tip;
  }
  return std::nullopt;
}

/// The corners that are left, in a ring, and a grid of those where the outline does not bulge.
class EarClipper {
 public:
  EarClipper(std::span<const Point> points, std::span<const VertexId> polygon, const Point& normal,
             std::vector<Triangle>& triangles)
      : polygon_(polygon),
        triangles_(triangles),
        left_(polygon.size()),
        most_steps_(std::min<std::uint64_t>(300'000'000, 100'000 + 10'000 * polygon.size())) {
    flatten(points, normal);
    const std::uint32_t n = static_cast<std::uint32_t>(polygon.size());
    next_.resize(n);
    previous_.resize(n);
    stamp_.assign(n, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = i + 1 == n ? 0 : i + 1;
      previous_[i] = i == 0 ? n - 1 : i - 1;
    }
    bulges_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) bulges_[i] = bends_left(i);
    hollow_ = static_cast<std::size_t>(std::count(bulges_.begin(), bulges_.end(), false));
    fill_grid();
  }

  PolygonCut run() {
    while (left_ > 3) {
      const std::size_t before = left_;
      clip_ears();
      if (left_ <= 3) break;
      if (left_ == before && !clip_spikes() && !clip_flat()) return give_up();
    }
    const std::uint32_t a = any_left(), b = next_[a], c = next_[b];
    if (left_ < 3) return PolygonCut::whole;
    if (id(a) == id(b) || id(b) == id(c) || id(c) == id(a)) return PolygonCut::whole;  // a spike
    add(a, b, c);
    return turn(at_[a], at_[b], at_[c]) < -flat(a, c) ? PolygonCut::crossed : PolygonCut::whole;
  }

 private:
  VertexId id(std::uint32_t i) const { return polygon_[i]; }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles_.push_back({id(a), id(b), id(c)});
  }

  void flatten(std::span<const Point> points, const Point& normal) {
    const Point z = normal.normalized();
    Eigen::Index least = 0;
    z.cwiseAbs().minCoeff(&least);
    const Point x = Point::Unit(least).cross(z).normalized(), y = z.cross(x);
    const Point& origin = points[polygon_[0]];
    for (const VertexId v : polygon_)
      at_.push_back({(points[v] - origin).dot(x), (points[v] - origin).dot(y)});
    low_ = high_ = at_[0];
    for (const Flat& p : at_) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    nearness_ = cross_rounding * (high_ - low_).norm();
  }

  /// What the turn of a point beside the side from a to c may be and the point still lie on it.
  double flat(std::uint32_t a, std::uint32_t c) const {
    return nearness_ * (at_[c] - at_[a]).norm();
  }
  bool bends_left(std::uint32_t i) const {
    const std::uint32_t a = previous_[i], c = next_[i];
    return turn(at_[a], at_[i], at_[c]) > flat(a, c);
  }

  void fill_grid() {
    const Flat size = high_ - low_;
    const double cells = std::max<double>(1.0, static_cast<double>(hollow_));
    cell_ = std::max(std::sqrt(size.x() * size.y() / cells), size.maxCoeff() / (2.0 * cells));
    if (!(cell_ > 0.0)) cell_ = 1.0;
    columns_ = 1 + static_cast<std::size_t>(size.x() / cell_);
    rows_ = 1 + static_cast<std::size_t>(size.y() / cell_);
    first_.assign(columns_ * rows_ + 1, 0);
    const auto slot = [&](std::uint32_t i) {
      return row(at_[i].y()) * columns_ + column(at_[i].x());
    };
    for (std::uint32_t i = 0; i < at_.size(); ++i)
      if (!bulges_[i]) ++first_[slot(i) + 1];
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    inside_.resize(hollow_);
    std::vector<std::uint32_t> cursor(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < at_.size(); ++i)
      if (!bulges_[i]) inside_[cursor[slot(i)]++] = i;
  }
  std::size_t column(double x) const { return cell((x - low_.x()) / cell_, columns_); }
  std::size_t row(double y) const { return cell((y - low_.y()) / cell_, rows_); }
  static std::size_t cell(double at, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  }

  /// Whether the corner can be cut off along a line that runs inside the polygon.
  bool is_ear(std::uint32_t i) {
    const std::uint32_t a = previous_[i], c = next_[i];
    if (!bends_left(i) || id(a) == id(c)) return false;
    // Where the outline passes one place twice, the line must leave it on the inner side.
    const std::uint32_t before = previous_[a], after = next_[c];
    if (turn(at_[before], at_[a], at_[i]) > 0.0 &&
        turn(at_[a], at_[c], at_[before]) <= flat(a, c) && before != c)
      return false;
    if (turn(at_[i], at_[c], at_[after]) > 0.0 && turn(at_[a], at_[c], at_[after]) <= flat(a, c) &&
        after != a)
      return false;
    return hollow_ == 0 || !holds_a_corner(a, i, c);
  }

  bool holds_a_corner(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::array<Flat, 3> t{at_[a], at_[b], at_[c]};
    const auto [low, high] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
    const std::size_t last_row = row(high);
    for (std::size_t y = row(low); y <= last_row; ++y) {
      // Only the cells that the triangle crosses in this row: it may be a needle across all of it.
      const auto [left, right] = crossed(t, low_.y() + cell_ * static_cast<double>(y));
      const std::size_t last = column(right);
      for (std::size_t x = column(left); x <= last; ++x) {
        ++steps_;
        for (std::uint32_t k = first_[y * columns_ + x]; k < first_[y * columns_ + x + 1]; ++k) {
          const std::uint32_t p = inside_[k];
          ++steps_;
          if (next_[p] == gone || bulges_[p] || p == a || p == b || p == c) continue;
          const Flat& at = at_[p];
          if (at == t[0] || at == t[1] || at == t[2]) continue;
          if (turn(t[0], t[1], at) >= -flat(a, b) && turn(t[1], t[2], at) >= -flat(b, c) &&
              turn(t[2], t[0], at) >= -flat(c, a))
            return true;
        }
      }
    }
    return false;
  }

  /// From where to where along x a triangle reaches in the row of the grid that begins at `y`, and
  /// a little more, for points on its sides count as inside.
  std::pair<double, double> crossed(const std::array<Flat, 3>& t, double y) const {
    const double margin = 0.01 * cell_, low = y - margin, high = y + cell_ + margin;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    const auto take = [&](double x) {
      left = std::min(left, x - margin);
      right = std::max(right, x + margin);
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const Flat &p = t[k], &q = t[(k + 1) % 3];
      if (p.y() >= low && p.y() <= high) take(p.x());
      for (const double edge : {low, high})
        if ((p.y() < edge) != (q.y() < edge))
          take(p.x() + (q.x() - p.x()) * ((edge - p.y()) / (q.y() - p.y())));
    }
    return {left, right};
  }

  /// Cuts off ears while there are any; the fullest triangles first.
  void clip_ears() {
    struct Candidate {
      double fullness;
      std::uint32_t corner, stamp;
      bool operator<(const Candidate& other) const {
        return fullness != other.fullness ? fullness < other.fullness : corner > other.corner;
      }
    };
    std::priority_queue<Candidate> candidates;
    const auto offer = [&](std::uint32_t i) {
      if (!bulges_[i]) return;
      const Flat &a = at_[previous_[i]], &b = at_[i], &c = at_[next_[i]];
      const double longest =
          std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
      candidates.push({turn(a, b, c) / longest, i, stamp_[i]});
    };
    for (std::uint32_t i = 0; i < next_.size(); ++i)
      if (next_[i] != gone) offer(i);
    steps_ += left_;
    while (!candidates.empty() && left_ > 3 && steps_ < most_steps_) {
      const Candidate best = candidates.top();
      candidates.pop();
      const std::uint32_t i = best.corner;
      if (next_[i] == gone || stamp_[i] != best.stamp || !is_ear(i)) continue;
      const std::uint32_t a = previous_[i], c = next_[i];
      add(a, i, c);
      remove(i);
      offer(a);
      offer(c);
    }
  }

  /// Takes the corner out of the ring.
  void remove(std::uint32_t i) {
    const std::uint32_t a = previous_[i], c = next_[i];
    next_[a] = c;
    previous_[c] = a;
    next_[i] = gone;
    hollow_ -= !bulges_[i];
    --left_;
    for (const std::uint32_t k : {a, c}) {
      ++stamp_[k];
      const bool bulges = bends_left(k);
      // What bulged and no longer does is not in the grid; the outline crosses itself there.
      if (bulges == bulges_[k] || !bulges) continue;
      bulges_[k] = true;
      --hollow_;
    }
  }

  std::uint32_t any_left() const {
    std::uint32_t i = 0;
    while (next_[i] == gone) ++i;
    return i;
  }

  /// Cuts off where the outline runs to a corner and straight back; it covers nothing there.
  bool clip_spikes() {
    const std::size_t before = left_;
    std::uint32_t i = any_left();
    for (std::size_t passed = 0; passed <= left_ && left_ > 3; ++steps_) {
      const std::uint32_t a = previous_[i], c = next_[i];
      if (id(a) != id(c)) {
        i = c;
        ++passed;
        continue;
      }
      remove(i);
      remove(a);
      i = previous_[c];  // it and c may be ends of a spike now
      passed = 0;
    }
    return left_ < before;
  }

  /// A corner in the middle of a straight side, when no ear is left: a triangle without area.
  bool clip_flat() {
    if (steps_ >= most_steps_) return false;
    for (std::uint32_t i = 0; i < next_.size(); ++i) {
      if (next_[i] == gone) continue;
      ++steps_;
      const std::uint32_t a = previous_[i], c = next_[i];
      if (id(a) == id(c) || std::abs(turn(at_[a], at_[i], at_[c])) > flat(a, c)) continue;
      add(a, i, c);
      remove(i);
      return true;
    }
    return false;
  }

  /// Whatever is left becomes a fan, so that the surface stays joined with its neighbours.
  PolygonCut give_up() {
    bool crossed = false;
    const std::uint32_t tip = any_left();
    for (std::uint32_t i = next_[tip]; next_[i] != tip; i = next_[i]) {
      const std::uint32_t c = next_[i];
      crossed = crossed || turn(at_[tip], at_[i], at_[c]) < -flat(tip, c);
      if (id(i) != id(c) && id(tip) != id(i) && id(tip) != id(c)) add(tip, i, c);
    }
    return crossed ? PolygonCut::crossed : PolygonCut::whole;
  }

  static constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();
  std::span<const VertexId> polygon_;
  std::vector<Triangle>& triangles_;
  std::size_t left_;
  std::vector<Flat> at_;
  Flat low_, high_;
  double nearness_ = 0.0;
  std::vector<std::uint32_t> next_, previous_, stamp_;
  std::vector<bool> bulges_;
  std::size_t hollow_ = 0;  // corners left that do not bulge
  double cell_ = 1.0;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_, inside_;  // corners of each cell, as rows of the grid
  std::uint64_t steps_ = 0;
  /// Far more than an outline takes that a person drew; a second at the most.
  std::uint64_t most_steps_;
};

}  // namespace

PolygonCut cut_polygon(std::span<const Point> points, std::span<const VertexId> polygon,
                       std::vector<Triangle>& triangles) {
  const std::size_t n = polygon.size();
  Point normal = Point::Zero();
  double reach = 0.0;
  const Point& origin = points[polygon[0]];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Point a = points[polygon[i]] - origin, b = points[polygon[i + 1]] - origin;
    normal += a.cross(b);
    reach = std::max({reach, a.squaredNorm(), b.squaredNorm()});
  }
  // Without a plane it is a line or crosses itself.
  const bool has_plane =
      std::isfinite(reach) && normal.allFinite() && normal.norm() > cross_rounding * reach;
  const std::optional<std::size_t> tip =
      has_plane ? fan_tip(points, polygon, normal) : std::optional<std::size_t>(0);
  if (!tip) return EarClipper(points, polygon, normal, triangles).run();
  bool crossed = false;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Triangle t{polygon[*tip], polygon[(*tip + i) % n], polygon[(*tip + i + 1) % n]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    triangles.push_back(t);
    crossed = crossed || (!has_plane &&
                          (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm() >
                              cross_rounding * reach);
  }
  return crossed ? PolygonCut::crossed : PolygonCut::whole;
}

}  // namespace arris
