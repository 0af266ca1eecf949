#include "core/document/document.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/mesh/distance.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

void add(Hasher& hasher, const std::optional<Step>& step) {
  hasher.number(step.has_value());
  if (!step) return;
  hasher.text(step->parameters.dump());
  hasher.number(step->out_of_date);
}

void add(Hasher& hasher, const ErrorZonesPtr& zones) {
  hasher.number(zones != nullptr);
  if (!zones) return;
  hasher.number(zones->hash());
}

void add_real(Hasher& hasher, double value) { hasher.bytes(&value, sizeof value); }

/// For each face of `from` the face of the working mesh that labels_on_scan() takes its label from.
std::vector<FaceId> nearest_working_faces(const Mesh& from, const Mesh& working,
                                          const ErrorZonesPtr& zones) {
  std::vector<FaceId> answering(from.vertex_count(), no_id);  // of each removed vertex
  if (zones) {
    for (FaceId f = 0; f < working.face_count(); ++f)
      for (const VertexId v : zones->of_face(f)) answering[v] = f;
    for (EdgeId e = 0; e < working.edge_count(); ++e)
      for (const VertexId v : zones->of_border_edge(e)) {
        const auto [left, right] = working.edge_faces(e);
        answering[v] = left != no_id ? left : right;
      }
  }
  std::vector<FaceId> nearest(from.face_count(), no_id);
  parallel_for(from.face_count(), [&](std::size_t i) {
    static thread_local std::vector<FaceId> candidates;
    candidates.clear();
    const Triangle& t = from.triangle(static_cast<FaceId>(i));
    for (const VertexId v : t) {
      if (answering[v] != no_id)
        candidates.push_back(answering[v]);
      else if (!working.is_isolated(v))
        working.for_ring(v, [&](HalfEdgeId h) {
          if (working.face(h) != no_id) candidates.push_back(working.face(h));
        });
    }
    const std::size_t direct = candidates.size();
    for (std::size_t k = 0; k < direct; ++k) {
      HalfEdgeId h = working.face_half_edge(candidates[k]);
      for (int side = 0; side < 3; ++side, h = working.next(h))
        if (const FaceId f = working.face(Mesh::opposite(h)); f != no_id) candidates.push_back(f);
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    const Point& a = from.point(t[0]);
    const Point& b = from.point(t[1]);
    const Point& c = from.point(t[2]);
    const Point centre = (a + b + c) / 3.0;
    const Point normal = (b - a).cross(c - a).normalized();
    double least = std::numeric_limits<double>::infinity(), agreement = -2.0;
    for (const FaceId f : candidates) {
      const Triangle& w = working.triangle(f);
      const Point &p = working.point(w[0]), &q = working.point(w[1]), &r = working.point(w[2]);
      const double distance = squared_distance_to_triangle(centre, p, q, r);
      const double cosine = (q - p).cross(r - p).normalized().dot(normal);
      if (distance > least || (distance == least && cosine <= agreement)) continue;
      least = distance;
      agreement = cosine;
      nearest[i] = f;
    }
  });
  return nearest;
}

}  // namespace

const std::optional<Step>& Document::step(StepName name) const {
  static const std::optional<Step> none;
  return name.place < steps.size() ? steps[name.place] : none;
}

bool Document::is_divided_as(const Document& other) const {
  return mesh == other.mesh && lines.lines == other.lines.lines && lines.cuts == other.lines.cuts &&
         lines.edges == other.lines.edges && partitions.labels == other.partitions.labels;
}

Criterion Document::criterion() const {
  return step("find_partitions") &&
                 step("find_partitions")->parameters.value("criterion", "kabs") == "ikabs"
             ? Criterion::ikabs
             : Criterion::kabs;
}

PartitionMethod Document::partition_method() const {
  return step("find_partitions") &&
                 step("find_partitions")->parameters.value("method", "fronts") == "fronts"
             ? PartitionMethod::fronts
             : PartitionMethod::surfaces;
}

