#include "ui/view/ribbons.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUniforms.h>
#include <Eigen/Geometry>

namespace arris::ui {
namespace {

constexpr std::size_t most_strokes = 8;

// Each segment is a quad; its four vertices hold one end, the other end, and which corner they are:
// 0 and 1 at the first end, 2 and 3 at the second. VTK drops triangles with two corners in one
// place, so the odd corners come a quarter of the way along and are put back here.
constexpr const char* vertex_code = R"(
//VTK::System::Dec
in vec4 vertexMC;
in vec3 otherMC;
in vec4 cornerMC;   // corner, arc length here, arc length at the other end, stroke
in vec3 leftMC;     // see side_directions()
in vec3 rightMC;
uniform mat4 MCDCMatrix;
//VTK::CustomUniforms::Dec
out vec2 place;            // pixels along and across, from the first end
flat out float len;        // pixels
flat out vec2 arc;         // arc lengths of the first and the second end
flat out vec4 shape;       // half width with the layer's, dash, period; pixel ratio
flat out vec4 paint;
out float beyond_section;
// How steeply a side rises towards the viewer; -1 where the side faces away.
float rise(vec3 side, vec3 normal)
{
  if (dot(normal, towardsViewer) <= 0.0) return -1.0;
  float along = dot(side, towardsViewer);
  return clamp(along / sqrt(max(1.0 - along * along, 0.01)), 0.0, mostRise);
}
void main()
{
  bool second = cornerMC.x > 1.5;
  float side = mod(cornerMC.x, 2.0) < 0.5 ? 1.0 : -1.0;
  vec4 stroke = strokeShapes[int(cornerMC.w + 0.5)];
  float radius = (stroke.x + grow) * pixelRatio;
  float rim = radius + 1.0;
  vec3 end = side > 0.0 ? vertexMC.xyz : (4.0 * vertexMC.xyz - otherMC) / 3.0;
  vec4 here = MCDCMatrix * vec4(end, 1.0);
  vec4 there = MCDCMatrix * vec4(otherMC, 1.0);
  beyond_section = dot(sectionPlane.xyz, end) - sectionPlane.w;
  vec2 half_size = 0.5 * viewportSize;
  vec2 along = (there.xy - here.xy) * half_size;
  if (second) along = -along;
  len = length(along);
  along = len > 1e-4 ? along / len : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  vec2 shift = (second ? along : -along) * rim + across * side * rim;
  place = vec2(second ? len + rim : -rim, side * rim);
  arc = second ? cornerMC.zy : cornerMC.yz;
  shape = vec4(radius, stroke.yz, pixelRatio);
  paint = layerPaint.a > 0.0 ? layerPaint : strokePaints[int(cornerMC.w + 0.5)];
  vec3 edge = second ? end - otherMC : otherMC - end;
  float steep = max(rise(leftMC, cross(edge, leftMC)), rise(rightMC, cross(rightMC, edge)));
  float lift = steep < 0.0 ? backLift
                           : min(stroke.x + widest, mostLifted) * (leastRise + steep);
  gl_Position = here;
  gl_Position.xy += shift / half_size;
  // The round end runs on in the direction of the line, also in depth.
  float slope = (here.z - there.z) / max(len, 0.01);
  gl_Position.z += clamp(slope, -mostRise * depthPerPixel, mostRise * depthPerPixel) * rim;
  gl_Position.z -= lift * pixelRatio * depthPerPixel + extraLift;
}
)";

// Dashes lie along the arc length in the mesh's unit; dashUnit of it stands for one pixel. That
// changes by powers of two, so that dashes keep their place while one zooms.
constexpr const char* fragment_code = R"(
//VTK::System::Dec
//VTK::Output::Dec
//VTK::CustomUniforms::Dec
in vec2 place;
flat in float len;
flat in vec2 arc;
flat in vec4 shape;
flat in vec4 paint;
in float beyond_section;
void main()
{
  if (beyond_section > 0.0) discard;
  float beyond = max(max(-place.x, place.x - len), 0.0);
  if (shape.z > 0.0) {
    float share = len > 1e-4 ? clamp(place.x / len, 0.0, 1.0) : 0.0;
    float at = mod(mix(arc.x, arc.y, share) / dashUnit, shape.z);
    float gap = at <= shape.y ? 0.0 : min(at - shape.y, shape.z - at);
    float units = abs(arc.y - arc.x) / dashUnit;
    beyond += gap * (units > 1e-4 ? min(len / units, 4.0 * shape.w) : shape.w);
  }
  float rim = shape.x - length(vec2(beyond, place.y));
  float cover = clamp(rim + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  gl_FragData[0] = vec4(paint.rgb, paint.a * cover);
}
)";

vtkSmartPointer<vtkFloatArray> floats(const char* name, int components, std::size_t tuples) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

// Of the lift of lines; the halves of lines wider than most_lifted may sink into a rising surface.
constexpr double back_lift = 0.6;
constexpr double least_rise = 0.4;
constexpr double most_rise = 2.0;
constexpr double most_lifted = 4.0;

void uniform4(vtkUniforms* uniforms, const char* name, const QColor& colour) {
  const std::array<float, 4> value =
      colour.isValid()
          ? std::array{static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
                       static_cast<float>(colour.blueF()), static_cast<float>(colour.alphaF())}
          : std::array{0.0F, 0.0F, 0.0F, 0.0F};
  uniforms->SetUniform4f(name, value.data());
}

/// VTK calls this right before it draws an actor, and sets the mask again for the next one.
void mask_depth(vtkObject*, unsigned long, void* renderer, void*) {
  auto* window =
      vtkOpenGLRenderWindow::SafeDownCast(static_cast<vtkRenderer*>(renderer)->GetRenderWindow());
  if (window != nullptr) window->GetState()->vtkglDepthMask(0);
}

}  // namespace

