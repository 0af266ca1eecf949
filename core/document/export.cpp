#include "core/document/export.h"

#include "core/curvature/fields.h"
#include "core/mesh/write_ply.h"

namespace arris {

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
