#include "ui/view/mesh_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <QCoreApplication>
#include <QOpenGLContext>
#include <QPainter>

#include "core/base/number_text.h"
#include "core/mesh/measurement.h"
#include "ui/view/mesh_view_impl.h"

namespace arris::ui {
namespace {

constexpr int hover_interval = 33;     // ms
constexpr int rest_interval = 180;     // ms without movement until the full mesh is drawn again
constexpr double slow_surface = 80.0;  // ms; with lines and the rest about 100 for a frame
constexpr std::size_t stand_in_faces = 60'000;
constexpr std::size_t most_smooth_faces = 150'000;  // where the processor draws: three times slower

/// A stand-in where a mesh is large enough to need one.
Later<CoarseMesh> coarse_later(QThreadPool& workers, const MeshPtr& mesh) {
  if (mesh->face_count() <= 2 * stand_in_faces) return {};
  return in_background<CoarseMesh>(workers, [mesh] { return make_coarse(*mesh, stand_in_faces); });
}

/// Direction a face looks in, over it and the faces about its corners: steady on noise.
Point mean_normal_about(const Mesh& mesh, FaceId face) {
  Point sum = Point::Zero();
  for (const VertexId v : mesh.triangle(face)) {
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (mesh.face(h) == no_id) return;
      const Triangle& t = mesh.triangle(mesh.face(h));
      const Point& a = mesh.point(t[0]);
      sum += (mesh.point(t[1]) - a).cross(mesh.point(t[2]) - a);
    });
  }
  return sum.norm() > 0.0 ? Point(sum.normalized()) : Point(Point::UnitZ());
}

bool is_light(const QColor& colour) {
  return 0.299 * colour.red() + 0.587 * colour.green() + 0.114 * colour.blue() > 110.0;
}

/// Micrometres on a part of 100 mm; more digits on smaller ones.
QString length_text(const Mesh& mesh, double length) {
  const double digits = std::ceil(-std::log10(std::max(mesh.diagonal(), 1e-9) * 1e-5));
  return QString::fromStdString(fixed_text(length, std::clamp(static_cast<int>(digits), 1, 9)));
}

bool has_undefined(const ViewField& field) {
  return field.values && std::any_of(field.values->begin(), field.values->end(),
                                     [](double value) { return std::isnan(value); });
}

}  // namespace

QStringList measured_lines(const Mesh& mesh, LengthUnit unit, const Pick& from, const Pick& to) {
  const Measurement found = measure(mesh, {from.point, from.face}, {to.point, to.face});
  const auto length = [&](double value) { return length_text(mesh, value); };
  const Point& d = found.difference;
  QStringList lines{
      QString::fromStdString(with_unit(length(found.distance).toStdString(), unit)),
      QString("dx %1   dy %2   dz %3").arg(length(d.x()), length(d.y()), length(d.z()))};
  if (found.angle)
    lines << QCoreApplication::translate("arris::ui::MeshView", "angle between faces %1°")
                 .arg(QString::fromStdString(fixed_text(*found.angle, 1)));
  return lines;
}

void MeshView::Impl::show_ground() {
  if (dark) {
    scene.set_ground(QColor(33, 36, 41), QColor(66, 71, 80));
  } else {
    scene.set_ground(QColor(208, 216, 226), QColor(249, 250, 252));
  }
}

Overlay MeshView::Impl::overlay(const ViewCamera& seen, double units) const {
  Overlay result;
  result.dark = dark;
  if (field_shown() && scalar_bar_visible) {
    result.field = field;
    result.field_has_undefined = field_has_undefined;
  }
  if (lines_visible && legend_visible) result.line_types = line_types;
  result.scale_bar = mesh != nullptr;
  result.orientation_marker = mesh != nullptr;
  result.units_per_pixel = units;
  result.unit = unit;
  result.axes = seen.axes();
  return result;
}

