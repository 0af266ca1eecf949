#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/mesh/mesh.h"

namespace arris {

/// Vertices that lie where another lies (equal coordinates), and those of the border that lie no
/// farther from another than the last digits of the file tell apart.
struct JoinedVertices {
  std::uint64_t coincident = 0;        ///< Those beside the first on each place.
  std::uint64_t coincident_edges = 0;  ///< Kept apart: edges along which that cuts the surface.
  bool kept_apart = false;             ///< As ScanOptions::weld wished.
  std::uint64_t near = 0;              ///< Joined though their last digits differ.
  std::uint64_t near_edges = 0;        ///< Border edges that found another side by that.
  double tolerance = 0.0;              ///< How far apart those could lie.
};

/// What a file held and what was done so that a half-edge mesh can hold it. Faces are polygon
/// numbers in the file, vertices are vertex ids (index in the file, after vertices on one place
/// were joined), both from 0.
struct LoadReport {
  std::string file;
  std::string format;
  std::string content_hash;
  std::uint64_t file_bytes = 0;

  std::string unit;                ///< As the file names it ("millimeter"); empty: it does not.
  std::vector<std::string> notes;  ///< What the reader has to say, a sentence each.

  std::uint64_t file_vertices = 0;   ///< STL: after its corners were joined.
  std::uint64_t file_faces = 0;      ///< Polygons.
  std::uint64_t welded_corners = 0;  ///< STL only: it names no vertices, so corners are joined.

  JoinedVertices joined;
  double coordinate_step = 0.0;    ///< coordinate_step() of the file; 0: finer than ever needed.
  double distance_in_sizes = 0.0;  ///< Largest coordinate of the mesh over its diagonal.
  double step_over_edge = 0.0;     ///< coordinate_step over the mean edge.
  /// Whether the place of the part costs digits that would be kept near the origin.
  bool step_is_coarse() const;

  // The mesh that came out.
  std::uint64_t vertices = 0;  ///< Isolated ones included.
  std::uint64_t faces = 0;     ///< Triangles.
  std::uint64_t edges = 0;
  std::uint64_t border_edges = 0;
  std::uint64_t border_loops = 0;
  std::uint64_t components = 0;
  std::int64_t euler_number = 0;  ///< V - E + F without isolated vertices.

  /// Vertices that the mesh had before copies were added: copy k has the id original_vertices() +
  /// k.
  std::uint64_t original_vertices() const {
    return file_vertices - (joined.kept_apart ? 0 : joined.coincident) - joined.near;
  }

  // Found, and what was done about it. All but `copies` are ascending, each once; of a polygon with
  // more than three corners it may be only some of its triangles that were left out or turned.
  std::vector<std::uint32_t> split_polygons;    ///< Polygons of more than 3 corners, triangulated.
  std::vector<std::uint32_t> crossed_polygons;  ///< Outline crosses itself: triangles overlap.
  std::vector<std::uint32_t> repeated_corners;  ///< A corner named twice in a row: taken once.
  std::vector<std::uint32_t> degenerate_faces;  ///< < 3 different corners: covers nothing, dropped.
  std::vector<std::uint32_t> zero_area_faces;   ///< Three distinct vertices in a line: kept.
  std::vector<std::uint32_t> duplicate_faces;   ///< Same vertices as an earlier face: left out.
  std::vector<std::uint32_t> non_finite_vertices;  ///< NaN or infinite; their faces are left out.
  std::vector<std::uint32_t> non_finite_faces;
  std::vector<std::uint32_t> isolated_vertices;  ///< In no face: kept, they have no quantities.
  std::vector<EdgeVertices> non_manifold_edges;  ///< More than two faces: paired or cut open.
  std::vector<EdgeVertices> paired_edges;        ///< Those paired: each body keeps its two faces.
  std::vector<EdgeVertices> unorientable_edges;  ///< One-sided surface (Möbius): cut open.
  std::vector<VertexId> non_manifold_vertices;   ///< More than one fan: split into copies.
  std::vector<std::uint32_t> turned_faces;       ///< Turned round to agree with neighbours.
  std::vector<std::uint32_t> left_out_faces;     ///< Still could not be held: left out.
  std::vector<VertexId> copies;                  ///< Copy k is of this vertex.
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
