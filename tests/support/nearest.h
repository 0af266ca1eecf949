#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace arris::testing {

/// Distances to a set of triangles or segments, worked out apart from the code under test: a tree
/// of boxes over them, and the closest point by regions (Ericson, Real-Time Collision
/// Detection, 5.1).
class Nearest {
 public:
  /// The faces of a mesh.
  static Nearest faces(const Mesh& mesh);
  /// The edges of its free border.
  static Nearest border(const Mesh& mesh);

  struct Hit {
    double distance;
    std::size_t element;  ///< Face, or index among the border edges by ascending edge id.
  };
  Hit find(const Point& p) const;

 private:
  struct Node {
    Point low, high;
    std::uint32_t begin, end;  // elements in order_; children are 2i + 1, 2i + 2 of a full tree
  };
  explicit Nearest(std::vector<std::array<Point, 3>> elements);
  void build(std::size_t node, std::uint32_t begin, std::uint32_t end);
  void search(std::size_t node, const Point& p, double& least, std::uint32_t& element) const;

  std::vector<std::array<Point, 3>> elements_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace arris::testing
