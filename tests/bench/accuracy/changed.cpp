#include "tests/bench/accuracy/changed.h"

#include <cmath>
#include <utility>

#include "core/document/operation.h"
#include "core/partitions/intervals.h"
#include "core/sharp_lines/lines.h"

namespace arris::accuracy {

namespace {

Polyline polyline(const Mesh& mesh, const std::vector<VertexId>& path) {
  Polyline line;
  line.reserve(path.size());
  for (const VertexId v : path) line.push_back(mesh.point(v));
  return line;
}

/// The edges that are lines, of one origin for each edge.
template <class Origins>
std::vector<EdgeId> line_edges_of(const Origins& origins, std::size_t count) {
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < count; ++e)
    if (origins[e] != Origin::none) edges.push_back(e);
  return edges;
}

}  // namespace

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

void add_lines(const Document& document, Found& found) {
  for (const LinePtr& line : document.lines.lines)
    found.lines.push_back(polyline(*document.mesh, line->vertices));
  if (document.mesh == document.scan->mesh)
    found.line_edges = line_edges_of(document.lines.edges, document.lines.edges.size());
}

void add_lines(const Mesh& mesh, const Curvatures& curvatures, const std::vector<Origin>& edges,
               Found& found) {
  for (const Line& line : derive_lines(mesh, curvatures, edges))
    found.lines.push_back(polyline(mesh, line.vertices));
  found.line_edges = line_edges_of(edges, edges.size());
}

Result<Found> changed_lines(
    const ScanPtr& scan,
    const std::function<void(LineEvidenceOptions&, LineChoiceOptions&)>& change) {
  const Mesh& mesh = *scan->mesh;
  const Result<CurvaturesPtr> curvatures = compute_curvatures(mesh);
  if (!curvatures) return tl::unexpected<Error>(curvatures.error());
  LineEvidenceOptions options;
  LineChoiceOptions choice;
  change(options, choice);
  const Result<LineEvidencePtr> evidence = gather_line_evidence(mesh, **curvatures, options);
  if (!evidence) return tl::unexpected<Error>(evidence.error());
  choice.angle = static_cast<float>(std::round(jump_threshold((*evidence)->noise, options)));
  if (choice.clear_slit > 0.0F)
    choice.clear_slit = static_cast<float>(clear_jump((*evidence)->noise, options));
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  for (const EdgeId e : (*evidence)->candidates.choose(choice)) edges[e] = Origin::found;
  Found found;
  add_lines(mesh, **curvatures, edges, found);
  return found;
}

Result<Found> changed_areas(const ScanPtr& scan,
                            const std::function<void(AreaTreeOptions&)>& change) {
  Result<Document> document = opened(scan);
  if (document) document = apply(*document, {"find_sharp_lines"});
  if (!document) return tl::unexpected<Error>(document.error());
  Found found;
  add_lines(*document, found);
  AreaTreeOptions options;
  change(options);
  const Result<AreaTree> tree = grow_area_tree(*scan->mesh, document->lines, options, {});
  if (!tree) return tl::unexpected<Error>(tree.error());
  found.labels =
      tree->by_face(tree->cut(1.0F, default_min_faces(*scan->mesh, PartitionMethod::surfaces)));
  for (std::uint32_t& label : found.labels) ++label;
  return found;
}

}  // namespace arris::accuracy
