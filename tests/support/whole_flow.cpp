#include "tests/support/whole_flow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "core/base/hash.h"
#include "core/curvature/distribution.h"
#include "core/curvature/fields.h"
#include "core/document/comparison.h"
#include "core/document/curve_files.h"
#include "core/document/document_bytes.h"
#include "core/document/flow.h"
#include "core/document/perform.h"
#include "core/guidance/explain.h"
#include "core/guidance/stability.h"
#include "core/guidance/worklist.h"
#include "core/mesh/face_quality.h"
#include "core/mesh/scan_content.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/sides.h"
#include "core/partitions/tangent_lines.h"

namespace arris::testing {

namespace {

using nlohmann::json;

/// One file, in memory.
class OneFile : public FileSource {
 public:
  explicit OneFile(const std::string& bytes) : bytes_(bytes) {}
  Result<FileContent> find(const std::string&, const std::string&, const Context&) const override {
    return content_of(bytes_);
  }
  static FileContent content_of(const std::string& bytes) {
    FileContent content{std::make_unique<char[]>(bytes.size()), bytes.size()};
    std::copy(bytes.begin(), bytes.end(), content.bytes.get());
    return content;
  }

 private:
  const std::string& bytes_;
};

bool is_sentence(const std::string& message) {
  return message.size() > 4 && message.ends_with('.') && message.find('\n') == std::string::npos;
}

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// What must hold of every document, as far as it can be told apart from the code that made it.
std::string fault_of_document(const Document& document) {
  const Mesh& mesh = *document.mesh;
  std::set<std::uint32_t> ids;
  if (!document.lines.edges.empty() && document.lines.edges.size() != mesh.edge_count())
    return "the lines are of another mesh";
  for (const LinePtr& line : document.lines.lines) {
    if (!ids.insert(line->id).second || line->id >= document.next_id)
      return "the id of line " + std::to_string(line->id) + " is not its own";
    if (line->vertices.size() < 2 || !std::isfinite(line->length))
      return "line " + std::to_string(line->id) + " is none";
    for (std::size_t k = 1; k < line->vertices.size(); ++k) {
      const auto edge = mesh.find_edge(line->vertices[k - 1], line->vertices[k]);
      if (!edge || !document.lines.is_sharp(*edge))
        return "line " + std::to_string(line->id) + " leaves the sharp edges";
    }
  }
  if (document.partitions.labels.empty()) return {};
  if (document.partitions.labels.size() != mesh.face_count())
    return "the partitions are of another mesh";
  std::map<std::uint32_t, std::uint32_t> counted;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (const std::uint32_t id = document.partitions.labels[f]; id != 0) ++counted[id];
  if (counted.size() != document.partitions.partitions.size())
    return "there are labels of no partition";
  for (const PartitionPtr& partition : document.partitions.partitions)
    if (!ids.insert(partition->id).second || partition->id >= document.next_id ||
        partition->faces != counted[partition->id])
      return "partition " + std::to_string(partition->id) + " is not as it says";
  return {};
}

/// One walk; the first fault found stops it.
class WholeFlow {
 public:
  explicit WholeFlow(const std::string& bytes) : bytes_(bytes), files_(bytes_) {}

  std::string run() {
    Result<PolygonFile> file = fail("It was not read.");
    const std::string path = "part.ply";
    if (std::string fault = fault_of_reading(path, bytes_, file); !fault.empty()) return fault;
    const Operation open{"open", {{"file", path}, {"hash", hash_of_content(bytes_)}}};
    for (const bool weld : {true, false}) {
      Operation one = open;
      one.parameters["weld"] = weld;
      const std::optional<Document> opened = perform_on(Document(), one);
      if (!opened) continue;
      if (!file) return "what cannot be read is opened";
      look_at(*opened);
      for (const Flow flow : {Flow::scan, Flow::paper}) through(*opened, flow);
      if (weld) treat(*opened);
    }
    return fault_;
  }

 private:
  void fault(const std::string& what) {
    if (fault_.empty()) fault_ = what;
  }
  template <class T>
  bool holds(const Result<T>& result, const std::string& what) {
    if (!result && !is_sentence(result.error().message))
      fault(what + ": \"" + result.error().message + "\" is no sentence");
    return result.has_value();
  }

  std::optional<Document> perform_on(const Document& document, const Operation& operation) {
    Result<Performed> done = perform(document, operation, &files_, {});
    if (!holds(done, operation.text())) return std::nullopt;
    if (std::string wrong = fault_of_document(done->document); !wrong.empty())
      fault(operation.text() + ": " + wrong);
    // The row that a journal would hold says the same again.
    const Result<Operation> row = Operation::parse(done->operation.text());
    if (!holds(row, "parse") || !(*row == done->operation))
      fault(operation.text() + " is another one in the journal: " + done->operation.text());
    return std::move(done->document);
  }

