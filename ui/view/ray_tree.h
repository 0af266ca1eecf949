#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris::ui {

/// Finds the first face on a ray: a tree of boxes over the faces of a mesh. Reading is safe from
/// several threads.
class RayTree {
 public:
  explicit RayTree(MeshPtr mesh);

  struct Hit {
    FaceId face = no_id;
    double distance = 0.0;  ///< From the origin, in lengths of the direction.
    bool front = false;     ///< The ray meets the outer side of the face.
  };
  /// The nearest hit at a distance in [0, most]. A ray along a face's plane misses it. `hidden`:
  /// one value per face, true for those that are not there; null: all are.
  std::optional<Hit> first(const Point& origin, const Point& direction, double most,
                           const std::vector<bool>* hidden = nullptr) const;

  const MeshPtr& mesh() const { return mesh_; }

 private:
  struct Node {
    Eigen::Vector3d low, high;
    std::uint32_t begin = 0;  // of the faces of a leaf, or the left child (the right one follows)
    std::uint32_t count = 0;  // 0: not a leaf
  };
  void split(std::uint32_t node, std::vector<Point>& centres);

  MeshPtr mesh_;
  std::vector<FaceId> faces_;
  std::vector<Node> nodes_;
};

}  // namespace arris::ui
