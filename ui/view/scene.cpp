#include "ui/view/scene.h"

#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>
#include <vtkTypeInt32Array.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>
#include <Eigen/Geometry>

namespace arris::ui {
namespace {

// Clay for a bare part; lighter where coloured edges lie on it.
const QColor bare_colour(212, 216, 223);
const QColor paper_colour(232, 234, 237);
const QColor unlabelled_colour(226, 227, 230);
const QColor selected_colour(255, 190, 30);

/// Normals of the vertices make a scan look smooth, those of the faces keep its sharp lines crisp:
/// where the two differ much the face's is taken.
constexpr const char* normal_code = R"(
  //VTK::Normal::Impl
  vec3 faceNormal = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));
  if (faceNormal.z < 0.0) faceNormal = -faceNormal;
  float agreement = dot(faceNormal, normalVCVSOutput);
  normalVCVSOutput = normalize(mix(faceNormal, normalVCVSOutput,
                                   smoothstep(0.80, 0.94, agreement)));
)";

/// Shades without ever changing a hue, and full colour where the surface faces the viewer: colours
/// on the part are those of the scalar bar. The back of the part is a dull grey.
constexpr const char* light_code = R"(
  float key = max(dot(normalVCVSOutput, vec3(-0.38, 0.48, 0.79)), 0.0);
  float fill = max(dot(normalVCVSOutput, vec3(0.62, -0.30, 0.72)), 0.0);
  float head = max(normalVCVSOutput.z, 0.0);
  float bare = 0.30 + 0.52 * key + 0.18 * fill + 0.12 * head;
  float coloured = min(0.32 + 0.30 * key + 0.12 * fill + 0.3566 * head, 1.0);
  vec3 shaded = diffuseColor * mix(bare, coloured, colourShare);
  shaded += (1.0 - colourShare) * 0.10 * pow(key, 24.0);
  if (!gl_FrontFacing) shaded = vec3(0.47, 0.48, 0.52) * (0.35 + 0.65 * head);
  gl_FragData[0] = vec4(shaded, opacity);
)";

/// As VTK declares them, but taken within the triangle where only a part of a pixel is covered:
/// values at the end of a scale must not spill over to the colour beyond it.
constexpr const char* vertex_place_code = "in vec2 tcoord; centroid out vec2 tcoordVCVSOutput;";
constexpr const char* fragment_place_code = "centroid in vec2 tcoordVCVSOutput;";

constexpr const char* lift_code = R"(
  //VTK::PositionVC::Impl
  gl_Position.z -= lift;
)";

std::vector<StrokeLayer> line_layers() {
  return {{line_rim, QColor(255, 255, 255, 215)}, {0.0F, QColor()}};
}

std::vector<StrokeLayer> selected_layers() {
  return {{4.3F, QColor(40, 30, 0)}, {3.2F, QColor(255, 214, 0)}, {0.5F, QColor()}};
}

std::vector<Stroke> brighter(std::vector<Stroke> strokes) {
  for (Stroke& stroke : strokes) stroke.colour = stroke.colour.lighter(125);
  return strokes;
}

vtkSmartPointer<vtkCellArray> cells_of(const std::vector<Triangle>& triangles) {
  const auto count = static_cast<vtkIdType>(triangles.size());
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(3 * count);
  for (vtkIdType i = 0; i <= count; ++i) {
    offsets->SetValue(i, static_cast<std::int32_t>(3 * i));
  }
  for (vtkIdType i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      corners->SetValue(3 * i + k,
                        static_cast<std::int32_t>(
                            triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]));
    }
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets.Get(), corners.Get());
  return cells;
}

vtkSmartPointer<vtkUnsignedCharArray> colours(std::size_t count) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  return array;
}

void write(unsigned char* at, const QColor& colour) {
  at[0] = static_cast<unsigned char>(colour.red());
  at[1] = static_cast<unsigned char>(colour.green());
  at[2] = static_cast<unsigned char>(colour.blue());
}

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto channel = [&](int x, int y) {
    return static_cast<int>(std::lround(x + (y - x) * share));
  };
  return {channel(a.red(), b.red()), channel(a.green(), b.green()), channel(a.blue(), b.blue())};
}

