#include "core/document/export.h"

#include <unordered_map>

#include "core/base/number_text.h"
#include "core/curvature/fields.h"
#include "core/mesh/write_ply.h"

namespace arris {

namespace {

/// OBJ with polylines; each vertex is written once, before its first line.
class PolylineObj {
 public:
  explicit PolylineObj(const Document& document) : mesh_(*document.mesh) {
    const LengthUnit unit = length_unit_of(document);
    text_ =
        "# Arris; lengths in " +
        (unit == LengthUnit::unknown ? "the unit of the scan" : std::string(info_of(unit).name)) +
        "\n";
  }

  void add(const std::string& group, const std::vector<VertexId>& path) {
    std::string indices;
    for (const VertexId v : path) {
      const auto [it, fresh] = index_.try_emplace(v, index_.size() + 1);
      if (fresh) {
        const Point& p = mesh_.point(v);
        text_ += "v " + number_text(p.x(), 12) + " " + number_text(p.y(), 12) + " " +
                 number_text(p.z(), 12) + "\n";
      }
      indices += " " + std::to_string(it->second);
    }
    text_ += "g " + group + "\nl" + indices + "\n";
  }
  std::string take() { return std::move(text_); }

 private:
  const Mesh& mesh_;
  std::unordered_map<VertexId, std::size_t> index_;
  std::string text_;
};

}  // namespace

std::string lines_obj(const Document& document) {
  PolylineObj obj(document);
  for (const LinePtr& line : document.lines.lines)
    obj.add("line_" + std::to_string(line->id) + (line->convex() ? "_convex" : "_concave"),
            line->vertices);
  return obj.take();
}

std::string boundaries_obj(const Document& document) {
  PolylineObj obj(document);
  std::size_t number = 0;
  for (const BoundaryPtr& boundary : *document.boundaries) {
    std::string group = "boundary_" + std::to_string(++number) + "_";
    group += name_of(boundary->type);
    if (boundary->type == BoundaryType::c0) group += "_line" + std::to_string(boundary->line);
    for (const std::uint32_t id : {boundary->left, boundary->right})
      if (id != 0) group += "_p" + std::to_string(id);
    obj.add(group, boundary->vertices);
  }
  return obj.take();
}

Result<void> write_curvature_ply(const std::string& path, const Document& document) {
  std::vector<std::vector<double>> values;
  std::vector<VertexProperty> properties;
  constexpr Field fields[] = {Field::k, Field::h, Field::kabs, Field::ik, Field::ih, Field::ikabs};
  values.reserve(std::size(fields));
  for (const Field field : fields) {
    values.push_back(field_values(*document.curvatures, field));
    properties.push_back({std::string(info_of(field).name), &values.back()});
  }
  return write_ply(path, *document.mesh, properties, length_unit_of(document));
}

}  // namespace arris
