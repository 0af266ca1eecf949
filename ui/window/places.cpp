#include "ui/window/places.h"

#include <optional>

#include <Eigen/Geometry>

#include "core/mesh/measurement.h"

namespace arris::ui {

namespace {

/// Whether something else lies before these vertices, which the middle of the view looks at.
bool is_hidden(MeshView& view, const Mesh& mesh, const std::vector<VertexId>& vertices) {
  const std::optional<Pick> pick = view.pick(view.rect().center());
  if (!pick) return false;  // they lie round an opening
  Eigen::AlignedBox3d box;
  for (const VertexId v : vertices)
    if (v < mesh.vertex_count()) box.extend(mesh.point(v));
  if (box.isEmpty()) return false;
  const double slack = 3.0 * mesh.mean_edge_length();
  return box.exteriorDistance(pick->point) > slack;
}

}  // namespace

void show_place(MeshView& view, const Mesh& mesh, const std::vector<VertexId>& vertices) {
  if (vertices.empty()) return;
  constexpr double steep = 0.5;  // cosine: 60 degrees off the line of sight
  const Point normal = mean_normal_at(mesh, vertices);
  bool turn = normal.dot(view.towards_viewer()) < steep;
  if (!turn) {
    view.zoom_to(vertices);
    turn = is_hidden(view, mesh, vertices);
  }
  if (!turn) return;
  if (normal.norm() > 0.0) view.look_against(normal);
  view.zoom_to(vertices);
}

}  // namespace arris::ui
