#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/length_unit.h"
#include "core/mesh/mesh.h"
#include "core/mesh/scan.h"

namespace arris {

/// One float property per vertex, for write_ply(). Undefined values are NaN.
struct VertexProperty {
  std::string name;
  const std::vector<double>* values;
};

/// Binary little-endian PLY of a mesh with vertex properties. PLY has no units: a comment names
/// that of lengths where it is known. Coordinates are written as float
/// where every one of them is a float, else as double.
Result<void> write_ply(const std::string& path, const Mesh& mesh,
                       const std::vector<VertexProperty>& properties,
                       LengthUnit unit = LengthUnit::unknown);

/// Binary little-endian PLY of the scan as it stood in its file (polygons, order), with one integer
/// face property `partition`. `face_labels`: one per face of scan.mesh. Polygons without a face in
/// the mesh get 0; of the triangles of one polygon the label with the largest area wins (tie: the
/// lower).
Result<void> write_labelled_scan(const std::string& path, const Scan& scan,
                                 const std::vector<std::uint32_t>& face_labels,
                                 LengthUnit unit = LengthUnit::unknown);

}  // namespace arris
