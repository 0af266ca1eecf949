#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_set>
#include <vector>

#include <QColor>
#include <QImage>
#include <QOpenGLWidget>
#include <QString>

#include "core/curvature/fields.h"
#include "core/mesh/mesh.h"
#include "ui/view/colour_scale.h"
#include "ui/view/navigation.h"
#include "ui/view/view_camera.h"

namespace arris::ui {

/// How a line is drawn: types tell apart by colour *and* dash or width, for the colour-blind too.
enum class LineType { c0_convex, c0_concave, gn, tangent, undefined, border };

struct ViewLine {
  std::uint32_t id = 0;  ///< What picking and selection name it by; 0: not selectable.
  LineType type = LineType::c0_convex;
  std::vector<VertexId> vertices;  ///< A closed line repeats its first vertex at the end.
};

/// A point marked by a small ring with a label.
struct ViewMark {
  Point point = Point::Zero();
  QString text;
  bool operator==(const ViewMark&) const = default;
};

/// The field that colours the surface.
struct ViewField {
  QString title;                                      ///< With unit: "Kabs (1/mm²)".
  std::shared_ptr<const std::vector<double>> values;  ///< One per element; NaN: undefined.
  /// Vertices and faces colour the surface; edges are drawn coloured over a plain one (figure 24b).
  Element element = Element::vertex;
  ColourScale scale;
  bool read_as_radius = false;  ///< The scalar bar shows a radius beside each value of Kabs.
  /// Where set, values are class numbers 0, 1, ...: `class_names[k]` in `class_colours[k]` as a
  /// legend.
  QStringList class_names;
  std::vector<QColor> class_colours;
  std::optional<ViewMark> mark;  ///< What the field points out, as the place of its largest value.
  bool operator==(const ViewField&) const = default;
};

/// Which of two states of a part is drawn: the mesh, the reference it came from, plain, or the
/// reference translucent over the mesh.
enum class ShownSurface { mesh, reference, both };

/// Colour of the bands of MeshView::set_marked_paths().
QColor marked_colour();

/// A plane to look into the part: what lies beyond it, where normal · p > offset, is cut away.
struct Section {
  Point normal = Point::UnitX();  ///< Unit vector.
  double offset = 0.0;            ///< Mesh unit.
  bool operator==(const Section&) const = default;
};

/// What the left mouse button does.
enum class Tool {
  select,      ///< Clicks select, drags orbit; with Shift, a rectangle over lines.
  band,        ///< Drags draw the rectangle.
  brush,       ///< Drags on the part paint.
  path,        ///< Clicks on the part give the points of a path.
  measure,     ///< Two clicks measure.
  move_point,  ///< Drags on a line move it.
};

/// What lies under the pointer. Only what is visible is ever picked: the nearest front surface, and
/// lines that are shown and not hidden behind it. Where a line is picked beside the surface, or
/// over the back of an open one, face, vertex and edge are no_id.
struct Pick {
  FaceId face = no_id;
  VertexId vertex = no_id;  ///< The corner of `face` nearest to the pointer.
  EdgeId edge = no_id;      ///< Of the line; where there is none, of `face` nearest to the pointer.
  std::uint32_t line = 0;   ///< Id of the line within a few pixels, 0: none.
  Point point = Point::Zero();
};

struct PictureOptions {
  QSize size = {1600, 1200};   // pixels of the picture
  double dots_per_inch = 0.0;  // as the file says; 0: nothing
  /// What of the part the height of the picture shows, in its unit; 0: at least what the view does.
  double height = 0.0;
  bool scalar_bar = true;
  bool scale_bar = true;
  bool orientation_marker = true;
  bool legend = true;             // of the lines, where the view shows it
  QString caption;                // lines of text at the bottom; empty: none
  QColor background = Qt::white;  // transparent where its alpha is 0
};

/// The part in the centre of the window: one QOpenGLWidget that drives VTK (shared/qt6-vtk.md). It
/// holds no geometry of its own making and knows nothing of documents: it shows what it is given.
///
/// Whatever the tool: the middle button pans (with Shift: orbits), the right one and the wheel
/// zoom, Ctrl + left pans. A tool whose drags mean something leaves those that begin beside the
/// part, or beside a line, to orbiting.
class MeshView : public QOpenGLWidget {
  Q_OBJECT
 public:
  explicit MeshView(QWidget* parent = nullptr);
  ~MeshView() override;