/// Where a value lies in the texture of a scale with `steps` colours, one for below and one for
/// above.
float texture_place(const ColourScale& scale, double value, int steps) {
  constexpr double rim = 1e-5;  // keeps the ends of the scale clear of the colours beyond it
  double x = scale.position(value);
  if (value < scale.min) {
    x = std::min(x, -1.0);
  } else if (value > scale.max) {
    x = std::max(x, 2.0);
  } else {
    x = std::clamp(x, rim, 1.0 - rim);
  }
  x = std::clamp(x, -1000.0, 1000.0);
  return static_cast<float>((x * steps + 1.0) / (steps + 2.0));
}

}  // namespace

const std::vector<Stroke>& line_strokes() {
  static const std::vector<Stroke> strokes{
      {1.9F, 0.0F, 0.0F, QColor(222, 66, 12)},    // C0 convex: solid
      {1.9F, 13.0F, 21.0F, QColor(16, 52, 186)},  // C0 concave: long dashes
      {1.6F, 4.0F, 11.5F, QColor(0, 112, 52)},    // Gn: short dashes
      {1.5F, 0.0F, 6.5F, QColor(150, 36, 170)},   // undefined: dots
      {0.9F, 0.0F, 0.0F, QColor(66, 68, 74)},     // border: thin
  };
  return strokes;
}

/// One set of triangles over the points of the mesh.
struct Scene::Shape {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;

  explicit Shape(vtkRenderer* renderer) {
    mapper->SetInputData(data);
    mapper->SetColorModeToDirectScalars();
    mapper->SetResolveCoincidentTopologyToOff();
    keep_coordinates(mapper);
    actor->SetMapper(mapper);
    actor->ForceOpaqueOn();
    vtkProperty* property = actor->GetProperty();
    property->SetAmbient(0.0);
    property->SetDiffuse(1.0);
    property->SetSpecular(0.0);
    property->ShowTexturesOnBackfaceOff();
    vtkShaderProperty* shader = actor->GetShaderProperty();
    shader->AddFragmentShaderReplacement("//VTK::Normal::Impl", true, normal_code, false);
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, light_code, false);
    shader->AddVertexShaderReplacement("//VTK::TCoord::Dec", true, vertex_place_code, false);
    shader->AddFragmentShaderReplacement("//VTK::TCoord::Dec", true, fragment_place_code, false);
    renderer->AddActor(actor);
  }
};

Scene::Scene()
    : label_outline_(line_renderer_, {{3.9F, 0.0F, 0.0F, QColor(255, 214, 0)}},
                     {{1.0F, QColor(40, 30, 0)}, {0.0F, QColor()}}),
      lines_(line_renderer_, line_strokes(), line_layers()),
      selected_lines_(line_renderer_, brighter(line_strokes()), selected_layers()) {
  fine_ = std::make_unique<Shape>(surface_renderer_);
  rough_ = std::make_unique<Shape>(surface_renderer_);
  fine_->actor->VisibilityOff();
  rough_->actor->VisibilityOff();

  texture_->SetInputData(texture_image_);
  texture_->InterpolateOff();
  texture_->RepeatOff();
  texture_->EdgeClampOn();

  net_mapper_->SetInputData(net_data_);
  net_mapper_->SetColorModeToDirectScalars();
  net_mapper_->SetResolveCoincidentTopologyToOff();
  keep_coordinates(net_mapper_);
  net_->SetMapper(net_mapper_);
  net_->ForceOpaqueOn();
  net_->VisibilityOff();
  net_->GetProperty()->LightingOff();
  net_->GetProperty()->SetAmbient(1.0);
  net_->GetProperty()->SetDiffuse(0.0);
  net_->GetShaderProperty()->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, lift_code,
                                                        false);
  surface_renderer_->AddActor(net_);

  // The shaders above do the lighting; the light makes VTK hand them normals.
  for (vtkRenderer* renderer : {surface_renderer_.Get(), line_renderer_.Get()}) {
    renderer->AutomaticLightCreationOff();
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    renderer->AddLight(light);
    renderer->GetActiveCamera()->ParallelProjectionOn();
  }
  surface_renderer_->SetLayer(0);
  line_renderer_->SetLayer(1);
  line_renderer_->PreserveColorBufferOn();
  line_renderer_->PreserveDepthBufferOn();
  line_renderer_->SetActiveCamera(surface_renderer_->GetActiveCamera());
}

