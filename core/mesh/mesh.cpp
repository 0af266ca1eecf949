#include "core/mesh/mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "core/base/hash.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

std::string edge_name(VertexId a, VertexId b) {
  return std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
}

/// One side of a face: the far (larger) vertex, the corner it starts from and its direction.
struct Side {
  VertexId far_vertex;
  std::uint32_t corner;  // 3 * face + corner index of the start of the half-edge
  bool forward;          // runs from the smaller vertex id to the larger
};

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

HalfedgeHandle handle(HalfEdgeId h) { return HalfedgeHandle(static_cast<int>(h)); }

}  // namespace

/// What a mesh is built with.
struct Mesh::Build {
  Mesh& mesh;
  std::vector<Triangle>& triangles;
  const std::size_t vertex_count, face_count;
  std::vector<std::uint32_t> starts;  // of the sides of each vertex
  std::vector<Side> sides;
  std::vector<HalfEdgeId> half_edge_of;     // of each corner
  std::vector<std::array<bool, 2>> used;    // of each edge: its half-edges that have a face
  std::vector<std::uint32_t> corner_count;  // of each vertex

  Result<void> sort_sides();
  Result<void> number_edges();
  void link_faces();
  Result<void> link_border();
  Result<void> check_fans();
  void measure();
};

/// The sides of all faces by the smaller of their vertices. Errors: a face names a vertex that is
/// not there, or one twice.
Result<void> Mesh::Build::sort_sides() {
  starts.assign(vertex_count + 1, 0);
  for (std::size_t f = 0; f < face_count; ++f) {
    const Triangle& t = triangles[f];
    for (int k = 0; k < 3; ++k) {
      const VertexId a = t[k], b = t[(k + 1) % 3];
      if (a >= vertex_count)
        return fail("Face " + std::to_string(f) + " names vertex " + std::to_string(a) +
                    ", but there are only " + std::to_string(vertex_count) + " vertices.");
      if (a == b)
        return fail("Face " + std::to_string(f) + " has vertex " + std::to_string(a) + " twice.");
      if (b < vertex_count) ++starts[std::min(a, b) + 1];
    }
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  sides.resize(3 * face_count);
  {
    std::vector<std::uint32_t> cursor(starts.begin(), starts.end() - 1);
    for (std::size_t f = 0; f < face_count; ++f)
      for (int k = 0; k < 3; ++k) {
        const VertexId a = triangles[f][k], b = triangles[f][(k + 1) % 3];
        sides[cursor[std::min(a, b)]++] = {std::max(a, b), static_cast<std::uint32_t>(3 * f + k),
                                           a < b};
      }
  }
  return {};
}

/// Edges in the order of their vertices. Errors: one has more than two faces, or two that run the
/// same way.
Result<void> Mesh::Build::number_edges() {
  half_edge_of.resize(3 * face_count);
  mesh.edges_.reserve(face_count * 3 / 2 + 16);
  used.reserve(face_count * 3 / 2 + 16);
  for (VertexId a = 0; a < vertex_count; ++a) {
    const auto begin = sides.begin() + starts[a], end = sides.begin() + starts[a + 1];
    std::sort(begin, end, [](const Side& x, const Side& y) {
      return x.far_vertex != y.far_vertex ? x.far_vertex < y.far_vertex : x.corner < y.corner;
    });
    for (auto side = begin; side != end; ++side) {
      if (side == begin || side->far_vertex != (side - 1)->far_vertex) {
        mesh.edges_.push_back({a, side->far_vertex});
        used.push_back({false, false});
      }
      const int direction = side->forward ? 0 : 1;
      if (used.back()[direction])
        return fail("Edge " + edge_name(a, side->far_vertex) +
                    " has more than two faces, or two that run the same way.");
      used.back()[direction] = true;
      half_edge_of[side->corner] =
          static_cast<HalfEdgeId>(2 * (mesh.edges_.size() - 1) + direction);
    }
  }
  sides = {};
  return {};
}

void Mesh::Build::link_faces() {
  HalfEdgeMesh& om = mesh.half_edges_;
  om.resize(vertex_count, mesh.edges_.size(), face_count);
  for (std::size_t e = 0; e < mesh.edges_.size(); ++e) {
    om.set_vertex_handle(handle(2 * e), VertexHandle(static_cast<int>(mesh.edges_[e][1])));
    om.set_vertex_handle(handle(2 * e + 1), VertexHandle(static_cast<int>(mesh.edges_[e][0])));
  }
  corner_count.assign(vertex_count, 0);
  for (std::size_t f = 0; f < face_count; ++f) {
    const FaceHandle face(static_cast<int>(f));
    om.set_halfedge_handle(face, handle(half_edge_of[3 * f]));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeHandle h = handle(half_edge_of[3 * f + k]);
      om.set_face_handle(h, face);
      om.set_next_halfedge_handle(h, handle(half_edge_of[3 * f + (k + 1) % 3]));
      ++corner_count[triangles[f][k]];
      om.set_halfedge_handle(VertexHandle(static_cast<int>(triangles[f][k])), h);
    }
  }
}

