#include "tests/bench/accuracy/methods.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#ifdef ARRIS_ACCURACY_VTK
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkPolyDataNormals.h>
#include <vtkStripper.h>
#endif

#include "core/document/document.h"
#include "core/document/operation.h"
#include "core/partitions/area_tree.h"
#include "core/partitions/intervals.h"
#include "core/sharp_lines/line_evidence.h"
#include "core/sharp_lines/lines.h"
#include "tests/bench/accuracy/changed.h"
#include "tests/bench/accuracy/turning.h"

namespace arris::accuracy {

namespace {

constexpr double dihedral_angle = 30.0;  // degrees; what the peers are usually set to

Result<Found> run_operations(const std::vector<Operation>& operations, const ScanPtr& scan) {
  Result<Document> document = opened(scan);
  for (const Operation& operation : operations) {
    if (!document) return tl::unexpected<Error>(document.error());
    document = apply(*document, operation);
  }
  if (!document) return tl::unexpected<Error>(document.error());
  Found found;
  add_lines(*document, found);
  if (document->step("find_partitions")) found.labels = labels_on_scan(*document);
  found.document = std::make_shared<const Document>(std::move(*document));
  return found;
}

/// One of the ideas that lines are found by, changed.
struct Idea {
  const char* name;
  void (*change)(LineEvidenceOptions&, LineChoiceOptions&);
};

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
    {"slits beside lines", [](LineEvidenceOptions&, LineChoiceOptions& c) { c.beside = 0.0F; }},
    {"no closing", [](LineEvidenceOptions&, LineChoiceOptions& c) { c.gap = 0.0F; }},
    {"no filter", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.filter.rounds = 0; }},
    {"no rise with noise", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.rise = 0.0F; }},
    {"no tubes", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.tubes = false; }},
    {"no crests", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.open = false; }},
    {"no exact creases", [](LineEvidenceOptions& o, LineChoiceOptions&) { o.exact = false; }},
};

struct AreaIdea {
  const char* name;
  void (*change)(AreaTreeOptions&);
};

/// Each idea of the partitions switched off, one at a time.
constexpr AreaIdea area_ideas[] = {
    {"no grains", [](AreaTreeOptions& o) { o.grain = 1; }},
    {"no growing", [](AreaTreeOptions& o) { o.growing.good = 0.0; }},
    {"noise of windows", [](AreaTreeOptions& o) { o.growths = 1; }},
    {"no joins by surfaces", [](AreaTreeOptions& o) { o.joining.surfaces = false; }},
    {"no continuations", [](AreaTreeOptions& o) { o.joining.continuations = false; }},
    {"strips as other areas", [](AreaTreeOptions& o) { o.joining.strip_votes = 0.0F; }},
    {"no free forms", [](AreaTreeOptions& o) { o.joining.free_forms = false; }},
    {"no joins over kinks", [](AreaTreeOptions& o) { o.joining.kink = 1e-3F; }},
    {"no limit on free areas", [](AreaTreeOptions& o) { o.joining.free_rise = 1e9F; }},
    {"borders count nothing",
     [](AreaTreeOptions& o) { o.joining.rise_border = o.joining.free_border = 0.0F; }},
    {"all beside lines vote", [](AreaTreeOptions& o) { o.smallest.band = 0.0F; }},
    {"borders not settled", [](AreaTreeOptions& o) { o.borders.rounds = 0; }},
    {"borders not straight", [](AreaTreeOptions& o) { o.borders.straightenings = 0; }},
};

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
  add_lines(mesh, **curvatures, edges, found);
  return found;
}

#ifdef ARRIS_ACCURACY_VTK
vtkNew<vtkPolyData> vtk_surface(const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& p : mesh.points()) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> faces;
  for (const Triangle& t : mesh.triangles()) faces->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(faces);
  return surface;
}

/// vtkFeatureEdges, its edges joined by vtkStripper.
Result<Found> vtk_feature_edges(const ScanPtr& scan) {
  const Mesh& mesh = *scan->mesh;
  const vtkNew<vtkPolyData> surface = vtk_surface(mesh);
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

/// The surface split at its sharp edges by vtkPolyDataNormals, its pieces by
/// vtkPolyDataConnectivityFilter, specks and all; with the lines of vtkFeatureEdges at the same
/// angle.
Result<Found> vtk_connectivity(const ScanPtr& scan) {
  const Mesh& mesh = *scan->mesh;
  Result<Found> found = vtk_feature_edges(scan);
  if (!found) return found;

  const vtkNew<vtkPolyData> surface = vtk_surface(mesh);
  vtkNew<vtkPolyDataNormals> split;
  split->SetInputData(surface);
  split->SetFeatureAngle(dihedral_angle);
  split->SplittingOn();
  split->ConsistencyOff();  // the mesh is consistent
  vtkNew<vtkPolyDataConnectivityFilter> pieces;
  pieces->SetInputConnection(split->GetOutputPort());
  pieces->SetExtractionModeToAllRegions();
  pieces->ColorRegionsOn();
  pieces->Update();

  // The filter numbers points anew, and leaves the faces in their order.
  vtkPolyData* output = pieces->GetOutput();
  vtkDataArray* regions = output->GetPointData()->GetArray("RegionId");
  vtkCellArray* faces = output->GetPolys();
  if (!regions || faces->GetNumberOfCells() != static_cast<vtkIdType>(mesh.face_count()))
    return fail("vtkPolyDataConnectivityFilter did not number the regions of all faces.");
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (faces->InitTraversal(); faces->GetNextCell(count, ids);)
    found->labels.push_back(static_cast<std::uint32_t>(regions->GetTuple1(ids[0])) + 1);
  found->line_edges = edges_between(mesh, found->labels);  // pieces end at sharp edges only
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
      methods.push_back(timed(
          idea.name, [&idea](const ScanPtr& scan) { return changed_lines(scan, idea.change); }));
  if (with_ideas)
    for (const AreaIdea& idea : area_ideas)
      methods.push_back(timed(
          idea.name, [&idea](const ScanPtr& scan) { return changed_areas(scan, idea.change); }));
  methods.push_back(timed("dihedral 30", dihedral_lines));
#ifdef ARRIS_ACCURACY_VTK
  methods.push_back(timed("vtkFeatureEdges", vtk_feature_edges));
  methods.push_back(timed("vtk connectivity", vtk_connectivity));
#endif
  return methods;
}

}  // namespace arris::accuracy
