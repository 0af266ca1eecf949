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

#include "ui/view/surface_shaders.h"

namespace arris::ui {
namespace {

// Clay for a bare part; lighter where coloured edges lie on it.
const QColor bare_colour(212, 216, 223);
const QColor paper_colour(232, 234, 237);
const QColor unlabelled_colour(226, 227, 230);
const QColor selected_colour(255, 190, 30);
const QColor highlight_colour(255, 128, 0);
const QColor ghost_colour(0, 214, 236);
constexpr float marked_half_width = 6.5F;

/// Gives an actor the uniforms `lift` (towards the viewer, in depth) and `sectionPlane`, and the
/// distance beyond the section to its fragments.
void add_place(vtkActor* actor) {
  vtkShaderProperty* shader = actor->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Dec", true,
                                     "//VTK::PositionVC::Dec\nout float beyondVS;", false);
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, place_code, false);
  shader->AddFragmentShaderReplacement("//VTK::PositionVC::Dec", true,
                                       "//VTK::PositionVC::Dec\nin float beyondVS;", false);
  shader->GetVertexCustomUniforms()->SetUniformf("lift", 0.0F);
  set_section_uniform(shader->GetVertexCustomUniforms(), no_section);
}

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

std::array<std::uint8_t, 3> rgb_of(const QColor& colour) {
  return {static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
          static_cast<std::uint8_t>(colour.blue())};
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

bool fits(const ViewField& field, const Mesh& mesh) {
  if (!field.values) return false;
  const std::size_t count = field.element == Element::edge   ? mesh.edge_count()
                            : field.element == Element::face ? mesh.face_count()
                                                             : mesh.vertex_count();
  return field.values->size() == count;
}

bool shows(const std::array<FaceId, 2>& faces, const std::vector<bool>& hidden) {
  return std::any_of(faces.begin(), faces.end(),
                     [&](FaceId f) { return f != no_id && !hidden[f]; });
}

const std::vector<Stroke>& line_strokes() {
  static const std::vector<Stroke> strokes{
      {1.9F, 0.0F, 0.0F, QColor(222, 66, 12)},    // C0 convex: solid
      {1.9F, 13.0F, 21.0F, QColor(16, 52, 186)},  // C0 concave: long dashes
      {1.6F, 4.0F, 11.5F, QColor(0, 112, 52)},    // Gn: short dashes
      {1.0F, 0.0F, 0.0F, QColor(0, 132, 138)},    // tangent: thin
      {1.5F, 0.0F, 6.5F, QColor(150, 36, 170)},   // undefined: dots
      {0.9F, 0.0F, 0.0F, QColor(66, 68, 74)},     // border: thin
  };
  return strokes;
}

QColor marked_colour() { return QColor(255, 60, 172, 215); }

/// One set of triangles over the points of a mesh.
struct Scene::Shape {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  std::vector<FaceId> faces;  // the face of the mesh behind each triangle drawn; empty: the same

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
    add_place(actor);
    shader->AddFragmentShaderReplacement("//VTK::Normal::Impl", true, normal_code, false);
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, light_code, false);
    shader->AddFragmentShaderReplacement("//VTK::TCoord::Impl", true, rim_code, false);
    shader->AddVertexShaderReplacement("//VTK::TCoord::Dec", true, vertex_place_code, false);
    shader->AddFragmentShaderReplacement("//VTK::TCoord::Dec", true, fragment_place_code, false);
    shader->GetFragmentCustomUniforms()->SetUniformf("cutRimWidth", 1.0F);
    shader->GetFragmentCustomUniforms()->SetUniformf("cutMost", 1.0F);
    shader->GetFragmentCustomUniforms()->SetUniformf("hatchPeriod", 8.0F);
    set_smooth(true);
    actor->VisibilityOff();
    renderer->AddActor(actor);
  }

  /// `light_share`: 0 draws the bare colour, whatever way the surface faces.
  void paint(const QColor& colour, float colour_share, float light_share, const QColor& undefined) {
    actor->GetProperty()->SetColor(colour.redF(), colour.greenF(), colour.blueF());
    vtkUniforms* uniforms = actor->GetShaderProperty()->GetFragmentCustomUniforms();
    uniforms->SetUniformf("colourShare", colour_share);
    uniforms->SetUniformf("lightShare", light_share);
    const std::array<float, 3> ink{undefined.redF(), undefined.greenF(), undefined.blueF()};
    uniforms->SetUniform3f("undefinedColour", ink.data());
  }

  void set_smooth(bool smooth) {
    actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf("smoothShare",
                                                                         smooth ? 1.0F : 0.0F);
  }

  /// Draws those of `triangles` that are shown; `sources`: their faces, empty: the same numbers.
  void set_triangles(const std::vector<Triangle>& triangles, const std::vector<FaceId>& sources,
                     const std::vector<bool>& hidden) {
    faces = sources;
    if (hidden.empty()) {
      data->SetPolys(cells_of(triangles));
      return;
    }
    std::vector<Triangle> shown;
    faces.clear();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const FaceId face = sources.empty() ? static_cast<FaceId>(i) : sources[i];
      if (hidden[face]) continue;
      shown.push_back(triangles[i]);
      faces.push_back(face);
    }
    data->SetPolys(cells_of(shown));
  }

  /// Flat colours: `colour_of(face)` is written for each triangle drawn.
  template <class ColourOf>
  void colour_faces(const ColourOf& colour_of) {
    const auto count = static_cast<std::size_t>(data->GetNumberOfPolys());
    const auto array = colours(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto rgb = colour_of(faces.empty() ? static_cast<FaceId>(i) : faces[i]);
      std::copy(rgb.begin(), rgb.end(), array->GetPointer(3 * static_cast<vtkIdType>(i)));
    }
    data->GetCellData()->SetScalars(array);
    mapper->SetScalarModeToUseCellData();
    mapper->ScalarVisibilityOn();
  }
};

