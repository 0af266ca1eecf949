#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

/// Gives equal coordinates (-0 is 0) one number: open addressing over the points themselves.
class Welder {
 public:
  /// New points are added to `points`, which must outlive this; `expected` is how many there may
  /// be.
  Welder(std::vector<Point>& points, std::size_t expected);

  /// The first of the points with these coordinates; it is added where there is none.
  VertexId vertex(const Point& point);

 private:
  // By bits, so that NaN equals itself and many of them cannot fill the table.
  using Key = std::array<std::uint64_t, 3>;
  static Key key_of(const Point& point);
  static std::size_t hash(const Key& key);
  void grow();

  std::vector<Point>& points_;
  std::vector<VertexId> slots_;
};

/// Which vertices are one: where the vertices of a file went.
struct Weld {
  std::vector<VertexId> target;  ///< Of each vertex before, its number after; empty: none joined.
  std::vector<Point> points;     ///< After; each is where the first of its vertices lay.
  std::uint64_t joined = 0;      ///< Vertices that are no longer there.
};

/// Joins vertices of faces that have equal finite coordinates; `corners` names those that are of
/// faces. Linear in their number.
Weld weld_coincident(const std::vector<Point>& points, const std::vector<VertexId>& corners);

/// How many edges of the polygons have one side only, but lie in a pair once `target` is applied:
/// the cuts in the surface that joining would close.
std::uint64_t cuts_closed_by(const std::vector<VertexId>& target,
                             const std::vector<std::uint64_t>& starts,
                             const std::vector<VertexId>& corners);

/// What joining vertices on the border would close.
struct BorderWeld {
  Weld weld;                       ///< Of the vertices before any copy.
  std::uint64_t closed_edges = 0;  ///< Edges of the border that found another side.
};

/// Joins border vertices that lie within `tolerance` of each other where that closes the surface:
/// a group of such vertices is joined only if it lies no wider than the tolerance, no two of it
/// belong to one face, and an edge of the border finds its other side at it.
///
/// `mesh` was built of `points`; its vertex points.size() + k is a copy of vertex copies[k] of
/// them. Edges with more than two faces (`excluded`, ascending) take no part.
BorderWeld weld_border(const Mesh& mesh, const std::vector<Point>& points,
                       const std::vector<VertexId>& copies,
                       const std::vector<EdgeVertices>& excluded, double tolerance);

}  // namespace arris
