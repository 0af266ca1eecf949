#include "core/mesh/scan.h"

#include <cstring>
#include <utility>

#include "core/mesh/build_mesh.h"
#include "core/mesh/within_memory.h"

namespace arris {

namespace {

/// By bytes: -0 is not 0 here, and NaN is itself.
template <class A, class B>
bool same_bytes(const A& a, const B& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0);
}

/// True when the mesh has the points and polygons of the file and nothing else.
bool is_as_in_file(const Mesh& mesh, const PolygonFile& file) {
  if (mesh.face_count() != file.polygon_count() || file.corners.size() != 3 * mesh.face_count() ||
      !same_bytes(mesh.points(), file.points))
    return false;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (file.starts[f] != 3 * std::uint64_t{f}) return false;
  return std::memcmp(mesh.triangles().data(), file.corners.data(),
                     mesh.face_count() * sizeof(Triangle)) == 0;
}

}  // namespace

Result<ScanPtr> load_scan(const std::string& path, const Context& context) {
  Result<PolygonFile> file = read_polygon_file(path, context.part(0.0, 0.4));
  if (!file) return tl::unexpected(file.error());
  return make_scan(std::move(*file), path, context.part(0.4, 1.0));
}

Result<ScanPtr> make_scan(PolygonFile polygons, const std::string& name, const Context& context) {
  return within_memory(name, [&]() -> Result<ScanPtr> {
    auto scan = std::make_shared<Scan>();
    scan->report.file = name;
    scan->report.format = polygons.format;
    scan->report.content_hash = polygons.content_hash;
    scan->report.file_bytes = polygons.bytes;
    scan->report.welded_corners = polygons.welded_corners;
    Result<BuiltMesh> built =
        build_mesh(polygons.points, polygons.starts, polygons.corners, scan->report, context);
    if (!built) return tl::unexpected(built.error());
    scan->mesh = std::move(built->mesh);
    scan->source_faces = std::move(built->source_faces);
    if (!is_as_in_file(*scan->mesh, polygons))
      scan->file = std::make_shared<const PolygonFile>(std::move(polygons));
    return scan;
  });
}

}  // namespace arris
