#include "tests/bench/accuracy/methods.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#ifdef ARRIS_ACCURACY_VTK
#include <vtkCellArray.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>
#endif

#include "core/document/document.h"
#include "core/document/operation.h"
#include "core/partitions/area_tree.h"
#include "core/sharp_lines/line_evidence.h"
#include "core/sharp_lines/lines.h"

namespace arris::accuracy {

namespace {

constexpr double dihedral_angle = 30.0;  // degrees; what the peers are usually set to

/// The document as `open` leaves it.
Result<Document> opened(const ScanPtr& scan) {
  Document document;
  document.scan = scan;
  document.mesh = scan->mesh;
  const Result<CurvaturesPtr> curvatures = compute_curvatures(*scan->mesh);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  document.curvatures = *curvatures;
  document.opened = {document.mesh, document.curvatures, nullptr};
  document.boundaries = std::make_shared<const Boundaries>();
  return document;
}

Polyline polyline(const Mesh& mesh, const std::vector<VertexId>& path) {
  Polyline line;
  line.reserve(path.size());
  for (const VertexId v : path) line.push_back(mesh.point(v));
  return line;
}

Result<Found> run_operations(const std::vector<Operation>& operations, const ScanPtr& scan) {
  Result<Document> document = opened(scan);
  for (const Operation& operation : operations) {
    if (!document) return tl::unexpected<Error>(document.error());
    document = apply(*document, operation);
  }
  if (!document) return tl::unexpected<Error>(document.error());
  Found found;
  for (const LinePtr& line : document->lines.lines)
    found.lines.push_back(polyline(*document->mesh, line->vertices));
  if (document->find_partitions) found.labels = labels_on_scan(*document);
  return found;
}

/// The lines of the default method with some of its ideas changed.
struct Idea {
  const char* name;
  void (*change)(LineEvidenceOptions&, LineChoiceOptions&);
};

Result<Found> jump_lines(const ScanPtr& scan, const Idea& idea) {
  const Mesh& mesh = *scan->mesh;
  const Result<CurvaturesPtr> curvatures = compute_curvatures(mesh);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  LineEvidenceOptions options;
  LineChoiceOptions choice;
  idea.change(options, choice);
  const Result<LineEvidencePtr> evidence = gather_line_evidence(mesh, **curvatures, options);
  if (!evidence) return tl::unexpected<Error>(evidence.error());
  choice.angle = static_cast<float>(std::round(jump_threshold((*evidence)->noise, options)));
  if (choice.clear_slit > 0.0F)
    choice.clear_slit = static_cast<float>(clear_jump((*evidence)->noise, options));
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  for (const EdgeId e : (*evidence)->candidates.choose(choice)) edges[e] = Origin::found;
  Found found;
  for (const Line& line : derive_lines(mesh, **curvatures, edges))
    found.lines.push_back(polyline(mesh, line.vertices));
  return found;
}

/// Each idea of the default method switched off, one at a time.
constexpr Idea ideas[] = {
    {"no extrapolation", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.jump.ridge = 1e6F; }},
    {"no slant", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.jump.least_slant = 1e-3F; }},
    {"no first cut",
     [](LineEvidenceOptions& o, LineChoiceOptions&) { o.regions.first_cut = 5.0F; }},
    {"no ratio test",
     [](LineEvidenceOptions& o, LineChoiceOptions&) { o.regions.test.least_ratio = 0.0F; }},
    {"no rule for narrow sides",
     [](LineEvidenceOptions& o, LineChoiceOptions&) { o.regions.test.narrow = 1.0F; }},
    {"no pooling", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.regions.test.pooled = 0; }},
    {"no rule for thin strips",
     [](LineEvidenceOptions& o, LineChoiceOptions&) { o.regions.thin = 0.0F; }},
    {"no teeth taken off",
     [](LineEvidenceOptions& o, LineChoiceOptions&) { o.regions.smoothing = 0; }},
    {"no slits", [](LineEvidenceOptions&, LineChoiceOptions& c) { c.least_slit = 0.0F; }},
    {"no closing", [](LineEvidenceOptions&, LineChoiceOptions& c) { c.gap = 0.0F; }},
    {"no filter", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.filter.rounds = 0; }},
    {"no rise with noise", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.rise = 0.0F; }},
    {"no crests", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.open = false; }},
    {"no exact creases", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.exact = false; }},
};

double env(const char* name, double value) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : value;
}
Result<Found> area_partitions(const ScanPtr& scan) {
  Result<Document> document = opened(scan);
  if (document) document = apply(*document, {"find_sharp_lines"});
  if (!document) return tl::unexpected<Error>(document.error());
  Found found;
  for (const LinePtr& line : document->lines.lines)
    found.lines.push_back(polyline(*document->mesh, line->vertices));
  AreaTreeOptions o;
#define ENV(x) o.x = static_cast<decltype(o.x)>(env(#x, static_cast<double>(o.x)))
  ENV(band);
  ENV(first_cut);
  ENV(first_area);
  ENV(grain);
  ENV(samples);
  ENV(rise);
  ENV(rise_area);
  ENV(rise_each);
  ENV(face_noise);
  o.settling.rounds = (int)env("srounds", 12);
  o.settling.length = env("slength", o.settling.length);
  o.settling.free = env("sfree", o.settling.free);
  o.settling.most = env("smost", o.settling.most);
  ENV(blend);
  ENV(narrow_band);
  ENV(narrow_rings);
  ENV(rise_border);
  ENV(free_border);
  ENV(free);
  ENV(free_rise);
  ENV(kink);
  ENV(small);
  ENV(line_share);
  ENV(rounds);
  ENV(distance);
  ENV(angle);
  ENV(surfaces);
  ENV(growths);
  o.growing.good = env("ggood", o.growing.good);
  o.growing.admits = env("gadmits", o.growing.admits);
  o.growing.seed = (size_t)env("gseed", 16);
  o.growing.least = (size_t)env("gleast", 6);
  o.watershed.depth = static_cast<float>(env("depth", 0.5));
  o.watershed.area = static_cast<float>(env("warea", 6));
  const Result<AreaTree> tree = grow_area_tree(*scan->mesh, document->lines, o, {});
  if (!tree) return tl::unexpected<Error>(tree.error());
  found.labels =
      tree->cut(static_cast<float>(env("cut", 1)), static_cast<std::uint32_t>(env("least", 12)))
          .of_face;
  if (std::getenv("verbose"))
    std::fprintf(stderr, "count %zu joins %zu noise %g deg %g\n", tree->surfaces.size(),
                 tree->joins.size(), tree->noise.angle * 57.3, tree->noise.distance);
  for (std::uint32_t& label : found.labels) ++label;
  return found;
}