Scene::~Scene() = default;

void Scene::refresh() {
  stale_ = true;
  ++surface_version_;
}

void Scene::set_mesh(MeshPtr mesh) {
  mesh_ = std::move(mesh);
  coarse_.reset();
  field_.reset();
  labels_.clear();
  label_colours_.clear();
  selected_labels_.clear();
  lines_.clear();
  selected_lines_.clear();
  label_outline_.clear();
  net_built_ = false;
  net_data_->Initialize();
  fine_->data->Initialize();
  rough_->data->Initialize();
  if (mesh_) upload_geometry();
  refresh();
}

void Scene::upload_geometry() {
  origin_ = (mesh_->box_min() + mesh_->box_max()) / 2;
  radius_ = std::max(mesh_->diagonal() / 2, 1e-30);
  const std::size_t count = mesh_->vertex_count();
  vtkNew<vtkFloatArray> points;
  points->SetNumberOfComponents(3);
  points->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (VertexId v = 0; v < count; ++v) {
    const Eigen::Vector3f point = (mesh_->point(v) - origin_).cast<float>();
    points->SetTypedTuple(v, point.data());
  }
  // Weighted by area: small faces of noise count little.
  std::vector<Point> sums(count, Point::Zero());
  for (const Triangle& t : mesh_->triangles()) {
    const Point& a = mesh_->point(t[0]);
    const Point normal = (mesh_->point(t[1]) - a).cross(mesh_->point(t[2]) - a);
    for (const VertexId v : t) sums[v] += normal;
  }
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (VertexId v = 0; v < count; ++v) {
    const double length = sums[v].norm();
    const Eigen::Vector3f normal =
        (length > 0.0 ? Point(sums[v] / length) : Point(Point::UnitZ())).cast<float>();
    normals->SetTypedTuple(v, normal.data());
  }
  vtkNew<vtkPoints> shell;
  shell->SetData(points);
  for (const auto& shape : {fine_.get(), rough_.get()}) {
    shape->data->SetPoints(shell);
    shape->data->GetPointData()->SetNormals(normals);
  }
  fine_->data->SetPolys(cells_of(mesh_->triangles()));
}

void Scene::set_coarse(std::shared_ptr<const CoarseMesh> coarse) {
  coarse_ = std::move(coarse);
  if (!coarse_) return;
  rough_->data->SetPolys(cells_of(coarse_->triangles));
  stale_ = true;
}

void Scene::set_field(const std::optional<ViewField>& field) {
  field_ = field;
  refresh();
}

void Scene::set_face_labels(std::vector<std::uint32_t> labels, std::vector<QColor> colours) {
  labels_ = std::move(labels);
  if (mesh_ && labels_.size() != mesh_->face_count()) labels_.clear();
  label_colours_ = std::move(colours);
  outline_selection();
  refresh();
}

void Scene::set_selected_labels(std::unordered_set<std::uint32_t> labels) {
  if (labels == selected_labels_) return;
  selected_labels_ = std::move(labels);
  outline_selection();
  refresh();
}

