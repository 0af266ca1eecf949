#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <new>
#include <set>
#include <unordered_set>
#include <utility>

#include <QThreadPool>
#include <QTimer>

#include "core/base/vector_state.h"
#include "ui/view/gl_canvas.h"
#include "ui/view/mesh_view.h"
#include "ui/view/overlay_layers.h"
#include "ui/view/picker.h"
#include "ui/view/scene.h"
#include "ui/view/tool_overlay.h"

namespace arris::ui {

template <class Value>
using Later = std::shared_future<std::shared_ptr<const Value>>;

/// Makes a value on another thread; null if memory runs out.
template <class Value, class Make>
Later<Value> in_background(QThreadPool& workers, Make make) {
  const auto promise = std::make_shared<std::promise<std::shared_ptr<const Value>>>();
  Later<Value> later = promise->get_future().share();
  workers.start([promise, make = std::move(make)] {
    clear_vector_state();
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

inline QSizeF logical_size(const QWidget& view) { return QSizeF(view.size().expandedTo({1, 1})); }

/// The numbers of a measurement, line by line, the distance first.
QStringList measured_lines(const Mesh& mesh, LengthUnit unit, const Pick& from, const Pick& to);

/// What MeshView keeps: what is shown (mesh_view.cpp) and what the user is doing
/// (mesh_view_input.cpp).
struct MeshView::Impl {
  /// What look_like() takes over.
  struct Look {
    ViewCamera camera;
    std::optional<Section> section;
    ShownSurface surface = ShownSurface::mesh;
    bool lines_visible = true;
    bool edges_visible = false;
    bool dark = false;
    bool fields_lit = false;
    bool flat = false;
    NavigationStyle navigation = NavigationStyle::arris;
    bool operator==(const Look&) const = default;
  };

  /// `click`: the left button is down and moves nothing.
  enum class Drag { none, orbit, pan, zoom, band, paint, line, click };

  MeshPtr mesh;
  LengthUnit unit = LengthUnit::unknown;
  MeshPtr reference;
  std::vector<ViewLine> lines;        // as given
  std::vector<ViewLine> shown_lines;  // without the runs between hidden faces
  std::unordered_set<std::uint32_t> selected_lines;
  std::vector<std::vector<VertexId>> marked_paths;  // as given
  std::vector<bool> hidden;                         // faces; empty: none
  std::vector<bool> hidden_reference;
  std::optional<Section> section;
  /// The section of before while `section` cuts away what hides a place; see show_place().
  std::optional<std::optional<Section>> cut_before_place;
  std::optional<ViewField> field;
  bool field_has_undefined = false;
  std::set<LineType> line_types;
  bool lines_visible = true;
  bool scalar_bar_visible = true;
  bool legend_visible = true;
  bool dark = false;
  Look told;  // by the last look_changed()

  ViewCamera camera;
  ViewCamera fitted;             // as fit() left it
  std::array<QRectF, 2> panels;  // scalar bar and legend that the part was last fitted beside
  Scene scene;
  GlCanvas canvas{scene};
  QMetaObject::Connection context_end;
  Later<RayTree> tree;
  Later<CoarseMesh> coarse, reference_coarse;
  bool coarse_given = false, reference_coarse_given = false;  // to the scene
  QThreadPool workers;  // of its own: a click must not wait for other work of the program

  const NavigationInfo* navigation = &navigation_table().front();
  bool after_second = false;  // see NavigationRule
  Drag drag = Drag::none;
  bool dragged = false;
  Qt::MouseButton button = Qt::NoButton;
  QPoint pressed_at, last_at, hover_at;
  Point pivot = Point::Zero();
  bool moving = false;
  QTimer hover_timer, rest_timer;

  Tool tool = Tool::select;
  QString hint;  // empty: that of the tool
  double brush_radius = 1.0;
  std::optional<Pick> brush_at;  // where the ring is drawn
  std::vector<VertexId> stroke;
  QPoint painted_at;
  std::unordered_set<FaceId> painted;
  std::vector<Pick> measured;     // one or two
  std::optional<Pick> measuring;  // the end that follows the pointer
  std::uint32_t grabbed_line = 0;
  VertexId grabbed_vertex = no_id, dragged_vertex = no_id;
  std::vector<Point> picked_points;

  OverlayLayers overlay_layers;
  QImage tools_image;
  QPoint tools_at;
  ToolOverlay tools_shown;
  QSize tools_pixels;

  void show_ground();
  double least_height() const { return mesh ? std::max(mesh->diagonal() * 1e-5, 1e-30) : 1e-30; }
  double most_height() const { return mesh ? std::max(mesh->diagonal() * 50.0, 1e-30) : 1e30; }
  /// What is written over a picture whose pixels, those of its text, are `units` wide.
  Overlay overlay(const ViewCamera& seen, double units) const;
  /// What tools and marks draw over a view of `size` seen by `seen`.
  ToolOverlay tools(const ViewCamera& seen, QSizeF size) const;
  bool field_shown() const;
  /// Frames points so that no scalar bar and no legend lies over them, where there is room.
  void frame_clear(const std::vector<Point>& points, QSizeF size);
  /// Where scalar bar and legend are on a view of `size`.
  std::array<QRectF, 2> panels_on(QSizeF size) const;
  /// Whether one of `panels` lies over one of these points.
  bool covers(const std::vector<Point>& points, const ViewCamera& seen, QSizeF size) const;
  void look_upright(const Point& towards_viewer);
  QString hint_shown() const;
  bool moves_camera() const {
    return drag == Drag::orbit || drag == Drag::pan || drag == Drag::zoom;
  }
  /// The drag that the buttons held mean in the style of navigation; `otherwise`: none of it.
  Drag drag_of(Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers, Drag otherwise) const;
  void show_lines();
  void show_marked_paths();
  /// The runs of a path that are not between two hidden faces.
  std::vector<std::vector<VertexId>> visible_runs(const std::vector<VertexId>& path) const;
  /// Whether the mesh has all vertices of a path that can be drawn.
  bool has(const std::vector<VertexId>& path) const {
    return mesh && path.size() > 1 &&
           std::ranges::all_of(path, [&](VertexId v) { return v < mesh->vertex_count(); });
  }
  Look look() const {
    return {camera,
            section,
            scene.chosen(),
            lines_visible,
            scene.edges_visible(),
            dark,
            scene.fields_lit(),
            scene.flat(),
            navigation->style};
  }

  PickSpace space(const RayTree& with, QSizeF size) const {
    return {with, camera, size, hidden.empty() ? nullptr : &hidden, section};
  }
  std::optional<Pick> pick(const RayTree& with, QSizeF size, const QPoint& position,
                           bool with_lines = true) const {
    static const std::vector<ViewLine> none;
    return pick_at(space(with, size), position, with_lines && lines_visible ? shown_lines : none);
  }
};

}  // namespace arris::ui