LineMethod Document::line_method() const {
  return step("find_sharp_lines") &&
                 step("find_sharp_lines")->parameters.value("method", "walk") == "walk"
             ? LineMethod::walk
             : LineMethod::normal_jump;
}

Result<LineEvidencePtr> line_evidence_of(const Document& document, const Context& context) {
  if (!document.step("find_sharp_lines") || document.line_method() == LineMethod::walk)
    return LineEvidencePtr();
  if (document.evidence) return document.evidence->get(context);
  return SharedLineEvidence(document.mesh, document.curvatures).get(context);
}

CurvaturesPtr line_measures(const Document& document) {
  const Result<LineEvidencePtr> evidence = line_evidence_of(document);
  return *evidence ? (*evidence)->measures : document.curvatures;
}

std::string hash_of(const Document& document) {
  Hasher hasher;
  hasher.number(document.scan != nullptr);
  if (!document.scan) return hasher.hex();
  hasher.text(document.scan->mesh->hash());
  hasher.text(document.mesh->hash());
  hasher.number(document.scan_faces != nullptr);
  if (document.scan_faces)
    hasher.bytes(document.scan_faces->data(), document.scan_faces->size() * sizeof(FaceId));

  // Edges and faces are numbered by what the mesh holds, and its hash is in already.
  hasher.number(document.lines.edges.hash());
  hasher.number(document.lines.cuts.size());
  hasher.bytes(document.lines.cuts.data(), document.lines.cuts.size() * sizeof(VertexId));
  hasher.number(document.lines.lines.size());
  for (const LinePtr& line : document.lines.lines) {
    hasher.number(line->id);
    hasher.number(line->locked);
    hasher.number(line->vertices.size());
    hasher.bytes(line->vertices.data(), line->vertices.size() * sizeof(VertexId));
  }

  hasher.number(document.partitions.labels.hash());
  hasher.number(document.partitions.partitions.size());
  for (const PartitionPtr& partition : document.partitions.partitions) {
    hasher.number(partition->id);
    hasher.number(partition->locked);
    hasher.bytes(partition->anchor.data(), sizeof partition->anchor);
    hasher.number(static_cast<std::uint64_t>(partition->criterion));
    add_real(hasher, partition->interval.min);
    add_real(hasher, partition->interval.max);
  }
  hasher.number(document.corrections.size());
  for (const CorrectionPtr& correction : document.corrections) hasher.text(correction->hash);
  const auto add_mesh_of = [&](const Stage& stage) {
    hasher.text(stage.mesh ? stage.mesh->hash() : "");
  };
  add_mesh_of(document.opened);
  for (std::size_t k = 0; k < chain_steps.size(); ++k)
    if (chain_steps[k].leaves_mesh && (!chain_steps[k].later || document.outputs[k].mesh))
      add_mesh_of(document.outputs[k]);
  add(hasher, document.zones);
  for (std::size_t k = 0; k < chain_steps.size(); ++k)
    if (!chain_steps[k].later || document.steps[k]) add(hasher, document.steps[k]);
  hasher.number(document.next_id);
  // Only where it was said: documents of before there was such an operation are what they were.
  if (document.unit) hasher.text(info_of(*document.unit).key);
  return hasher.hex();
}

std::vector<std::uint32_t> labels_on_scan(const Document& document) {
  std::vector<std::uint32_t> labels(document.scan->mesh->face_count(), 0);
  if (document.partitions.labels.empty()) return labels;
  const Mesh& from = *document.opened.mesh;
  std::vector<FaceId> nearest;
  if (document.mesh != document.opened.mesh)
    nearest = nearest_working_faces(from, *document.mesh, document.zones);
  for (FaceId f = 0; f < from.face_count(); ++f) {
    const FaceId working = nearest.empty() ? f : nearest[f];
    if (working == no_id) continue;
    labels[document.scan_faces ? (*document.scan_faces)[f] : f] =
        document.partitions.labels[working];
  }
  return labels;
}

