// Mouse and keyboard of MeshView: the camera and the tools.

#include <algorithm>
#include <array>
#include <cmath>

#include <QMouseEvent>

#include "core/base/number_text.h"
#include "core/mesh/brush.h"
#include "ui/view/mesh_view_impl.h"
#include "ui/view/translated.h"

namespace arris::ui {
namespace {

constexpr int drag_threshold = 3;  // logical pixels before a press becomes a drag
constexpr double radians_per_pixel = 0.0075;
constexpr double wheel_zoom = 1.18;
constexpr double wheel_radius = 1.12;

/// The vertex of a line that is drawn nearest to a position.
VertexId nearest_vertex(const PickSpace& space, const std::vector<ViewLine>& lines,
                        std::uint32_t id, QPointF position) {
  VertexId best = no_id;
  double nearest = HUGE_VAL;
  for (const ViewLine& line : lines) {
    if (line.id != id) continue;
    for (const VertexId v : line.vertices) {
      const Eigen::Vector3d at = space.camera.project(space.tree.mesh()->point(v), space.size);
      const double distance = std::hypot(at.x() - position.x(), at.y() - position.y());
      if (distance >= nearest) continue;
      nearest = distance;
      best = v;
    }
  }
  return best;
}

}  // namespace

QString MeshView::Impl::hint_shown() const {
  if (!hint.isEmpty() || !mesh) return mesh ? hint : QString();
  switch (tool) {
    case Tool::select:
      return measured.empty() ? QString() : translated("Esc removes the measurement");
    case Tool::band:
      return translated(
          "Select by rectangle: drag over lines  ·  Ctrl adds or removes  ·  Esc ends");
    case Tool::brush:
      return translated(
                 "Brush, radius %1: paint on the part  ·  [ and ] or Ctrl + wheel change "
                 "the radius  ·  Esc ends")
          .arg(QString::fromStdString(with_unit(number_text(brush_radius, 3), unit)));
    case Tool::path:
      return translated(
          "Path: click points on the part  ·  double click or Enter completes it  ·  "
          "Backspace takes the last back  ·  Esc ends");
    case Tool::measure:
      return measured.size() == 1
                 ? translated("Measure: click the second point  ·  Esc ends")
                 : translated("Measure: click two points on the part  ·  Esc ends");
    case Tool::move_point:
      return translated("Move a point: drag it from a line  ·  Esc ends");
  }
  return {};
}

void MeshView::set_tool(Tool tool, const QString& hint) {
  cancel_drag();
  const bool other = tool != impl_->tool;
  impl_->tool = tool;
  impl_->hint = hint;
  impl_->brush_at.reset();
  impl_->measuring.reset();
  if (tool != Tool::measure && impl_->measured.size() < 2) impl_->measured.clear();
  show_cursor();
  // Esc and the tool's keys come here, wherever the tool was chosen.
  if (tool != Tool::select) setFocus();
  update();
  if (other) emit tool_changed(tool);
}

Tool MeshView::tool() const { return impl_->tool; }

void MeshView::show_cursor() {
  switch (impl_->tool) {
    case Tool::select:
      unsetCursor();
      break;
    case Tool::band:
    case Tool::brush:
    case Tool::path:
    case Tool::measure:
      setCursor(Qt::CrossCursor);
      break;
    case Tool::move_point:
      setCursor(impl_->drag == Impl::Drag::line ? Qt::ClosedHandCursor : Qt::ArrowCursor);
      break;
  }
}

void MeshView::set_brush_radius(double radius) {
  const double diagonal = impl_->mesh ? impl_->mesh->diagonal() : 1.0;
  const double kept = std::clamp(radius, diagonal * 1e-3, diagonal * 0.5);
  if (kept == impl_->brush_radius) return;
  impl_->brush_radius = kept;
  update();
  emit brush_radius_changed(kept);
}

double MeshView::brush_radius() const { return impl_->brush_radius; }

void MeshView::clear_measurement() {
  impl_->measured.clear();
  impl_->measuring.reset();
  update();
}

void MeshView::moved() {
  impl_->moving = true;
  impl_->rest_timer.start();
  update();
}

void MeshView::hover() {
  const auto tree = if_ready(impl_->tree);
  if (!tree || impl_->drag != Impl::Drag::none) return;
  const auto found = impl_->pick(*tree, logical_size(*this), impl_->hover_at);
  if (impl_->tool == Tool::path && found && found->face != no_id) emit path_hover(*found);
  if (impl_->tool == Tool::move_point)
    setCursor(found && found->line != 0 ? Qt::OpenHandCursor : Qt::ArrowCursor);
  emit hovered(found);
}

MeshView::Impl::Drag MeshView::Impl::drag_of(Qt::MouseButtons buttons,
                                             Qt::KeyboardModifiers modifiers,
                                             Drag otherwise) const {
  const std::optional<Motion> motion = motion_of(*navigation, buttons, modifiers, after_second);
  if (!motion) return otherwise;
  switch (*motion) {
    case Motion::orbit:
      return Drag::orbit;
    case Motion::pan:
      return Drag::pan;
    case Motion::zoom:
      return Drag::zoom;
  }
  return otherwise;
}

void MeshView::set_navigation(NavigationStyle style) {
  cancel_drag();
  impl_->navigation = &navigation_info(style);
  update();
}

NavigationStyle MeshView::navigation() const { return impl_->navigation->style; }

void MeshView::mousePressEvent(QMouseEvent* event) {
  if (impl_->drag != Impl::Drag::none) {
    // A second button while one is held: in some styles the camera moves in another way then.
    if (impl_->moves_camera() && impl_->button != Qt::LeftButton)
      impl_->drag = impl_->drag_of(event->buttons(), event->modifiers(), impl_->drag);
    return;
  }
  impl_->after_second = false;
  const QPoint at = event->position().toPoint();
  impl_->button = event->button();
  impl_->pressed_at = impl_->last_at = at;
  impl_->dragged = false;
  switch (event->button()) {
    case Qt::LeftButton:
      press_left(at, event->modifiers());
      break;
    case Qt::MiddleButton:
    case Qt::RightButton:
      impl_->drag = impl_->drag_of(event->button(), event->modifiers(), Impl::Drag::click);
      break;
    default:
      event->ignore();
      return;
  }
  impl_->pivot = impl_->mesh ? Point((impl_->mesh->box_min() + impl_->mesh->box_max()) / 2)
                             : impl_->camera.focus();
  if (const auto tree = if_ready(impl_->tree)) {
    const auto point = surface_at(impl_->space(*tree, logical_size(*this)), at);
    if (point) impl_->pivot = *point;
  }
}

void MeshView::press_left(const QPoint& at, Qt::KeyboardModifiers modifiers) {
  const bool shift = modifiers.testFlag(Qt::ShiftModifier);
  const bool draws_band = shift || !impl_->navigation->left_moves();
  impl_->drag = impl_->drag_of(Qt::LeftButton, modifiers, Impl::Drag::click);
  if (impl_->tool == Tool::band || (impl_->tool == Tool::select && draws_band)) {
    impl_->drag = Impl::Drag::band;
    return;
  }
  if (impl_->drag == Impl::Drag::pan) return;
  if (impl_->tool == Tool::brush) {
    const auto found = pick(at);
    if (!found || found->face == no_id) return;
    impl_->drag = Impl::Drag::paint;
    impl_->stroke.clear();
    impl_->painted.clear();
    impl_->painted_at = at;
    paint_to(at);
  } else if (impl_->tool == Tool::move_point) {
    const auto found = pick(at);
    if (!found || found->line == 0) return;
    impl_->drag = Impl::Drag::line;
    impl_->grabbed_line = found->line;
    impl_->grabbed_vertex = nearest_vertex(impl_->space(*impl_->tree.get(), logical_size(*this)),
                                           impl_->shown_lines, found->line, at);
    impl_->dragged_vertex = impl_->grabbed_vertex;
    show_cursor();
    emit line_grabbed(impl_->grabbed_line, impl_->grabbed_vertex);
  }
}

void MeshView::mouseMoveEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  const QSizeF size = logical_size(*this);
  const bool follows =
      impl_->tool == Tool::brush || (impl_->tool == Tool::measure && impl_->measured.size() == 1);
  if (follows && (impl_->drag == Impl::Drag::none || impl_->drag == Impl::Drag::paint)) {
    const auto tree = if_ready(impl_->tree);
    auto found = tree ? impl_->pick(*tree, size, at, false) : std::nullopt;
    (impl_->tool == Tool::brush ? impl_->brush_at : impl_->measuring) = found;
    update();
  }
  if (impl_->drag == Impl::Drag::none) {
    impl_->hover_at = at;
    if (!impl_->hover_timer.isActive()) impl_->hover_timer.start();
    return;
  }
  if (!impl_->dragged && (at - impl_->pressed_at).manhattanLength() <= drag_threshold) return;
  impl_->dragged = true;
  const QPoint by = at - impl_->last_at;
  impl_->last_at = at;
  switch (impl_->drag) {
    case Impl::Drag::orbit:
      uncover();
      impl_->camera.orbit(impl_->pivot, -by.x() * radians_per_pixel, -by.y() * radians_per_pixel);
      moved();
      break;
    case Impl::Drag::pan:
      impl_->camera.pan(by, size);
      moved();
      break;
    case Impl::Drag::zoom:
      impl_->camera.zoom(std::exp(-by.y() * 0.01), impl_->pressed_at, size, impl_->least_height(),
                         impl_->most_height());
      moved();
      break;
    case Impl::Drag::band:
    case Impl::Drag::paint:
    case Impl::Drag::line:
      drag_tool(at);
      break;
    case Impl::Drag::click:
    case Impl::Drag::none:
      break;
  }
}