std::array<Point, 2> side_directions(const Mesh& mesh, VertexId from, VertexId to) {
  std::array<Point, 2> result{Point::Zero(), Point::Zero()};
  const Point along = (mesh.point(to) - mesh.point(from)).normalized();
  if (const auto edge = mesh.find_edge(from, to)) {
    const HalfEdgeId left = mesh.from(2 * *edge) == from ? 2 * *edge : 2 * *edge + 1;
    const std::array<HalfEdgeId, 2> halves{left, Mesh::opposite(left)};
    for (std::size_t k = 0; k < 2; ++k) {
      if (mesh.face(halves[k]) == no_id) continue;
      const Point inwards = mesh.point(mesh.to(mesh.next(halves[k]))) - mesh.point(from);
      result[k] = (inwards - inwards.dot(along) * along).normalized();
    }
    return result;
  }
  Point normal = Point::Zero();
  for (const VertexId end : {from, to}) {
    mesh.for_ring(end, [&](HalfEdgeId h) {
      if (mesh.face(h) == no_id) return;
      const Triangle& t = mesh.triangle(mesh.face(h));
      const Point& a = mesh.point(t[0]);
      normal += (mesh.point(t[1]) - a).cross(mesh.point(t[2]) - a);
    });
  }
  result[0] = normal.cross(along).normalized();
  result[1] = -result[0];
  return result;
}

double line_lift(const Mesh& mesh, VertexId from, VertexId to, const Point& towards_viewer,
                 double half_width) {
  const Point edge = mesh.point(to) - mesh.point(from);
  const auto sides = side_directions(mesh, from, to);
  const auto rise = [&](const Point& side, const Point& normal) {
    if (normal.dot(towards_viewer) <= 0.0) return -1.0;
    const double along = side.dot(towards_viewer);
    return std::clamp(along / std::sqrt(std::max(1.0 - along * along, 0.01)), 0.0, most_rise);
  };
  const double steep =
      std::max(rise(sides[0], edge.cross(sides[0])), rise(sides[1], sides[1].cross(edge)));
  return steep < 0.0 ? back_lift : std::min(half_width, most_lifted) * (least_rise + steep);
}

void keep_coordinates(vtkPolyDataMapper* mapper) {
  if (auto* gl_mapper = vtkOpenGLPolyDataMapper::SafeDownCast(mapper)) {
    gl_mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  }
}

void set_section_uniform(vtkUniforms* uniforms, const Eigen::Vector4d& section) {
  const std::array<float, 4> value{static_cast<float>(section.x()), static_cast<float>(section.y()),
                                   static_cast<float>(section.z()),
                                   static_cast<float>(section.w())};
  uniforms->SetUniform4f("sectionPlane", value.data());
}

void write_no_depth(vtkPolyDataMapper* mapper, vtkRenderer* renderer) {
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(mask_depth);
  observer->SetClientData(renderer);
  mapper->AddObserver(vtkCommand::UpdateShaderEvent, observer);
}

