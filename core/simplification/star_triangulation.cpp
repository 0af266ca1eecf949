#include "core/simplification/star_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/geometry.h"
#include "core/simplification/working_mesh.h"

namespace arris {

namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();

/// Minus the cosine of the largest angle: grows with it.
double largest_angle_cost(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double x = ab.squaredNorm(), y = bc.squaredNorm(), z = ca.squaredNorm();
  // The largest angle lies opposite the longest side.
  if (x >= y && x >= z) return bc.dot(ca) / std::sqrt(y * z);
  if (y >= z) return ca.dot(ab) / std::sqrt(z * x);
  return ab.dot(bc) / std::sqrt(x * y);
}

}  // namespace

StarTriangulator::StarTriangulator() : states_(n_ * n_ * n_) {}

bool StarTriangulator::may_join(int i, int j) const {
  const StarPolygon& p = *polygon_;
  if (j == i + 1 || (i == 0 && j == p.size - 1)) return true;
  return !(p.joined[i] >> j & 1u) &&
         (p.points[j] - p.points[i]).squaredNorm() <= p.longest_edge * p.longest_edge;
}

/// |beta| between a face and one beyond a side, or impossible where it counts as a flip.
double StarTriangulator::across(const Point& normal, const Point* other) const {
  if (other == nullptr) return 0.0;
  if (normal.dot(*other) < polygon_->least_cosine) return impossible;
  return angle_between(normal, *other);
}

void StarTriangulator::set(const StarPolygon& polygon) {
  polygon_ = &polygon;
  const int n = polygon.size;
  std::array<std::uint32_t, n_> joinable{};
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) joinable[i] |= static_cast<std::uint32_t>(may_join(i, j)) << j;
  for (int i = 0; i < n; ++i)
    for (int m = i + 1; m < n; ++m)
      for (int j = m + 1; j < n; ++j) {
        State& state = states_[index(i, m, j)];
        state.possible = (joinable[i] >> m & joinable[m] >> j & joinable[i] >> j & 1u) != 0;
        if (!state.possible) continue;
        // From the smallest id on, so that the normal is that of WorkingMesh::normal_of().
        int a = i, b = m, c = j;
        while (polygon.vertices[a] > polygon.vertices[b] ||
               polygon.vertices[a] > polygon.vertices[c]) {
          const int first = a;
          a = b, b = c, c = first;
        }
        const Point ab = polygon.points[b] - polygon.points[a];
        const Point ac = polygon.points[c] - polygon.points[a];
        const Point bc = polygon.points[c] - polygon.points[b];
        const Point cross = ab.cross(ac);
        state.area = cross.norm();
        state.possible = !WorkingMesh::is_degenerate(state.area, ab, ac, bc);
        state.normal = cross / state.area;
        state.has_query = false;
      }
}

bool StarTriangulator::best(StarCost cost, std::vector<StarFace>& faces) {
  faces.clear();
  return cost == StarCost::flat ? best_flat(faces) : best_by_face(cost, faces);
}