/// The edges of a mesh as thin lines.
struct Scene::Net {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  std::vector<EdgeId> edges;  // the edge behind each line drawn
  bool built = false;

  explicit Net(vtkRenderer* renderer) {
    mapper->SetInputData(data);
    mapper->SetColorModeToDirectScalars();
    mapper->SetResolveCoincidentTopologyToOff();
    keep_coordinates(mapper);
    actor->SetMapper(mapper);
    actor->ForceOpaqueOn();
    actor->VisibilityOff();
    vtkProperty* property = actor->GetProperty();
    property->LightingOff();
    property->SetAmbient(1.0);
    property->SetDiffuse(0.0);
    property->SetColor(0.25, 0.27, 0.31);
    property->SetOpacity(0.45);
    add_place(actor);
    actor->GetShaderProperty()->AddFragmentShaderReplacement(
        "//VTK::Clip::Impl", true, "//VTK::Clip::Impl\n  if (beyondVS > 0.0) discard;", false);
    renderer->AddActor(actor);
  }

  void build(const Mesh& mesh, vtkPoints* points, const std::vector<bool>& hidden) {
    if (built) return;
    built = true;
    edges.clear();
    for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
      if (hidden.empty() || shows(mesh.edge_faces(e), hidden)) edges.push_back(e);
    }
    const auto count = static_cast<vtkIdType>(edges.size());
    vtkNew<vtkTypeInt32Array> offsets;
    offsets->SetNumberOfValues(count + 1);
    vtkNew<vtkTypeInt32Array> ends;
    ends->SetNumberOfValues(2 * count);
    for (vtkIdType i = 0; i <= count; ++i) {
      offsets->SetValue(i, static_cast<std::int32_t>(2 * i));
    }
    for (vtkIdType i = 0; i < count; ++i) {
      const EdgeVertices& edge = mesh.edge(edges[static_cast<std::size_t>(i)]);
      ends->SetValue(2 * i, static_cast<std::int32_t>(edge[0]));
      ends->SetValue(2 * i + 1, static_cast<std::int32_t>(edge[1]));
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets.Get(), ends.Get());
    data->SetPoints(points);
    data->SetLines(cells);
  }

  void clear() {
    built = false;
    data->Initialize();
  }
};

/// Faces marked in passing, translucent over the surface.
struct Scene::Highlight {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;

  explicit Highlight(vtkRenderer* renderer) {
    points->SetDataTypeToFloat();
    data->SetPoints(points);
    data->SetPolys(cells);
    mapper->SetInputData(data);
    mapper->SetResolveCoincidentTopologyToOff();
    keep_coordinates(mapper);
    write_no_depth(mapper, renderer);
    actor->SetMapper(mapper);
    actor->ForceOpaqueOn();
    actor->VisibilityOff();
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(highlight_colour.redF(), highlight_colour.greenF(),
                                   highlight_colour.blueF());
    actor->GetProperty()->SetAmbient(1.0);
    actor->GetProperty()->SetDiffuse(0.0);
    actor->GetProperty()->SetOpacity(0.55);
    add_place(actor);
    actor->GetShaderProperty()->AddFragmentShaderReplacement(
        "//VTK::Clip::Impl", true, "//VTK::Clip::Impl\n  if (beyondVS > 0.0) discard;", false);
    renderer->AddActor(actor);
  }

