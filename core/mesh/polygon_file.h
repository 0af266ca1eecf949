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
  /// "STL (binary)", "STL (ASCII)", "PLY", "OBJ", "OFF", "3MF"; of a compressed file with ", gzip".
  std::string format;
  /// Of lengths, as the file names it: "millimeter". 3MF, and PLY as write_ply() writes it, only.
  std::string unit;
  std::vector<std::string> notes;  ///< What is odd about the file, a sentence each.
  std::vector<Point> points;       ///< STL: welded where coordinates are equal.
  std::vector<std::uint64_t>
      starts;                        ///< Polygon k is corners[starts[k]] .. corners[starts[k+1]-1].
  std::vector<VertexId> corners;     ///< Indices into points; each is in range.
  std::uint64_t welded_corners = 0;  ///< STL: corners that were joined with an earlier one.
  std::string content_hash;          ///< Of the file's bytes (Hasher).
  std::uint64_t bytes = 0;           ///< Size of the file.

  std::size_t polygon_count() const { return starts.empty() ? 0 : starts.size() - 1; }
};

/// Reads STL (binary or ASCII), PLY (ASCII, little or big endian), OBJ, OFF (plain, COFF, NOFF,
/// ...) or 3MF, the first four also compressed by gzip. The content decides, the name's ending only
/// where the content cannot. Where programs write otherwise than the format says, but what is meant
/// is beyond doubt, the file is read and `notes` says so.
///
/// Errors, one sentence each with the path and the line or element: no such file, a directory, an
/// empty file, an unknown format (named where it is a known one), a truncated file, an absurd count
/// (checked against the file's size before anything is allocated), an index out of range, no faces
/// at all, more than 2^31 elements, a compressed file that grows more than 200 times. NaN and
/// infinite coordinates are read as they are; build_mesh() deals with them.
Result<PolygonFile> read_polygon_file(const std::string& path, const Context& context = {});

}  // namespace arris