/// Errors: a vertex has more than one fan of faces.
Result<void> Mesh::Build::link_border() {
  HalfEdgeMesh& om = mesh.half_edges_;
  // Border half-edges: each vertex of a single fan has at most one outgoing one; link them.
  for (std::size_t e = 0; e < mesh.edges_.size(); ++e)
    for (int side = 0; side < 2; ++side) {
      if (used[e][side]) continue;
      const HalfEdgeId h = static_cast<HalfEdgeId>(2 * e + side);
      const VertexId from = mesh.from(h);
      const VertexHandle vertex(static_cast<int>(from));
      const HalfedgeHandle known = om.halfedge_handle(vertex);
      if (!om.face_handle(known).is_valid())
        return fail("Vertex " + std::to_string(from) + " has more than one fan of faces.");
      om.set_halfedge_handle(vertex, handle(h));
      ++mesh.border_edge_count_;
    }
  for (std::size_t e = 0; e < mesh.edges_.size(); ++e)
    for (int side = 0; side < 2; ++side) {
      if (used[e][side]) continue;
      const HalfEdgeId h = static_cast<HalfEdgeId>(2 * e + side);
      const HalfedgeHandle next = om.halfedge_handle(VertexHandle(static_cast<int>(mesh.to(h))));
      om.set_next_halfedge_handle(handle(h), next);
    }
  return {};
}

/// Errors: a vertex has more than one fan of faces.
Result<void> Mesh::Build::check_fans() {
  for (VertexId v = 0; v < vertex_count; ++v) {
    std::uint32_t fan = 0;
    mesh.for_ring(v, [&](HalfEdgeId h) { fan += mesh.face(h) != no_id; });
    if (fan != corner_count[v])
      return fail("Vertex " + std::to_string(v) + " has more than one fan of faces.");
  }
  return {};
}

void Mesh::Build::measure() {
  double length = 0.0;
  for (EdgeId e = 0; e < mesh.edges_.size(); ++e) length += mesh.edge_length(e);
  if (!mesh.edges_.empty()) mesh.mean_edge_length_ = length / mesh.edges_.size();
  for (FaceId f = 0; f < mesh.face_count(); ++f) mesh.area_ += face_area(mesh, f);
  bool first = true;
  for (VertexId v = 0; v < vertex_count; ++v) {
    if (mesh.is_isolated(v)) continue;
    const Point& p = mesh.point(v);
    mesh.box_min_ = first ? p : Point(mesh.box_min_.cwiseMin(p));
    mesh.box_max_ = first ? p : Point(mesh.box_max_.cwiseMax(p));
    first = false;
  }
}

Result<MeshPtr> Mesh::create(std::vector<Point> points, std::vector<Triangle> triangles) {
  const std::size_t vertex_count = points.size();
  const std::size_t face_count = triangles.size();
  if (vertex_count >= static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
      face_count >= static_cast<std::size_t>(std::numeric_limits<int>::max()) / 6)
    return fail("The mesh has more elements than 32-bit ids can number.");

  std::shared_ptr<Mesh> mesh(new Mesh());
  Build build{*mesh, triangles, vertex_count, face_count, {}, {}, {}, {}, {}};
  if (auto done = build.sort_sides(); !done) return tl::unexpected<Error>(done.error());
  if (auto done = build.number_edges(); !done) return tl::unexpected<Error>(done.error());
  build.link_faces();
  if (auto done = build.link_border(); !done) return tl::unexpected<Error>(done.error());
  for (VertexId v = 0; v < vertex_count; ++v)
    mesh->half_edges_.set_point(VertexHandle(static_cast<int>(v)), points[v]);
  mesh->triangles_ = std::move(triangles);
  if (auto done = build.check_fans(); !done) return tl::unexpected<Error>(done.error());
  build.measure();
  Hasher hasher;
  hasher.number(vertex_count);
  hasher.bytes(points.data(), vertex_count * sizeof(Point));
  hasher.number(face_count);
  hasher.bytes(mesh->triangles_.data(), face_count * sizeof(Triangle));
  mesh->hash_ = hasher.hex();
  return MeshPtr(std::move(mesh));
}

std::optional<EdgeId> Mesh::find_edge(VertexId a, VertexId b) const {
  const EdgeVertices wanted{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), wanted);
  if (found == edges_.end() || *found != wanted) return std::nullopt;
  return static_cast<EdgeId>(found - edges_.begin());
}

std::optional<FaceId> Mesh::find_face(const Triangle& vertices) const {
  const std::optional<EdgeId> e = find_edge(vertices[0], vertices[1]);
  if (!e) return std::nullopt;
  for (const HalfEdgeId h : {2 * *e, 2 * *e + 1})
    if (face(h) != no_id && to(next(h)) == vertices[2]) return face(h);
  return std::nullopt;
}

std::size_t Mesh::bytes() const {
  return vertex_count() * (sizeof(Point) + 4) + triangles_.size() * (sizeof(Triangle) + 4) +
         edges_.size() * (sizeof(EdgeVertices) + 2 * 16);
}

}  // namespace arris
