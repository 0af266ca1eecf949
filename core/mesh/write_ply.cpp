#include "core/mesh/write_ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "core/base/write_file.h"
#include "core/mesh/within_memory.h"

namespace arris {

namespace {

template <class T>
void append(std::string& out, T value) {
  std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

/// The cast alone is undefined beyond the largest float.
float to_float(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (std::abs(x) > largest) return std::copysign(std::numeric_limits<float>::infinity(), x);
  return static_cast<float>(x);
}

bool is_float(double x) { return std::isnan(x) || static_cast<double>(to_float(x)) == x; }

bool are_floats(std::span<const Point> points) {
  return std::all_of(points.begin(), points.end(), [](const Point& p) {
    return is_float(p.x()) && is_float(p.y()) && is_float(p.z());
  });
}

std::string header_begin(std::span<const Point> points, bool floats, LengthUnit unit) {
  const std::string type = floats ? "float" : "double";
  return "ply\nformat binary_little_endian 1.0\ncomment written by Arris\n" +
         (unit == LengthUnit::unknown
              ? ""
              : "comment lengths in " + std::string(info_of(unit).name) + "\n") +
         "element vertex " + std::to_string(points.size()) + "\nproperty " + type +
         " x\nproperty " + type + " y\nproperty " + type + " z\n";
}

void append_point(std::string& out, const Point& point, bool floats) {
  for (const double x : point)
    if (floats)
      append(out, to_float(x));
    else
      append(out, x);
}

void append_triangle(std::string& out, const Triangle& triangle) {
  append(out, std::uint8_t{3});
  for (const VertexId v : triangle) append(out, v);
}

double area(const Mesh& mesh, FaceId f) {
  const auto& [a, b, c] = mesh.triangle(f);
  return 0.5 * (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)).norm();
}

/// One label per polygon of the file.
std::vector<std::uint32_t> polygon_labels(const Scan& scan,
                                          const std::vector<std::uint32_t>& face_labels,
                                          std::size_t polygon_count) {
  std::vector<std::uint32_t> result(polygon_count, 0);
  std::vector<std::pair<std::uint32_t, double>> areas;  // by label, of one polygon
  for (FaceId begin = 0; begin < face_labels.size();) {
    const std::uint32_t polygon = scan.source_faces[begin];
    areas.clear();
    FaceId end = begin;
    for (; end < face_labels.size() && scan.source_faces[end] == polygon; ++end)
      areas.emplace_back(face_labels[end], area(*scan.mesh, end));
    begin = end;
    std::stable_sort(areas.begin(), areas.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    double largest = -1.0;
    for (std::size_t i = 0; i < areas.size();) {
      const std::uint32_t label = areas[i].first;
      double sum = 0.0;
      for (; i < areas.size() && areas[i].first == label; ++i) sum += areas[i].second;
      // The halves of a square tie, whatever rounding makes of them.
      if (largest < 0.0 || sum > largest * (1.0 + 1e-9)) {
        largest = sum;
        result[polygon] = label;
      }
    }
  }
  return result;
}

}  // namespace

Result<void> write_ply(const std::string& path, const Mesh& mesh,
                       const std::vector<VertexProperty>& properties, LengthUnit unit) {
  const bool floats = are_floats(mesh.points());
  std::string content = header_begin(mesh.points(), floats, unit);
  for (const VertexProperty& property : properties) {
    if (property.name.empty() || property.name.find_first_of(" \t\r\n\v\f") != std::string::npos)
      return fail(path + " cannot be written: \"" + property.name +
                  "\" is no name for a PLY property.");
    if (property.values->size() != mesh.vertex_count())
      return fail(path + " cannot be written: property " + property.name + " has " +
                  std::to_string(property.values->size()) + " values for " +
                  std::to_string(mesh.vertex_count()) + " vertices.");
    content += "property float " + property.name + "\n";
  }
  content += "element face " + std::to_string(mesh.face_count()) +
             "\nproperty list uchar int vertex_indices\nend_header\n";
  return within_memory(path, [&] {
    content.reserve(content.size() + 13 * mesh.face_count() +
                    mesh.vertex_count() * ((floats ? 12 : 24) + 4 * properties.size()));
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      append_point(content, mesh.point(v), floats);
      for (const VertexProperty& property : properties)
        append(content, to_float((*property.values)[v]));
    }
    for (const Triangle& triangle : mesh.triangles()) append_triangle(content, triangle);
    return write_file_whole(path, content);
  });
}

Result<void> write_labelled_scan(const std::string& path, const Scan& scan,
                                 const std::vector<std::uint32_t>& face_labels, LengthUnit unit) {
  const Mesh& mesh = *scan.mesh;
  if (face_labels.size() != mesh.face_count())
    return fail(path + " cannot be written: there are " + std::to_string(face_labels.size()) +
                " labels for " + std::to_string(mesh.face_count()) + " faces.");
  constexpr std::uint32_t most = std::numeric_limits<std::int32_t>::max();
  if (std::any_of(face_labels.begin(), face_labels.end(),
                  [](std::uint32_t label) { return label > most; }))
    return fail(path + " cannot be written: a label is larger than " + std::to_string(most) + ".");
  return within_memory(path, [&] {
    const PolygonFile* const file = scan.file.get();
    const std::span<const Point> points =
        file ? std::span<const Point>(file->points) : mesh.points();
    const std::size_t polygon_count = file ? file->polygon_count() : mesh.face_count();
    bool long_lists = false;  // more corners than a uchar counts
    for (std::size_t k = 0; file && k < polygon_count; ++k)
      long_lists = long_lists || file->starts[k + 1] - file->starts[k] > 255;

    const bool floats = are_floats(points);
    std::string content = header_begin(points, floats, unit);
    content += "element face " + std::to_string(polygon_count) + "\nproperty list " +
               (long_lists ? "uint" : "uchar") +
               " int vertex_indices\nproperty int partition\nend_header\n";
    content.reserve(content.size() + points.size() * (floats ? 12 : 24) +
                    polygon_count * (long_lists ? 8 : 5) +
                    4 * (file ? file->corners.size() : 3 * mesh.face_count()));
    for (const Point& point : points) append_point(content, point, floats);
    if (!file) {
      for (FaceId f = 0; f < mesh.face_count(); ++f) {
        append_triangle(content, mesh.triangle(f));
        append(content, face_labels[f]);
      }
      return write_file_whole(path, content);
    }
    const std::vector<std::uint32_t> labels = polygon_labels(scan, face_labels, polygon_count);
    for (std::size_t k = 0; k < polygon_count; ++k) {
      const std::uint64_t begin = file->starts[k], end = file->starts[k + 1];
      if (long_lists)
        append(content, static_cast<std::uint32_t>(end - begin));
      else
        append(content, static_cast<std::uint8_t>(end - begin));
      for (std::uint64_t c = begin; c < end; ++c) append(content, file->corners[c]);
      append(content, labels[k]);
    }
    return write_file_whole(path, content);
  });
}

}  // namespace arris
