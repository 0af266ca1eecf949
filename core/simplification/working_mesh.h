#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/chunked_array.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"
#include "core/simplification/error_zones.h"

namespace arris {

/// The mesh while a preparation phase changes it: triangles with links to their neighbours in flat
/// arrays, and the zones as linked lists through one array, so that no change allocates.
///
/// Side k of face f runs from corner k to corner k + 1 and has the number 4f + k.
class WorkingMesh {
 public:
  using SideId = std::uint32_t;

  struct Face {
    std::array<VertexId, 3> vertices;  // the first is no_id once the face is gone
    VertexId first_zone = no_id;       // head of the list of zones it answers for
    std::array<SideId, 3> twins;       // the same edge in the neighbour; no_id on the border
    std::uint32_t sharp = 0;           // bit k: side k is a sharp edge
  };

  /// `mesh` must outlive this. `zones` fit it. `sharp`: per edge of it, or empty.
  WorkingMesh(const Mesh& mesh, const ErrorZones& zones, const ChunkedArray<Origin>& sharp);

  const Point& point(VertexId v) const { return points_[v]; }
  std::size_t vertex_slots() const { return points_.size(); }
  std::size_t face_slots() const { return faces_.size(); }
  const Face& face(FaceId f) const { return faces_[f]; }
  Face& face(FaceId f) { return faces_[f]; }
  bool is_gone(FaceId f) const { return faces_[f].vertices[0] == no_id; }

  static FaceId face_of(SideId s) { return s >> 2; }
  static SideId next(SideId s) { return (s & 3u) == 2u ? s - 2 : s + 1; }
  static SideId previous(SideId s) { return (s & 3u) == 0u ? s + 2 : s - 1; }
  SideId twin(SideId s) const { return faces_[s >> 2].twins[s & 3u]; }
  VertexId from(SideId s) const { return faces_[s >> 2].vertices[s & 3u]; }
  VertexId to(SideId s) const { return from(next(s)); }
  bool is_sharp(SideId s) const { return (faces_[s >> 2].sharp >> (s & 3u)) & 1u; }

  /// The side that leaves v first, counter-clockwise: on the border the border side. no_id for a
  /// vertex in no face.
  SideId first_side(VertexId v) const { return first_side_[v]; }
  bool is_in_mesh(VertexId v) const { return first_side_[v] != no_id; }
  bool is_border(VertexId v) const { return (flags_[v] & border_flag) != 0; }
  bool is_on_sharp(VertexId v) const { return (flags_[v] & sharp_flag) != 0; }
  const Point& normal(FaceId f) const { return normals_[f]; }
  double squared_radius(VertexId v) const {
    return squared_radii_.size() == 1 ? squared_radii_[0] : squared_radii_[v];
  }
  std::uint64_t vertices_in_mesh() const { return vertices_in_mesh_; }

  /// Calls visit(s) for each side that leaves v, counter-clockwise.
  template <class Visit>
  void for_sides(VertexId v, const Visit& visit) const {
    const SideId first = first_side_[v];
    SideId s = first;
    do {
      visit(s);
      s = twin(previous(s));
    } while (s != first && s != no_id);
  }
  /// Calls visit(w) for each vertex joined to v.
  template <class Visit>
  void for_neighbours(VertexId v, const Visit& visit) const {
    const SideId first = first_side_[v];
    SideId s = first;
    for (;;) {
      visit(to(s));
      const SideId back = previous(s);
      s = twin(back);
      if (s == first) return;
      if (s == no_id) {
        visit(from(back));
        return;
      }
    }
  }
  bool has_edge(VertexId a, VertexId b) const;

  /// Unit normal of a triangle of these vertices, bit for bit the same whichever comes first.
  Point normal_of(VertexId a, VertexId b, VertexId c) const;
  /// True where the height of a triangle is nothing beside its longest side: it may not be made.
  /// `area`: twice its area.
  static bool is_degenerate(double area, const Point& ab, const Point& ac, const Point& bc) {
    constexpr double least_height_share = 1e-4;
    return !(area >
             least_height_share * std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()}));
  }

  // Zones.
  VertexId next_zone(VertexId v) const { return next_zone_[v]; }
  void add_zone(FaceId f, VertexId v) {
    next_zone_[v] = faces_[f].first_zone;
    faces_[f].first_zone = v;
  }
  /// Zones of the border edge that starts at border vertex v, the face on its left.
  VertexId first_border_zone(VertexId v) const { return first_border_zone_[v]; }
  void clear_border_zones(VertexId v) { first_border_zone_[v] = no_id; }
  void add_border_zone(VertexId start, VertexId v) {
    next_zone_[v] = first_border_zone_[start];
    first_border_zone_[start] = v;
  }

  // Changes.
  /// Rewrites slot f; sides are unlinked and not sharp, it answers for nothing.
  void set_face(FaceId f, VertexId a, VertexId b, VertexId c, const Point& normal);
  /// Makes two sides one edge; `t` no_id: s is on the border.
  void link(SideId s, SideId t) {
    faces_[s >> 2].twins[s & 3u] = t;
    if (t != no_id) faces_[t >> 2].twins[t & 3u] = s;
  }
  void set_sharp(SideId s) { faces_[s >> 2].sharp |= 1u << (s & 3u); }
  /// To be called for each side of each rewritten face once it is linked: its start vertex leaves
  /// by it, unless it is a border vertex and the side is inside.
  void update_first_side(SideId s) {
    const VertexId v = from(s);
    if (twin(s) == no_id || !is_border(v)) first_side_[v] = s;
  }
  void drop_face(FaceId f) { faces_[f].vertices[0] = no_id; }
  void drop_vertex(VertexId v) {
    first_side_[v] = no_id;
    --vertices_in_mesh_;
  }
  void set_radii(std::vector<double> radii);

  /// The mesh and zones as values. Faces keep the order of their slots. Errors: those of
  /// Mesh::create().
  Result<Prepared> finish() const;

 private:
  static constexpr std::uint8_t border_flag = 1, sharp_flag = 2;

  std::span<const Point> points_;
  std::vector<Face> faces_;
  std::vector<Point> normals_;
  std::vector<SideId> first_side_;
  std::vector<VertexId> next_zone_;
  std::vector<VertexId> first_border_zone_;
  std::vector<std::uint8_t> flags_;
  std::vector<double> radii_, squared_radii_;
  std::uint64_t vertices_in_mesh_ = 0;
  std::uint64_t vertices_before_ = 0;
};

/// The sharp edges of `from` that `to` has inside, too: one flag per edge of `to`.
std::vector<Origin> carry_sharp_edges(const Mesh& from, const ChunkedArray<Origin>& sharp,
                                      const Mesh& to);

}  // namespace arris