void MeshView::drag_tool(const QPoint& at) {
  if (impl_->drag == Impl::Drag::band) {
    update();
  } else if (impl_->drag == Impl::Drag::paint) {
    paint_to(at);
  } else if (const auto found = impl_->pick(*impl_->tree.get(), logical_size(*this), at, false);
             found && found->vertex != impl_->dragged_vertex) {
    impl_->dragged_vertex = found->vertex;
    emit line_dragged(found->vertex);
  }
}

void MeshView::paint_to(const QPoint& at) {
  const QSizeF size = logical_size(*this);
  const auto tree = impl_->tree.get();
  const Mesh& mesh = *impl_->mesh;
  // The pointer may have come far since the last event: the way between is painted, too.
  const double step =
      std::max(2.0, impl_->brush_radius / impl_->camera.units_per_pixel(size) / 2.0);
  const QPointF way = at - impl_->painted_at;
  constexpr int most_steps = 64;
  const int steps =
      std::clamp(static_cast<int>(std::ceil(std::hypot(way.x(), way.y()) / step)), 1, most_steps);
  for (int k = 1; k <= steps; ++k) {
    const QPointF place = QPointF(impl_->painted_at) + way * k / steps;
    const auto found = impl_->pick(*tree, size, place.toPoint(), false);
    if (!found) continue;
    const Point& point = mesh.point(found->vertex);
    std::vector<VertexId>& stroke = impl_->stroke;
    if (!stroke.empty() && ((mesh.point(stroke.back()) - point).norm() < impl_->brush_radius / 2 ||
                            std::find(stroke.begin(), stroke.end(), found->vertex) != stroke.end()))
      continue;
    stroke.push_back(found->vertex);
    std::vector<FaceId> touched = faces_within(mesh, found->face, point, impl_->brush_radius);
    std::erase_if(touched, [&](FaceId f) {
      const bool hidden = !impl_->hidden.empty() && impl_->hidden[f];
      return hidden || !impl_->painted.insert(f).second;
    });
    impl_->scene.highlight_faces(touched);
  }
  impl_->painted_at = at;
  update();
}