  void through(const Document& opened, Flow flow) {
    Document document = opened;
    for (const Operation& operation : operations_of(flow))
      if (std::optional<Document> next = perform_on(document, operation)) {
        document = std::move(*next);
        look_at(document);
      }
    if (std::optional<Document> smooth = perform_on(document, {"smooth_curvature"})) {
      if (std::optional<Document> again =
              perform_on(*smooth, {"find_partitions", {{"method", "fronts"}}}))
        look_at(*again);
    }
    snapshot(opened, document);
  }

  /// Everything that only looks.
  void look_at(const Document& document) {
    const Mesh& mesh = *document.mesh;
    for (const FieldInfo& info : field_table()) {
      std::vector<double> values = info.field == Field::face_quality
                                       ? face_qualities(mesh)
                                       : field_values(*document.shown_curvatures(), info.field);
      if (values.empty()) continue;
      const Distribution distribution(values, field_weights(mesh, info.field));
      if (distribution.empty()) continue;
      if (std::isnan(distribution.quantile(0.5)) || std::isnan(distribution.share_up_to(0.0)))
        fault(std::string(info.name) + " has no distribution");
      for (const double share :
           distribution.bins(distribution.min(), distribution.max(), 16, false).shares)
        if (!(share >= 0.0 && share <= 1.0 + 1e-9))
          fault(std::string(info.name) + " has a bin of " + std::to_string(share));
    }
    if (const auto items = worklist(document); holds(items, "worklist"))
      for (std::size_t k = 0; k < items->size() && k < 20; ++k) {
        if (!is_sentence((*items)[k].sentence)) fault("worklist: " + (*items)[k].sentence);
        holds(with_cuts(document, (*items)[k]), "with_cuts");
      }
    for (std::size_t k = 0; k < 8; ++k) {
      if (mesh.edge_count() > 0)
        explained(explain_edge(document, static_cast<EdgeId>(k * mesh.edge_count() / 8)));
      if (mesh.face_count() > 0)
        explained(explain_face(document, static_cast<FaceId>(k * mesh.face_count() / 8)));
    }
    const auto evidence = line_evidence_of(document);
    if (holds(evidence, "line_evidence_of")) {
      SharpLineOptions options;
      options.method = *evidence ? LineMethod::normal_jump : LineMethod::walk;
      if (const auto curve =
              line_stability(mesh, *document.curvatures, evidence->get(), options, {}, 6);
          holds(curve, "line_stability"))
        static_cast<void>(plateau(*curve));
    }
    if (const auto curve =
            partition_stability(mesh, document.shown_curvatures()->kabs, document.lines, {}, {}, 6);
        holds(curve, "partition_stability"))
      static_cast<void>(plateau(*curve));
    const auto surfaces = fit_partition_surfaces(mesh, document.lines, document.partitions);
    if (holds(surfaces, "fit_partition_surfaces") && document.boundaries)
      holds(find_tangent_lines(mesh, document.partitions, *document.boundaries, *surfaces),
            "find_tangent_lines");
    if (!document.partitions.labels.empty()) {
      const double share = four_sided_share(document.partitions,
                                            outlines_of(mesh, document.lines, document.partitions));
      if (!(share >= 0.0 && share <= 1.0 + 1e-9)) fault("four-sided: " + std::to_string(share));
      if (labels_on_scan(document).size() != document.scan->mesh->face_count())
        fault("there is not one label for each face of the scan");
      const double assigned = assigned_share(document);
      if (!(assigned >= 0.0 && assigned <= 1.0 + 1e-9))
        fault("assigned: " + std::to_string(assigned));
    }
    const HandedCurves lines = handed_lines(document);
    for (const auto& format : {curves_obj, curves_dxf, curves_step, curves_vtp, curves_csv}) {
      if (format(lines).empty()) fault("an export of lines is empty");
      if (document.boundaries && format(handed_boundaries(document)).empty())
        fault("an export of boundaries is empty");
    }
    if (hash_of(document) != hash_of(Document(document))) fault("a copy has another hash");
  }

  void explained(const Explanation& explanation) {
    if (!is_sentence(explanation.headline)) fault("explained: " + explanation.headline);
    for (const ExplainedTest& test : explanation.tests)
      if (!is_sentence(test.sentence)) fault("explained: " + test.sentence);
  }

