#include "core/document/document_bytes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include <zlib.h>

#include "core/document/journal.h"

namespace arris {

namespace {

/// Of the layout below, and the oldest that is still read: another one is not. 2: with the unit.
/// 3: steps by name, so that a chain of other steps can be read.
constexpr std::uint32_t layout = 3, oldest_layout = 1;
/// The steps of layouts that did not name them; the first two left a mesh.
constexpr std::array<StepName, 6> unnamed_steps{"simplify",         "swap_edges",
                                                "find_sharp_lines", "equilateralize",
                                                "smooth_curvature", "find_partitions"};
constexpr std::uint32_t none = 0xFFFFFFFFu;

/// Plain values one after the other, as this machine holds them.
class Writer {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void value(const T& v) { bytes.append(reinterpret_cast<const char*>(&v), sizeof v); }
  template <class T>
  void values(const std::vector<T>& list) {
    value(std::uint64_t{list.size()});
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
  }
  void text(const std::string& t) { values(std::vector<char>(t.begin(), t.end())); }
  template <class T>
  void chunked(const ChunkedArray<T>& array) {
    std::vector<T> list(array.size());
    for (std::size_t k = 0; k < list.size(); ++k) list[k] = array[k];
    values(list);
  }
  void step(const std::optional<Step>& s) {
    value(s.has_value());
    if (!s) return;
    text(s->parameters.dump());
    value(s->out_of_date);
  }

  std::string bytes;
};

/// Reads them again; once something is missing or cannot be, all is zero or empty from there on.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  bool good() const { return good_; }
  bool at_end() const { return good_ && rest_.empty(); }
  void expect(bool holds) { good_ = good_ && holds; }

  template <class T>
  requires std::is_trivially_copyable_v<T> T value() {
    T v{};
    expect(rest_.size() >= sizeof v);
    if (!good_) return v;
    std::memcpy(&v, rest_.data(), sizeof v);
    rest_.remove_prefix(sizeof v);
    return v;
  }
  bool flag() {
    const auto byte = value<std::uint8_t>();
    expect(byte <= 1);
    return byte == 1;
  }
  /// How many there are of things that take at least `least` bytes each.
  std::size_t count(std::size_t least) {
    const auto number = value<std::uint64_t>();
    expect(number <= rest_.size() / least);
    return good_ ? static_cast<std::size_t>(number) : 0;
  }
  template <class T>
  std::vector<T> values() {
    std::vector<T> list(count(sizeof(T)));
    if (list.empty()) return list;  // which has no place that could be copied to
    std::memcpy(static_cast<void*>(list.data()), rest_.data(), list.size() * sizeof(T));
    rest_.remove_prefix(list.size() * sizeof(T));
    return list;
  }
  /// Numbers below `end`.
  std::vector<std::uint32_t> ids(std::size_t end) {
    auto list = values<std::uint32_t>();
    expect(std::ranges::all_of(list, [end](std::uint32_t id) { return id < end; }));
    return good_ ? std::move(list) : std::vector<std::uint32_t>();
  }
  std::string text() {
    const auto list = values<char>();
    return {list.begin(), list.end()};
  }
  std::optional<Step> step() {
    if (!flag()) return std::nullopt;
    Step s;
    s.parameters = parse_record(text());
    s.out_of_date = flag();
    expect(s.parameters.is_object());
    return good_ ? std::optional(std::move(s)) : std::nullopt;
  }

 private:
  std::string_view rest_;
  bool good_ = true;
};

/// Objects that several stages share, each once.
template <class T>
std::uint32_t place_among(std::vector<std::shared_ptr<const T>>& all,
                          const std::shared_ptr<const T>& one) {
  if (!one) return none;
  const auto found = std::ranges::find(all, one);
  if (found == all.end()) {
    all.push_back(one);
    return static_cast<std::uint32_t>(all.size() - 1);
  }
  return static_cast<std::uint32_t>(found - all.begin());
}

void write_zones(Writer& out, const ErrorZones& zones, const Mesh& mesh) {
  out.values(zones.radii());
  std::vector<std::uint32_t> starts{0}, border_starts{0};
  std::vector<VertexId> of_faces, of_borders;
  std::vector<EdgeId> edges;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const auto zone = zones.of_face(f);
    of_faces.insert(of_faces.end(), zone.begin(), zone.end());
    starts.push_back(static_cast<std::uint32_t>(of_faces.size()));
  }
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const auto zone = zones.of_border_edge(e);
    if (zone.empty()) continue;
    edges.push_back(e);
    of_borders.insert(of_borders.end(), zone.begin(), zone.end());
    border_starts.push_back(static_cast<std::uint32_t>(of_borders.size()));
  }
  out.values(starts);
  out.values(of_faces);
  out.values(edges);
  out.values(border_starts);
  out.values(of_borders);
}