void MeshView::mouseReleaseEvent(QMouseEvent* event) {
  if (impl_->drag == Impl::Drag::none) return;
  if (event->button() != impl_->button) {
    if (impl_->moves_camera() && impl_->button != Qt::LeftButton) {
      impl_->after_second = true;
      impl_->drag = impl_->drag_of(event->buttons(), event->modifiers(), impl_->drag);
    }
    return;
  }
  const bool toggle = event->modifiers().testFlag(Qt::ControlModifier);
  if (impl_->drag == Impl::Drag::paint || impl_->drag == Impl::Drag::line ||
      (impl_->drag == Impl::Drag::band && impl_->dragged)) {
    drop_tool(event->position().toPoint(), event->modifiers());
    return;
  }
  impl_->drag = Impl::Drag::none;
  if (impl_->dragged) {
    update();
    return;
  }
  const std::optional<Pick> found = pick(impl_->pressed_at);
  if (event->button() == Qt::LeftButton) {
    click_tool(found, toggle);
  } else if (event->button() == Qt::RightButton) {
    emit context_menu_wanted(event->globalPosition().toPoint(), found);
  }
}

void MeshView::drop_tool(const QPoint& at, Qt::KeyboardModifiers modifiers) {
  const Impl::Drag drag = std::exchange(impl_->drag, Impl::Drag::none);
  update();
  if (drag == Impl::Drag::band) {
    const auto tree = impl_->tree.valid() ? impl_->tree.get() : nullptr;
    if (!tree) return;
    const std::vector<std::uint32_t> ids =
        impl_->lines_visible
            ? lines_in(impl_->space(*tree, logical_size(*this)),
                       QRectF(impl_->pressed_at, at).normalized(), impl_->shown_lines)
            : std::vector<std::uint32_t>();
    emit banded(ids, modifiers.testFlag(Qt::ControlModifier));
  } else if (drag == Impl::Drag::paint) {
    impl_->scene.clear_highlight();
    emit brushed(std::exchange(impl_->stroke, {}), impl_->brush_radius);
  } else {
    show_cursor();
    emit line_dropped(impl_->dragged_vertex);
  }
}

