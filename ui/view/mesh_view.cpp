#include "ui/view/mesh_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <new>
#include <utility>

#include <QMouseEvent>
#include <QOpenGLContext>
#include <QPainter>
#include <QThreadPool>
#include <QTimer>

#include "ui/view/gl_canvas.h"
#include "ui/view/overlay.h"
#include "ui/view/picker.h"
#include "ui/view/scene.h"

namespace arris::ui {
namespace {

constexpr int drag_threshold = 3;  // logical pixels before a press becomes a drag
constexpr double radians_per_pixel = 0.0075;
constexpr int hover_interval = 33;     // ms
constexpr int rest_interval = 180;     // ms without movement until the full mesh is drawn again
constexpr double slow_surface = 80.0;  // ms; with lines and the rest about 100 for a frame
constexpr std::size_t stand_in_faces = 60'000;
constexpr std::size_t most_smooth_faces = 150'000;  // where the processor draws: three times slower
constexpr double fit_share = 0.86;                  // of the view that the part fills

template <class Value>
using Later = std::shared_future<std::shared_ptr<const Value>>;

/// Makes a value on another thread; null if memory runs out.
template <class Value, class Make>
Later<Value> in_background(QThreadPool& workers, Make make) {
  const auto promise = std::make_shared<std::promise<std::shared_ptr<const Value>>>();
  Later<Value> later = promise->get_future().share();
  workers.start([promise, make = std::move(make)] {
    try {
      promise->set_value(std::make_shared<const Value>(make()));
    } catch (const std::bad_alloc&) {
      promise->set_value(nullptr);
    }
  });
  return later;
}

template <class Value>
std::shared_ptr<const Value> if_ready(const Later<Value>& later) {
  using namespace std::chrono_literals;
  return later.valid() && later.wait_for(0s) == std::future_status::ready ? later.get() : nullptr;
}

bool is_light(const QColor& colour) {
  return 0.299 * colour.red() + 0.587 * colour.green() + 0.114 * colour.blue() > 110.0;
}

bool has_undefined(const ViewField& field) {
  return field.values && std::any_of(field.values->begin(), field.values->end(),
                                     [](double value) { return std::isnan(value); });
}

}  // namespace

struct MeshView::Impl {
  enum class Drag { none, orbit, pan, zoom };

  MeshPtr mesh;
  std::vector<ViewLine> lines;
  std::unordered_set<std::uint32_t> selected_lines;
  std::optional<ViewField> field;
  bool field_has_undefined = false;
  std::set<LineType> line_types;
  bool lines_visible = true;
  bool scalar_bar_visible = true;
  bool dark = false;

  ViewCamera camera;
  Scene scene;
  GlCanvas canvas{scene};
  QMetaObject::Connection context_end;
  Later<RayTree> tree;
  Later<CoarseMesh> coarse;
  bool coarse_given = false;  // to the scene
  QThreadPool workers;        // of its own: a click must not wait for other work of the program

  Drag drag = Drag::none;
  bool dragged = false;
  Qt::MouseButton button = Qt::NoButton;
  QPoint pressed_at, last_at, hover_at;
  Point pivot = Point::Zero();
  bool moving = false;
  QTimer hover_timer, rest_timer;

  QImage overlay_image;
  Overlay overlay_shown;
  QSize overlay_pixels;

  void show_ground() {
    if (dark) {
      scene.set_ground(QColor(33, 36, 41), QColor(66, 71, 80));
    } else {
      scene.set_ground(QColor(208, 216, 226), QColor(249, 250, 252));
    }
  }

  double least_height() const { return mesh ? std::max(mesh->diagonal() * 1e-5, 1e-30) : 1e-30; }
  double most_height() const { return mesh ? std::max(mesh->diagonal() * 50.0, 1e-30) : 1e30; }

