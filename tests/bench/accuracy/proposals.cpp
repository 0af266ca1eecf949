#include "tests/bench/accuracy/proposals.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "core/document/document.h"
#include "core/mesh/geometry.h"
#include "tests/bench/accuracy/narrow.h"
#include "tests/bench/accuracy/samples.h"
#include "tests/bench/accuracy/turning.h"

namespace arris::accuracy {

namespace {

constexpr double pieces_per_edge = 4.0;

Point centre_of(const Mesh& mesh, FaceId f) {
  const Triangle& t = mesh.triangle(f);
  return (mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0;
}

std::vector<Point> true_lines(const Part& part, double step) {
  LengthSamples samples;
  for (const TrueCurve& curve : part.truth.curves) add_samples(curve.points, step, samples);
  if (!part.truth.patches.empty()) {
    const Mesh& mesh = *part.scan->mesh;
    for (const EdgeId e : edges_between(mesh, part.truth.patches))
      add_samples({mesh.point(mesh.edge(e)[0]), mesh.point(mesh.edge(e)[1])}, step, samples);
  }
  return std::move(samples.points);
}

std::vector<Point> face_centres(const Mesh& mesh) {
  std::vector<Point> centres;
  centres.reserve(mesh.face_count());
  for (FaceId f = 0; f < mesh.face_count(); ++f) centres.push_back(centre_of(mesh, f));
  return centres;
}

}  // namespace

ProposalJudge::ProposalJudge(const Part& part, const ProposalOptions& options)
    : part_(part),
      options_(options),
      mean_edge_(mean_inner_edge(*part.scan->mesh)),
      lines_(true_lines(part, mean_edge_ / pieces_per_edge)),
      centres_(face_centres(*part.scan->mesh)),
      narrow_(narrow_centres(part)) {}

std::optional<bool> ProposalJudge::is_right(const Document& document, const WorkItem& item) const {
  if (part_.truth.patches.empty()) return std::nullopt;
  switch (item.kind) {
    case WorkKind::leak:
      if (runs_along(narrow_, part_.tolerance, 0.5, document, item.paths)) return std::nullopt;
      return runs_along_lines(document, item.paths) && parts_patches(document, item.paths);
    case WorkKind::loose_end: {
      if (item.continuations.empty()) return std::nullopt;
      const Paths way{item.continuations.front().vertices};
      if (runs_along(narrow_, part_.tolerance, 0.5, document, way)) return std::nullopt;
      return runs_along_lines(document, way);
    }
    case WorkKind::unassigned_area:
    case WorkKind::undefined_boundary:
    case WorkKind::many_borders:
    case WorkKind::sliver:
      break;
  }
  return std::nullopt;
}

Result<std::vector<ProposalCount>> ProposalJudge::count(const Document& document) const {
  const Result<std::vector<WorkItem>> items = worklist(document);
  if (!items) return tl::unexpected<Error>(items.error());
  std::map<WorkKind, ProposalCount> by_kind;
  for (const WorkItem& item : *items)
    if (const std::optional<bool> right = is_right(document, item)) {
      ProposalCount& count = by_kind[item.kind];
      count.kind = item.kind;
      ++count.made;
      count.right += *right;
    }
  std::vector<ProposalCount> counts;
  for (const auto& [kind, count] : by_kind) counts.push_back(count);
  return counts;
}

bool ProposalJudge::runs_along_lines(const Document& document, const Paths& paths) const {
  return runs_along(lines_, options_.reach * mean_edge_, options_.share, document, paths);
}

bool ProposalJudge::runs_along(const KdTree& places, double reach, double share,
                               const Document& document, const Paths& paths) const {
  if (places.empty()) return false;
  LengthSamples samples;
  for (const std::vector<VertexId>& path : paths) {
    Polyline line;
    for (const VertexId v : path) line.push_back(document.mesh->point(v));
    add_samples(line, mean_edge_ / pieces_per_edge, samples);
  }
  double length = 0.0, near = 0.0;
  for (std::size_t k = 0; k < samples.points.size(); ++k) {
    length += samples.lengths[k];
    if (places.has_within(samples.points[k], reach)) near += samples.lengths[k];
  }
  return length > 0.0 && near >= share * length;
}

bool ProposalJudge::parts_patches(const Document& document, const Paths& paths) const {
  const Mesh& mesh = *document.mesh;
  std::vector<EdgeId> walls;
  for (const std::vector<VertexId>& path : paths)
    for (const HalfEdgeId h : half_edges_of(mesh, path)) walls.push_back(h >> 1);
  std::ranges::sort(walls);
  double length = 0.0, parted = 0.0;
  for (const EdgeId e : walls) {
    length += mesh.edge_length(e);
    if (!mesh.is_border_edge(e) && parts_patches_at(document, walls, e))
      parted += mesh.edge_length(e);
  }
  return length > 0.0 && parted >= options_.share * length;
}

bool ProposalJudge::parts_patches_at(const Document& document, const std::vector<EdgeId>& walls,
                                     EdgeId e) const {
  const Mesh& mesh = *document.mesh;
  const Point middle = (mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0;
  struct Reached {
    FaceId face;
    int side;
  };
  const auto [left, right] = mesh.edge_faces(e);
  std::vector<Reached> front{{left, 0}, {right, 1}};
  std::set<FaceId> seen{left, right};
  std::array<std::map<std::uint32_t, double>, 2> areas;  // of patches on either side
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto [face, side] = front[next];
    areas[side][patch_of(document, face)] += face_area(mesh, face);
    HalfEdgeId h = mesh.face_half_edge(face);
    for (int corner = 0; corner < 3; ++corner, h = mesh.next(h)) {
      const FaceId f = mesh.face(Mesh::opposite(h));
      if (f == no_id || document.lines.is_sharp(h >> 1) ||
          std::ranges::binary_search(walls, h >> 1) ||
          (centre_of(mesh, f) - middle).norm() > options_.side_reach * mean_edge_)
        continue;
      if (seen.insert(f).second) front.push_back({f, side});
    }
  }
  const auto main_patch = [](const std::map<std::uint32_t, double>& side) {
    return std::ranges::max_element(
               side, [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  };
  return main_patch(areas[0]) != main_patch(areas[1]);
}

std::uint32_t ProposalJudge::patch_of(const Document& document, FaceId face) const {
  const Mesh& mesh = *document.mesh;
  if (document.mesh == part_.scan->mesh) return part_.truth.patches[face];
  return part_.truth.patches[centres_.nearest(centre_of(mesh, face)).index];
}

}  // namespace arris::accuracy
