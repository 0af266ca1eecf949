#include "core/document/partition_files.h"

#include <vector>

#include "core/base/number_text.h"
#include "core/document/handed_curves.h"

namespace arris {

namespace {

void add_points(const Mesh& mesh, std::string_view before, std::string& text) {
  for (const Point& p : mesh.points()) {
    text += before;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) text += ' ';
      text += number_text(p[axis], file_digits);
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

}  // namespace arris
