#include "ui/window/places.h"

#include "core/mesh/measurement.h"

namespace arris::ui {

void show_place(MeshView& view, const Mesh& mesh, const std::vector<VertexId>& vertices) {
  if (vertices.empty()) return;
  constexpr double steep = 0.25;  // cosine: about 75 degrees off the line of sight
  const Point normal = mean_normal_at(mesh, vertices);
  if (normal.norm() > 0.0 && normal.dot(view.towards_viewer()) < steep) view.look_against(normal);
  view.zoom_to(vertices);
}

}  // namespace arris::ui