void MeshView::click_tool(const std::optional<Pick>& found, bool toggle) {
  switch (impl_->tool) {
    case Tool::select:
    case Tool::band:
      emit clicked(found, toggle);
      break;
    case Tool::path:
      if (found && found->face != no_id) emit path_point(*found);
      break;
    case Tool::measure:
      if (found) measure_to(*found);
      break;
    case Tool::brush:
    case Tool::move_point:
      break;
  }
}

void MeshView::measure_to(const Pick& found) {
  impl_->measuring.reset();
  if (impl_->measured.size() == 2) impl_->measured.clear();
  impl_->measured.push_back(found);
  update();
  if (impl_->measured.size() < 2) return;
  const QStringList lines =
      measured_lines(*impl_->mesh, impl_->unit, impl_->measured.front(), impl_->measured.back());
  emit measured(lines.join("   "));
}

void MeshView::cancel_drag() {
  const Impl::Drag drag = std::exchange(impl_->drag, Impl::Drag::none);
  impl_->dragged = false;
  if (drag == Impl::Drag::paint) {
    impl_->stroke.clear();
    impl_->scene.clear_highlight();
  } else if (drag == Impl::Drag::line) {
    show_cursor();
    emit line_dropped(impl_->grabbed_vertex);
  }
  update();
}