void Scene::outline_selection() {
  label_outline_.clear();
  if (!mesh_ || labels_.empty() || selected_labels_.empty()) return;
  std::vector<std::vector<VertexId>> segments;
  for (EdgeId e = 0; e < mesh_->edge_count(); ++e) {
    const auto faces = mesh_->edge_faces(e);
    const auto label = [&](FaceId f) { return f == no_id ? 0u : labels_[f]; };
    const std::uint32_t a = label(faces[0]);
    const std::uint32_t b = label(faces[1]);
    if (a == b || selected_labels_.count(a) + selected_labels_.count(b) == 0) continue;
    segments.push_back({mesh_->edge(e)[0], mesh_->edge(e)[1]});
  }
  std::vector<Ribbons::Line> lines;
  lines.reserve(segments.size());
  for (const auto& segment : segments) lines.push_back({&segment, 0});
  label_outline_.set_lines(*mesh_, origin_, lines);
}

void Scene::set_lines(const std::vector<ViewLine>& lines) {
  if (!mesh_) return;
  std::vector<Ribbons::Line> ribbons;
  ribbons.reserve(lines.size());
  for (const ViewLine& line : lines) {
    ribbons.push_back({&line.vertices, static_cast<int>(line.type)});
  }
  lines_.set_lines(*mesh_, origin_, ribbons);
}

void Scene::set_selected_lines(const std::vector<ViewLine>& lines,
                               const std::unordered_set<std::uint32_t>& ids) {
  selected_lines_.clear();
  if (!mesh_ || ids.empty()) return;
  std::vector<Ribbons::Line> ribbons;
  for (const ViewLine& line : lines) {
    if (line.id != 0 && ids.count(line.id) != 0) {
      ribbons.push_back({&line.vertices, static_cast<int>(line.type)});
    }
  }
  selected_lines_.set_lines(*mesh_, origin_, ribbons);
}

void Scene::set_lines_visible(bool visible) {
  lines_.set_visible(visible);
  selected_lines_.set_visible(visible);
}

void Scene::set_edges_visible(bool visible) {
  if (visible == edges_visible_) return;
  edges_visible_ = visible;
  refresh();
}

void Scene::set_ground(const QColor& bottom, const QColor& top) {
  surface_renderer_->SetBackground(bottom.redF(), bottom.greenF(), bottom.blueF());
  surface_renderer_->SetBackground2(top.redF(), top.greenF(), top.blueF());
  surface_renderer_->SetBackgroundAlpha(bottom.alphaF());
  surface_renderer_->SetGradientBackground(bottom != top);
  ++surface_version_;
}

void Scene::prepare(const ViewCamera& camera, QSize pixels, double pixel_ratio, bool coarse) {
  coarse = coarse && coarse_ != nullptr;
  if (stale_) show_field();
  stale_ = false;
  const bool shown = mesh_ != nullptr && mesh_->face_count() > 0;
  fine_->actor->SetVisibility(shown && !coarse);
  rough_->actor->SetVisibility(shown && coarse);
  const bool edge_field = labels_.empty() && field_ && field_->on_edges;
  net_->SetVisibility(shown && !coarse && (edge_field || edges_visible_));
  net_->GetProperty()->SetLineWidth(static_cast<float>((edge_field ? 1.3 : 1.0) * pixel_ratio));

  // In a parallel projection the camera's distance does not show; it stays in front of the part.
  const Point focus = camera.focus() - origin_;
  const double ahead = -focus.dot(camera.towards_viewer());
  const Point position = focus + camera.towards_viewer() * (ahead + 3.0 * radius_);
  vtkCamera* vtk_camera = surface_renderer_->GetActiveCamera();
  const Point up = camera.up();
  const Point target = focus + camera.towards_viewer() * ahead;
  vtk_camera->SetFocalPoint(target.data());
  vtk_camera->SetPosition(position.data());
  vtk_camera->SetViewUp(up.data());
  vtk_camera->SetParallelScale(camera.height() / 2);
  vtk_camera->SetClippingRange(1.8 * radius_, 4.2 * radius_);

  RibbonFrame frame;
  frame.pixel_ratio = pixel_ratio;
  frame.units_per_pixel = camera.height() / pixels.height() * pixel_ratio;
  frame.depth_per_unit = 2.0 / (2.4 * radius_);
  frame.extra_lift = coarse ? coarse_->cell : 0.0;
  frame.viewport = {pixels.width(), pixels.height()};
  frame.towards_viewer = camera.towards_viewer();
  for (Ribbons* ribbons : {&lines_, &selected_lines_, &label_outline_}) ribbons->update(frame);
  net_->GetShaderProperty()->GetVertexCustomUniforms()->SetUniformf(
      "lift", static_cast<float>(1.2 * frame.units_per_pixel * frame.depth_per_unit));
}