ToolOverlay MeshView::Impl::tools(const ViewCamera& seen, QSizeF size) const {
  ToolOverlay result;
  result.dark = dark;
  const auto at = [&](const Point& point) {
    const Eigen::Vector3d place = seen.project(point, size);
    return QPointF(place.x(), place.y());
  };
  if (field_shown() && field->mark) {
    // The point may lie a little under the surface, as a vertex of the scan does.
    const Point raised =
        field->mark->point + seen.towards_viewer() * (0.5 * mesh->mean_edge_length());
    const auto with = if_ready(tree);
    const bool seen_there =
        !with || is_seen({*with, seen, size, hidden.empty() ? nullptr : &hidden, section}, raised);
    result.mark = ToolOverlay::Mark{at(field->mark->point), field->mark->text, !seen_there};
  }
  for (const Point& point : picked_points) result.points.push_back(at(point));
  for (const Pick& end : measured) result.measured.push_back(at(end.point));
  if (measured.size() == 1 && measuring) result.measured.push_back(at(measuring->point));
  if (result.measured.size() == 2)
    result.measured_text =
        measured_lines(*mesh, unit, measured[0], measured.size() == 2 ? measured[1] : *measuring);
  if (brush_at && tool == Tool::brush && drag != Drag::orbit) {
    const Point normal = mean_normal_about(*mesh, brush_at->face);
    const Point right = normal.unitOrthogonal();
    const Point up = normal.cross(right);
    constexpr int corners = 48;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners;
      result.ring << at(brush_at->point +
                        brush_radius * (std::cos(angle) * right + std::sin(angle) * up));
    }
  }
  if (drag == Drag::band && dragged) result.band = QRectF(pressed_at, last_at).normalized();
  return result;
}

bool MeshView::Impl::field_shown() const {
  return mesh && field && !scene.labels_shown() && scene.shown() != ShownSurface::reference &&
         fits(*field, *mesh);
}

std::vector<std::vector<VertexId>> MeshView::Impl::visible_runs(
    const std::vector<VertexId>& path) const {
  std::vector<std::vector<VertexId>> runs;
  std::vector<VertexId> run{path.front()};
  const auto end_run = [&](VertexId next) {
    if (run.size() > 1) runs.push_back(std::move(run));
    run = {next};
  };
  for (std::size_t k = 1; k < path.size(); ++k) {
    const auto edge = mesh->find_edge(path[k - 1], path[k]);
    if (edge && !shows(mesh->edge_faces(*edge), hidden))
      end_run(path[k]);
    else
      run.push_back(path[k]);
  }
  end_run(no_id);
  return runs;
}

void MeshView::Impl::show_marked_paths() {
  std::vector<std::vector<VertexId>> shown;
  for (const std::vector<VertexId>& path : marked_paths)
    if (hidden.empty())
      shown.push_back(path);
    else
      std::ranges::move(visible_runs(path), std::back_inserter(shown));
  scene.set_marked_paths(shown);
}

void MeshView::Impl::show_lines() {
  shown_lines.clear();
  line_types.clear();
  for (const ViewLine& line : lines) {
    line_types.insert(line.type);
    if (hidden.empty()) {
      shown_lines.push_back(line);
      continue;
    }
    for (std::vector<VertexId>& run : visible_runs(line.vertices))
      shown_lines.push_back({line.id, line.type, std::move(run)});
  }
  scene.set_lines(shown_lines);
  scene.set_selected_lines(shown_lines, selected_lines);
}

