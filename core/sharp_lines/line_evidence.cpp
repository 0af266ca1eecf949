#include "core/sharp_lines/line_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

/// The jump as what a walk along lines reads.
CurvaturesPtr as_measures(const Mesh& mesh, const NormalJump& jump,
                          const std::vector<float>& at_edge,
                          const std::vector<BorderEdge>& candidates) {
  // Windows see a jump from some edges away; what follows lines must keep to where it is.
  constexpr float off_crest = 0.3F;
  auto measures = std::make_shared<Curvatures>();
  measures->beta.resize(mesh.edge_count());
  measures->ikabs.resize(mesh.vertex_count());
  parallel_for(at_edge.size(), [&](std::size_t e) {
    measures->beta[e] = at_edge[e] * in_radians<float> * off_crest;
  });
  for (const BorderEdge& candidate : candidates)
    measures->beta[candidate.edge] =
        (std::abs(candidate.place.jump) >= std::abs(at_edge[candidate.edge])
             ? candidate.place.jump
             : at_edge[candidate.edge]) *
        in_radians<float>;
  parallel_for(measures->ikabs.size(), [&](std::size_t v) {
    // A vertex is as sharp as its sharpest edge, where that is told exactly.
    float sharpest = std::abs(jump.at_vertex[v]) * in_radians<float>;
    mesh.for_ring(static_cast<VertexId>(v), [&](HalfEdgeId h) {
      sharpest = std::max(sharpest, std::abs(measures->beta[h >> 1]));
    });
    measures->ikabs[v] = mesh.is_isolated(static_cast<VertexId>(v))
                             ? 0.0
                             : ikabs_of_straight_edge(static_cast<double>(sharpest));
  });
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.is_isolated(v) && !mesh.is_border(v)) measures->by_decreasing_ikabs.push_back(v);
  parallel_sort(measures->by_decreasing_ikabs.begin(), measures->by_decreasing_ikabs.end(),
                [&](VertexId a, VertexId b) {
                  return measures->ikabs[a] != measures->ikabs[b]
                             ? measures->ikabs[a] > measures->ikabs[b]
                             : a < b;
                });
  return measures;
}

/// By how much thresholds rise with the noise, degrees.
float rise_of(float noise, const LineEvidenceOptions& options) {
  return std::clamp(options.rise * (noise - options.ordinary), 0.0F, options.most_rise);
}

/// Both, by increasing edge; one that is a border as well as a crest keeps its height and takes the
/// crest's place, which is pooled along it.
std::vector<BorderEdge> merged(const std::vector<BorderEdge>& borders,
                               const std::vector<BorderEdge>& crests) {
  std::vector<BorderEdge> all;
  all.reserve(borders.size() + crests.size());
  auto crest = crests.begin();
  for (const BorderEdge& border : borders) {
    for (; crest != crests.end() && crest->edge < border.edge; ++crest) all.push_back(*crest);
    all.push_back(border);
    if (crest == crests.end() || crest->edge != border.edge) continue;
    all.back().place = crest->place;
    ++crest;
  }
  all.insert(all.end(), crest, crests.end());
  return all;
}

}  // namespace

double jump_threshold(float noise, const LineEvidenceOptions& options) {
  return static_cast<double>(options.threshold + rise_of(noise, options));
}

double clear_jump(float noise, const LineEvidenceOptions& options) {
  return static_cast<double>(options.clear) * jump_threshold(noise, options);
}

std::size_t LineEvidence::bytes() const {
  return sizeof *this + jump.size() * sizeof(float) + candidates.bytes() +
         (measures ? measures->bytes() : 0);
}

Result<LineEvidencePtr> gather_line_evidence(const Mesh& mesh, const Curvatures& curvatures,
                                             const LineEvidenceOptions& options,
                                             const Context& context) {
  auto evidence = std::make_shared<LineEvidence>();
  const FaceTable table(mesh);
  evidence->noise = normal_noise(mesh, table);
  const bool is_harsh = evidence->noise > options.harsh;
  std::vector<Eigen::Vector3f> normals;
  if (is_harsh && options.filter.rounds > 0) {
    normals = filter_normals(mesh, table, options.filter, context.part(0.0, 0.2));
  } else {
    normals.resize(table.size());
    parallel_for(normals.size(), [&](std::size_t f) { normals[f] = table.faces[f].normal; });
  }
  const float rise = rise_of(evidence->noise, options);
  Result<NormalJump> jump =
      measure_normal_jump(mesh, table, normals, options.jump, context.part(0.2, 0.65));
  if (!jump) return tl::unexpected<Error>(jump.error());
  std::vector<std::uint32_t> tubes(table.size(), no_id);
  if (options.tubes) {
    tubes = find_tight_tubes(mesh, table, normals, *jump, options.tight_tubes,
                             context.part(0.65, 0.75));
    if (context.cancelled()) return cancelled();
    clear_jump_on(mesh, tubes, *jump);
  }
  LineRegionOptions regions = options.regions;
  regions.first_cut += rise * options.first_cut_rise;
  Result<std::vector<BorderEdge>> borders =
      find_line_regions(mesh, table, normals, *jump, tubes, regions, context.part(0.75, 0.95));
  if (!borders) return tl::unexpected<Error>(borders.error());
  const auto goes_on = [&context](double fraction) {
    context.report(fraction, "line evidence");
    return !context.cancelled();
  };
  if (!goes_on(0.95)) return cancelled();
  if (options.exact)
    *borders = merge_creases(
        mesh, *borders, find_exact_creases(mesh, curvatures.beta, table, *jump, options.creases));
  if (!goes_on(0.96)) return cancelled();
  if (options.open) {
    const std::vector<BorderEdge> crests =
        find_crests(mesh, table, *jump, *borders, regions.first_cut, options.crests);
    *borders = merged(*borders, crests);
  }
  if (!goes_on(0.97)) return cancelled();
  evidence->jump.resize(mesh.edge_count());
  parallel_for(evidence->jump.size(), [&](std::size_t e) {
    evidence->jump[e] = jump->convex[e] ? jump->at_edge[e] : -jump->at_edge[e];
  });
  for (const BorderEdge& border : *borders)
    if (border.exact || border.place.value > 0.0F)
      evidence->jump[border.edge] =
          border.place.turn >= 0.0F ? border.place.value : -border.place.value;
  if (!goes_on(0.98)) return cancelled();
  evidence->candidates = CandidateGraph(mesh, table, std::move(*borders));
  if (!goes_on(0.99)) return cancelled();
  evidence->measures = as_measures(mesh, *jump, evidence->jump, evidence->candidates.edges());
  context.report(1.0, "line evidence");
  if (context.cancelled()) return cancelled();
  return evidence;
}

Result<LineEvidencePtr> SharedLineEvidence::get(const Context& context) const {
  if (LineEvidencePtr known = known_.load()) return known;
  const std::lock_guard lock(working_);
  if (LineEvidencePtr known = known_.load()) return known;
  Result<LineEvidencePtr> gathered = gather_line_evidence(*mesh_, *curvatures_, {}, context);
  if (gathered) known_.store(*gathered);
  return gathered;
}

std::size_t SharedLineEvidence::bytes() const {
  const LineEvidencePtr known = known_.load();
  return sizeof *this + (known ? known->bytes() : 0);
}

}  // namespace arris
