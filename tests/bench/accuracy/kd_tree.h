#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris::accuracy {

/// The nearest of a set of points.
class KdTree {
 public:
  explicit KdTree(std::vector<Point> points);

  bool empty() const { return points_.empty(); }
  const std::vector<Point>& points() const { return points_; }  ///< In an order of its own.

  struct Hit {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t index = no_id;  ///< Among the points as given; no_id: none that near.
  };
  /// The nearest point no farther than `reach` (mm).
  Hit nearest(const Point& p, double reach = std::numeric_limits<double>::infinity()) const;
  bool has_within(const Point& p, double reach) const { return nearest(p, reach).index != no_id; }

 private:
  void build(std::uint32_t begin, std::uint32_t end);
  void search(std::uint32_t begin, std::uint32_t end, const Point& p, double& least,
              std::uint32_t& place) const;

  // A range of points is split at its middle along axes_[middle], down to a handful.
  std::vector<Point> points_;
  std::vector<std::uint32_t> order_;  // as given
  std::vector<std::uint8_t> axes_;
};

}  // namespace arris::accuracy