bool StarTriangulator::best_flat(std::vector<StarFace>& faces) {
  const StarPolygon& p = *polygon_;
  const int n = p.size;
  for (int length = 2; length < n; ++length)
    for (int i = 0; i + length < n; ++i) {
      const int j = i + length;
      for (int m = i + 1; m < j; ++m) {
        State& state = states_[index(i, m, j)];
        state.cost = impossible;
        if (!state.possible) continue;
        double left = impossible, right = impossible;
        state.left = state.right = -1;
        if (m == i + 1) {
          left = across(state.normal, p.outer_normals[i]);
        } else {
          for (int l = i + 1; l < m; ++l) {
            const State& below = states_[index(i, l, m)];
            if (!below.possible || !(below.cost < left)) continue;
            const double sum = below.cost + across(state.normal, &below.normal);
            if (sum < left) left = sum, state.left = static_cast<std::int8_t>(l);
          }
        }
        if (left == impossible) continue;
        if (j == m + 1) {
          right = across(state.normal, p.outer_normals[m]);
        } else {
          for (int r = m + 1; r < j; ++r) {
            const State& below = states_[index(m, r, j)];
            if (!below.possible || !(below.cost < right)) continue;
            const double sum = below.cost + across(state.normal, &below.normal);
            if (sum < right) right = sum, state.right = static_cast<std::int8_t>(r);
          }
        }
        state.cost = left + right;
      }
    }
  double least = impossible;
  int middle = -1;
  for (int m = 1; m < n - 1; ++m) {
    const State& state = states_[index(0, m, n - 1)];
    if (!state.possible || !(state.cost < least)) continue;
    const double sum = state.cost + across(state.normal, p.outer_normals[n - 1]);
    if (sum < least) least = sum, middle = m;
  }
  if (middle < 0) return false;
  faces.push_back({0, static_cast<std::int8_t>(middle), static_cast<std::int8_t>(n - 1)});
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const StarFace face = faces[k];
    const State& state = states_[index(face.first, face.middle, face.last)];
    if (state.left >= 0) faces.push_back({face.first, state.left, face.middle});
    if (state.right >= 0) faces.push_back({face.middle, state.right, face.last});
  }
  return true;
}

bool StarTriangulator::best_by_face(StarCost cost, std::vector<StarFace>& faces) {
  const StarPolygon& p = *polygon_;
  const int n = p.size;
  std::array<std::array<double, n_>, n_> least;
  std::array<std::array<std::int8_t, n_>, n_> middle;
  for (int i = 0; i + 1 < n; ++i) least[i][i + 1] = -impossible;
  const bool is_area = cost == StarCost::area;
  for (int length = 2; length < n; ++length)
    for (int i = 0; i + length < n; ++i) {
      const int j = i + length;
      least[i][j] = impossible;
      middle[i][j] = -1;
      for (int m = i + 1; m < j; ++m) {
        const State& state = states_[index(i, m, j)];
        if (!state.possible) continue;
        double sum =
            is_area ? state.area : largest_angle_cost(p.points[i], p.points[m], p.points[j]);
        for (const double part : {least[i][m], least[m][j]}) {
          if (!is_area)
            sum = std::max(sum, part);
          else if (part != -impossible)
            sum += part;
        }
        if (sum < least[i][j]) least[i][j] = sum, middle[i][j] = static_cast<std::int8_t>(m);
      }
    }
  if (!(least[0][n - 1] < impossible)) return false;
  faces.push_back({0, middle[0][n - 1], static_cast<std::int8_t>(n - 1)});
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const StarFace face = faces[k];
    if (face.middle > face.first + 1)
      faces.push_back({face.first, middle[face.first][face.middle], face.middle});
    if (face.last > face.middle + 1)
      faces.push_back({face.middle, middle[face.middle][face.last], face.last});
  }
  // These costs do not see the angles between faces: whether one is a flip is asked at the end.
  return cost_of(StarCost::flat, faces) < impossible;
}

double StarTriangulator::cost_of(StarCost cost, std::span<const StarFace> faces) const {
  const StarPolygon& p = *polygon_;
  if (cost != StarCost::flat) {
    double result = cost == StarCost::area ? 0.0 : -1.0;
    for (const StarFace& f : faces) {
      const Point &a = p.points[f.first], &b = p.points[f.middle], &c = p.points[f.last];
      if (cost == StarCost::area)
        result += (b - a).cross(c - a).norm();
      else
        result = std::max(result, largest_angle_cost(a, b, c));
    }
    return result;
  }
  std::array<std::array<const Point*, n_>, n_> beyond{};  // the face with (first, last) as its base
  for (const StarFace& f : faces) beyond[f.first][f.last] = &normal(f);
  double result = across(*beyond[0][p.size - 1], p.outer_normals[p.size - 1]);
  for (const StarFace& f : faces) {
    result += across(
        normal(f), f.middle == f.first + 1 ? p.outer_normals[f.first] : beyond[f.first][f.middle]);
    result += across(normal(f),
                     f.last == f.middle + 1 ? p.outer_normals[f.middle] : beyond[f.middle][f.last]);
  }
  return result;
}

}  // namespace arris
