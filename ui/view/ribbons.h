#pragma once

#include <array>
#include <vector>

#include <QColor>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "core/mesh/mesh.h"

class vtkActor;
class vtkFloatArray;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkUniforms;

namespace arris::ui {

/// How one kind of line is drawn. Lengths in pixels at a device pixel ratio of 1.
struct Stroke {
  float half_width = 1.0F;
  float dash = 0.0F;    ///< Length drawn, without its round ends; 0 with a period: dots.
  float period = 0.0F;  ///< 0: solid.
  QColor colour;
};

/// Lines of one layer are all under those of the next, and all lines of one Ribbons under those of
/// the next in its renderer.
struct StrokeLayer {
  float grow = 0.0F;  ///< Pixels wider than the stroke on each side.
  QColor colour;      ///< Invalid: the stroke's.
};

/// A plane as normal and offset beyond which nothing is drawn: this one cuts nothing away.
inline const Eigen::Vector4d no_section(0.0, 0.0, 0.0, 1.0);

/// What a frame needs to know to draw lines; see ViewCamera.
struct RibbonFrame {
  double pixel_ratio = 1.0;       ///< Device pixels per pixel of the strokes.
  double units_per_pixel = 1.0;   ///< Mesh unit per pixel of the strokes.
  double depth_per_unit = 1.0;    ///< Depth in device coordinates per mesh unit.
  double extra_lift = 0.0;        ///< Mesh unit; for a surface that is only nearly the mesh.
  std::array<int, 2> viewport{};  ///< Device pixels.
  Point towards_viewer = Point::UnitZ();
  Eigen::Vector4d section = no_section;  ///< In coordinates that start at the origin of the lines.
};

/// Unit vectors in the faces left and right of the segment, at right angles to it and away from it;
/// zero where there is no face. Where it is no edge of the mesh: in the mean plane about its ends.
std::array<Point, 2> side_directions(const Mesh& mesh, VertexId from, VertexId to);

/// How far a line is drawn in front of the surface it lies on, in pixels: as much as the surface
/// beside it rises towards the viewer within `half_width` pixels, and a little more. Hardly
/// anything where the surface faces away, so that no line shows through a thin wall. The shader in
/// ribbons.cpp does the same.
double line_lift(const Mesh& mesh, VertexId from, VertexId to, const Point& towards_viewer,
                 double half_width);

/// Hands coordinates to the shaders as they are: VTK may scale them otherwise.
void keep_coordinates(vtkPolyDataMapper* mapper);

/// Sets the vertex shader's uniform `sectionPlane`.
void set_section_uniform(vtkUniforms* uniforms, const Eigen::Vector4d& section);

/// Keeps what a mapper draws in this renderer from hiding what is drawn after it.
void write_no_depth(vtkPolyDataMapper* mapper, vtkRenderer* renderer);

/// Polylines drawn as camera-facing bands of constant width in pixels, with round joins and round
/// dashes, smooth at their rims. (Line stipple does not exist in core OpenGL, and wide lines only
/// here and there.)
class Ribbons {
 public:
  Ribbons(vtkRenderer* renderer, std::vector<Stroke> strokes,
          const std::vector<StrokeLayer>& layers);
  ~Ribbons();
  Ribbons(const Ribbons&) = delete;
  Ribbons& operator=(const Ribbons&) = delete;

  struct Line {
    const std::vector<VertexId>* vertices;
    int stroke;
  };
  /// `origin` is subtracted from the points of the mesh; both are those of the call before, or
  /// clear() comes between. Lines of the call before are not worked out anew.
  void set_lines(const Mesh& mesh, const Point& origin, const std::vector<Line>& lines);
  void clear();
  void set_visible(bool visible);
  void update(const RibbonFrame& frame);

 private:
  std::vector<Stroke> strokes_;
  std::vector<StrokeLayer> layers_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
  vtkNew<vtkPolyData> data_;
  /// A line that is drawn, and where its segments begin in the arrays.
  struct Kept {
    std::vector<VertexId> vertices;
    std::size_t segment;
  };
  std::vector<Kept> kept_;
  std::array<vtkSmartPointer<vtkFloatArray>, 5> arrays_;
  bool visible_ = true;
  bool empty_ = true;
};

}  // namespace arris::ui
