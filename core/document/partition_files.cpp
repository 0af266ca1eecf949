#include "core/document/partition_files.h"

#include <numbers>
#include <vector>

#include "core/base/number_text.h"
#include "core/document/handed_curves.h"
#include "core/mesh/geometry.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"

namespace arris {

namespace {

constexpr int digits = 12;

void add_points(const Mesh& mesh, std::string_view before, std::string& text) {
  for (const Point& p : mesh.points()) {
    text += before;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) text += ' ';
      text += number_text(p[axis], digits);
    }
    text += '\n';
  }
}

}  // namespace

std::string partitions_obj(const Document& document) {
  const Mesh& mesh = *document.mesh;
  std::string text = "# Arris; lengths in " + lengths_in(length_unit_of(document)) + "\n";
  add_points(mesh, "v ", text);
  const auto add_group = [&](const std::string& name, const std::vector<FaceId>& faces) {
    if (faces.empty()) return;
    text += "g " + name + "\n";
    for (const FaceId f : faces) {
      text += 'f';
      for (const VertexId v : mesh.triangle(f)) text += ' ' + std::to_string(v + 1);
      text += '\n';
    }
  };
  const std::vector<PartitionPtr>& partitions = document.partitions.partitions;
  std::uint32_t most = 0;
  for (const PartitionPtr& partition : partitions) most = std::max(most, partition->id);
  std::vector<std::vector<FaceId>> faces(most + 1);
  for (FaceId f = 0; f < mesh.face_count(); ++f) faces[document.partitions.label(f)].push_back(f);
  for (const PartitionPtr& partition : partitions)
    add_group("partition_" + std::to_string(partition->id), faces[partition->id]);
  add_group("unassigned", faces[0]);
  return text;
}

std::string partitions_vtp(const Document& document) {
  const Mesh& mesh = *document.mesh;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(mesh.vertex_count()) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      std::to_string(mesh.face_count()) +
      "\">\n<CellData Scalars=\"partition\">\n<DataArray type=\"UInt32\" format=\"ascii\" "
      "Name=\"partition\">\n";
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    text += std::to_string(document.partitions.label(f)) + "\n";
  text +=
      "</DataArray>\n</CellData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">\n";
  add_points(mesh, "", text);
  text +=
      "</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">\n";
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    text += std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  text += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    text += std::to_string(3 * (static_cast<std::uint64_t>(f) + 1)) + "\n";
  return text + "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

Result<std::string> partition_table_csv(const Document& document) {
  const Mesh& mesh = *document.mesh;
  const Partitions& partitions = document.partitions;
  const auto surfaces = fit_partition_surfaces(mesh, document.lines, partitions);
  if (!surfaces) return tl::unexpected<Error>(surfaces.error());
  const std::vector<Outline> outlines = outlines_of(mesh, document.lines, partitions);
  double whole = 0.0;
  for (FaceId f = 0; f < mesh.face_count(); ++f) whole += face_area(mesh, f);
  std::string text =
      "partition,faces,area,area_share,sides,holes,surface,radius,tube_radius,half_angle_degrees,"
      "mean_deviation,max_deviation,within_tolerance,approved\n";
  const auto cell = [&](double value) { text += "," + number_text(value, digits); };
  for (std::size_t k = 0; k < partitions.partitions.size(); ++k) {
    const Partition& partition = *partitions.partitions[k];
    const PartitionSurface& fit = (*surfaces)[k];
    const Surface& surface = fit.surface;
    text += std::to_string(partition.id) + "," + std::to_string(partition.faces);
    cell(partition.area);
    cell(whole > 0.0 ? partition.area / whole : 0.0);
    cell(static_cast<double>(outlines[k].sides()));
    cell(static_cast<double>(outlines[k].loops.empty() ? 0 : outlines[k].loops.size() - 1));
    text += ",";
    text += name_of(surface.type);
    const auto cell_if = [&](bool has, double value) {
      if (has)
        cell(value);
      else
        text += ",";
    };
    const SurfaceType type = surface.type;
    cell_if(
        type == SurfaceType::sphere || type == SurfaceType::cylinder || type == SurfaceType::torus,
        surface.radius);
    cell_if(type == SurfaceType::torus || type == SurfaceType::blend, surface.tube);
    cell_if(type == SurfaceType::cone, surface.half_angle * 180.0 / std::numbers::pi);
    cell_if(fit.fitted, fit.mean_deviation);
    cell_if(fit.fitted, fit.max_deviation);
    cell_if(fit.fitted, fit.within);
    text += partition.locked ? ",1\n" : ",0\n";
  }
  return text;
}

}  // namespace arris
