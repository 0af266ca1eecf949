#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <unordered_set>
#include <vector>

#include <QColor>
#include <QSize>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "ui/view/coarse_mesh.h"
#include "ui/view/mesh_view.h"
#include "ui/view/ribbons.h"
#include "ui/view/view_camera.h"

class vtkImageData;
class vtkRenderer;
class vtkTexture;

namespace arris::ui {

/// How each type of line is drawn, in the order of LineType; also what the legend shows.
const std::vector<Stroke>& line_strokes();
/// Width of the light rim on each side of a line that sets it off from dark surfaces; pixels.
inline constexpr float line_rim = 1.1F;
/// From stripe to stripe across a surface without a value, along x or y; pixels.
inline constexpr double hatch_period = 8.0;

/// Whether a field has as many values as the mesh has elements for it.
bool fits(const ViewField& field, const Mesh& mesh);
/// Whether one of the faces of an edge is shown; `hidden`: of each face.
bool shows(const std::array<FaceId, 2>& faces, const std::vector<bool>& hidden);

/// What VTK draws: the surface and its net in one renderer, the lines over them in another, so that
/// lines can be drawn anew over a kept picture of the surface. Points are relative to the middle of
/// the mesh, which keeps them exact in single precision.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void set_mesh(MeshPtr mesh);
  void set_coarse(std::shared_ptr<const CoarseMesh> coarse);
  /// Another state of the mesh, at most `gap` away from it; uploaded when it is first shown.
  void set_reference(MeshPtr mesh, double gap);
  void set_reference_coarse(std::shared_ptr<const CoarseMesh> coarse);
  void set_shown(ShownSurface shown);
  /// What is drawn: the mesh where there is no reference.
  ShownSurface shown() const;
  ShownSurface chosen() const { return shown_; }              ///< Reference or none.
  void set_hidden_faces(std::vector<bool> hidden);            ///< Of the mesh; empty: none.
  void set_hidden_reference_faces(std::vector<bool> hidden);  ///< The same, of the reference.
  void set_section(const std::optional<Section>& section);
  void set_field(const std::optional<ViewField>& field);
  /// Whether the surface looks other than before.
  bool set_face_labels(std::vector<std::uint32_t> labels, std::vector<QColor> colours);
  void set_selected_labels(std::unordered_set<std::uint32_t> labels);
  void set_lines(const std::vector<ViewLine>& lines);
  void set_selected_lines(const std::vector<ViewLine>& lines,
                          const std::unordered_set<std::uint32_t>& ids);
  void set_ghost_paths(const std::vector<std::vector<VertexId>>& paths);
  void set_marked_paths(const std::vector<std::vector<VertexId>>& paths);
  void highlight_faces(const std::vector<FaceId>& faces);  ///< These too.
  void clear_highlight();
  void set_lines_visible(bool visible);
  void set_edges_visible(bool visible);
  bool edges_visible() const { return edges_visible_; }
  void set_fields_lit(bool lit);  ///< See MeshView.
  bool fields_lit() const { return fields_lit_; }
  void set_flat(bool flat);
  bool flat() const { return flat_; }
  /// Two colours from the bottom to the top; one where they are alike; alpha 0: transparent.
  void set_ground(const QColor& bottom, const QColor& top);

  bool labels_shown() const { return !labels_.empty(); }

  /// Prepares a frame. `pixels`: its size; `pixel_ratio`: device pixels per pixel of line widths.
  /// `coarse` draws the stand-in, where there is one.
  void prepare(const ViewCamera& camera, QSize pixels, double pixel_ratio, bool coarse);
  /// Counts the changes to all that is not a line.
  std::uint64_t surface_version() const { return surface_version_; }

  vtkRenderer* surface_renderer() { return surface_renderer_; }
  vtkRenderer* line_renderer() { return line_renderer_; }

 private:
  struct Shape;
  struct Net;
  struct Highlight;
  struct Body;
  Eigen::Vector4d local_section() const;
  void show_field();
  void show_class_field();
  void show_scale_field();
  void show_edge_field();
  void show_labels();
  void outline_selection();
  void refresh();

  ShownSurface shown_ = ShownSurface::mesh;
  double gap_ = 0.0;
  std::vector<bool> hidden_, hidden_reference_;
  std::optional<Section> section_;
  Point origin_ = Point::Zero();
  double radius_ = 1.0;
  std::optional<ViewField> field_;
  std::vector<std::uint32_t> labels_;
  std::vector<QColor> label_colours_;
  std::unordered_set<std::uint32_t> selected_labels_;
  bool edges_visible_ = false;
  bool fields_lit_ = false;
  bool flat_ = false;
  bool stale_ = true;  // colours have to be made again before the next frame
  std::uint64_t surface_version_ = 0;

  vtkNew<vtkRenderer> surface_renderer_;
  vtkNew<vtkRenderer> line_renderer_;
  std::unique_ptr<Body> body_;
  std::unique_ptr<Body> reference_;
  vtkNew<vtkTexture> texture_;
  vtkNew<vtkImageData> texture_image_;
  std::unique_ptr<Highlight> highlight_;
  Ribbons marked_;
  Ribbons label_outline_;
  Ribbons lines_;
  Ribbons selected_lines_;
  Ribbons ghosts_;
};

}  // namespace arris::ui