  void clear() {
    points->Reset();
    cells->Reset();
    actor->VisibilityOff();
  }

  void add(const Mesh& mesh, const Point& origin, const std::vector<FaceId>& faces) {
    for (const FaceId f : faces) {
      std::array<vtkIdType, 3> ids{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Point point = mesh.point(mesh.triangle(f)[k]) - origin;
        ids[k] = points->InsertNextPoint(point.data());
      }
      cells->InsertNextCell(3, ids.data());
    }
    points->Modified();
    cells->Modified();
    data->Modified();
    actor->SetVisibility(cells->GetNumberOfCells() > 0);
  }
};

/// A mesh as it is drawn: in full, and as its stand-in while the camera moves.
struct Scene::Body {
  MeshPtr mesh;
  std::shared_ptr<const CoarseMesh> coarse;
  Shape fine, rough;
  Net net;
  bool uploaded = false;

  explicit Body(vtkRenderer* renderer) : fine(renderer), rough(renderer), net(renderer) {}

  void set_mesh(MeshPtr other) {
    mesh = std::move(other);
    coarse.reset();
    uploaded = false;
    net.clear();
    fine.data->Initialize();
    rough.data->Initialize();
  }

  void upload(const Point& origin, const std::vector<bool>& hidden) {
    if (uploaded || !mesh) return;
    uploaded = true;
    const std::size_t count = mesh->vertex_count();
    vtkNew<vtkFloatArray> points;
    points->SetNumberOfComponents(3);
    points->SetNumberOfTuples(static_cast<vtkIdType>(count));
    for (VertexId v = 0; v < count; ++v) {
      const Eigen::Vector3f point = (mesh->point(v) - origin).cast<float>();
      points->SetTypedTuple(v, point.data());
    }
    // Weighted by area: small faces of noise count little.
    std::vector<Point> sums(count, Point::Zero());
    for (const Triangle& t : mesh->triangles()) {
      const Point& a = mesh->point(t[0]);
      const Point normal = (mesh->point(t[1]) - a).cross(mesh->point(t[2]) - a);
      for (const VertexId v : t) sums[v] += normal;
    }
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(static_cast<vtkIdType>(count));
    for (Point& sum : sums) sum = sum.norm() > 0.0 ? Point(sum.normalized()) : Point::UnitZ();
    // As long as it agrees with the face about it that it fits least, which the shader reads.
    constexpr double least_agreement = 0.05;  // a direction is left in any case
    std::vector<double> agreements(count, 1.0);
    for (const Triangle& t : mesh->triangles()) {
      const Point& a = mesh->point(t[0]);
      const Point normal = (mesh->point(t[1]) - a).cross(mesh->point(t[2]) - a);
      const double length = normal.norm();
      if (!(length > 0.0)) continue;
      for (const VertexId v : t)
        agreements[v] = std::min(agreements[v], sums[v].dot(normal) / length);
    }
    for (VertexId v = 0; v < count; ++v) {
      const Eigen::Vector3f normal =
          (sums[v] * std::max(agreements[v], least_agreement)).cast<float>();
      normals->SetTypedTuple(v, normal.data());
    }
    vtkNew<vtkPoints> shell;
    shell->SetData(points);
    for (Shape* shape : {&fine, &rough}) {
      shape->data->SetPoints(shell);
      shape->data->GetPointData()->SetNormals(normals);
    }
    set_hidden(hidden);
  }

  void set_hidden(const std::vector<bool>& hidden) {
    if (!uploaded) return;
    fine.set_triangles(mesh->triangles(), {}, hidden);
    if (coarse) rough.set_triangles(coarse->triangles, coarse->source_faces, hidden);
    net.clear();
  }

  void show(bool shown, bool as_coarse, bool with_net) {
    as_coarse = as_coarse && coarse != nullptr;
    fine.actor->SetVisibility(shown && !as_coarse);
    rough.actor->SetVisibility(shown && as_coarse);
    net.actor->SetVisibility(shown && !as_coarse && with_net);
  }

