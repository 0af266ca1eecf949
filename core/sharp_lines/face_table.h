#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// What the measures of sharpness read of each face, side by side in memory, in units of the mean
/// edge and about the middle of the box: so that nothing measured depends on the part's unit or
/// place.
struct FaceTable {
  struct Face {
    Eigen::Vector3f centre;
    Eigen::Vector3f normal;  ///< Unit; zero for a face without area.
    float area = 0.0F;       ///< In squares of the mean edge.
  };

  explicit FaceTable(const Mesh& mesh);

  std::vector<Face> faces;
  std::vector<std::array<FaceId, 3>> neighbours;  ///< Across side k (corner k to k + 1), or no_id.
  std::vector<std::array<EdgeId, 3>> sides;
  std::vector<Eigen::Vector3f> points;  ///< Of the vertices.
  double unit = 1.0;                    ///< The mean edge, in the mesh's unit.

  std::size_t size() const { return faces.size(); }
};

/// How far the centre of each face lies from the middle of the nearest of `edges`, mean edges, as
/// reached over sides; infinite beyond `reach`. The faces beside an edge count whatever theirs is.
std::vector<float> distances_from(const Mesh& mesh, const FaceTable& table,
                                  const std::vector<EdgeId>& edges, float reach);

/// Faces about a place, grown over shared sides, so that another sheet that is near in space only
/// (the other face of a thin wall) does not come in. One for each thread.
class FaceWindow {
 public:
  /// No window holds more faces than this: the nearest ones by steps over sides.
  static constexpr std::size_t most_faces = 400;

  explicit FaceWindow(const FaceTable& table) : table_(table), seen_(table.size(), 0) {}

  /// The faces that `admits(f)` lets in, joined over sides to `seeds`, with centres within `radius`
  /// (mean edges) of `place`. Seeds come in whatever their distance. Valid until the next call.
  template <class Seeds, class Admits>
  const std::vector<FaceId>& grow(const Seeds& seeds, const Eigen::Vector3f& place, float radius,
                                  const Admits& admits) {
    if (++stamp_ == 0) {
      std::fill(seen_.begin(), seen_.end(), 0);
      stamp_ = 1;
    }
    faces_.clear();
    for (const FaceId f : seeds)
      if (f != no_id && seen_[f] != stamp_) {
        seen_[f] = stamp_;
        faces_.push_back(f);
      }
    const float radius2 = radius * radius;
    for (std::size_t i = 0; i < faces_.size() && faces_.size() < most_faces; ++i)
      for (const FaceId g : table_.neighbours[faces_[i]])
        if (g != no_id && seen_[g] != stamp_) {
          seen_[g] = stamp_;
          if ((table_.faces[g].centre - place).squaredNorm() < radius2 && admits(g))
            faces_.push_back(g);
        }
    return faces_;
  }
  template <class Seeds>
  const std::vector<FaceId>& grow(const Seeds& seeds, const Eigen::Vector3f& place, float radius) {
    return grow(seeds, place, radius, [](FaceId) { return true; });
  }

 private:
  const FaceTable& table_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t stamp_ = 0;
  std::vector<FaceId> faces_;
};

}  // namespace arris