ErrorZonesPtr read_zones(Reader& in, const Mesh& mesh) {
  auto radii = in.values<double>();
  auto starts = in.values<std::uint32_t>();
  auto of_faces = in.ids(mesh.vertex_count());
  auto edges = in.ids(mesh.edge_count());
  auto border_starts = in.values<std::uint32_t>();
  auto of_borders = in.ids(mesh.vertex_count());
  const auto bound = [&](const std::vector<std::uint32_t>& s, std::size_t count, std::size_t size) {
    in.expect(s.size() == count + 1 && s.front() == 0 && s.back() == size &&
              std::ranges::is_sorted(s));
  };
  in.expect(radii.size() == 1 || radii.size() == mesh.vertex_count());
  bound(starts, mesh.face_count(), of_faces.size());
  bound(border_starts, edges.size(), of_borders.size());
  if (!in.good()) return nullptr;
  auto zones = std::make_shared<const ErrorZones>(std::move(radii), std::move(starts),
                                                  std::move(of_faces), std::move(edges),
                                                  std::move(border_starts), std::move(of_borders));
  in.expect(zones->check(mesh).has_value());
  return zones;
}

std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  compress2(reinterpret_cast<Bytef*>(result.data()), &size,
            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  result.resize(size);
  return result;
}

Line read_line(Reader& in, const Mesh& mesh) {
  Line line;
  line.id = in.value<std::uint32_t>();
  line.closed = in.flag();
  line.length = in.value<double>();
  line.mean_angle = in.value<double>();
  line.origin = static_cast<Origin>(in.value<std::uint8_t>());
  in.expect(line.origin <= Origin::drawn);
  line.locked = in.flag();
  line.vertices = in.ids(mesh.vertex_count());
  in.expect(line.vertices.size() >= 2);
  return line;
}

Partition read_partition(Reader& in, const Mesh& mesh) {
  Partition partition;
  partition.id = in.value<std::uint32_t>();
  partition.anchor = in.value<Triangle>();
  partition.faces = in.value<std::uint32_t>();
  partition.area = in.value<double>();
  partition.mean_value = in.value<double>();
  partition.criterion = static_cast<Criterion>(in.value<std::uint8_t>());
  partition.interval.min = in.value<double>();
  partition.interval.max = in.value<double>();
  partition.locked = in.flag();
  in.expect(
      partition.criterion <= Criterion::ikabs &&
      std::ranges::all_of(partition.anchor, [&](VertexId v) { return v < mesh.vertex_count(); }));
  return partition;
}

CorrectionPtr read_correction(Reader& in) {
  const auto id = in.value<std::uint32_t>();
  Result<Operation> operation = Operation::parse(in.text());
  const auto state = static_cast<CorrectionState>(in.value<std::uint8_t>());
  std::string message = in.text();
  in.expect(operation.has_value() && state <= CorrectionState::off);
  if (!in.good()) return nullptr;
  return std::make_shared<const Correction>(id, std::move(*operation), state, std::move(message));
}

/// The meshes of the stages with their zones, each once. False: there is one that this layout
/// cannot hold.
bool write_stages(Writer& out, const Document& document) {
  const auto scan_points = document.scan->mesh->points();
  std::vector<MeshPtr> meshes{document.scan->mesh};
  std::vector<ErrorZonesPtr> zones;
  std::vector<std::uint32_t> stages;  // of each: mesh and zones
  std::vector<MeshPtr> mesh_of_zones;
  const auto add = [&](const MeshPtr& mesh, const ErrorZonesPtr& with) {
    stages.push_back(place_among(meshes, mesh));
    stages.push_back(place_among(zones, with));
    if (zones.size() > mesh_of_zones.size()) mesh_of_zones.push_back(mesh);
  };
  add(document.mesh, document.zones);
  add(document.opened.mesh, document.opened.zones);
  for (const Stage& output : document.outputs) add(output.mesh, output.zones);

  out.value(std::uint64_t{meshes.size()});
  for (std::size_t k = 1; k < meshes.size(); ++k) {
    const auto own = meshes[k]->points();
    // All begin with the points of the scan; deleting faces may split vertices, which adds some.
    if (own.size() < scan_points.size() ||
        std::memcmp(own.data(), scan_points.data(), scan_points.size_bytes()) != 0)
      return false;
    std::vector<std::array<double, 3>> added;
    for (const Point& p : own.subspan(scan_points.size())) added.push_back({p.x(), p.y(), p.z()});
    out.values(added);
    out.values(meshes[k]->triangles());
  }
  out.value(std::uint64_t{zones.size()});
  for (std::size_t k = 0; k < zones.size(); ++k) {
    out.value(place_among(meshes, mesh_of_zones[k]));
    write_zones(out, *zones[k], *mesh_of_zones[k]);
  }
  out.values(stages);
  out.value(document.scan_faces != nullptr);
  if (document.scan_faces) out.values(*document.scan_faces);
  return true;
}