  std::array<vtkActor*, 3> actors() { return {fine.actor, rough.actor, net.actor}; }
};

Scene::Scene()
    : highlight_(std::make_unique<Highlight>(line_renderer_)),
      marked_(line_renderer_, {{marked_half_width, 0.0F, 0.0F, marked_colour()}},
              {{0.0F, QColor()}}),
      label_outline_(line_renderer_, {{3.9F, 0.0F, 0.0F, QColor(255, 214, 0)}},
                     {{1.0F, QColor(40, 30, 0)}, {0.0F, QColor()}}),
      lines_(line_renderer_, line_strokes(), line_layers()),
      selected_lines_(line_renderer_, brighter(line_strokes()), selected_layers()),
      ghosts_(line_renderer_, {{2.1F, 7.0F, 13.0F, ghost_colour}},
              {{1.3F, QColor(10, 30, 38, 220)}, {0.0F, QColor()}}) {
  body_ = std::make_unique<Body>(surface_renderer_);
  // After the mesh, so that it blends over it.
  reference_ = std::make_unique<Body>(surface_renderer_);

  texture_->SetInputData(texture_image_);
  texture_->InterpolateOff();
  texture_->RepeatOff();
  texture_->EdgeClampOn();

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
  hidden_.clear();
  field_.reset();
  labels_.clear();
  label_colours_.clear();
  selected_labels_.clear();
  lines_.clear();
  selected_lines_.clear();
  label_outline_.clear();
  ghosts_.clear();
  marked_.clear();
  highlight_->clear();
  body_->set_mesh(std::move(mesh));
  reference_->set_mesh(nullptr);
  hidden_reference_.clear();
  if (body_->mesh) {
    origin_ = (body_->mesh->box_min() + body_->mesh->box_max()) / 2;
    radius_ = std::max(body_->mesh->diagonal() / 2, 1e-30);
    body_->upload(origin_, hidden_);
  }
  refresh();
}

void Scene::set_coarse(std::shared_ptr<const CoarseMesh> coarse) {
  body_->coarse = std::move(coarse);
  if (!body_->coarse) return;
  body_->rough.set_triangles(body_->coarse->triangles, body_->coarse->source_faces, hidden_);
  stale_ = true;
}

void Scene::set_reference(MeshPtr mesh, double gap) {
  reference_->set_mesh(std::move(mesh));
  hidden_reference_.clear();
  gap_ = gap;
  refresh();
}

void Scene::set_reference_coarse(std::shared_ptr<const CoarseMesh> coarse) {
  reference_->coarse = std::move(coarse);
  if (!reference_->coarse || !reference_->uploaded) return;
  reference_->rough.set_triangles(reference_->coarse->triangles, reference_->coarse->source_faces,
                                  hidden_reference_);
}

void Scene::set_shown(ShownSurface shown) {
  if (shown == shown_) return;
  shown_ = shown;
  refresh();
}

ShownSurface Scene::shown() const { return reference_->mesh ? shown_ : ShownSurface::mesh; }

void Scene::set_hidden_faces(std::vector<bool> hidden) {
  hidden_ = std::move(hidden);
  body_->set_hidden(hidden_);
  outline_selection();
  refresh();
}

void Scene::set_hidden_reference_faces(std::vector<bool> hidden) {
  hidden_reference_ = std::move(hidden);
  reference_->set_hidden(hidden_reference_);
  refresh();
}

void Scene::set_section(const std::optional<Section>& section) {
  section_ = section;
  ++surface_version_;
}

namespace {

std::vector<Ribbons::Line> ribbons_of(const std::vector<std::vector<VertexId>>& paths) {
  std::vector<Ribbons::Line> ribbons;
  for (const auto& path : paths) ribbons.push_back({&path, 0});
  return ribbons;
}

}  // namespace

void Scene::set_ghost_paths(const std::vector<std::vector<VertexId>>& paths) {
  if (body_->mesh) ghosts_.set_lines(*body_->mesh, origin_, ribbons_of(paths));
}

void Scene::set_marked_paths(const std::vector<std::vector<VertexId>>& paths) {
  if (body_->mesh) marked_.set_lines(*body_->mesh, origin_, ribbons_of(paths));
}

void Scene::highlight_faces(const std::vector<FaceId>& faces) {
  highlight_->add(*body_->mesh, origin_, faces);
}