void MeshView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (impl_->tool == Tool::path && event->button() == Qt::LeftButton) {
    emit path_done();  // its first click gave the last point
    return;
  }
  mousePressEvent(event);
}

void MeshView::wheelEvent(QWheelEvent* event) {
  double steps = event->angleDelta().y() / 120.0;
  event->accept();
  if (impl_->tool == Tool::brush && event->modifiers().testFlag(Qt::ControlModifier)) {
    set_brush_radius(impl_->brush_radius * std::pow(wheel_radius, steps));
    return;
  }
  if (impl_->navigation->wheel_up_is_away) steps = -steps;
  impl_->camera.zoom(std::pow(wheel_zoom, steps), event->position(), logical_size(*this),
                     impl_->least_height(), impl_->most_height());
  moved();
}

void MeshView::fly(double right, double up, double towards, double about_right, double about_up,
                   double seconds) {
  if (!impl_->mesh || impl_->drag != Impl::Drag::none) return;
  constexpr double shares_a_second = 0.8, radians_a_second = 1.6, zooms_a_second = 1.2;
  const QSizeF size = logical_size(*this);
  uncover();
  // About what is in the middle of the view, in the depth of the part.
  const Point middle = (impl_->mesh->box_min() + impl_->mesh->box_max()) / 2;
  const Point& towards_viewer = impl_->camera.towards_viewer();
  const Point pivot =
      impl_->camera.focus() + towards_viewer * (middle - impl_->camera.focus()).dot(towards_viewer);
  const double turn = radians_a_second * seconds;
  impl_->camera.orbit(pivot, -about_up * turn, -about_right * turn);
  impl_->camera.pan(QPointF(right, -up) * (shares_a_second * seconds * size.height()), size);
  impl_->camera.zoom(std::exp(towards * zooms_a_second * seconds),
                     QPointF(size.width() / 2.0, size.height() / 2.0), size, impl_->least_height(),
                     impl_->most_height());
  moved();
}

void MeshView::leaveEvent(QEvent* event) {
  impl_->hover_timer.stop();
  if (impl_->brush_at || impl_->measuring) update();
  impl_->brush_at.reset();
  impl_->measuring.reset();
  emit hovered(std::nullopt);
  QOpenGLWidget::leaveEvent(event);
}

void MeshView::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  if (key == Qt::Key_Escape) {
    const bool dragging = impl_->drag != Impl::Drag::none;
    cancel_drag();
    if (dragging) return;  // the first Esc ends the drag
    if (impl_->tool != Tool::select) {
      clear_measurement();
      set_tool(Tool::select);
      emit tool_left();
      return;
    }
    if (!impl_->measured.empty()) {
      clear_measurement();
      return;
    }
  }
  if (impl_->tool == Tool::path) {
    if (key == Qt::Key_Return || key == Qt::Key_Enter) {
      emit path_done();
      return;
    }
    if (key == Qt::Key_Backspace) {
      emit path_back();
      return;
    }
  }
  if (impl_->tool == Tool::brush && (key == Qt::Key_BracketLeft || key == Qt::Key_BracketRight)) {
    set_brush_radius(impl_->brush_radius *
                     (key == Qt::Key_BracketRight ? wheel_radius : 1.0 / wheel_radius));
    return;
  }
  constexpr std::array<std::pair<int, StandardView>, 7> views{
      {{Qt::Key_1, StandardView::front},
       {Qt::Key_2, StandardView::back},
       {Qt::Key_3, StandardView::left},
       {Qt::Key_4, StandardView::right},
       {Qt::Key_5, StandardView::top},
       {Qt::Key_6, StandardView::bottom},
       {Qt::Key_0, StandardView::isometric}}};
  for (const auto& [view_key, view] : views) {
    if (key == view_key) {
      look_from(view);
      return;
    }
  }
  if (key == Qt::Key_F) {
    fit();
    return;
  }
  QOpenGLWidget::keyPressEvent(event);
}

}  // namespace arris::ui
