#include "tests/bench/accuracy/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace arris::accuracy {

namespace {

constexpr std::uint32_t leaf_size = 8;

}  // namespace

KdTree::KdTree(std::vector<Point> points)
    : points_(std::move(points)), order_(points_.size()), axes_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(points_.size()));
  std::vector<Point> sorted;
  sorted.reserve(points_.size());
  for (const std::uint32_t k : order_) sorted.push_back(points_[k]);
  points_ = std::move(sorted);
}

void KdTree::build(std::uint32_t begin, std::uint32_t end) {
  if (end - begin <= leaf_size) return;
  Point low = points_[order_[begin]], high = low;
  for (std::uint32_t k = begin; k < end; ++k) {
    low = low.cwiseMin(points_[order_[k]]);
    high = high.cwiseMax(points_[order_[k]]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) {
        return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
      });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

void KdTree::search(std::uint32_t begin, std::uint32_t end, const Point& p, double& least,
                    std::uint32_t& place) const {
  const auto look = [&](std::uint32_t k) {
    const double squared = (points_[k] - p).squaredNorm();
    if (squared > least || (squared == least && place != no_id)) return;
    least = squared;
    place = k;
  };
  if (end - begin <= leaf_size) {
    for (std::uint32_t k = begin; k < end; ++k) look(k);
    return;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  look(middle);
  const double offset = p[axes_[middle]] - points_[middle][axes_[middle]];
  const bool below = offset < 0.0;
  search(below ? begin : middle + 1, below ? middle : end, p, least, place);
  if (offset * offset <= least)
    search(below ? middle + 1 : begin, below ? end : middle, p, least, place);
}

KdTree::Hit KdTree::nearest(const Point& p, double reach) const {
  double least = reach * reach;
  std::uint32_t place = no_id;
  search(0, static_cast<std::uint32_t>(points_.size()), p, least, place);
  if (place == no_id) return {};
  return {std::sqrt(least), order_[place]};
}

}  // namespace arris::accuracy