  /// What is written over a picture whose pixels, those of its text, are `units` wide.
  Overlay overlay(const ViewCamera& seen, double units) const {
    Overlay result;
    result.dark = dark;
    const bool shown =
        field && field->values && mesh && !scene.labels_shown() &&
        field->values->size() == (field->on_edges ? mesh->edge_count() : mesh->vertex_count());
    if (shown && scalar_bar_visible) {
      result.field = field;
      result.field_has_undefined = field_has_undefined;
    }
    if (lines_visible) result.line_types = line_types;
    result.scale_bar = mesh != nullptr;
    result.orientation_marker = mesh != nullptr;
    result.units_per_pixel = units;
    result.axes = seen.axes();
    return result;
  }

  std::optional<Pick> pick(const RayTree& with, QSizeF size, const QPoint& position) const {
    static const std::vector<ViewLine> none;
    return pick_at(with, camera, size, position, lines_visible ? lines : none);
  }
};

namespace {

QSizeF logical_size(const QWidget& view) { return QSizeF(view.size().expandedTo({1, 1})); }

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

}  // namespace

MeshView::MeshView(QWidget* parent) : QOpenGLWidget(parent), impl_(std::make_unique<Impl>()) {
  QSurfaceFormat wanted;
  wanted.setVersion(3, 2);
  wanted.setProfile(QSurfaceFormat::CoreProfile);
  wanted.setDepthBufferSize(24);
  wanted.setSamples(0);  // VTK samples by itself
  setFormat(wanted);
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(120, 90);
  impl_->show_ground();
  impl_->hover_timer.setSingleShot(true);
  impl_->hover_timer.setInterval(hover_interval);
  connect(&impl_->hover_timer, &QTimer::timeout, this, [this] {
    const auto tree = if_ready(impl_->tree);
    if (!tree || impl_->drag != Impl::Drag::none) return;
    emit hovered(impl_->pick(*tree, logical_size(*this), impl_->hover_at));
  });
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
  impl_->mesh = std::move(mesh);
  impl_->lines.clear();
  impl_->line_types.clear();
  impl_->selected_lines.clear();
  impl_->field.reset();
  impl_->workers.clear();
  impl_->tree = {};
  impl_->coarse = {};
  impl_->coarse_given = false;
  impl_->scene.set_mesh(impl_->mesh);
  if (impl_->mesh) {
    impl_->tree =
        in_background<RayTree>(impl_->workers, [shared = impl_->mesh] { return RayTree(shared); });
    if (impl_->mesh->face_count() > 2 * stand_in_faces) {
      impl_->coarse = in_background<CoarseMesh>(
          impl_->workers, [shared = impl_->mesh] { return make_coarse(*shared, stand_in_faces); });
    }
  }
  if (fit) this->fit();
  update();
}

void MeshView::set_field(std::optional<ViewField> field) {
  impl_->field = std::move(field);
  impl_->field_has_undefined = impl_->field && has_undefined(*impl_->field);
  impl_->scene.set_field(impl_->field);
  update();
}

void MeshView::set_face_labels(std::vector<std::uint32_t> labels, std::vector<QColor> colours) {
  impl_->scene.set_face_labels(std::move(labels), std::move(colours));
  update();
}

void MeshView::set_lines(std::vector<ViewLine> lines) {
  const std::size_t count = impl_->mesh ? impl_->mesh->vertex_count() : 0;
  std::erase_if(lines, [&](const ViewLine& line) {
    return line.vertices.size() < 2 || std::any_of(line.vertices.begin(), line.vertices.end(),
                                                   [&](VertexId v) { return v >= count; });
  });
  impl_->lines = std::move(lines);
  impl_->line_types.clear();
  for (const ViewLine& line : impl_->lines) impl_->line_types.insert(line.type);
  impl_->scene.set_lines(impl_->lines);
  impl_->scene.set_selected_lines(impl_->lines, impl_->selected_lines);
  update();
}

void MeshView::set_selected_lines(const std::unordered_set<std::uint32_t>& ids) {
  if (ids == impl_->selected_lines) return;
  impl_->selected_lines = ids;
  impl_->scene.set_selected_lines(impl_->lines, ids);
  update();
}

void MeshView::set_selected_labels(const std::unordered_set<std::uint32_t>& labels) {
  impl_->scene.set_selected_labels(labels);
  update();
}

void MeshView::set_lines_visible(bool visible) {
  impl_->lines_visible = visible;
  impl_->scene.set_lines_visible(visible);
  update();
}

void MeshView::set_edges_visible(bool visible) {
  impl_->scene.set_edges_visible(visible);
  update();
}

void MeshView::set_scalar_bar_visible(bool visible) {
  impl_->scalar_bar_visible = visible;
  update();
}

void MeshView::set_dark(bool dark) {
  impl_->dark = dark;
  impl_->show_ground();
  update();
}

void MeshView::fit() {
  if (!impl_->mesh) return;
  std::vector<Point> points;
  points.reserve(impl_->mesh->vertex_count());
  for (VertexId v = 0; v < impl_->mesh->vertex_count(); ++v) {
    if (!impl_->mesh->is_isolated(v)) points.push_back(impl_->mesh->point(v));
  }
  impl_->camera.frame(points, logical_size(*this), fit_share, impl_->least_height());
  update();
}

void MeshView::look_against(const Point& towards_viewer) {
  const Point direction = towards_viewer.normalized();
  constexpr double steep = 0.95;  // nearly from above or below: y is up then
  impl_->camera.look(
      direction, std::abs(direction.z()) > steep ? Point(Point::UnitY()) : Point(Point::UnitZ()));
  fit();
}

void MeshView::look_from(StandardView view) {
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

void MeshView::zoom_to(const std::vector<VertexId>& vertices) {
  if (!impl_->mesh) return;
  std::vector<Point> points;
  for (const VertexId v : vertices) {
    if (v < impl_->mesh->vertex_count()) points.push_back(impl_->mesh->point(v));
  }
  constexpr double share = 0.6;
  constexpr double edges_seen = 12.0;  // so that a single vertex is shown with what is about it
  impl_->camera.frame(
      points, logical_size(*this), share,
      std::max(impl_->least_height(), edges_seen * impl_->mesh->mean_edge_length()));
  update();
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
  frame.camera.set_height(impl_->camera.height() * options.size.height() / (scale * size.height()));
  frame.pixels = options.size;
  frame.pixel_ratio = scale;
  impl_->scene.set_ground(options.background, options.background);
  impl_->canvas.draw_once(frame);
  QImage image = impl_->canvas.read();
  impl_->show_ground();
  doneCurrent();
  update();
  if (image.isNull()) return {};

  Overlay overlay = impl_->overlay(impl_->camera, impl_->camera.units_per_pixel(size));
  if (options.background.alpha() > 0) overlay.dark = !is_light(options.background);
  if (!options.scalar_bar) overlay.field.reset();
  overlay.scale_bar = overlay.scale_bar && options.scale_bar;
  overlay.orientation_marker = overlay.orientation_marker && options.orientation_marker;
  QPainter painter(&image);
  painter.drawImage(0, 0, draw_overlay(overlay, options.size, scale));
  painter.end();
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

void MeshView::resizeGL(int, int) {}

void MeshView::paintGL() {
  if (!impl_->canvas.started()) return;
  if (!impl_->coarse_given) {
    if (auto coarse = if_ready(impl_->coarse)) {
      impl_->scene.set_coarse(std::move(coarse));
      impl_->coarse_given = true;
    }
  }
  const double ratio = devicePixelRatio();
  GlCanvas::Frame frame;
  frame.camera = impl_->camera;
  frame.pixels = device_size(*this);
  frame.pixel_ratio = ratio;
  frame.smooth = !(impl_->canvas.is_software() && impl_->mesh &&
                   impl_->mesh->face_count() > most_smooth_faces);
  frame.coarse = impl_->moving && impl_->canvas.surface_time() > slow_surface;
  impl_->canvas.draw(frame);

  const Overlay overlay =
      impl_->overlay(impl_->camera, impl_->camera.units_per_pixel(logical_size(*this)));
  if (impl_->overlay_image.isNull() || impl_->overlay_pixels != frame.pixels ||
      !(overlay == impl_->overlay_shown)) {
    impl_->overlay_image = draw_overlay(overlay, frame.pixels, ratio);
    impl_->overlay_pixels = frame.pixels;
    impl_->overlay_shown = overlay;
  }
  impl_->canvas.show(impl_->overlay_image, defaultFramebufferObject());
}

void MeshView::moved() {
  impl_->moving = true;
  impl_->rest_timer.start();
  update();
}

void MeshView::mousePressEvent(QMouseEvent* event) {
  if (impl_->drag != Impl::Drag::none) return;  // a second button while one is held
  impl_->button = event->button();
  impl_->pressed_at = impl_->last_at = event->position().toPoint();
  impl_->dragged = false;
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  switch (event->button()) {
    case Qt::LeftButton:
      impl_->drag = shift ? Impl::Drag::pan : Impl::Drag::orbit;
      break;
    case Qt::MiddleButton:
      impl_->drag = Impl::Drag::pan;
      break;
    case Qt::RightButton:
      impl_->drag = Impl::Drag::zoom;
      break;
    default:
      event->ignore();
      return;
  }
  impl_->pivot = impl_->mesh ? Point((impl_->mesh->box_min() + impl_->mesh->box_max()) / 2)
                             : impl_->camera.focus();
  if (const auto tree = if_ready(impl_->tree)) {
    const auto point = surface_at(*tree, impl_->camera, logical_size(*this), impl_->pressed_at);
    if (point) impl_->pivot = *point;
  }
}

void MeshView::mouseMoveEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  if (impl_->drag == Impl::Drag::none) {
    impl_->hover_at = at;
    if (!impl_->hover_timer.isActive()) impl_->hover_timer.start();
    return;
  }
  if (!impl_->dragged && (at - impl_->pressed_at).manhattanLength() <= drag_threshold) return;
  impl_->dragged = true;
  const QPoint by = at - impl_->last_at;
  impl_->last_at = at;
  const QSizeF size = logical_size(*this);
  switch (impl_->drag) {
    case Impl::Drag::orbit:
      impl_->camera.orbit(impl_->pivot, -by.x() * radians_per_pixel, -by.y() * radians_per_pixel);
      break;
    case Impl::Drag::pan:
      impl_->camera.pan(by, size);
      break;
    case Impl::Drag::zoom:
      impl_->camera.zoom(std::exp(-by.y() * 0.01), impl_->pressed_at, size, impl_->least_height(),
                         impl_->most_height());
      break;
    case Impl::Drag::none:
      break;
  }
  moved();
}

void MeshView::mouseReleaseEvent(QMouseEvent* event) {
  if (impl_->drag == Impl::Drag::none || event->button() != impl_->button) return;
  impl_->drag = Impl::Drag::none;
  if (impl_->dragged) return;
  const std::optional<Pick> found = pick(impl_->pressed_at);
  if (event->button() == Qt::LeftButton) {
    emit clicked(found, event->modifiers().testFlag(Qt::ControlModifier));
  } else if (event->button() == Qt::RightButton) {
    emit context_menu_wanted(event->globalPosition().toPoint(), found);
  }
}

void MeshView::wheelEvent(QWheelEvent* event) {
  const double steps = event->angleDelta().y() / 120.0;
  impl_->camera.zoom(std::pow(1.18, steps), event->position(), logical_size(*this),
                     impl_->least_height(), impl_->most_height());
  moved();
  event->accept();
}

void MeshView::leaveEvent(QEvent* event) {
  impl_->hover_timer.stop();
  emit hovered(std::nullopt);
  QOpenGLWidget::leaveEvent(event);
}

void MeshView::keyPressEvent(QKeyEvent* event) {
  constexpr std::array<std::pair<int, StandardView>, 7> views{
      {{Qt::Key_1, StandardView::front},
       {Qt::Key_2, StandardView::back},
       {Qt::Key_3, StandardView::left},
       {Qt::Key_4, StandardView::right},
       {Qt::Key_5, StandardView::top},
       {Qt::Key_6, StandardView::bottom},
       {Qt::Key_0, StandardView::isometric}}};
  for (const auto& [key, view] : views) {
    if (event->key() == key) {
      look_from(view);
      return;
    }
  }
  if (event->key() == Qt::Key_F) {
    fit();
    return;
  }
  QOpenGLWidget::keyPressEvent(event);
}

}  // namespace arris::ui