void Scene::clear_highlight() { highlight_->clear(); }

void Scene::set_field(const std::optional<ViewField>& field) {
  field_ = field;
  refresh();
}

bool Scene::set_face_labels(std::vector<std::uint32_t> labels, std::vector<QColor> colours) {
  if (body_->mesh && labels.size() != body_->mesh->face_count()) labels.clear();
  // While a threshold is dragged often nothing is other than a moment ago, and the kept picture of
  // the surface stays.
  if (labels == labels_ && (labels.empty() || colours == label_colours_)) return false;
  labels_ = std::move(labels);
  label_colours_ = std::move(colours);
  outline_selection();
  refresh();
  return true;
}

void Scene::set_selected_labels(std::unordered_set<std::uint32_t> labels) {
  if (labels == selected_labels_) return;
  selected_labels_ = std::move(labels);
  outline_selection();
  refresh();
}

void Scene::outline_selection() {
  label_outline_.clear();
  if (!body_->mesh || labels_.empty() || selected_labels_.empty()) return;
  const Mesh& mesh = *body_->mesh;
  std::vector<std::vector<VertexId>> segments;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const auto faces = mesh.edge_faces(e);
    const auto label = [&](FaceId f) { return f == no_id ? 0u : labels_[f]; };
    const std::uint32_t a = label(faces[0]);
    const std::uint32_t b = label(faces[1]);
    if (a == b || selected_labels_.count(a) + selected_labels_.count(b) == 0) continue;
    if (!hidden_.empty() && !shows(faces, hidden_)) continue;
    segments.push_back({mesh.edge(e)[0], mesh.edge(e)[1]});
  }
  std::vector<Ribbons::Line> lines;
  lines.reserve(segments.size());
  for (const auto& segment : segments) lines.push_back({&segment, 0});
  label_outline_.set_lines(mesh, origin_, lines);
}

void Scene::set_lines(const std::vector<ViewLine>& lines) {
  if (!body_->mesh) return;
  std::vector<Ribbons::Line> ribbons;
  ribbons.reserve(lines.size());
  for (const ViewLine& line : lines) {
    ribbons.push_back({&line.vertices, static_cast<int>(line.type)});
  }
  lines_.set_lines(*body_->mesh, origin_, ribbons);
}

void Scene::set_selected_lines(const std::vector<ViewLine>& lines,
                               const std::unordered_set<std::uint32_t>& ids) {
  selected_lines_.clear();
  if (!body_->mesh || ids.empty()) return;
  std::vector<Ribbons::Line> ribbons;
  for (const ViewLine& line : lines) {
    if (line.id != 0 && ids.count(line.id) != 0) {
      ribbons.push_back({&line.vertices, static_cast<int>(line.type)});
    }
  }
  selected_lines_.set_lines(*body_->mesh, origin_, ribbons);
}

void Scene::set_lines_visible(bool visible) {
  lines_.set_visible(visible);
  marked_.set_visible(visible);
  selected_lines_.set_visible(visible);
}

void Scene::set_edges_visible(bool visible) {
  if (visible == edges_visible_) return;
  edges_visible_ = visible;
  refresh();
}

void Scene::set_fields_lit(bool lit) {
  if (lit == fields_lit_) return;
  fields_lit_ = lit;
  refresh();
}

void Scene::set_flat(bool flat) {
  if (flat == flat_) return;
  flat_ = flat;
  for (Body* body : {body_.get(), reference_.get()})
    for (Shape* shape : {&body->fine, &body->rough}) shape->set_smooth(!flat);
  ++surface_version_;
}

void Scene::set_ground(const QColor& bottom, const QColor& top) {
  surface_renderer_->SetBackground(bottom.redF(), bottom.greenF(), bottom.blueF());
  surface_renderer_->SetBackground2(top.redF(), top.greenF(), top.blueF());
  surface_renderer_->SetBackgroundAlpha(bottom.alphaF());
  surface_renderer_->SetGradientBackground(bottom != top);
  ++surface_version_;
}