void Scene::show_field() {
  if (!mesh_) return;
  QColor base = bare_colour;
  float colour_share = 1.0F;
  for (const auto& shape : {fine_.get(), rough_.get()}) {
    shape->actor->SetTexture(nullptr);
    shape->data->GetPointData()->SetScalars(nullptr);
    shape->data->GetCellData()->SetScalars(nullptr);
    shape->mapper->ScalarVisibilityOff();
  }
  const auto fits = [&](std::size_t count) {
    return field_ && field_->values && field_->values->size() == count;
  };
  net_mapper_->ScalarVisibilityOff();
  net_->GetProperty()->SetColor(0.25, 0.27, 0.31);
  net_->GetProperty()->SetOpacity(0.45);
  if (edges_visible_ || (field_ && field_->on_edges)) build_net();
  if (!labels_.empty()) {
    show_labels();
  } else if (field_ && field_->on_edges && fits(mesh_->edge_count())) {
    base = paper_colour;
    colour_share = 0.0F;
    show_edge_field();
  } else if (field_ && !field_->on_edges && fits(mesh_->vertex_count())) {
    base = QColor(Qt::white);
    if (field_->class_names.isEmpty()) {
      show_scale_field();
    } else {
      show_class_field();
    }
  } else {
    colour_share = 0.0F;
  }
  for (const auto& shape : {fine_.get(), rough_.get()}) {
    shape->actor->GetProperty()->SetColor(base.redF(), base.greenF(), base.blueF());
    shape->actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf("colourShare",
                                                                                colour_share);
  }
}

void Scene::show_scale_field() {
  const ColourScale& scale = field_->scale;
  const std::vector<double>& values = *field_->values;
  const int steps = scale.bands > 0 ? scale.bands : 1024;
  texture_image_->SetDimensions(steps + 2, 2, 1);
  texture_image_->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  ColourScale plain;  // evenly over the positions, to read the colours of the positions from
  plain.map = scale.map;
  plain.reversed = scale.reversed;
  plain.bands = scale.bands;
  for (int i = 0; i < steps + 2; ++i) {
    auto colour = plain.colour((i - 0.5) / steps);
    if (i == 0 && scale.below.isValid()) colour = scale.colour(-HUGE_VAL);
    if (i == steps + 1 && scale.above.isValid()) colour = scale.colour(HUGE_VAL);
    std::copy(colour.begin(), colour.end(),
              static_cast<unsigned char*>(texture_image_->GetScalarPointer(i, 0, 0)));
    write(static_cast<unsigned char*>(texture_image_->GetScalarPointer(i, 1, 0)), scale.undefined);
  }
  texture_image_->Modified();
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  places->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (VertexId v = 0; v < values.size(); ++v) {
    if (!std::isnan(values[v])) {
      const std::array<float, 2> place{texture_place(scale, values[v], steps), 0.25F};
      places->SetTypedTuple(v, place.data());
      continue;
    }
    // Half of each face beside an undefined vertex still shows the field, as its neighbours have
    // it.
    double sum = 0.0;
    int count = 0;
    mesh_->for_ring(v, [&](HalfEdgeId h) {
      const double value = values[mesh_->to(h)];
      if (std::isnan(value)) return;
      sum += texture_place(scale, value, steps);
      ++count;
    });
    const std::array<float, 2> place{static_cast<float>(count > 0 ? sum / count : 0.5), 0.75F};
    places->SetTypedTuple(v, place.data());
  }
  for (const auto& shape : {fine_.get(), rough_.get()}) {
    shape->data->GetPointData()->SetTCoords(places);
    shape->actor->SetTexture(texture_);
  }
}