  /// The mesh to show; fits the camera when `fit`. A null mesh empties the view. Field, labels,
  /// lines and selections belong to a mesh and go with it: set them after.
  void set_mesh(MeshPtr mesh, bool fit);
  /// Colours the surface by a field; nullopt: plain. Values change without uploading geometry
  /// again. A field whose number of values does not fit the mesh is not drawn.
  void set_field(std::optional<ViewField> field);
  /// One label per face (0: none) and a colour for each label value; empty labels: not shown.
  /// Drawn instead of the field. `colours` is indexed by label. Labels whose number does not fit
  /// the mesh are not drawn.
  void set_face_labels(std::vector<std::uint32_t> labels, std::vector<QColor> colours);
  /// Lines drawn thick on top of the surface. Cheap: the surface is left alone. Lines through
  /// vertices that the mesh does not have are left out.
  void set_lines(std::vector<ViewLine> lines);
  void set_selected_lines(const std::unordered_set<std::uint32_t>& ids);
  /// Faces whose label is selected are drawn highlighted.
  void set_selected_labels(const std::unordered_set<std::uint32_t>& labels);

  /// Another state of the same part, as the scan that the mesh was made from: at most `gap` (mesh
  /// unit) away from it. Set after set_mesh(), which drops it; null: none. Field, labels, lines,
  /// hidden faces and picks always belong to the mesh.
  void set_reference(MeshPtr reference, double gap);
  /// Stays set while there is no reference, and means the mesh until then.
  void set_surface(ShownSurface surface);
  ShownSurface surface() const;
  /// Faces that are neither drawn nor picked, nor are lines between two of them: one value for each
  /// face of the mesh, or empty for none. Gone with the mesh.
  void set_hidden_faces(std::vector<bool> hidden);
  /// The same for the faces of the reference, with which they go.
  void set_hidden_reference_faces(std::vector<bool> hidden);
  /// What lengths of the mesh are told in. Stays when the mesh changes.
  void set_length_unit(LengthUnit unit);
  /// Cuts the part open; what is cut away is not picked. Stays when the mesh changes.
  void set_section(const std::optional<Section>& section);
  const std::optional<Section>& section() const;
  /// Paths drawn dashed over the surface in a colour of their own: previews and proposals. Those
  /// with vertices that the mesh does not have are left out.
  void set_ghost_paths(std::vector<std::vector<VertexId>> paths);
  /// Paths under which a broad band is drawn, as what only one of two versions has. Those with
  /// vertices that the mesh does not have are left out; gone with the mesh.
  void set_marked_paths(std::vector<std::vector<VertexId>> paths);
  /// Points marked by small rings, as the picks of a path so far.
  void set_picked_points(std::vector<Point> points);

  /// Which buttons of the mouse move the camera. The left one is the tools' where no rule has it.
  void set_navigation(NavigationStyle style);
  NavigationStyle navigation() const;

  /// Another tool; what the one before had begun is dropped. `hint` replaces the line at the bottom
  /// that tells what the tool does. Esc goes back to Tool::select.
  void set_tool(Tool tool, const QString& hint = {});
  Tool tool() const;
  /// In the mesh's unit, kept between a thousandth and a half of the part's diagonal. At first a
  /// fiftieth of it.
  void set_brush_radius(double radius);
  double brush_radius() const;
  void clear_measurement();

  void set_lines_visible(bool visible);
  void set_edges_visible(bool visible);  ///< Mesh edges as a thin net.
  /// Whether colours of a field on faces or vertices are shaded as the surface is lit. If not, as
  /// at first, they are exactly those of the scalar bar. Labels and a bare part always are.
  void set_fields_lit(bool lit);
  void set_flat_shading(bool flat);  ///< Each face by its own normal, else smooth between creases.
  void set_scalar_bar_visible(bool visible);
  void set_legend_visible(bool visible);  ///< That of the types of lines.
  void set_dark(bool dark);               ///< Ground and text colours.