/// All edges of an exterior angle above the usual one, linked into lines.
Result<Found> dihedral_lines(const ScanPtr& scan) {
  const Mesh& mesh = *scan->mesh;
  const Result<CurvaturesPtr> curvatures = compute_curvatures(mesh);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (std::abs((*curvatures)->beta[e]) > dihedral_angle * std::numbers::pi / 180.0)
      edges[e] = Origin::found;
  Found found;
  for (const Line& line : derive_lines(mesh, **curvatures, edges))
    found.lines.push_back(polyline(mesh, line.vertices));
  return found;
}

#ifdef ARRIS_ACCURACY_VTK
/// vtkFeatureEdges, its edges joined by vtkStripper.
Result<Found> vtk_feature_edges(const ScanPtr& scan) {
  const Mesh& mesh = *scan->mesh;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& p : mesh.points()) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> faces;
  for (const Triangle& t : mesh.triangles()) faces->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(faces);
  vtkNew<vtkFeatureEdges> features;
  features->SetInputData(surface);
  features->SetFeatureAngle(dihedral_angle);
  features->FeatureEdgesOn();
  features->BoundaryEdgesOff();
  features->NonManifoldEdgesOff();
  features->ManifoldEdgesOff();
  features->ColoringOff();
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(features->GetOutputPort());
  stripper->SetMaximumLength(static_cast<int>(mesh.edge_count()) + 1);
  stripper->Update();

  Found found;
  vtkPolyData* output = stripper->GetOutput();
  vtkCellArray* lines = output->GetLines();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (lines->InitTraversal(); lines->GetNextCell(count, ids);) {
    Polyline line;
    for (vtkIdType k = 0; k < count; ++k) {
      Point p;
      output->GetPoint(ids[k], p.data());
      line.push_back(p);
    }
    found.lines.push_back(std::move(line));
  }
  return found;
}
#endif

Method timed(std::string name, std::function<Result<Found>(const ScanPtr&)> run) {
  return {std::move(name), [run = std::move(run)](const ScanPtr& scan) {
            const auto start = std::chrono::steady_clock::now();
            Result<Found> found = run(scan);
            const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
            if (found) found->seconds = spent.count();
            return found;
          }};
}

}  // namespace

Result<Method> operations_method(const std::string& name, std::string_view operations) {
  const nlohmann::json list = nlohmann::json::parse(operations, nullptr, false);
  if (!list.is_array()) return fail("Method " + name + ": not a JSON array of operations.");
  std::vector<Operation> parsed;
  for (const nlohmann::json& item : list) {
    Result<Operation> operation = Operation::from_json(item);
    if (!operation) return fail("Method " + name + ": " + operation.error().message);
    parsed.push_back(std::move(*operation));
  }
  return timed(name, [parsed = std::move(parsed)](const ScanPtr& scan) {
    return run_operations(parsed, scan);
  });
}

std::vector<Method> method_table(bool with_ideas) {
  constexpr std::pair<const char*, const char*> flows[] = {
      // As arris-cli segment and the window's F5.
      {"default", R"([{"operation": "find_sharp_lines"}, {"operation": "find_partitions"}])"},
      // Figure 2 of the paper, as segment --flow paper.
      {"paper", R"([{"operation": "simplify"}, {"operation": "find_sharp_lines", "method": "walk"},
                    {"operation": "equilateralize"},
                    {"operation": "find_partitions", "method": "fronts"}])"},
      {"walk", R"([{"operation": "find_sharp_lines", "method": "walk"},
                   {"operation": "find_partitions", "method": "fronts"}])"},
      // The paper's fronts between the lines of the default.
      {"fronts", R"([{"operation": "find_sharp_lines"},
                     {"operation": "find_partitions", "method": "fronts"}])"},
  };
  std::vector<Method> methods;
  for (const auto& [name, operations] : flows) {
    Result<Method> method = operations_method(name, operations);
    if (!method) throw std::logic_error(method.error().message);
    methods.push_back(std::move(*method));
  }
  if (with_ideas)
    for (const Idea& idea : ideas)
      methods.push_back(
          timed(idea.name, [&idea](const ScanPtr& scan) { return jump_lines(scan, idea); }));
  methods.push_back(timed("areas", area_partitions));
  methods.push_back(timed("dihedral 30", dihedral_lines));
#ifdef ARRIS_ACCURACY_VTK
  methods.push_back(timed("vtkFeatureEdges", vtk_feature_edges));
#endif
  return methods;
}

}  // namespace arris::accuracy