void write_lines(Writer& out, const SharpLines& lines) {
  out.chunked(lines.edges);
  out.values(lines.cuts);
  out.value(std::uint64_t{lines.lines.size()});
  for (const LinePtr& line : lines.lines) {
    out.value(line->id);
    out.value(line->closed);
    out.value(line->length);
    out.value(line->mean_angle);
    out.value(line->origin);
    out.value(line->locked);
    out.values(line->vertices);
  }
}

void write_partitions(Writer& out, const Partitions& partitions) {
  out.chunked(partitions.labels);
  out.value(std::uint64_t{partitions.partitions.size()});
  for (const PartitionPtr& partition : partitions.partitions) {
    out.value(partition->id);
    out.value(partition->anchor);
    out.value(partition->faces);
    out.value(partition->area);
    out.value(partition->mean_value);
    out.value(partition->criterion);
    out.value(partition->interval.min);
    out.value(partition->interval.max);
    out.value(partition->locked);
  }
}

}  // namespace

std::optional<std::string> bytes_of(const Document& document) {
  if (document.empty() || document.smoothed) return std::nullopt;
  Writer out;
  if (!write_stages(out, document)) return std::nullopt;
  write_lines(out, document.lines);
  write_partitions(out, document.partitions);
  out.value(std::uint64_t{document.corrections.size()});
  for (const CorrectionPtr& correction : document.corrections) {
    out.value(correction->id);
    out.text(correction->operation.text());
    out.value(correction->state);
    out.text(correction->message);
  }
  out.value(std::uint64_t{chain_steps.size()});
  for (std::size_t k = 0; k < chain_steps.size(); ++k) {
    out.text(std::string(chain_steps[k].name));
    out.step(document.steps[k]);
  }
  out.value(document.next_id);
  out.value(document.unit.has_value());
  if (document.unit) out.value(*document.unit);

  Writer whole;
  whole.value(layout);
  whole.value(std::uint64_t{out.bytes.size()});
  whole.bytes += packed(out.bytes);
  return std::move(whole.bytes);
}

