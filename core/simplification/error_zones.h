#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace arris {

/// The error zones of section 4.1: a sphere round each initial vertex that the current surface has
/// to meet. A part of the document that lives through simplification and both kinds of swap.
///
/// A vertex that is still in the mesh lies on the surface by itself. Each removed one is answered
/// for by exactly one face, or, where it lay on the free border, by exactly one border edge: its
/// distance to that face or edge is at most its radius. Value type; immutable once built.
class ErrorZones {
 public:
  /// Every vertex of `mesh` is its own zone, of one radius (mm, not negative).
  static ErrorZones start(const Mesh& mesh, double radius);

  /// The zones each face answers for, and each border edge, for `mesh`. `radii`: one value for all
  /// or one per vertex. `border_edges`: ascending, only those that answer for a vertex.
  ErrorZones(std::vector<double> radii, std::vector<std::uint32_t> face_starts,
             std::vector<VertexId> face_zones, std::vector<EdgeId> border_edges,
             std::vector<std::uint32_t> border_starts, std::vector<VertexId> border_zones);

  /// Radius of the zone of one initial vertex, mm.
  double radius(VertexId v) const { return radii_.size() == 1 ? radii_[0] : radii_[v]; }
  /// One value for all, or one per initial vertex.
  const std::vector<double>& radii() const { return radii_; }
  double largest_radius() const;

  std::span<const VertexId> of_face(FaceId f) const {
    return {face_zones_.data() + face_starts_[f], face_zones_.data() + face_starts_[f + 1]};
  }
  /// Empty for edges inside the mesh.
  std::span<const VertexId> of_border_edge(EdgeId e) const;

  /// Initial vertices that are no longer in the mesh.
  std::size_t removed_count() const { return face_zones_.size() + border_zones_.size(); }
  std::size_t face_count() const { return face_starts_.size() - 1; }
  /// An error unless these zones can be those of `mesh`.
  Result<void> check(const Mesh& mesh) const;

  std::size_t bytes() const;
  std::uint64_t hash() const { return hash_; }  ///< Of the content.
  bool operator==(const ErrorZones&) const = default;

 private:
  std::vector<double> radii_;
  std::vector<std::uint32_t> face_starts_;
  std::vector<VertexId> face_zones_;
  std::vector<EdgeId> border_edges_;
  std::vector<std::uint32_t> border_starts_;
  std::vector<VertexId> border_zones_;
  std::uint64_t hash_ = 0;
};

using ErrorZonesPtr = std::shared_ptr<const ErrorZones>;

/// What a preparation phase hands on: the mesh, whose vertices keep their ids (removed ones stay as
/// isolated points), and its zones.
struct Prepared {
  MeshPtr mesh;
  ErrorZonesPtr zones;
  std::uint64_t vertices_before = 0;  ///< In a face, before this phase.
  std::uint64_t vertices_after = 0;
  std::uint64_t swaps = 0;  ///< Edges swapped; 0 after simplify().
};

/// Distance in mm from each initial vertex to the face or border edge that answers for it: 0 for
/// those still in the mesh, NaN for those that never were in a face.
std::vector<double> zone_distances(const Mesh& mesh, const ErrorZones& zones);

}  // namespace arris
