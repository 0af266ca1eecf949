#include "core/mesh/scan.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/machine_memory.h"
#include "core/mesh/build_mesh.h"
#include "core/mesh/coordinate_step.h"
#include "core/mesh/scan_content.h"
#include "core/mesh/weld.h"
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

std::vector<VertexId> applied(const Weld& weld, const std::vector<VertexId>& corners) {
  std::vector<VertexId> result(corners.size());
  for (std::size_t c = 0; c < corners.size(); ++c) result[c] = weld.target[corners[c]];
  return result;
}

/// Vertices as computed twice with the last digits of the file may lie this many of its steps apart
/// (two along each axis, and some).
constexpr double steps_apart = 4.0;

/// What opening a part takes of memory at least: its file's polygons, the mesh and its curvatures.
/// Segmenting takes more (680 bytes a triangle at five millions): what cannot even be opened is
/// refused before it is tried.
constexpr std::uint64_t bytes_per_triangle = 250;

/// Builds the mesh of the vertices that remain when those on one place are joined.
Result<BuiltMesh> build_joined(const PolygonFile& file, const ScanOptions& options,
                               LoadReport& report, const Context& context) {
  Weld weld = weld_coincident(file.points, file.corners);
  const double step = coordinate_step(file.points);
  JoinedVertices joined;
  joined.coincident = weld.joined;
  joined.kept_apart = !options.weld;
  if (!options.weld) {
    if (weld.joined > 0)
      joined.coincident_edges = cuts_closed_by(weld.target, file.starts, file.corners);
    weld = {};
  }
  const bool any = weld.joined > 0;
  const std::vector<VertexId> corners_joined =
      any ? applied(weld, file.corners) : std::vector<VertexId>();
  const std::vector<Point>& points = any ? weld.points : file.points;
  const std::vector<VertexId>& corners = any ? corners_joined : file.corners;

  Result<BuiltMesh> built =
      build_mesh(points, file.starts, corners, report, context.part(0.0, 0.9));
  if (built && options.weld && report.border_edges > 0) {
    const double tolerance = steps_apart * step;
    const BorderWeld closing =
        weld_border(*built->mesh, points, report.copies, report.non_manifold_edges, tolerance);
    if (closing.closed_edges > 0) {
      joined.near = closing.weld.joined;
      joined.near_edges = closing.closed_edges;
      joined.tolerance = tolerance;
      built = build_mesh(closing.weld.points, file.starts, applied(closing.weld, corners), report,
                         context.part(0.9, 1.0));
    }
  }
  if (!built) return built;
  report.file_vertices = file.points.size();
  report.joined = joined;
  report.coordinate_step = step;
  const Mesh& mesh = *built->mesh;
  if (mesh.diagonal() > 0.0)
    report.distance_in_sizes = std::max(mesh.box_min().lpNorm<Eigen::Infinity>(),
                                        mesh.box_max().lpNorm<Eigen::Infinity>()) /
                               mesh.diagonal();
  if (mesh.mean_edge_length() > 0.0)
    report.step_over_edge = report.coordinate_step / mesh.mean_edge_length();
  return built;
}

}  // namespace

Result<ScanPtr> load_scan(const std::string& path, const Context& context,
                          const ScanOptions& options) {
  Result<PolygonFile> file = read_polygon_file(path, context.part(0.0, 0.4));
  if (!file) return tl::unexpected(file.error());
  return make_scan(std::move(*file), path, context.part(0.4, 1.0), options);
}

Result<ScanPtr> load_scan_content(const std::string& path, FileContent content,
                                  const Context& context, const ScanOptions& options) {
  Result<PolygonFile> file = read_polygon_content(path, std::move(content), context.part(0.0, 0.4));
  if (!file) return tl::unexpected(file.error());
  return make_scan(std::move(*file), path, context.part(0.4, 1.0), options);
}

Result<ScanPtr> make_scan(PolygonFile polygons, const std::string& name, const Context& context,
                          const ScanOptions& options) {
  // Each polygon of k corners becomes k - 2 triangles.
  const std::uint64_t corners = polygons.corners.size(), count = polygons.polygon_count();
  const std::uint64_t triangles = corners > 2 * count ? corners - 2 * count : 0;
  const auto fits = check_memory(name + " with its " + std::to_string(triangles) + " triangles",
                                 triangles * bytes_per_triangle);
  if (!fits) return tl::unexpected<Error>(fits.error());
  return within_memory(name, [&]() -> Result<ScanPtr> {
    auto scan = std::make_shared<Scan>();
    scan->report.file = name;
    scan->report.format = polygons.format;
    scan->report.content_hash = polygons.content_hash;
    scan->report.file_bytes = polygons.bytes;
    scan->report.welded_corners = polygons.welded_corners;
    scan->report.unit = polygons.unit;
    scan->report.notes = polygons.notes;
    Result<BuiltMesh> built = build_joined(polygons, options, scan->report, context);
    if (!built) return tl::unexpected(built.error());
    scan->mesh = std::move(built->mesh);
    scan->source_faces = std::move(built->source_faces);
    if (!is_as_in_file(*scan->mesh, polygons))
      scan->file = std::make_shared<const PolygonFile>(std::move(polygons));
    return scan;
  });
}

}  // namespace arris