  /// The whole part in the view, clear of scalar bar and legend where there is room; keeps the
  /// direction. Fitted anew when the view gets another size, until the camera is moved.
  void fit();
  bool is_fitted() const;
  enum class StandardView { front, back, left, right, top, bottom, isometric };
  /// Looks against this direction, upright as far as it goes; fits the part.
  void look_against(const Point& towards_viewer);
  void look_from(StandardView view);  ///< z is up; fits the part.
  Point towards_viewer() const;
  const ViewCamera& camera() const;
  int surfaces_drawn() const;  ///< Frames so far that did not keep the picture of the surface.
  QSizeF extent_seen() const;  ///< Of the whole part across and up the view, in its unit.
  void set_camera(const ViewCamera& camera);  ///< Its height within what the part allows.
  /// As a cap that is held like the part moves it: shares of the view a second, radians a second.
  void fly(double right, double up, double towards, double about_right, double about_up,
           double seconds);
  void zoom_by(double factor);  ///< Magnifies about the middle of the view.
  /// Takes over how another view looks at its part: camera, section, surface, ground and light,
  /// what of lines and edges is visible. Not the scalar bar: two views side by side need one.
  void look_like(const MeshView& other);
  /// Moves the camera (keeps direction) so that these vertices fill most of the view, beside the
  /// scalar bar.
  void zoom_to(const std::vector<VertexId>& vertices);
  /// The same, turned to a side from which they are seen where they are hidden or face away. Where
  /// there is none, what lies before them is cut away until the part is turned. In the first
  /// moments after set_mesh() it waits as pick() does.
  void show_place(const std::vector<VertexId>& vertices);
  /// Whether any of these vertices is inside the view and not hidden. Waits as pick() does.
  bool sees(const std::vector<VertexId>& vertices);

  /// The picture as on the screen, drawn again at the wanted size: text and line widths grow with
  /// it, and at least what is seen on the screen is in it. Null image if drawing failed, which it
  /// does before the view was first shown and beyond the size that the graphics driver allows.
  QImage picture(const PictureOptions& options);

  /// The pick at a widget position (logical pixels); nullopt: nothing there. In the first moments
  /// after set_mesh() it waits for the search tree (about 0.5 s for a million faces).
  std::optional<Pick> pick(const QPoint& position);

 signals:
  /// What look_like() takes over has changed, by the user or by a call.
  void look_changed();
  /// At most about 30 times a second, and never while a button is held.
  void hovered(const std::optional<arris::ui::Pick>& pick);
  /// A click without dragging (select and band); `toggle` with Ctrl held. nullopt: the ground.
  void clicked(const std::optional<arris::ui::Pick>& pick, bool toggle);
  void context_menu_wanted(const QPoint& global, const std::optional<arris::ui::Pick>& pick);

  void tool_changed(arris::ui::Tool tool);
  /// The user went back to Tool::select by Esc (after tool_changed()).
  void tool_left();
  /// Lines of whose visible length at least half lies in the rectangle; `toggle` with Ctrl held.
  void banded(const std::vector<std::uint32_t>& line_ids, bool toggle);
  /// The brush was let go: the vertices picked along its way, about half a radius apart, each once.
  void brushed(const std::vector<arris::VertexId>& stroke, double radius);
  void brush_radius_changed(double radius);
  /// Tool::path. Each pick has a face.
  void path_point(const arris::ui::Pick& pick);
  void path_hover(const arris::ui::Pick& pick);  ///< At most about 30 times a second.
  void path_done();                              ///< Double click or Enter.
  void path_back();                              ///< Backspace.
  /// Tool::move_point: the vertex of the line nearest to the pointer; then each other vertex that
  /// the pointer comes to; then the last one. Esc ends the drag at the vertex where it began.
  void line_grabbed(std::uint32_t line, arris::VertexId vertex);
  void line_dragged(arris::VertexId vertex);
  void line_dropped(arris::VertexId vertex);
  /// Distance, its parts along the axes and the angle between the faces, for the clipboard.
  void measured(const QString& text);

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void moved();
  void hover();
  void press_left(const QPoint& at, Qt::KeyboardModifiers modifiers);
  void drag_tool(const QPoint& at);
  void drop_tool(const QPoint& at, Qt::KeyboardModifiers modifiers);
  void click_tool(const std::optional<Pick>& pick, bool toggle);
  void cancel_drag();
  void paint_to(const QPoint& at);
  void measure_to(const Pick& pick);
  void show_cursor();
  void tell_look();
  /// Fits again where scalar bar or legend came to lie over the fitted part.
  void keep_clear();
  /// What was cut away before a place is there again.
  void uncover();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::ui