void Scene::show_class_field() {
  const std::vector<double>& values = *field_->values;
  const auto array = colours(values.size());
  for (VertexId v = 0; v < values.size(); ++v) {
    const bool known =
        values[v] >= 0.0 && values[v] < static_cast<double>(field_->class_colours.size());
    write(array->GetPointer(3 * static_cast<vtkIdType>(v)),
          known ? field_->class_colours[static_cast<std::size_t>(values[v])]
                : field_->scale.undefined);
  }
  for (const auto& shape : {fine_.get(), rough_.get()}) {
    shape->data->GetPointData()->SetScalars(array);
    shape->mapper->SetScalarModeToUsePointData();
    shape->mapper->ScalarVisibilityOn();
  }
}

void Scene::show_edge_field() {
  const std::vector<double>& values = *field_->values;
  const auto array = colours(values.size());
  for (EdgeId e = 0; e < values.size(); ++e) {
    const auto colour = field_->scale.colour(values[e]);
    std::copy(colour.begin(), colour.end(), array->GetPointer(3 * static_cast<vtkIdType>(e)));
  }
  net_data_->GetCellData()->SetScalars(array);
  net_mapper_->SetScalarModeToUseCellData();
  net_mapper_->ScalarVisibilityOn();
  net_->GetProperty()->SetOpacity(1.0);
}

void Scene::build_net() {
  if (net_built_) return;
  net_built_ = true;
  const auto count = static_cast<vtkIdType>(mesh_->edge_count());
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  vtkNew<vtkTypeInt32Array> ends;
  ends->SetNumberOfValues(2 * count);
  for (vtkIdType i = 0; i <= count; ++i) {
    offsets->SetValue(i, static_cast<std::int32_t>(2 * i));
  }
  for (vtkIdType i = 0; i < count; ++i) {
    const EdgeVertices& edge = mesh_->edge(static_cast<EdgeId>(i));
    ends->SetValue(2 * i, static_cast<std::int32_t>(edge[0]));
    ends->SetValue(2 * i + 1, static_cast<std::int32_t>(edge[1]));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets.Get(), ends.Get());
  net_data_->SetPoints(fine_->data->GetPoints());
  net_data_->SetLines(cells);
}

void Scene::show_labels() {
  const auto colour_of = [&](std::uint32_t label) {
    QColor colour = label == 0 || label >= label_colours_.size() || !label_colours_[label].isValid()
                        ? unlabelled_colour
                        : label_colours_[label];
    if (label != 0 && selected_labels_.count(label) != 0) {
      colour = mixed(colour, selected_colour, 0.75);
    }
    return colour;
  };
  std::vector<QColor> table;
  const std::uint32_t most = *std::max_element(labels_.begin(), labels_.end());
  const std::size_t size = std::min<std::size_t>(most, label_colours_.size()) + 1;
  for (std::uint32_t label = 0; label < size; ++label) table.push_back(colour_of(label));
  const auto all = colours(labels_.size());
  for (std::size_t f = 0; f < labels_.size(); ++f) {
    write(all->GetPointer(3 * static_cast<vtkIdType>(f)),
          labels_[f] < size ? table[labels_[f]] : colour_of(labels_[f]));
  }
  fine_->data->GetCellData()->SetScalars(all);
  if (coarse_) {
    const auto some = colours(coarse_->source_faces.size());
    for (std::size_t i = 0; i < coarse_->source_faces.size(); ++i) {
      std::copy_n(all->GetPointer(3 * static_cast<vtkIdType>(coarse_->source_faces[i])), 3,
                  some->GetPointer(3 * static_cast<vtkIdType>(i)));
    }
    rough_->data->GetCellData()->SetScalars(some);
  }
  for (const auto& shape : {fine_.get(), rough_.get()}) {
    shape->mapper->SetScalarModeToUseCellData();
    shape->mapper->ScalarVisibilityOn();
  }
}

}  // namespace arris::ui
