#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/mesh/scan.h"

namespace arris {

/// One float property per vertex, for write_ply(). Undefined values are NaN.
struct VertexProperty {
  std::string name;
  const std::vector<double>* values;
};

/// Writes `text` to `path` so that the file is replaced only by a whole new one (written beside it,
/// then renamed). Errors: cannot create, write or rename, with the path and the system's reason.
Result<void> write_file_whole(const std::string& path, const std::string& content);

/// Whether write_file_whole() could write to `path` now: to be asked before long work whose result
/// goes there. Errors: its own. Leaves nothing behind.
Result<void> check_writable(const std::string& path);
/// The same for a folder that may have to be made first. Errors: the folder, or one above it, is a
/// file; nothing can be made there.
Result<void> check_folder_writable(const std::string& folder);

/// Binary little-endian PLY of a mesh with vertex properties. Coordinates are written as float
/// where every one of them is a float, else as double.
Result<void> write_ply(const std::string& path, const Mesh& mesh,
                       const std::vector<VertexProperty>& properties);

/// Binary little-endian PLY of the scan as it stood in its file (polygons, order), with one integer
/// face property `partition`. `face_labels`: one per face of scan.mesh. Polygons without a face in
/// the mesh get 0; of the triangles of one polygon the label with the largest area wins (tie: the
/// lower).
Result<void> write_labelled_scan(const std::string& path, const Scan& scan,
                                 const std::vector<std::uint32_t>& face_labels);

}  // namespace arris
