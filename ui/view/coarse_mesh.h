#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace arris::ui {

/// A lighter stand-in for a mesh: vertices in one cell of a grid become one of them.
struct CoarseMesh {
  std::vector<Triangle> triangles;   ///< Between vertices of the mesh.
  std::vector<FaceId> source_faces;  ///< The face each triangle stems from.
  double cell = 0.0;                 ///< Side of a grid cell: how far the surface may be off.
};

/// About `faces` triangles, fewer where the mesh has fewer.
CoarseMesh make_coarse(const Mesh& mesh, std::size_t faces);

}  // namespace arris::ui
