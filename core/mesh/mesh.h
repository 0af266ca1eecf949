#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

// EigenVectorT.hh specialises the traits without declaring them, so their header comes first.
#include <OpenMesh/Core/Utils/vector_traits.hh>
// (order matters)
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// (order matters)
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "core/base/result.h"

namespace arris {

using Point = Eigen::Vector3d;
/// Index of a vertex. A vertex is never moved and never renumbered: its id is its index in the
/// loaded scan, for life (document.md, rule 1).
using VertexId = std::uint32_t;
/// Indices of faces, edges and half-edges of one mesh value. They are not stored on disk: there an
/// edge is its sorted pair of vertex ids and a face its triple.
using FaceId = std::uint32_t;
using EdgeId = std::uint32_t;
using HalfEdgeId = std::uint32_t;
inline constexpr std::uint32_t no_id = 0xFFFFFFFFu;

using Triangle = std::array<VertexId, 3>;
using EdgeVertices = std::array<VertexId, 2>;  ///< Smaller id first.

struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = arris::Point;
  using Normal = arris::Point;
  VertexAttributes(OpenMesh::Attributes::None);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::None);
  FaceAttributes(OpenMesh::Attributes::None);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

/// An immutable, conforming, consistently oriented triangle mesh over OpenMesh's half-edges.
///
/// Edges are numbered by their sorted vertex pair, so that the order of edge ids is an order that
/// does not depend on how the mesh came about; half-edge 2e runs from the smaller vertex id of edge
/// e to the larger, 2e+1 back. Isolated vertices are kept (ids are for life). Where a vertex lies
/// on the border, half_edge(v) is the outgoing border half-edge.
class Mesh {
 public:
  /// Builds the half-edge structure.
  /// Errors: an index out of range, a repeated vertex in a face, an edge with more than two faces
  /// or run through twice in one direction, a vertex whose faces do not form one fan. Call
  /// build_mesh() for data that may have such faults.
  static Result<std::shared_ptr<const Mesh>> create(std::vector<Point> points,
                                                    std::vector<Triangle> triangles);

  std::size_t vertex_count() const { return half_edges_.n_vertices(); }
  std::size_t edge_count() const { return edges_.size(); }
  std::size_t face_count() const { return triangles_.size(); }
  std::size_t border_edge_count() const { return border_edge_count_; }

  std::span<const Point> points() const { return {half_edges_.points(), vertex_count()}; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Point& point(VertexId v) const { return half_edges_.points()[v]; }
  const Triangle& triangle(FaceId f) const { return triangles_[f]; }
  const std::vector<EdgeVertices>& edges() const { return edges_; }
  const EdgeVertices& edge(EdgeId e) const { return edges_[e]; }

  static EdgeId edge_of(HalfEdgeId h) { return h >> 1; }
  VertexId to(HalfEdgeId h) const { return edges_[edge_of(h)][(h & 1) ? 0 : 1]; }
  VertexId from(HalfEdgeId h) const { return edges_[edge_of(h)][(h & 1) ? 1 : 0]; }
  static HalfEdgeId opposite(HalfEdgeId h) { return h ^ 1u; }
  HalfEdgeId next(HalfEdgeId h) const {
    return id(half_edges_.next_halfedge_handle(OpenMesh::HalfedgeHandle(static_cast<int>(h))));
  }
  HalfEdgeId previous(HalfEdgeId h) const {
    return id(half_edges_.prev_halfedge_handle(OpenMesh::HalfedgeHandle(static_cast<int>(h))));
  }
  /// no_id on the outer side of the border.
  FaceId face(HalfEdgeId h) const {
    return id(half_edges_.face_handle(OpenMesh::HalfedgeHandle(static_cast<int>(h))));
  }
  /// An outgoing half-edge; no_id for an isolated vertex.
  HalfEdgeId half_edge(VertexId v) const {
    return id(half_edges_.halfedge_handle(OpenMesh::VertexHandle(static_cast<int>(v))));
  }
  /// The half-edge of face f that starts at its first corner.
  HalfEdgeId face_half_edge(FaceId f) const {
    return id(half_edges_.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(f))));
  }
  /// The two faces of an edge; no_id where the scan ends. The first is left of half-edge 2e.
  std::array<FaceId, 2> edge_faces(EdgeId e) const { return {face(2 * e), face(2 * e + 1)}; }
  bool is_border_edge(EdgeId e) const { return face(2 * e) == no_id || face(2 * e + 1) == no_id; }
  /// True for a vertex on the free border. False for an isolated vertex.
  bool is_border(VertexId v) const {
    const HalfEdgeId h = half_edge(v);
    return h != no_id && face(h) == no_id;
  }
  bool is_isolated(VertexId v) const { return half_edge(v) == no_id; }

  /// Calls visit(h) for each outgoing half-edge of v, once round.
  template <class Visit>
  void for_ring(VertexId v, const Visit& visit) const {
    const HalfEdgeId first = half_edge(v);
    if (first == no_id) return;
    HalfEdgeId h = first;
    do {
      visit(h);
      h = next(opposite(h));
    } while (h != first);
  }

  /// The three half-edges of face f, from its first corner on.
  std::array<HalfEdgeId, 3> sides(FaceId f) const {
    const HalfEdgeId first = face_half_edge(f), second = next(first);
    return {first, second, next(second)};
  }

  /// The edge between two vertices, if the mesh has it; either order.
  std::optional<EdgeId> find_edge(VertexId a, VertexId b) const;
  /// The face with these three vertices in any order, if the mesh has it.
  std::optional<FaceId> find_face(const Triangle& vertices) const;

  double edge_length(EdgeId e) const { return (point(edges_[e][1]) - point(edges_[e][0])).norm(); }
  double mean_edge_length() const { return mean_edge_length_; }
  double area() const { return area_; }  ///< Of all faces.
  /// Corners of the bounding box of the vertices that belong to a face.
  const Point& box_min() const { return box_min_; }
  const Point& box_max() const { return box_max_; }
  double diagonal() const { return (box_max_ - box_min_).norm(); }

  /// Content hash of points and triangles.
  const std::string& hash() const { return hash_; }
  std::size_t bytes() const;

 private:
  struct Build;
  Mesh() = default;
  template <class Handle>
  static std::uint32_t id(Handle handle) {
    return static_cast<std::uint32_t>(handle.idx());  // OpenMesh's invalid -1 becomes no_id.
  }

  std::vector<Triangle> triangles_;
  std::vector<EdgeVertices> edges_;
  HalfEdgeMesh half_edges_;
  std::size_t border_edge_count_ = 0;
  double mean_edge_length_ = 0.0, area_ = 0.0;
  Point box_min_ = Point::Zero();
  Point box_max_ = Point::Zero();
  std::string hash_;
};

using MeshPtr = std::shared_ptr<const Mesh>;

}  // namespace arris