void Scene::prepare(const ViewCamera& camera, QSize pixels, double pixel_ratio, bool coarse) {
  if (stale_) show_field();
  stale_ = false;
  const bool both = shown() == ShownSurface::both;
  const bool with_reference = shown() != ShownSurface::mesh;
  const bool with_mesh =
      shown() != ShownSurface::reference && body_->mesh != nullptr && body_->mesh->face_count() > 0;
  const bool edge_field = labels_.empty() && field_ && field_->element == Element::edge;
  body_->show(with_mesh, coarse, edge_field || edges_visible_);
  reference_->show(with_reference, coarse, !both && edges_visible_);
  for (Shape* shape : {&reference_->fine, &reference_->rough})
    shape->actor->GetProperty()->SetOpacity(both ? 0.5 : 1.0);
  body_->net.actor->GetProperty()->SetLineWidth(
      static_cast<float>((edge_field ? 1.3 : 1.0) * pixel_ratio));
  reference_->net.actor->GetProperty()->SetLineWidth(static_cast<float>(pixel_ratio));

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
  // Lines belong to the mesh, over which the reference may lie and a stand-in may rise.
  const double reference_lift = both ? 1.5 * gap_ : 0.0;
  if (with_reference) frame.extra_lift = 1.5 * gap_ + reference_lift;
  for (const Body* body : {body_.get(), reference_.get()}) {
    if (body->rough.actor->GetVisibility())
      frame.extra_lift = std::max(frame.extra_lift, body->coarse->cell);
  }
  frame.viewport = {pixels.width(), pixels.height()};
  frame.towards_viewer = camera.towards_viewer();
  frame.section = local_section();
  for (Ribbons* ribbons : {&marked_, &lines_, &selected_lines_, &label_outline_, &ghosts_})
    ribbons->update(frame);
  const auto lift = [&](vtkActor* actor, double units) {
    actor->GetShaderProperty()->GetVertexCustomUniforms()->SetUniformf(
        "lift", static_cast<float>(units * frame.depth_per_unit));
  };
  const double net_lift = 1.2 * frame.units_per_pixel;
  lift(body_->net.actor, net_lift);
  lift(reference_->net.actor, net_lift);
  lift(reference_->fine.actor, reference_lift);
  lift(reference_->rough.actor, reference_lift);
  lift(highlight_->actor, net_lift + frame.extra_lift);
  for (Body* body : {body_.get(), reference_.get()}) {
    for (vtkActor* actor : body->actors())
      set_section_uniform(actor->GetShaderProperty()->GetVertexCustomUniforms(), frame.section);
    for (Shape* shape : {&body->fine, &body->rough}) {
      vtkUniforms* uniforms = shape->actor->GetShaderProperty()->GetFragmentCustomUniforms();
      uniforms->SetUniformf("cutRimWidth", static_cast<float>(1.2 * pixel_ratio));
      uniforms->SetUniformf("hatchPeriod", static_cast<float>(hatch_period * pixel_ratio));
      uniforms->SetUniformf("cutMost",
                            static_cast<float>(1.5 * frame.units_per_pixel / pixel_ratio));
    }
  }
  set_section_uniform(highlight_->actor->GetShaderProperty()->GetVertexCustomUniforms(),
                      frame.section);
}

Eigen::Vector4d Scene::local_section() const {
  if (!section_) return no_section;
  const Point& n = section_->normal;
  return {n.x(), n.y(), n.z(), section_->offset - n.dot(origin_)};
}

void Scene::show_field() {
  if (!body_->mesh) return;
  const Mesh& mesh = *body_->mesh;
  QColor base = bare_colour;
  float colour_share = 1.0F;
  for (Shape* shape : {&body_->fine, &body_->rough}) {
    shape->actor->SetTexture(nullptr);
    shape->data->GetPointData()->SetScalars(nullptr);
    shape->data->GetCellData()->SetScalars(nullptr);
    shape->mapper->ScalarVisibilityOff();
  }
  const bool drawn = field_ && fits(*field_, mesh);
  bool lit = true;
  const bool on_edges = drawn && field_->element == Element::edge;
  body_->net.mapper->ScalarVisibilityOff();
  body_->net.actor->GetProperty()->SetOpacity(0.45);
  if (edges_visible_ || on_edges) body_->net.build(mesh, body_->fine.data->GetPoints(), hidden_);
  if (!labels_.empty()) {
    show_labels();
  } else if (on_edges) {
    base = paper_colour;
    colour_share = 0.0F;
    show_edge_field();
  } else if (drawn && field_->element == Element::face) {
    base = QColor(Qt::white);
    lit = fields_lit_;
    for (Shape* shape : {&body_->fine, &body_->rough})
      shape->colour_faces([&](FaceId f) { return field_->scale.colour((*field_->values)[f]); });
  } else if (drawn) {
    base = QColor(Qt::white);
    lit = fields_lit_;
    if (field_->class_names.isEmpty()) {
      show_scale_field();
    } else {
      show_class_field();
    }
  } else {
    colour_share = 0.0F;
  }
  const QColor undefined = drawn ? field_->scale.undefined : bare_colour;
  for (Shape* shape : {&body_->fine, &body_->rough})
    shape->paint(base, colour_share, lit ? 1.0F : 0.0F, undefined);
  if (shown() != ShownSurface::mesh) {
    reference_->upload(origin_, hidden_reference_);
    if (edges_visible_)
      reference_->net.build(*reference_->mesh, reference_->fine.data->GetPoints(), {});
    for (Shape* shape : {&reference_->fine, &reference_->rough})
      shape->paint(bare_colour, 0.0F, 1.0F, bare_colour);
  }
}

