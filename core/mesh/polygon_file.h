#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace arris {

/// A mesh file as it stands: points and polygons in the order of the file, nothing mended.
struct PolygonFile {
  std::string format;         ///< "STL (binary)", "STL (ASCII)", "PLY", "OBJ", "OFF".
  std::vector<Point> points;  ///< STL: welded where coordinates are equal.
  std::vector<std::uint64_t>
      starts;                        ///< Polygon k is corners[starts[k]] .. corners[starts[k+1]-1].
  std::vector<VertexId> corners;     ///< Indices into points; each is in range.
  std::uint64_t welded_corners = 0;  ///< STL: corners that were joined with an earlier one.
  std::string content_hash;          ///< Of the file's bytes (Hasher).
  std::uint64_t bytes = 0;           ///< Size of the file.

  std::size_t polygon_count() const { return starts.empty() ? 0 : starts.size() - 1; }
};

/// Reads STL (binary or ASCII), PLY (ASCII, little or big endian), OBJ or OFF (plain, COFF, NOFF,
/// ...). The content decides, the name's ending only where the content cannot.
///
/// Errors, one sentence each with the path and the line or element: no such file, a directory, an
/// empty file, an unknown format, a truncated file, an absurd count (checked against the file's
/// size before anything is allocated), an index out of range, no faces at all, more than 2^31
/// elements. NaN and infinite coordinates are read as they are; build_mesh() deals with them.
Result<PolygonFile> read_polygon_file(const std::string& path, const Context& context = {});

}  // namespace arris
