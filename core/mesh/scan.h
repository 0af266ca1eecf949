#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/mesh/load_report.h"
#include "core/mesh/mesh.h"
#include "core/mesh/polygon_file.h"

namespace arris {

/// A loaded scan: the mesh, the report, and the way back to the file's own faces.
struct Scan {
  MeshPtr mesh;
  LoadReport report;
  std::vector<std::uint32_t> source_faces;  ///< Polygon number in the file of each face of `mesh`.
  /// Points and polygons as in the file; absent where the mesh is the same to the letter.
  std::shared_ptr<const PolygonFile> file;
};

using ScanPtr = std::shared_ptr<const Scan>;

struct ScanOptions {
  /// Vertices with equal coordinates are joined, then vertices of the border that lie no farther
  /// apart than the last digits of the file tell, where that closes the surface. Off: they stay as
  /// the file has them (the corners of STL, which has no vertices, are joined where equal).
  bool weld = true;
};

/// Reads and builds. Errors: those of read_polygon_file() and build_mesh().
Result<ScanPtr> load_scan(const std::string& path, const Context& context = {},
                          const ScanOptions& options = {});
/// The same from polygons in memory; `name` stands for the file name in the report.
Result<ScanPtr> make_scan(PolygonFile polygons, const std::string& name,
                          const Context& context = {}, const ScanOptions& options = {});

}  // namespace arris