std::optional<Document> document_from(std::string_view bytes, const Document& opened,
                                      const Context& context) {
  Reader head(
      bytes.substr(0, std::min(bytes.size(), sizeof(std::uint32_t) + sizeof(std::uint64_t))));
  const auto version = head.value<std::uint32_t>();
  const auto size = head.value<std::uint64_t>();
  // No more than what such a part can need is allocated.
  const std::size_t elements = opened.scan->mesh->vertex_count() + opened.scan->mesh->face_count();
  constexpr std::size_t most_each = 400;  // bytes
  if (!head.at_end() || version < oldest_layout || version > layout ||
      size > (std::size_t{64} << 20) + most_each * elements)
    return std::nullopt;
  std::string unpacked(size, '\0');
  const std::string_view rest = bytes.substr(sizeof version + sizeof size);
  uLongf made = size;
  if (uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &made,
                 reinterpret_cast<const Bytef*>(rest.data()), rest.size()) != Z_OK ||
      made != size)
    return std::nullopt;

  Reader in(unpacked);
  Document document;
  document.scan = opened.scan;
  document.scan_path = opened.scan_path;
  /// A mesh with what is derived from it.
  std::vector<Stage> meshes{{opened.mesh, opened.curvatures, nullptr, opened.evidence}};
  const auto scan_points = opened.scan->mesh->points();
  const std::size_t mesh_count = in.count(sizeof(std::uint64_t));
  in.expect(mesh_count >= 1 && mesh_count <= chain_steps.size() + 3);
  for (std::size_t k = 1; in.good() && k < mesh_count; ++k) {
    std::vector<Point> points(scan_points.begin(), scan_points.end());
    for (const auto& [x, y, z] : in.values<std::array<double, 3>>()) points.emplace_back(x, y, z);
    auto triangles = in.values<Triangle>();
    for (const Triangle& t : triangles)
      for (const VertexId v : t) in.expect(v < points.size());
    if (!in.good()) return std::nullopt;
    Result<MeshPtr> mesh = Mesh::create(std::move(points), std::move(triangles));
    if (!mesh) return std::nullopt;
    Result<CurvaturesPtr> curvatures =
        compute_curvatures(**mesh, opened.curvatures->options, context.silent());
    if (!curvatures) return std::nullopt;
    auto evidence = std::make_shared<const SharedLineEvidence>(*mesh, *curvatures);
    meshes.push_back({std::move(*mesh), std::move(*curvatures), nullptr, std::move(evidence)});
  }
  std::vector<ErrorZonesPtr> zones;
  const std::size_t zone_count = in.count(sizeof(std::uint64_t));
  for (std::size_t k = 0; in.good() && k < zone_count; ++k) {
    const auto of = in.value<std::uint32_t>();
    in.expect(of < meshes.size());
    if (in.good()) zones.push_back(read_zones(in, *meshes[of].mesh));
  }
  const auto stages = in.values<std::uint32_t>();
  in.expect(stages.size() >= 4 && stages.size() % 2 == 0);
  if (!in.good()) return std::nullopt;
  const auto stage_at = [&](std::size_t k) {
    in.expect(2 * k + 1 < stages.size());
    if (!in.good()) return Stage{};
    const std::uint32_t mesh = stages[2 * k], with = stages[2 * k + 1];
    in.expect((mesh == none || mesh < meshes.size()) && (with == none || with < zones.size()));
    if (!in.good() || mesh == none) return Stage{};
    Stage stage = meshes[mesh];
    if (with != none) stage.zones = zones[with];
    return stage;
  };
  const bool named = version >= 3;
  const Stage current = stage_at(named ? 0 : 3);
  document.opened = stage_at(named ? 1 : 0);
  if (!in.good() || !current.mesh || !document.opened.mesh) return std::nullopt;
  document.mesh = current.mesh;
  document.curvatures = current.curvatures;
  document.evidence = current.evidence;
  document.zones = current.zones;
  const Mesh& mesh = *document.mesh;
  if (in.flag()) {
    auto faces = in.ids(opened.scan->mesh->face_count());
    in.expect(faces.size() == document.opened.mesh->face_count());
    document.scan_faces = std::make_shared<const std::vector<FaceId>>(std::move(faces));
  }

  const auto edges = in.values<Origin>();
  in.expect((edges.empty() || edges.size() == mesh.edge_count()) &&
            std::ranges::all_of(edges, [](Origin o) { return o <= Origin::drawn; }));
  document.lines.edges = ChunkedArray<Origin>(edges, {});
  document.lines.cuts = in.ids(mesh.vertex_count());
  const std::size_t line_count = in.count(sizeof(std::uint64_t));
  for (std::size_t k = 0; in.good() && k < line_count; ++k)
    document.lines.lines.push_back(std::make_shared<const Line>(read_line(in, mesh)));
  const auto labels = in.values<std::uint32_t>();
  in.expect(labels.empty() || labels.size() == mesh.face_count());
  document.partitions.labels = ChunkedArray<std::uint32_t>(labels, {});
  const std::size_t partition_count = in.count(sizeof(std::uint64_t));
  for (std::size_t k = 0; in.good() && k < partition_count; ++k)
    document.partitions.partitions.push_back(
        std::make_shared<const Partition>(read_partition(in, mesh)));
  const std::size_t correction_count = in.count(sizeof(std::uint64_t));
  for (std::size_t k = 0; in.good() && k < correction_count; ++k)
    document.corrections.push_back(read_correction(in));
  if (named) {
    const std::size_t step_count = in.count(sizeof(std::uint64_t));
    in.expect(stages.size() == 2 * (step_count + 2));
    for (std::size_t k = 0; in.good() && k < step_count; ++k) {
      const StepName name(in.text());
      in.expect(name.place < chain_steps.size());
      if (!in.good()) return std::nullopt;
      document.step(name) = in.step();
      document.outputs[name.place] = stage_at(k + 2);
    }
  } else {
    for (const StepName& name : unnamed_steps) document.step(name) = in.step();
    for (std::size_t k : {0, 1}) document.outputs[unnamed_steps[k].place] = stage_at(k + 1);
  }
  document.next_id = in.value<std::uint32_t>();
  if (version >= 2 && in.flag()) {
    document.unit = in.value<LengthUnit>();
    in.expect(static_cast<std::size_t>(*document.unit) < length_unit_table().size());
  }
  if (!in.at_end()) return std::nullopt;
  document.boundaries = std::make_shared<const Boundaries>(
      derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions));
  return document;
}

}  // namespace arris