Ribbons::Ribbons(vtkRenderer* renderer, std::vector<Stroke> strokes,
                 const std::vector<StrokeLayer>& layers)
    : strokes_(std::move(strokes)), layers_(layers) {
  strokes_.resize(most_strokes);
  float widest = 0.0F;
  for (const StrokeLayer& layer : layers_) widest = std::max(widest, layer.grow);
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data_);
    mapper->ScalarVisibilityOff();
    keep_coordinates(mapper);
    mapper->SetResolveCoincidentTopologyToOff();
    for (const char* name : {"otherMC", "cornerMC", "leftMC", "rightMC"}) {
      mapper->MapDataArrayToVertexAttribute(name, name, vtkDataObject::FIELD_ASSOCIATION_POINTS);
    }
    // Only the surface hides lines; if they wrote depth, the round end of one segment would cut
    // into the next where a line runs away from the viewer.
    write_no_depth(mapper, renderer);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->ForceOpaqueOn();
    actor->GetProperty()->LightingOff();
    actor->VisibilityOff();
    actor->GetShaderProperty()->SetVertexShaderCode(vertex_code);
    actor->GetShaderProperty()->SetFragmentShaderCode(fragment_code);
    vtkUniforms* uniforms = actor->GetShaderProperty()->GetVertexCustomUniforms();
    std::array<float[4], most_strokes> shapes{};
    std::array<float[4], most_strokes> paints{};
    for (std::size_t i = 0; i < most_strokes; ++i) {
      const Stroke& stroke = strokes_[i];
      shapes[i][0] = stroke.half_width;
      shapes[i][1] = stroke.dash;
      shapes[i][2] = stroke.period;
      const QColor colour = stroke.colour.isValid() ? stroke.colour : QColor(Qt::black);
      paints[i][0] = static_cast<float>(colour.redF());
      paints[i][1] = static_cast<float>(colour.greenF());
      paints[i][2] = static_cast<float>(colour.blueF());
      paints[i][3] = 1.0F;
    }
    uniforms->SetUniform4fv("strokeShapes", most_strokes, shapes.data());
    uniforms->SetUniform4fv("strokePaints", most_strokes, paints.data());
    uniforms->SetUniformf("grow", layers_[k].grow);
    uniforms->SetUniformf("widest", widest);
    uniform4(uniforms, "layerPaint", layers_[k].colour);
    uniforms->SetUniformf("backLift", static_cast<float>(back_lift));
    uniforms->SetUniformf("leastRise", static_cast<float>(least_rise));
    uniforms->SetUniformf("mostRise", static_cast<float>(most_rise));
    uniforms->SetUniformf("mostLifted", static_cast<float>(most_lifted));
    renderer->AddActor(actor);
    actors_.push_back(actor);
  }
  update({});
}

Ribbons::~Ribbons() = default;

namespace {

constexpr std::size_t corners_of_segment = 4;
/// Numbers of a corner in each array: here, there, (corner, arc, other arc, stroke), left, right.
constexpr std::array<std::size_t, 5> widths{3, 3, 4, 3, 3};
constexpr std::size_t stroke_place = 3;

using Floats = std::array<float*, widths.size()>;

/// The four corners of a segment, from `at` on.
void write_segment(const Mesh& mesh, const Point& origin, VertexId from, VertexId to, double arc,
                   double next, Floats at) {
  const Eigen::Vector3f a = (mesh.point(from) - origin).cast<float>();
  const Eigen::Vector3f b = (mesh.point(to) - origin).cast<float>();
  const auto sides = side_directions(mesh, from, to);
  const std::array<Eigen::Vector3f, 2> beside{sides[0].cast<float>(), sides[1].cast<float>()};
  for (std::size_t k = 0; k < corners_of_segment; ++k) {
    const bool at_second = k > 1;
    const Eigen::Vector3f there = at_second ? a : b;
    Eigen::Vector3f here = at_second ? b : a;
    if (k % 2 == 1) here += 0.25F * (there - here);
    const std::array<float, 3> corner{static_cast<float>(k),
                                      static_cast<float>(at_second ? next : arc),
                                      static_cast<float>(at_second ? arc : next)};
    std::copy_n(here.data(), 3, at[0] + k * widths[0]);
    std::copy_n(there.data(), 3, at[1] + k * widths[1]);
    std::copy_n(corner.data(), 3, at[2] + k * widths[2]);
    std::copy_n(beside[0].data(), 3, at[3] + k * widths[3]);
    std::copy_n(beside[1].data(), 3, at[4] + k * widths[4]);
  }
}

std::uint64_t key_of(const std::vector<VertexId>& path) {
  const std::uint64_t ends = (std::uint64_t{path.front()} << 32) | path.back();
  return ends ^ (std::uint64_t{path[path.size() / 2]} * 0x9E3779B97F4A7C15u);
}

}  // namespace

