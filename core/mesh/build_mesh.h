#pragma once

#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/mesh/load_report.h"
#include "core/mesh/mesh.h"

namespace arris {

/// A mesh built from data with faults, and where each part of it came from.
struct BuiltMesh {
  MeshPtr mesh;
  std::vector<std::uint32_t> source_faces;  ///< Polygon number of each face of the mesh; ascending.
};

/// Builds a conforming, oriented mesh from polygons, never silently: every repair is listed in
/// `report` (whose counts it fills in; file, format, hash, bytes and welded corners are the
/// caller's).
///
/// In this order: polygons are cut into triangles (cut_polygon(); a corner named twice in a row is
/// one); faces with non-finite points, fewer than three different corners, or the vertices of an
/// earlier face are left out; edges with more than two faces are paired into bodies where each pair
/// encloses a wedge of its own; faces are turned so that neighbours agree, the minority of each
/// component; other edges with more than two faces, and those that cannot be oriented, are cut
/// open; vertices with more than one fan are split, the first fan keeps the vertex, the others get
/// copies at the end of the vertex list (same position).
///
/// The ids of existing vertices never change. No face changes places with another. Whole components
/// are never turned: see LoadReport::looks_inside_out. Errors: no face is left, too many of them.
///
/// `points`: positions. `starts`, `corners`: polygons as in PolygonFile, indices in range.
Result<BuiltMesh> build_mesh(std::vector<Point> points, const std::vector<std::uint64_t>& starts,
                             const std::vector<VertexId>& corners, LoadReport& report,
                             const Context& context = {});

}  // namespace arris
