// How a view looks at its part: what fits into it, and from where places are seen.

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/view/free_side.h"
#include "ui/view/mesh_view_impl.h"

namespace arris::ui {
namespace {

constexpr double fit_share = 0.86;  // of the view that the part fills

/// Vertices, and points along edges so long that a panel of the view may lie between their ends.
std::vector<Point> points_to_fit(const Mesh& mesh) {
  std::vector<Point> points;
  points.reserve(mesh.vertex_count());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.is_isolated(v)) points.push_back(mesh.point(v));
  const double step = 0.02 * mesh.diagonal();
  if (!(step > 0.0) || mesh.mean_edge_length() < step) return points;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge(e);
    const int count = static_cast<int>(mesh.edge_length(e) / step);
    for (int k = 1; k < count; ++k)
      points.push_back(mesh.point(a) + (mesh.point(b) - mesh.point(a)) * k / count);
  }
  return points;
}

}  // namespace

std::array<QRectF, 2> MeshView::Impl::panels_on(QSizeF size) const {
  return overlay_panels(size, overlay(camera, camera.units_per_pixel(size)));
}

bool MeshView::Impl::covers(const std::vector<Point>& points, const ViewCamera& seen,
                            QSizeF size) const {
  constexpr double room = 4.0;  // pixels about a panel
  return std::ranges::any_of(points, [&](const Point& point) {
    const Eigen::Vector3d place = seen.project(point, size);
    const QPointF at(place.x(), place.y());
    return std::ranges::any_of(panels, [&](const QRectF& panel) {
      return !panel.isEmpty() && panel.adjusted(-room, -room, room, room).contains(at);
    });
  });
}

void MeshView::Impl::look_upright(const Point& towards_viewer) {
  const Point direction = towards_viewer.normalized();
  constexpr double steep = 0.95;  // nearly from above or below: y is up then
  camera.look(direction,
              std::abs(direction.z()) > steep ? Point(Point::UnitY()) : Point(Point::UnitZ()));
}