void Ribbons::set_lines(const Mesh& mesh, const Point& origin, const std::vector<Line>& lines) {
  std::size_t segments = 0;
  for (const Line& line : lines) segments += std::max<std::size_t>(line.vertices->size(), 1) - 1;
  const std::array<const char*, widths.size()> names{"points", "otherMC", "cornerMC", "leftMC",
                                                     "rightMC"};
  std::array<vtkSmartPointer<vtkFloatArray>, widths.size()> arrays;
  for (std::size_t k = 0; k < arrays.size(); ++k)
    arrays[k] = floats(names[k], static_cast<int>(widths[k]), corners_of_segment * segments);
  const auto place = [](const auto& of, std::size_t segment) {
    Floats at{};
    for (std::size_t k = 0; k < at.size(); ++k)
      at[k] = of[k]->GetPointer(static_cast<vtkIdType>(segment * corners_of_segment * widths[k]));
    return at;
  };

  // While a threshold is dragged most lines are those of a moment ago.
  std::unordered_multimap<std::uint64_t, const Kept*> known;
  for (const Kept& kept : kept_) known.emplace(key_of(kept.vertices), &kept);
  std::vector<Kept> keep;
  keep.reserve(lines.size());
  std::size_t segment = 0;
  for (const Line& line : lines) {
    const std::vector<VertexId>& path = *line.vertices;
    if (path.size() < 2) continue;
    const std::size_t count = path.size() - 1;
    const Floats to = place(arrays, segment);
    const auto [from, end] = known.equal_range(key_of(path));
    const auto same =
        std::find_if(from, end, [&](const auto& other) { return other.second->vertices == path; });
    if (same != end) {
      const Floats old = place(arrays_, same->second->segment);
      for (std::size_t k = 0; k < to.size(); ++k)
        std::copy_n(old[k], count * corners_of_segment * widths[k], to[k]);
    } else {
      double arc = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        const double next = arc + (mesh.point(path[i + 1]) - mesh.point(path[i])).norm();
        write_segment(mesh, origin, path[i], path[i + 1], arc, next, place(arrays, segment + i));
        arc = next;
      }
    }
    for (std::size_t k = 0; k < count * corners_of_segment; ++k)
      to[2][k * widths[2] + stroke_place] = static_cast<float>(line.stroke);
    keep.push_back({path, segment});
    segment += count;
  }
  kept_ = std::move(keep);
  arrays_ = arrays;

  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(2 * segments + 1));
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(static_cast<vtkIdType>(6 * segments));
  for (std::size_t i = 0; i <= 2 * segments; ++i)
    offsets->SetValue(static_cast<vtkIdType>(i), static_cast<std::int32_t>(3 * i));
  constexpr std::array<int, 6> quad{0, 1, 2, 2, 1, 3};
  for (std::size_t i = 0; i < 6 * segments; ++i)
    corners->SetValue(static_cast<vtkIdType>(i),
                      static_cast<std::int32_t>(corners_of_segment * (i / 6)) + quad[i % 6]);
  vtkNew<vtkPoints> shell;
  shell->SetData(arrays[0]);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets.Get(), corners.Get());
  data_->Initialize();
  data_->SetPoints(shell);
  data_->SetPolys(cells);
  for (std::size_t k = 1; k < arrays.size(); ++k) data_->GetPointData()->AddArray(arrays[k]);
  empty_ = segments == 0;
  set_visible(visible_);
}

void Ribbons::clear() {
  kept_.clear();
  arrays_ = {};
  data_->Initialize();
  empty_ = true;
  set_visible(visible_);
}

void Ribbons::set_visible(bool visible) {
  visible_ = visible;
  for (const auto& actor : actors_) actor->SetVisibility(visible && !empty_);
}

void Ribbons::update(const RibbonFrame& frame) {
  // Rather longer than shorter: gaps must stay gaps.
  const double dash_unit = std::exp2(std::ceil(std::log2(frame.units_per_pixel) - 0.25));
  const std::array<float, 2> viewport{static_cast<float>(frame.viewport[0]),
                                      static_cast<float>(frame.viewport[1])};
  const Eigen::Vector3f towards = frame.towards_viewer.cast<float>();
  for (const auto& actor : actors_) {
    vtkUniforms* uniforms = actor->GetShaderProperty()->GetVertexCustomUniforms();
    uniforms->SetUniformf("pixelRatio", static_cast<float>(frame.pixel_ratio));
    uniforms->SetUniform2f("viewportSize", viewport.data());
    uniforms->SetUniform3f("towardsViewer", towards.data());
    uniforms->SetUniformf(
        "depthPerPixel",
        static_cast<float>(frame.depth_per_unit * frame.units_per_pixel / frame.pixel_ratio));
    uniforms->SetUniformf("extraLift", static_cast<float>(frame.depth_per_unit * frame.extra_lift));
    set_section_uniform(uniforms, frame.section);
    actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
        "dashUnit", static_cast<float>(dash_unit));
  }
}

}  // namespace arris::ui
