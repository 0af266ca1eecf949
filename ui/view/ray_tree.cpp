#include "ui/view/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

namespace arris::ui {
namespace {

constexpr std::uint32_t leaf_size = 4;

/// Distance at which the ray enters the box, infinite if it misses it.
double entry(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Point& origin,
             const Point& inverse, double most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double near = 0.0;
  double far = most;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(inverse[k])) {  // the ray runs along the sides
      if (origin[k] < low[k] || origin[k] > high[k]) return infinity;
      continue;
    }
    const double a = (low[k] - origin[k]) * inverse[k];
    const double b = (high[k] - origin[k]) * inverse[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  // Rounding must never lose a box that the ray touches.
  return near <= far * (1.0 + 1e-12) ? near : infinity;
}

}  // namespace

RayTree::RayTree(MeshPtr mesh) : mesh_(std::move(mesh)) {
  const std::size_t count = mesh_->face_count();
  if (count == 0) return;
  std::vector<Point> centres(count);
  for (FaceId f = 0; f < count; ++f) {
    const Triangle& t = mesh_->triangle(f);
    centres[f] = (mesh_->point(t[0]) + mesh_->point(t[1]) + mesh_->point(t[2])) / 3.0;
  }
  faces_.resize(count);
  std::iota(faces_.begin(), faces_.end(), 0u);
  nodes_.reserve(count);
  nodes_.push_back({});
  nodes_[0].count = static_cast<std::uint32_t>(count);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node, centres);
}

void RayTree::split(std::uint32_t node, std::vector<Point>& centres) {
  const std::uint32_t begin = nodes_[node].begin;
  const std::uint32_t count = nodes_[node].count;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(infinity);
  Eigen::Vector3d high = -low;
  Eigen::Vector3d centre_low = low;
  Eigen::Vector3d centre_high = high;
  for (std::uint32_t i = begin; i < begin + count; ++i) {
    for (const VertexId v : mesh_->triangle(faces_[i])) {
      low = low.cwiseMin(mesh_->point(v));
      high = high.cwiseMax(mesh_->point(v));
    }
    centre_low = centre_low.cwiseMin(centres[faces_[i]]);
    centre_high = centre_high.cwiseMax(centres[faces_[i]]);
  }
  nodes_[node].low = low;
  nodes_[node].high = high;
  if (count <= leaf_size) return;
  int axis = 0;
  (centre_high - centre_low).maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  const auto first = faces_.begin() + begin;
  std::nth_element(first, first + half, first + count, [&](FaceId a, FaceId b) {
    return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
  });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  Node child;
  child.begin = begin;
  child.count = half;
  nodes_.push_back(child);
  child.begin = begin + half;
  child.count = count - half;
  nodes_.push_back(child);
  nodes_[node].begin = left;
  nodes_[node].count = 0;
}

std::optional<RayTree::Hit> RayTree::first(const Point& origin, const Point& direction, double most,
                                           const std::vector<bool>* hidden) const {
  if (nodes_.empty()) return std::nullopt;
  const Point inverse = direction.cwiseInverse();
  std::optional<Hit> best;
  struct Visit {
    std::uint32_t node;
    double near;
  };
  std::vector<Visit> stack;
  const auto push = [&](std::uint32_t node) {
    const double near = entry(nodes_[node].low, nodes_[node].high, origin, inverse, most);
    if (std::isfinite(near)) stack.push_back({node, near});
  };
  push(0);
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    if (visit.near > most) continue;
    const Node& node = nodes_[visit.node];
    if (node.count == 0) {
      push(node.begin);
      push(node.begin + 1);
      // The nearer child is looked into first.
      if (stack.size() >= 2 && stack[stack.size() - 1].near > stack[stack.size() - 2].near &&
          stack[stack.size() - 2].node == node.begin) {
        std::swap(stack[stack.size() - 1], stack[stack.size() - 2]);
      }
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) {
      if (hidden && (*hidden)[faces_[i]]) continue;
      const Triangle& t = mesh_->triangle(faces_[i]);
      const Point& a = mesh_->point(t[0]);
      const Point ab = mesh_->point(t[1]) - a;
      const Point ac = mesh_->point(t[2]) - a;
      const Point normal = ab.cross(ac);
      const double slope = -direction.dot(normal);
      if (slope == 0.0) continue;
      const Point from = origin - a;
      const double distance = from.dot(normal) / slope;
      if (!(distance >= 0.0) || distance > most) continue;
      const Point moment = from.cross(direction);
      const double v = ac.dot(moment) / slope;
      const double w = -ab.dot(moment) / slope;
      // A little generous, so that no ray slips through between two faces.
      constexpr double slack = 1e-9;
      if (v < -slack || w < -slack || v + w > 1.0 + slack) continue;
      if (best && distance == best->distance && faces_[i] > best->face) continue;
      best = Hit{faces_[i], distance, slope > 0.0};
      most = distance;
    }
  }
  return best;
}

}  // namespace arris::ui
