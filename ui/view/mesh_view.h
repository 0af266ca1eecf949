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

#include "core/mesh/mesh.h"
#include "ui/view/colour_scale.h"

namespace arris::ui {

/// How a line is drawn: types tell apart by colour *and* dash or width, for the colour-blind too.
enum class LineType { c0_convex, c0_concave, gn, undefined, border };

struct ViewLine {
  std::uint32_t id = 0;  ///< What picking and selection name it by; 0: not selectable.
  LineType type = LineType::c0_convex;
  std::vector<VertexId> vertices;  ///< A closed line repeats its first vertex at the end.
};

/// The field that colours the surface.
struct ViewField {
  QString title;                                      ///< With unit: "Kabs (1/mm²)".
  std::shared_ptr<const std::vector<double>> values;  ///< Per vertex, or per edge; NaN: undefined.
  bool on_edges = false;  ///< Draw coloured edges over a plain surface (figure 24b).
  ColourScale scale;
  bool read_as_radius = false;  ///< The scalar bar shows a radius in mm beside each value of Kabs.
  /// Where set, values are class numbers 0, 1, ...: `class_names[k]` in `class_colours[k]` as a
  /// legend.
  QStringList class_names;
  std::vector<QColor> class_colours;
  bool operator==(const ViewField&) const = default;
};

/// What lies under the pointer. Only what is visible is ever picked: the nearest front surface, and
/// lines that are shown and not hidden behind it. Where a line is picked beside the surface, or
/// over the back of an open one, face, vertex and edge are no_id.
struct Pick {
  FaceId face = no_id;
  VertexId vertex = no_id;  ///< The corner of `face` nearest to the pointer.
  EdgeId edge = no_id;      ///< The edge of `face` nearest to the pointer.
  std::uint32_t line = 0;   ///< Id of the line within a few pixels, 0: none.
  Point point = Point::Zero();
};

struct PictureOptions {
  QSize size = {1600, 1200};  // pixels of the picture
  bool scalar_bar = true;
  bool scale_bar = true;
  bool orientation_marker = true;
  QColor background = Qt::white;  // transparent where its alpha is 0
};

/// The part in the centre of the window: one QOpenGLWidget that drives VTK (shared/qt6-vtk.md). It
/// holds no geometry of its own making and knows nothing of documents: it shows what it is given.
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

  void set_lines_visible(bool visible);
  void set_edges_visible(bool visible);  ///< Mesh edges as a thin net.
  void set_scalar_bar_visible(bool visible);
  void set_dark(bool dark);  ///< Ground and text colours.

  void fit();  ///< The whole part in the view; keeps the direction.
  enum class StandardView { front, back, left, right, top, bottom, isometric };
  /// Looks against this direction, upright as far as it goes; fits the part.
  void look_against(const Point& towards_viewer);
  void look_from(StandardView view);  ///< z is up; fits the part.
  /// Moves the camera (keeps direction) so that these vertices fill most of the view.
  void zoom_to(const std::vector<VertexId>& vertices);

  /// The picture as on the screen, drawn again at the wanted size: text and line widths grow with
  /// it, and at least what is seen on the screen is in it. Null image if drawing failed, which it
  /// does before the view was first shown and beyond the size that the graphics driver allows.
  QImage picture(const PictureOptions& options);

  /// The pick at a widget position (logical pixels); nullopt: nothing there. In the first moments
  /// after set_mesh() it waits for the search tree (about 0.5 s for a million faces).
  std::optional<Pick> pick(const QPoint& position);

 signals:
  /// At most about 30 times a second, and never while a button is held.
  void hovered(const std::optional<arris::ui::Pick>& pick);
  /// A click without dragging; `toggle` with Ctrl held. nullopt: the ground.
  void clicked(const std::optional<arris::ui::Pick>& pick, bool toggle);
  void context_menu_wanted(const QPoint& global, const std::optional<arris::ui::Pick>& pick);

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void moved();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arris::ui