  /// What a hand can do without pointing at something.
  void treat(const Document& opened) {
    Document document = opened;
    const std::array operations{
        Operation{"find_sharp_lines", {{"method", "walk"}, {"angle", 30.0}, {"min_length", 0.0}}},
        Operation{"find_partitions",
                  {{"intervals", json::array({json::array({0.0, 1.0})})}, {"min_faces", 1}}},
        Operation{"fill_unassigned"},
        Operation{"smooth_boundaries", {{"rounds", 2}}},
        Operation{"split_to_four_sides"},
        Operation{"remove_small_partitions", {{"faces", 4}, {"fill", true}}},
        Operation{"flip_orientation"},
        Operation{"delete_faces", {{"components_under", 3}}},
        Operation{"find_sharp_lines"},
        Operation{"simplify", {{"target_vertices", 5}}},
        Operation{"swap_edges"},
        Operation{"equilateralize"},
        Operation{"find_partitions"}};
    for (const Operation& operation : operations)
      if (std::optional<Document> next = perform_on(document, operation)) {
        if (const auto between = compare(document, *next); !holds(between, "compare")) return;
        document = std::move(*next);
        by_hand(document);
      }
    look_at(document);
    snapshot(opened, document);
  }

  /// One treatment of each kind on the first thing there is for it.
  void by_hand(const Document& document) {
    const auto region = [&](VertexId v) {
      return json{{"vertices", {v}}, {"radius", document.mesh->mean_edge_length()}};
    };
    // What cannot be written as JSON cannot come from there.
    if (document.mesh->face_count() == 0 || !std::isfinite(document.mesh->mean_edge_length()))
      return;
    const VertexId corner = document.mesh->triangle(0)[0];
    if (!document.lines.lines.empty()) {
      const Line& line = *document.lines.lines.front();
      const std::uint32_t last = document.lines.lines.back()->id;
      perform_on(document, {"extend_line", {{"line", line.id}, {"angle", 10.0}}});
      perform_on(document, {"trim_line",
                            {{"line", line.id},
                             {"vertex", line.vertices[line.vertices.size() / 2]},
                             {"side", "last"}}});
      perform_on(
          document,
          {"split_line", {{"line", line.id}, {"vertex", line.vertices[line.vertices.size() / 2]}}});
      perform_on(document, {"merge_lines", {{"a", line.id}, {"b", last}}});
      perform_on(document, {"delete_lines", {{"lines", {line.id}}}});
      perform_on(document, {"lock", {{"lines", {line.id}}, {"locked", true}}});
    }
    perform_on(document, {"recompute_lines", {{"region", region(corner)}, {"angle", 20.0}}});
    perform_on(document, {"draw_line", {{"vertices", document.mesh->triangle(0)}}});
    if (!document.partitions.partitions.empty()) {
      const std::uint32_t a = document.partitions.partitions.front()->id,
                          b = document.partitions.partitions.back()->id;
      const json interval = json::array({0.0, 1.0});
      perform_on(document, {"connect_partitions", {{"partitions", {a, b}}, {"lines", "remove"}}});
      perform_on(document, {"extend_partition", {{"partition", a}, {"interval", interval}}});
      perform_on(document, {"restart_partitions", {{"partitions", {a}}, {"interval", interval}}});
      perform_on(document, {"remove_partitions", {{"partitions", {b}}}});
      perform_on(document,
                 {"recompute_partitions", {{"region", region(corner)}, {"interval", interval}}});
      perform_on(document, {"paint_partition", {{"partition", a}, {"region", region(corner)}}});
    }
  }

  void snapshot(const Document& opened, const Document& document) {
    const std::optional<std::string> bytes = bytes_of(document);
    if (!bytes) return;
    const std::optional<Document> again = document_from(*bytes, opened);
    if (!again || hash_of(*again) != hash_of(document)) fault("the snapshot is another document");
  }

  const std::string& bytes_;
  OneFile files_;
  std::string fault_;
};

}  // namespace

std::string ply_bytes(const Triangles& triangles) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(triangles.points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(triangles.triangles.size()) +
                      "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (const Point& p : triangles.points)
    for (int axis = 0; axis < 3; ++axis) append(bytes, p[axis]);
  for (const Triangle& t : triangles.triangles) {
    append(bytes, std::uint8_t{3});
    for (const VertexId v : t) append(bytes, v);
  }
  return bytes;
}

std::string fault_of_reading(const std::string& path, const std::string& bytes,
                             Result<PolygonFile>& read) {
  read = read_polygon_content(path, OneFile::content_of(bytes));
  if (!read) {
    const std::string& message = read.error().message;
    return is_sentence(message) && message.starts_with(path) ? "" : "\"" + message + "\"";
  }
  for (const std::string& note : read->notes)
    if (!is_sentence(note)) return "the note \"" + note + "\"";
  const std::vector<std::uint64_t>& starts = read->starts;
  if (starts.size() < 2 || starts.front() != 0 || starts.back() != read->corners.size() ||
      !std::is_sorted(starts.begin(), starts.end()))
    return "polygons that do not hold together";
  for (const VertexId v : read->corners)
    if (v >= read->points.size()) return "a corner that is not there";
  return {};
}

std::string fault_of_whole_flow(const std::string& bytes) { return WholeFlow(bytes).run(); }

}  // namespace arris::testing