namespace {

/// The one size in device pixels; QOpenGLWidget rounds its frame buffer the same way.
QSize device_size(const QWidget& view) {
  return (view.size() * view.devicePixelRatio()).expandedTo({1, 1});
}

/// `scale`: device pixels per pixel of text.
QImage draw_overlay(const Overlay& overlay, QSize pixels, double scale) {
  QImage image(pixels, QImage::Format_RGBA8888_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.scale(scale, scale);
  paint_overlay(painter, QSizeF(pixels) / scale, overlay);
  return image;
}

/// Only the part of the view in which anything is drawn; `at`: its top left corner, device pixels.
QImage draw_tools(const ToolOverlay& tools, QSizeF size, double scale, QPoint& at) {
  const QRectF bounds = bounds_of(tools, size);
  if (bounds.isEmpty()) return {};
  at = QPoint(static_cast<int>(bounds.left() * scale), static_cast<int>(bounds.top() * scale));
  const QSize pixels(static_cast<int>(std::ceil(bounds.right() * scale)) - at.x(),
                     static_cast<int>(std::ceil(bounds.bottom() * scale)) - at.y());
  QImage image(pixels, QImage::Format_RGBA8888_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.translate(-at);
  painter.scale(scale, scale);
  paint_tools(painter, size, tools);
  return image;
}

}  // namespace

MeshView::MeshView(QWidget* parent) : QOpenGLWidget(parent), impl_(std::make_unique<Impl>()) {
  QSurfaceFormat wanted;
  wanted.setVersion(3, 2);
  wanted.setProfile(QSurfaceFormat::CoreProfile);
  // A core profile without what is deprecated refuses lines wider than a pixel, those of the net.
  wanted.setOption(QSurfaceFormat::DeprecatedFunctions);
  wanted.setDepthBufferSize(24);
  wanted.setSamples(0);  // VTK samples by itself
  setFormat(wanted);
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(120, 90);
  impl_->show_ground();
  impl_->hover_timer.setSingleShot(true);
  impl_->hover_timer.setInterval(hover_interval);
  connect(&impl_->hover_timer, &QTimer::timeout, this, &MeshView::hover);
  impl_->rest_timer.setSingleShot(true);
  impl_->rest_timer.setInterval(rest_interval);
  connect(&impl_->rest_timer, &QTimer::timeout, this, [this] {
    impl_->moving = false;
    update();
  });
}

MeshView::~MeshView() {
  disconnect(impl_->context_end);
  if (impl_->canvas.started() && context() != nullptr) {
    makeCurrent();
    impl_->canvas.release();
    doneCurrent();
  }
}

void MeshView::set_mesh(MeshPtr mesh, bool fit) {
  cancel_drag();
  // A part of another size gets another brush.
  constexpr double brush_share = 0.02;  // of the diagonal
  if (mesh && !(impl_->mesh && impl_->mesh->diagonal() < 2.0 * mesh->diagonal() &&
                mesh->diagonal() < 2.0 * impl_->mesh->diagonal()))
    impl_->brush_radius = brush_share * mesh->diagonal();
  impl_->mesh = std::move(mesh);
  impl_->reference.reset();
  impl_->hidden_reference.clear();
  impl_->lines.clear();
  impl_->shown_lines.clear();
  impl_->line_types.clear();
  impl_->selected_lines.clear();
  impl_->marked_paths.clear();
  impl_->hidden.clear();
  impl_->field.reset();
  impl_->brush_at.reset();
  impl_->picked_points.clear();
  impl_->workers.clear();
  impl_->tree = {};
  impl_->coarse = {};
  impl_->reference_coarse = {};
  impl_->coarse_given = false;
  impl_->scene.set_mesh(impl_->mesh);
  uncover();
  clear_measurement();
  if (impl_->mesh) {
    impl_->tree =
        in_background<RayTree>(impl_->workers, [shared = impl_->mesh] { return RayTree(shared); });
    impl_->coarse = coarse_later(impl_->workers, impl_->mesh);
  }
  if (fit) this->fit();
  update();
}

void MeshView::set_reference(MeshPtr reference, double gap) {
  impl_->reference = std::move(reference);
  impl_->hidden_reference.clear();
  impl_->scene.set_reference(impl_->reference, gap);
  impl_->reference_coarse = {};
  impl_->reference_coarse_given = false;
  if (impl_->reference && surface() != ShownSurface::mesh)
    impl_->reference_coarse = coarse_later(impl_->workers, impl_->reference);
  update();
}

void MeshView::set_surface(ShownSurface surface) {
  impl_->scene.set_shown(surface);
  if (impl_->reference && surface != ShownSurface::mesh && !impl_->reference_coarse.valid())
    impl_->reference_coarse = coarse_later(impl_->workers, impl_->reference);
  update();
}

ShownSurface MeshView::surface() const { return impl_->scene.shown(); }

void MeshView::set_hidden_faces(std::vector<bool> hidden) {
  const bool any = std::find(hidden.begin(), hidden.end(), true) != hidden.end();
  if (!any || !impl_->mesh || hidden.size() != impl_->mesh->face_count()) hidden.clear();
  if (hidden == impl_->hidden) return;
  impl_->hidden = hidden;
  impl_->scene.set_hidden_faces(std::move(hidden));
  impl_->show_lines();
  impl_->show_marked_paths();
  update();
}

void MeshView::set_hidden_reference_faces(std::vector<bool> hidden) {
  if (!impl_->reference || hidden.size() != impl_->reference->face_count()) hidden.clear();
  if (hidden == impl_->hidden_reference) return;
  impl_->hidden_reference = hidden;
  impl_->scene.set_hidden_reference_faces(std::move(hidden));
  update();
}

void MeshView::set_section(const std::optional<Section>& section) {
  if (section == impl_->section) return;
  impl_->section = section;
  impl_->cut_before_place.reset();
  impl_->scene.set_section(section);
  moved();  // a slow surface follows as its stand-in
}

const std::optional<Section>& MeshView::section() const { return impl_->section; }

void MeshView::set_ghost_paths(std::vector<std::vector<VertexId>> paths) {
  std::erase_if(paths, [&](const std::vector<VertexId>& path) { return !impl_->has(path); });
  impl_->scene.set_ghost_paths(paths);
  update();
}

void MeshView::set_marked_paths(std::vector<std::vector<VertexId>> paths) {
  std::erase_if(paths, [&](const std::vector<VertexId>& path) { return !impl_->has(path); });
  impl_->marked_paths = std::move(paths);
  impl_->show_marked_paths();
  update();
}

void MeshView::set_picked_points(std::vector<Point> points) {
  impl_->picked_points = std::move(points);
  update();
}

void MeshView::set_field(std::optional<ViewField> field) {
  impl_->field = std::move(field);
  impl_->field_has_undefined = impl_->field && has_undefined(*impl_->field);
  impl_->scene.set_field(impl_->field);
  keep_clear();
  update();
}

void MeshView::set_face_labels(std::vector<std::uint32_t> labels, std::vector<QColor> colours) {
  if (impl_->scene.set_face_labels(std::move(labels), std::move(colours)))
    moved();  // a slow surface follows a dragged threshold as its stand-in
  keep_clear();
  update();
}

void MeshView::set_lines(std::vector<ViewLine> lines) {
  std::erase_if(lines, [&](const ViewLine& line) { return !impl_->has(line.vertices); });
  impl_->lines = std::move(lines);
  impl_->show_lines();
  keep_clear();
  update();
}

void MeshView::set_selected_lines(const std::unordered_set<std::uint32_t>& ids) {
  if (ids == impl_->selected_lines) return;
  impl_->selected_lines = ids;
  impl_->scene.set_selected_lines(impl_->shown_lines, ids);
  update();
}

void MeshView::set_selected_labels(const std::unordered_set<std::uint32_t>& labels) {
  impl_->scene.set_selected_labels(labels);
  update();
}

void MeshView::set_lines_visible(bool visible) {
  impl_->lines_visible = visible;
  impl_->scene.set_lines_visible(visible);
  keep_clear();
  update();
}

void MeshView::set_edges_visible(bool visible) {
  impl_->scene.set_edges_visible(visible);
  update();
}

void MeshView::set_fields_lit(bool lit) {
  impl_->scene.set_fields_lit(lit);
  update();
}

void MeshView::set_flat_shading(bool flat) {
  impl_->scene.set_flat(flat);
  update();
}

void MeshView::set_scalar_bar_visible(bool visible) {
  impl_->scalar_bar_visible = visible;
  keep_clear();
  update();
}

void MeshView::set_length_unit(LengthUnit unit) {
  if (impl_->unit == unit) return;
  impl_->unit = unit;
  update();
}

void MeshView::set_legend_visible(bool visible) {
  impl_->legend_visible = visible;
  keep_clear();
  update();
}

void MeshView::set_dark(bool dark) {
  impl_->dark = dark;
  impl_->show_ground();
  update();
}

void MeshView::look_like(const MeshView& other) {
  const Impl::Look look = other.impl_->look();
  if (look == impl_->look()) return;
  const bool follows = look.camera != impl_->camera || look.section != impl_->section;
  impl_->camera = look.camera;
  set_section(look.section);
  set_surface(look.surface);
  set_lines_visible(look.lines_visible);
  set_edges_visible(look.edges_visible);
  set_dark(look.dark);
  set_fields_lit(look.fields_lit);
  set_flat_shading(look.flat);
  if (look.navigation != navigation()) set_navigation(look.navigation);
  impl_->told = impl_->look();
  if (follows && other.impl_->moving) moved();
}

void MeshView::tell_look() {
  if (impl_->look() == impl_->told) return;
  impl_->told = impl_->look();
  emit look_changed();
}

QImage MeshView::picture(const PictureOptions& options) {
  if (!impl_->canvas.started() || context() == nullptr) return {};
  makeCurrent();
  if (!impl_->canvas.is_possible(options.size)) {
    doneCurrent();
    return {};
  }
  const QSizeF size = logical_size(*this);
  const double scale =
      std::min(options.size.width() / size.width(), options.size.height() / size.height());
  GlCanvas::Frame frame;
  frame.camera = impl_->camera;
  frame.camera.set_height(options.height > 0.0 ? options.height
                                               : impl_->camera.height() * options.size.height() /
                                                     (scale * size.height()));
  // Fitted, it lies beside scalar bar and legend; to scale it is wanted whole.
  if (options.height > 0.0 && is_fitted())
    frame.camera.set_focus(0.5 * (impl_->mesh->box_min() + impl_->mesh->box_max()));
  frame.pixels = options.size;
  frame.pixel_ratio = scale;
  impl_->scene.set_ground(options.background, options.background);
  impl_->canvas.draw_once(frame);
  QImage image = impl_->canvas.read();
  impl_->show_ground();
  doneCurrent();
  update();
  if (image.isNull()) return {};

  const QSizeF picture_size = QSizeF(options.size) / scale;
  Overlay overlay = impl_->overlay(frame.camera, frame.camera.units_per_pixel(picture_size));
  if (options.background.alpha() > 0) overlay.dark = !is_light(options.background);
  if (!options.scalar_bar) overlay.field.reset();
  overlay.scale_bar = overlay.scale_bar && options.scale_bar;
  overlay.orientation_marker = overlay.orientation_marker && options.orientation_marker;
  if (!options.legend) overlay.line_types.clear();
  overlay.hint = options.caption;
  ToolOverlay tools = impl_->tools(frame.camera, picture_size);
  tools.dark = overlay.dark;
  tools.ring.clear();
  tools.band.reset();
  QPainter painter(&image);
  painter.drawImage(0, 0, draw_overlay(overlay, options.size, scale));
  painter.scale(scale, scale);
  paint_tools(painter, picture_size, tools);
  painter.end();
  if (options.dots_per_inch > 0.0) {
    const int dots = static_cast<int>(std::lround(options.dots_per_inch / 0.0254));
    image.setDotsPerMeterX(dots);
    image.setDotsPerMeterY(dots);
  }
  return options.background.alpha() == 255
             ? image.convertToFormat(QImage::Format_RGB32)
             : image.convertToFormat(QImage::Format_ARGB32_Premultiplied);
}

std::optional<Pick> MeshView::pick(const QPoint& position) {
  if (!impl_->tree.valid()) return std::nullopt;
  const auto tree = impl_->tree.get();
  return tree ? impl_->pick(*tree, logical_size(*this), position) : std::nullopt;
}

void MeshView::initializeGL() {
  impl_->canvas.start(context());
  disconnect(impl_->context_end);
  impl_->context_end = connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    impl_->canvas.release();
    doneCurrent();
  });
}

