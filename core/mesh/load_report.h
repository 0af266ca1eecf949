#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/mesh/mesh.h"

namespace arris {

/// What a file held and what was done so that a half-edge mesh can hold it. Faces are polygon
/// numbers in the file, vertices are vertex ids (index in the file; for STL after welding), both
/// from 0.
struct LoadReport {
  std::string file;
  std::string format;
  std::string content_hash;
  std::uint64_t file_bytes = 0;

  std::uint64_t file_vertices = 0;
  std::uint64_t file_faces = 0;      ///< Polygons.
  std::uint64_t welded_corners = 0;  ///< STL only.

  // The mesh that came out.
  std::uint64_t vertices = 0;  ///< Isolated ones included.
  std::uint64_t faces = 0;     ///< Triangles.
  std::uint64_t edges = 0;
  std::uint64_t border_edges = 0;
  std::uint64_t border_loops = 0;
  std::uint64_t components = 0;
  std::int64_t euler_number = 0;  ///< V - E + F without isolated vertices.

  // Found, and what was done about it. All but `copies` are ascending, each once; of a polygon with
  // more than three corners it may be only some of its triangles that were left out or turned.
  std::vector<std::uint32_t> split_polygons;    ///< Polygons of more than 3 corners, triangulated.
  std::vector<std::uint32_t> degenerate_faces;  ///< Repeated vertex or < 3 corners: left out.
  std::vector<std::uint32_t> zero_area_faces;   ///< Three distinct vertices in a line: kept.
  std::vector<std::uint32_t> duplicate_faces;   ///< Same vertices as an earlier face: left out.
  std::vector<std::uint32_t> non_finite_vertices;  ///< NaN or infinite; their faces are left out.
  std::vector<std::uint32_t> non_finite_faces;
  std::vector<std::uint32_t> isolated_vertices;  ///< In no face: kept, they have no quantities.
  std::vector<EdgeVertices> non_manifold_edges;  ///< More than two faces: cut open.
  std::vector<EdgeVertices> unorientable_edges;  ///< One-sided surface (Möbius): cut open.
  std::vector<VertexId> non_manifold_vertices;   ///< More than one fan: split into copies.
  std::vector<std::uint32_t> turned_faces;       ///< Turned round to agree with neighbours.
  std::vector<std::uint32_t> left_out_faces;     ///< Still could not be held: left out.
  std::vector<VertexId> copies;                  ///< Copy k has id file_vertices + k, of this one.
  bool looks_inside_out = false;  ///< Closed and with negative volume: flip_orientation mends it.

  /// True when nothing had to be split, turned or left out, and nothing else in the lists above
  /// was found: just when there are no sentences().
  bool clean() const;
  /// One sentence per finding, worst first; empty when clean. Vertices and faces are counted from 0
  /// there too, edges are named by their vertices ("123-456").
  std::vector<std::string> sentences() const;
  /// Every count, and of every list its length and its first elements (up to 1,000).
  nlohmann::json to_json() const;
};

}  // namespace arris