std::size_t bytes_beyond(const Document& document, const Document& base) {
  std::size_t bytes = sizeof(Document);
  if (document.scan && document.scan != base.scan) {
    bytes += document.scan->source_faces.size() * sizeof(std::uint32_t);
    if (document.scan->mesh != document.mesh) bytes += document.scan->mesh->bytes();
    if (document.scan->file)
      bytes += document.scan->file->points.size() * sizeof(Point) +
               document.scan->file->corners.size() * sizeof(VertexId) +
               document.scan->file->starts.size() * sizeof(std::uint64_t);
  }
  if (document.mesh && document.mesh != base.mesh) bytes += document.mesh->bytes();
  if (document.curvatures && document.curvatures != base.curvatures)
    bytes += document.curvatures->bytes();
  if (document.evidence && document.evidence != base.evidence) bytes += document.evidence->bytes();
  if (document.areas && document.areas != base.areas) bytes += document.areas->bytes();
  const auto add_stage = [&](const Stage& stage, const Stage& other) {
    if (stage.mesh && stage.mesh != document.mesh && stage.mesh != other.mesh)
      bytes += stage.mesh->bytes() + (stage.curvatures ? stage.curvatures->bytes() : 0);
    if (stage.zones && stage.zones != document.zones && stage.zones != other.zones)
      bytes += stage.zones->bytes();
  };
  add_stage(document.opened, base.opened);
  for (std::size_t k = 0; k < chain_steps.size(); ++k)
    add_stage(document.outputs[k], base.outputs[k]);
  if (document.zones && document.zones != base.zones) bytes += document.zones->bytes();
  if (document.smoothed && document.smoothed != base.smoothed) bytes += document.smoothed->bytes();
  if (document.scan_faces && document.scan_faces != base.scan_faces)
    bytes += document.scan_faces->size() * sizeof(FaceId);
  bytes += document.lines.edges.bytes_beyond(base.lines.edges);
  for (const LinePtr& line : document.lines.lines) {
    bytes += sizeof(LinePtr);
    if (line.get() != base.lines.find(line->id))
      bytes += sizeof(Line) + line->vertices.size() * sizeof(VertexId);
  }
  if (document.boundaries && document.boundaries != base.boundaries) {
    std::unordered_set<const Boundary*> shared;
    if (base.boundaries)
      for (const BoundaryPtr& boundary : *base.boundaries) shared.insert(boundary.get());
    for (const BoundaryPtr& boundary : *document.boundaries) {
      bytes += sizeof(BoundaryPtr);
      if (!shared.contains(boundary.get()))
        bytes += sizeof(Boundary) + boundary->vertices.size() * sizeof(VertexId);
    }
  }
  for (std::size_t k = 0; k < document.corrections.size(); ++k) {
    bytes += sizeof(CorrectionPtr);
    if (k >= base.corrections.size() || base.corrections[k] != document.corrections[k])
      bytes += document.corrections[k]->bytes();
  }
  bytes += document.partitions.labels.bytes_beyond(base.partitions.labels);
  for (const PartitionPtr& partition : document.partitions.partitions) {
    bytes += sizeof(PartitionPtr);
    if (partition.get() != base.partitions.find(partition->id)) bytes += sizeof(Partition);
  }
  return bytes;
}

LengthUnit length_unit_of(const Document& document) {
  if (document.unit || document.empty()) return document.unit.value_or(LengthUnit::unknown);
  return find_length_unit(document.scan->report.unit).value_or(LengthUnit::unknown);
}

double assigned_share(const Document& document) {
  if (document.partitions.labels.empty()) return 0.0;
  const double all = document.mesh->area();
  if (!(all > 0.0) || !std::isfinite(all)) return 0.0;  // too large to be added
  double assigned = 0.0;
  std::size_t faces = 0;
  for (const PartitionPtr& p : document.partitions.partitions) {
    assigned += p->area;
    faces += p->faces;
  }
  // The areas are added in another order than the whole.
  return faces == document.mesh->face_count() ? 1.0 : std::min(assigned / all, 1.0);
}

}  // namespace arris