void MeshView::resizeGL(int, int) {
  if (is_fitted()) fit();
}

void MeshView::paintGL() {
  if (!impl_->canvas.started()) return;
  tell_look();
  if (!impl_->coarse_given) {
    if (auto coarse = if_ready(impl_->coarse)) {
      impl_->scene.set_coarse(std::move(coarse));
      impl_->coarse_given = true;
    }
  }
  if (!impl_->reference_coarse_given) {
    if (auto coarse = if_ready(impl_->reference_coarse)) {
      impl_->scene.set_reference_coarse(std::move(coarse));
      impl_->reference_coarse_given = true;
    }
  }
  const double ratio = devicePixelRatio();
  GlCanvas::Frame frame;
  frame.camera = impl_->camera;
  frame.pixels = device_size(*this);
  frame.pixel_ratio = ratio;
  std::size_t faces = impl_->mesh ? impl_->mesh->face_count() : 0;
  if (surface() != ShownSurface::mesh) faces = std::max(faces, impl_->reference->face_count());
  frame.smooth = !(impl_->canvas.is_software() && faces > most_smooth_faces);
  frame.coarse = impl_->moving && impl_->canvas.surface_time() > slow_surface;
  impl_->canvas.draw(frame);

  const QSizeF size = logical_size(*this);
  Overlay overlay = impl_->overlay(impl_->camera, impl_->camera.units_per_pixel(size));
  overlay.hint = impl_->hint_shown();
  const ToolOverlay tools = impl_->tools(impl_->camera, size);
  const bool resized = impl_->tools_pixels != frame.pixels;
  std::vector<GlCanvas::Layer> layers =
      impl_->overlay_layers.layers_of(overlay, frame.pixels, ratio);
  if (resized || !(tools == impl_->tools_shown)) {
    impl_->tools_image = draw_tools(tools, size, ratio, impl_->tools_at);
    impl_->tools_shown = tools;
  }
  impl_->tools_pixels = frame.pixels;
  layers.push_back({impl_->tools_image, impl_->tools_at});
  impl_->canvas.show(layers, defaultFramebufferObject());
}

}  // namespace arris::ui
