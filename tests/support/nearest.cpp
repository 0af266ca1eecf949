#include "tests/support/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace arris::testing {

namespace {

constexpr std::uint32_t leaf_size = 4;

Point closest_point(const Point& p, const std::array<Point, 3>& t) {
  const Point &a = t[0], &b = t[1], &c = t[2];
  const Point ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Point bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const Point cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

Nearest::Nearest(std::vector<std::array<Point, 3>> elements)
    : elements_(std::move(elements)), order_(elements_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build(0, 0, static_cast<std::uint32_t>(order_.size()));
}

Nearest Nearest::faces(const Mesh& mesh) {
  std::vector<std::array<Point, 3>> elements;
  for (const Triangle& t : mesh.triangles())
    elements.push_back({mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2])});
  return Nearest(std::move(elements));
}

Nearest Nearest::border(const Mesh& mesh) {
  std::vector<std::array<Point, 3>> elements;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_border_edge(e)) continue;
    const Point &a = mesh.point(mesh.edge(e)[0]), &b = mesh.point(mesh.edge(e)[1]);
    elements.push_back({a, b, b});
  }
  return Nearest(std::move(elements));
}

void Nearest::build(std::size_t node, std::uint32_t begin, std::uint32_t end) {
  if (nodes_.size() <= node) nodes_.resize(node + 1);
  Point low = elements_[order_[begin]][0], high = low;
  for (std::uint32_t i = begin; i < end; ++i)
    for (const Point& p : elements_[order_[i]]) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  nodes_[node] = {low, high, begin, end};
  if (end - begin <= leaf_size) return;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = (begin + end) / 2;
  const auto key = [&](std::uint32_t i) {
    return elements_[i][0][axis] + elements_[i][1][axis] + elements_[i][2][axis];
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

void Nearest::search(std::size_t node, const Point& p, double& least,
                     std::uint32_t& element) const {
  const Node& n = nodes_[node];
  const Point outside = (n.low - p).cwiseMax(p - n.high).cwiseMax(Point::Zero());
  if (outside.squaredNorm() >= least) return;
  if (n.end - n.begin > leaf_size) {
    const auto gap = [&](std::size_t child) {
      const Node& c = nodes_[child];
      return (c.low - p).cwiseMax(p - c.high).cwiseMax(Point::Zero()).squaredNorm();
    };
    const bool swapped = gap(2 * node + 2) < gap(2 * node + 1);
    search(2 * node + (swapped ? 2 : 1), p, least, element);
    search(2 * node + (swapped ? 1 : 2), p, least, element);
    return;
  }
  for (std::uint32_t i = n.begin; i < n.end; ++i) {
    const double distance2 = (p - closest_point(p, elements_[order_[i]])).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      element = order_[i];
    }
  }
}

Nearest::Hit Nearest::find(const Point& p) const {
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t element = no_id;
  if (!nodes_.empty()) search(0, p, least, element);
  return {std::sqrt(least), element};
}

}  // namespace arris::testing
