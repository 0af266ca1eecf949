#include "core/document/document.h"

#include "core/base/hash.h"

namespace arris {

namespace {

void add(Hasher& hasher, const std::optional<Step>& step) {
  hasher.number(step.has_value());
  if (!step) return;
  hasher.text(step->parameters.dump());
  hasher.number(step->out_of_date);
}

void add_real(Hasher& hasher, double value) { hasher.bytes(&value, sizeof value); }

}  // namespace

const std::optional<Step>& Document::step(std::string_view name) const {
  static const std::optional<Step> none;
  return name == "find_sharp_lines"   ? find_sharp_lines
         : name == "smooth_curvature" ? smooth_curvature
         : name == "find_partitions"  ? find_partitions
                                      : none;
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

  // Sharp edges by vertex pairs: edge numbers are not stored (document.md, rule 1).
  for (EdgeId e = 0; e < document.lines.edges.size(); ++e) {
    if (!document.lines.is_sharp(e)) continue;
    const EdgeVertices& v = document.mesh->edge(e);
    hasher.bytes(v.data(), sizeof v);
    hasher.number(static_cast<std::uint64_t>(document.lines.edges[e]));
  }
  hasher.number(document.lines.lines.size());
  for (const LinePtr& line : document.lines.lines) {
    hasher.number(line->id);
    hasher.number(line->vertices.size());
    hasher.bytes(line->vertices.data(), line->vertices.size() * sizeof(VertexId));
  }

  hasher.number(document.partitions.labels.size());
  for (FaceId f = 0; f < document.partitions.labels.size(); ++f)
    hasher.number(document.partitions.labels[f]);
  hasher.number(document.partitions.partitions.size());
  for (const PartitionPtr& partition : document.partitions.partitions) {
    hasher.number(partition->id);
    hasher.bytes(partition->anchor.data(), sizeof partition->anchor);
    hasher.number(static_cast<std::uint64_t>(partition->criterion));
    add_real(hasher, partition->interval.min);
    add_real(hasher, partition->interval.max);
  }
  add(hasher, document.find_sharp_lines);
  add(hasher, document.smooth_curvature);
  add(hasher, document.find_partitions);
  hasher.number(document.next_id);
  return hasher.hex();
}

std::vector<std::uint32_t> labels_on_scan(const Document& document) {
  std::vector<std::uint32_t> labels(document.scan->mesh->face_count(), 0);
  for (FaceId f = 0; f < document.partitions.labels.size(); ++f)
    labels[document.scan_faces ? (*document.scan_faces)[f] : f] = document.partitions.labels[f];
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
  if (document.smoothed && document.smoothed != base.smoothed) bytes += document.smoothed->bytes();
  if (document.scan_faces && document.scan_faces != base.scan_faces)
    bytes += document.scan_faces->size() * sizeof(FaceId);
  bytes += document.lines.edges.bytes_beyond(base.lines.edges);
  for (const LinePtr& line : document.lines.lines) {
    bytes += sizeof(LinePtr);
    if (line.get() != base.lines.find(line->id))
      bytes += sizeof(Line) + line->vertices.size() * sizeof(VertexId);
  }
  bytes += document.partitions.labels.bytes_beyond(base.partitions.labels);
  for (const PartitionPtr& partition : document.partitions.partitions) {
    bytes += sizeof(PartitionPtr);
    if (partition.get() != base.partitions.find(partition->id)) bytes += sizeof(Partition);
  }
  return bytes;
}

double assigned_share(const Document& document) {
  if (document.partitions.labels.empty()) return 0.0;
  double all = 0.0, assigned = 0.0;
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const double area = face_area(*document.mesh, f);
    all += area;
    if (document.partitions.labels[f] != 0) assigned += area;
  }
  return all > 0.0 ? assigned / all : 0.0;
}

}  // namespace arris