void MeshView::Impl::frame_clear(const std::vector<Point>& points, QSizeF size) {
  if (points.empty()) return;
  panels = panels_on(size);
  const auto [bar, legend] = panels;
  // The whole view, or what is left of it beside or below the panels: where the part is largest
  // and nothing of it is under a panel.
  const double right = bar.isEmpty() ? size.width() : bar.left();
  std::vector<QRectF> areas{QRectF(QPointF(0.0, 0.0), size),
                            QRectF(0.0, 0.0, right, size.height())};
  if (!legend.isEmpty()) {
    areas.emplace_back(0.0, legend.bottom(), size.width(), size.height() - legend.bottom());
    areas.emplace_back(0.0, legend.bottom(), right, size.height() - legend.bottom());
    areas.emplace_back(legend.right(), 0.0, right - legend.right(), size.height());
  }
  // Two corners of the box about all points, upright on the screen, frame as all of them do.
  Point low = camera.axes().transpose() * points.front(), high = low;
  for (const Point& point : points) {
    const Point local = camera.axes().transpose() * point;
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  const std::vector<Point> ends{camera.axes() * low, camera.axes() * high};
  ViewCamera best = camera;
  best.frame(ends, size, fit_share, least_height());
  bool found = false;
  for (const QRectF& area : areas) {
    constexpr double least = 0.25;  // of the view; in less room the part may be partly covered
    if (area.width() < least * size.width() || area.height() < least * size.height()) continue;
    ViewCamera candidate = camera;
    candidate.frame(ends, size, fit_share, least_height(), area);
    if ((found && candidate.height() >= best.height()) || covers(points, candidate, size)) continue;
    best = candidate;
    found = true;
  }
  camera = best;
}

void MeshView::fit() {
  if (!impl_->mesh) return;
  impl_->frame_clear(points_to_fit(*impl_->mesh), logical_size(*this));
  impl_->fitted = impl_->camera;
  update();
}

void MeshView::keep_clear() {
  if (!is_fitted()) return;
  const QSizeF size = logical_size(*this);
  const auto panels = impl_->panels_on(size);
  if (panels == impl_->panels) return;
  impl_->panels = panels;
  if (impl_->covers(points_to_fit(*impl_->mesh), impl_->camera, size)) fit();
}

bool MeshView::is_fitted() const { return impl_->mesh && impl_->camera == impl_->fitted; }

Point MeshView::towards_viewer() const { return impl_->camera.towards_viewer(); }

const ViewCamera& MeshView::camera() const { return impl_->camera; }

int MeshView::surfaces_drawn() const { return impl_->canvas.surfaces_drawn(); }

QSizeF MeshView::extent_seen() const {
  if (!impl_->mesh || impl_->mesh->face_count() == 0) return {0.0, 0.0};
  const Eigen::Matrix3d to_view = impl_->camera.axes().transpose();
  Point low = to_view * impl_->mesh->box_max(), high = low;
  for (VertexId v = 0; v < impl_->mesh->vertex_count(); ++v) {
    if (impl_->mesh->is_isolated(v)) continue;
    const Point local = to_view * impl_->mesh->point(v);
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  return {high.x() - low.x(), high.y() - low.y()};
}

void MeshView::set_camera(const ViewCamera& camera) {
  uncover();
  impl_->camera = camera;
  impl_->camera.set_height(
      std::clamp(camera.height(), impl_->least_height(), impl_->most_height()));
  update();
}

void MeshView::look_against(const Point& towards_viewer) {
  uncover();
  impl_->look_upright(towards_viewer);
  fit();
}

void MeshView::look_from(StandardView view) {
  uncover();
  const Point up = Point::UnitZ();
  switch (view) {
    case StandardView::front:
      impl_->camera.look(-Point::UnitY(), up);
      break;
    case StandardView::back:
      impl_->camera.look(Point::UnitY(), up);
      break;
    case StandardView::left:
      impl_->camera.look(-Point::UnitX(), up);
      break;
    case StandardView::right:
      impl_->camera.look(Point::UnitX(), up);
      break;
    case StandardView::top:
      impl_->camera.look(Point::UnitZ(), Point::UnitY());
      break;
    case StandardView::bottom:
      impl_->camera.look(-Point::UnitZ(), Point::UnitY());
      break;
    case StandardView::isometric:
      impl_->camera.look(Point(1.0, -1.0, 1.0), up);
      break;
  }
  fit();
}

void MeshView::zoom_by(double factor) {
  const QSizeF size = logical_size(*this);
  impl_->camera.zoom(factor, QPointF(size.width() / 2.0, size.height() / 2.0), size,
                     impl_->least_height(), impl_->most_height());
  update();
}

void MeshView::zoom_to(const std::vector<VertexId>& vertices) {
  if (!impl_->mesh) return;
  std::vector<Point> points;
  for (const VertexId v : vertices) {
    if (v < impl_->mesh->vertex_count()) points.push_back(impl_->mesh->point(v));
  }
  constexpr double share = 0.6;
  constexpr double edges_seen = 12.0;  // so that a single vertex is shown with what is about it
  const QSizeF size = logical_size(*this);
  // Beside the scalar bar, where that leaves most of the view.
  const QRectF bar = impl_->panels_on(size)[0];
  constexpr double most_room = 0.6;
  QRectF area(QPointF(0.0, 0.0), size);
  if (!bar.isEmpty() && bar.left() > most_room * size.width()) area.setRight(bar.left());
  impl_->camera.frame(points, size, share,
                      std::max(impl_->least_height(), edges_seen * impl_->mesh->mean_edge_length()),
                      area);
  update();
}

void MeshView::show_place(const std::vector<VertexId>& vertices) {
  if (!impl_->mesh || !impl_->tree.valid()) return;
  const auto tree = impl_->tree.get();
  if (!tree) return zoom_to(vertices);
  uncover();
  const FreeSide side = free_side(impl_->space(*tree, logical_size(*this)), vertices);
  if (side.turned) impl_->look_upright(side.towards_viewer);
  zoom_to(vertices);
  if (side.cut) {
    impl_->cut_before_place = impl_->section;
    impl_->section = side.cut;
    impl_->scene.set_section(side.cut);
  }
  update();
}

bool MeshView::sees(const std::vector<VertexId>& vertices) {
  const auto tree = impl_->mesh && impl_->tree.valid() ? impl_->tree.get() : nullptr;
  return tree && sees_any(impl_->space(*tree, logical_size(*this)), vertices);
}

void MeshView::uncover() {
  if (!impl_->cut_before_place) return;
  impl_->section = *impl_->cut_before_place;
  impl_->cut_before_place.reset();
  impl_->scene.set_section(impl_->section);
  update();
}

}  // namespace arris::ui