void Scene::show_scale_field() {
  const ColourScale& scale = field_->scale;
  const std::vector<double>& values = *field_->values;
  const int steps = scale.bands > 0 ? scale.bands : 1024;
  texture_image_->SetDimensions(steps + 2, 2, 1);
  texture_image_->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  ColourScale plain;  // evenly over the positions, to read the colours of the positions from
  plain.map = scale.map;
  plain.reversed = scale.reversed;
  plain.bands = scale.bands;
  for (int i = 0; i < steps + 2; ++i) {
    auto colour = plain.colour((i - 0.5) / steps);
    if (i == 0 && scale.below.isValid()) colour = scale.colour(-HUGE_VAL);
    if (i == steps + 1 && scale.above.isValid()) colour = scale.colour(HUGE_VAL);
    auto* defined = static_cast<unsigned char*>(texture_image_->GetScalarPointer(i, 0, 0));
    std::copy(colour.begin(), colour.end(), defined);
    defined[3] = 255;
    auto* undefined = static_cast<unsigned char*>(texture_image_->GetScalarPointer(i, 1, 0));
    write(undefined, scale.undefined);
    undefined[3] = 0;
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
    body_->mesh->for_ring(v, [&](HalfEdgeId h) {
      const double value = values[body_->mesh->to(h)];
      if (std::isnan(value)) return;
      sum += texture_place(scale, value, steps);
      ++count;
    });
    const std::array<float, 2> place{static_cast<float>(count > 0 ? sum / count : 0.5), 0.75F};
    places->SetTypedTuple(v, place.data());
  }
  for (Shape* shape : {&body_->fine, &body_->rough}) {
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
  for (Shape* shape : {&body_->fine, &body_->rough}) {
    shape->data->GetPointData()->SetScalars(array);
    shape->mapper->SetScalarModeToUsePointData();
    shape->mapper->ScalarVisibilityOn();
  }
}

void Scene::show_edge_field() {
  const std::vector<double>& values = *field_->values;
  Net& net = body_->net;
  const auto array = colours(net.edges.size());
  for (std::size_t i = 0; i < net.edges.size(); ++i) {
    const auto colour = field_->scale.colour(values[net.edges[i]]);
    std::copy(colour.begin(), colour.end(), array->GetPointer(3 * static_cast<vtkIdType>(i)));
  }
  net.data->GetCellData()->SetScalars(array);
  net.mapper->SetScalarModeToUseCellData();
  net.mapper->ScalarVisibilityOn();
  net.actor->GetProperty()->SetOpacity(1.0);
}

void Scene::show_labels() {
  const auto colour_of = [&](std::uint32_t label) {
    QColor colour = label == 0 || label >= label_colours_.size() || !label_colours_[label].isValid()
                        ? unlabelled_colour
                        : label_colours_[label];
    if (label != 0 && selected_labels_.count(label) != 0) {
      colour = mixed(colour, selected_colour, 0.75);
    }
    return rgb_of(colour);
  };
  std::vector<std::array<std::uint8_t, 3>> table;
  const std::uint32_t most = *std::max_element(labels_.begin(), labels_.end());
  const std::size_t size = std::min<std::size_t>(most, label_colours_.size()) + 1;
  for (std::uint32_t label = 0; label < size; ++label) table.push_back(colour_of(label));
  for (Shape* shape : {&body_->fine, &body_->rough})
    shape->colour_faces(
        [&](FaceId f) { return labels_[f] < size ? table[labels_[f]] : colour_of(labels_[f]); });
}

}  // namespace arris::ui
