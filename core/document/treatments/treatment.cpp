#include "core/document/treatments/treatment.h"
#include "core/partitions/area_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "core/base/words.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

namespace {

std::vector<EdgeId> edges_on(const Mesh& mesh, const Path& path) {
  std::vector<EdgeId> edges;
  for (const HalfEdgeId h : half_edges_of(mesh, path)) edges.push_back(h >> 1);
  return edges;
}

}  // namespace

void Ground::change(const LineChanges& changes) {
  SharpLines edited = edit_lines(mesh, measures(), lines, changes, next_id);
  std::vector<EdgeId> touched;
  for (const auto& [e, origin] : changes.edges) touched.push_back(e);
  boundaries = update_boundaries(mesh, curvatures, boundaries, {lines, partitions},
                                 {edited, partitions}, touched);
  lines = std::move(edited);
}

void Ground::change(const FaceLabels& labels, const std::vector<Partition>& fresh) {
  EditedPartitions edited = edit_partitions(partition_ground(), labels, fresh, next_id);
  boundaries = update_boundaries(mesh, curvatures, boundaries, {lines, partitions},
                                 {lines, edited.partitions}, edited.touched);
  partitions = std::move(edited.partitions);
}

void Ground::change_to(Ground&& tried) {
  lines = std::move(tried.lines);
  partitions = std::move(tried.partitions);
  boundaries = std::move(tried.boundaries);
  next_id = tried.next_id;
}

void Ground::part_along(const std::vector<Path>& paths) {
  if (partitions.labels.empty()) return;
  std::vector<EdgeId> edges;
  for (const Path& path : paths)
    for (const EdgeId e : edges_on(mesh, path)) edges.push_back(e);
  FaceLabels labels;
  std::vector<Partition> fresh;
  for (const auto& [id, pieces] : parted_by_lines(partition_ground(), edges)) {
    const Partition& whole = *partitions.find(id);
    for (const std::vector<FaceId>& piece : pieces) {
      fresh.push_back(new_partition(whole.interval));
      fresh.back().locked = whole.locked;
      for (const FaceId f : piece) labels.emplace_back(f, fresh.back().id);
    }
  }
  if (!labels.empty()) change(labels, fresh);
}

Partition Ground::new_partition(const CurvatureInterval& interval) {
  Partition partition;
  partition.id = next_id++;
  partition.criterion = criterion;
  partition.interval = interval;
  return partition;
}

Ground ground_of(const Document& document) {
  const Result<LineEvidencePtr> evidence = line_evidence_of(document);
  const Criterion criterion = document.criterion();
  Ground ground{*document.mesh,
                *document.curvatures,
                values_of(*document.shown_curvatures(), criterion),
                document.lines,
                document.partitions,
                *document.boundaries,
                document.next_id,
                criterion,
                *evidence};
  return ground;
}

Result<Document> apply_treatment(const OperationKind& treatment, const Document& document,
                                 const nlohmann::json& parameters, const Context& context) {
  Ground ground = ground_of(document);
  ground.context = context;
  const Result<TreatmentOutcome> done = treatment.treat(ground, parameters, Round::first);
  if (!done) return tl::unexpected<Error>(done.error());
  Document result = document;
  result.lines = std::move(ground.lines);
  result.partitions = std::move(ground.partitions);
  result.boundaries = std::make_shared<const Boundaries>(std::move(ground.boundaries));
  result.next_id = ground.next_id;
  result.corrections.push_back(std::make_shared<const Correction>(
      result.next_id++, Operation{std::string(treatment.name), parameters},
      done->adapted.empty() ? CorrectionState::applied : CorrectionState::adapted, done->adapted));
  if (!treatment.belongs(parameters, Round::after_lines)) return result;
  if (result.step("smooth_curvature")) result.step("smooth_curvature")->out_of_date = true;
  // Lines that parted the partitions beside them at once leave them as they are to be.
  if (result.step("find_partitions") && !parameters.value("part", false))
    result.step("find_partitions")->out_of_date = true;
  return result;
}

std::vector<CorrectionPtr> correct(const std::vector<CorrectionPtr>& corrections, Ground& ground,
                                   Round round, bool switched_on) {
  std::vector<CorrectionPtr> result;
  for (const CorrectionPtr& correction : corrections) {
    const OperationKind& treatment = *find_operation(correction->operation.name);
    if (!treatment.belongs(correction->operation.parameters, round)) {
      result.push_back(correction);
      continue;
    }
    CorrectionState state = CorrectionState::off;
    std::string message;
    if (switched_on) {
      const Result<TreatmentOutcome> done =
          treatment.treat(ground, correction->operation.parameters, round);
      state = !done                   ? CorrectionState::failed
              : done->adapted.empty() ? CorrectionState::applied
                                      : CorrectionState::adapted;
      message = done ? done->adapted : done.error().message;
    }
    if (state == correction->state && message == correction->message)
      result.push_back(correction);
    else
      result.push_back(std::make_shared<const Correction>(correction->id, correction->operation,
                                                          state, message));
  }
  return result;
}

Result<void> refind_lines(Document& document, const std::optional<nlohmann::json>& parameters,
                          const Context& context) {
  const Mesh& mesh = *document.mesh;
  const Curvatures& curvatures = *document.curvatures;
  if (!document.evidence)
    document.evidence =
        std::make_shared<const SharedLineEvidence>(document.mesh, document.curvatures);
  const Result<LineEvidencePtr> evidence = line_evidence_of(document, context.part(0.0, 0.9));
  if (!evidence) return tl::unexpected<Error>(evidence.error());
  const Curvatures& measures = *evidence ? *(*evidence)->measures : curvatures;
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  bool switched_on = true;
  if (parameters) {
    switched_on = parameters->at("corrections");
    Result<std::vector<Origin>> found = find_sharp_edges(
        mesh, curvatures, evidence->get(), line_options_of(*parameters), context.part(0.9, 1.0));
    if (!found) return tl::unexpected<Error>(found.error());
    edges = std::move(*found);
  }
  for (const LinePtr& line : document.lines.lines)
    if (line->locked)
      for (const EdgeId e : edges_on(mesh, line->vertices)) edges[e] = document.lines.edges[e];

  const bool corrected =
      std::any_of(document.corrections.begin(), document.corrections.end(), [](const auto& c) {
        return find_operation(c->operation.name)
            ->belongs(c->operation.parameters, Round::after_lines);
      });
  SharpLines previous = document.lines;
  if (corrected) {
    // Ids count from 1 here: which lines are which is only decided once all is done.
    Ground ground{mesh, curvatures, curvatures.kabs, {}, {}, {}, 1, Criterion::kabs, *evidence};
    SharpLines locked;
    for (const LinePtr& line : document.lines.lines)
      if (line->locked) {
        auto copy = std::make_shared<Line>(*line);
        copy->id = ground.next_id++;
        locked.lines.push_back(std::move(copy));
      }
    ground.lines = relink_lines(mesh, measures, edges, locked, ground.next_id);
    ground.boundaries = derive_boundaries(mesh, curvatures, ground.lines, {});
    document.corrections = correct(document.corrections, ground, Round::after_lines, switched_on);
    for (EdgeId e = 0; e < edges.size(); ++e) edges[e] = ground.lines.edges[e];
    previous.cuts = ground.lines.cuts;
  } else {
    previous.cuts.clear();
  }
  document.lines = relink_lines(mesh, measures, edges, previous, document.next_id);
  return {};
}

Result<void> refind_partitions(Document& document, const std::optional<nlohmann::json>& parameters,
                               const Context& context) {
  const Mesh& mesh = *document.mesh;
  PartitionOptions options;
  options.bare_areas = true;
  bool switched_on = true, by_surfaces = false;
  if (parameters) {
    options.criterion = parameters->at("criterion") == "kabs" ? Criterion::kabs : Criterion::ikabs;
    options.min_faces = parameters->at("min_faces");
    options.fill_holes = parameters->at("fill_holes");
    for (const auto& interval : parameters->at("intervals"))
      options.intervals.push_back(interval_of(interval));
    switched_on = parameters->at("corrections");
    by_surfaces = parameters->at("method") == "surfaces";
  }
  const std::vector<double>& values = values_of(*document.shown_curvatures(), options.criterion);
  std::vector<Partition> locked;
  std::vector<bool> taken;
  for (const PartitionPtr& partition : document.partitions.partitions)
    if (partition->locked) {
      taken.resize(mesh.face_count(), false);
      locked.push_back(*partition);
      for (const FaceId f : faces_of(mesh, document.partitions, *partition)) taken[f] = true;
    }
  Result<FoundPartitions> found;
  if (by_surfaces) {
    if (!document.areas || document.areas->mesh() != document.mesh)
      document.areas = std::make_shared<const SharedAreaTree>(document.mesh);
    const Result<AreaTreePtr> tree = document.areas->get(document.lines, context.part(0.0, 0.9));
    if (!tree) return tl::unexpected<Error>(tree.error());
    const double detail = parameters->at("detail");
    found = partitions_of(mesh, **tree, static_cast<float>(1.0 / detail), options.min_faces,
                          options.criterion, values, taken);
  } else {
    found = propagate_fronts(mesh, values, document.lines, options, context, taken);
  }
  if (!found) return tl::unexpected<Error>(found.error());
  // Locked partitions stay as they are, numbered after the found ones.
  for (Partition& partition : locked) {
    const auto label = static_cast<std::uint32_t>(found->partitions.size() + 1);
    for (const FaceId f : faces_of(mesh, document.partitions, partition)) found->labels[f] = label;
    partition.id = 0;
    found->partitions.push_back(partition);
  }
  const bool corrected =
      std::any_of(document.corrections.begin(), document.corrections.end(), [](const auto& c) {
        return find_operation(c->operation.name)
            ->belongs(c->operation.parameters, Round::after_partitions);
      });
  if (corrected) {
    const Result<LineEvidencePtr> evidence = line_evidence_of(document, context);
    if (!evidence) return tl::unexpected<Error>(evidence.error());
    Ground ground{mesh, *document.curvatures, values,   document.lines, {}, {},
                  1,    options.criterion,    *evidence};
    ground.partitions = number_partitions(mesh, *found, {}, ground.next_id);
    ground.boundaries =
        derive_boundaries(mesh, *document.curvatures, ground.lines, ground.partitions);
    document.corrections =
        correct(document.corrections, ground, Round::after_partitions, switched_on);
    std::vector<std::uint32_t> place(ground.next_id, 0);
    found->partitions.clear();
    for (const PartitionPtr& partition : ground.partitions.partitions) {
      found->partitions.push_back(*partition);
      found->partitions.back().id = 0;
      place[partition->id] = static_cast<std::uint32_t>(found->partitions.size());
    }
    for (FaceId f = 0; f < mesh.face_count(); ++f)
      found->labels[f] = place[ground.partitions.labels[f]];
  }
  document.partitions = number_partitions(mesh, *found, document.partitions, document.next_id);
  return {};
}

SharpLineOptions line_options_of(const nlohmann::json& parameters) {
  SharpLineOptions options;
  const std::string convexity = parameters.value("convexity", "any");
  options.method =
      parameters.value("method", "walk") == "walk" ? LineMethod::walk : LineMethod::normal_jump;
  options.angle = parameters.value("angle", options.angle);
  options.max_angle = parameters.value("max_angle", options.max_angle);
  options.convexity = convexity == "convex"    ? Convexity::convex
                      : convexity == "concave" ? Convexity::concave
                                               : Convexity::any;
  options.candidates = parameters.value("candidates", options.candidates);
  options.min_length = parameters.value("min_length", options.min_length);
  options.parallel_distance = parameters.value("parallel_distance", options.parallel_distance);
  options.bridge_gap = parameters.value("bridge_gap", options.bridge_gap);
  return options;
}

Path path_of(const nlohmann::json& given) { return given.get<Path>(); }
std::vector<Path> paths_of(const nlohmann::json& given) { return given.get<std::vector<Path>>(); }
std::vector<std::uint32_t> ids_of(const nlohmann::json& given) {
  return given.get<std::vector<std::uint32_t>>();
}

std::string interval_in_words(const CurvatureInterval& interval) {
  if (!std::isfinite(interval.max)) return "above " + number_text(interval.min, 3);
  return number_text(interval.min, 3) + " to " + number_text(interval.max, 3);
}

std::string targets_in_words(const nlohmann::json& parameters, const std::string& one,
                             const std::string& many) {
  if (const auto id = parameters.find(one); id != parameters.end() && id->is_number_unsigned())
    return named({id->get<std::uint32_t>()}, one, many);
  const auto ids = parameters.find(many);
  if (ids == parameters.end() || !ids->is_array() || ids->empty() ||
      !std::all_of(ids->begin(), ids->end(),
                   [](const auto& id) { return id.is_number_unsigned(); }))
    return many;
  return named(ids_of(*ids), one, many);
}

BrushedRegion region_of(const nlohmann::json& given) {
  return {given.at("vertices").get<Path>(), given.at("radius")};
}
CurvatureInterval interval_of(const nlohmann::json& given) {
  const nlohmann::json& max = given.at(1);
  return {given.at(0), max.is_null() ? std::numeric_limits<double>::infinity() : max.get<double>()};
}

Result<LinePtr> find_line(const Ground& ground, std::uint32_t id, const Path& anchor, Round round,
                          TreatmentOutcome& outcome) {
  const auto by_id = [&](std::uint32_t wanted) {
    return *std::find_if(ground.lines.lines.begin(), ground.lines.lines.end(),
                         [&](const LinePtr& line) { return line->id == wanted; });
  };
  if (round == Round::first) return by_id(id);
  std::vector<std::uint32_t> ids =
      lines_through(ground.mesh, ground.lines, edges_on(ground.mesh, anchor));
  if (ids.empty()) {
    // The mesh may be another one: any line through vertices of the anchor.
    std::vector<EdgeId> edges;
    for (const VertexId v : anchor)
      if (v < ground.mesh.vertex_count())
        for (const HalfEdgeId h : sharp_edges_at(ground.mesh, ground.lines, v))
          edges.push_back(h >> 1);
    ids = lines_through(ground.mesh, ground.lines, edges);
  }
  if (ids.empty()) return fail("The line it was made on is not found with these thresholds.");
  LinePtr line = by_id(ids.front());
  if (line->vertices != anchor)
    outcome.adapted = "The line it was made on runs a little differently now.";
  return line;
}

Result<PartitionPtr> find_partition(const Ground& ground, std::uint32_t id, const Triangle& anchor,
                                    Round round, TreatmentOutcome& outcome) {
  std::uint32_t label = id;
  if (round != Round::first) {
    label = 0;
    if (const auto f = ground.mesh.find_face(anchor)) {
      label = ground.partitions.label(*f);
    } else {
      for (const VertexId v : anchor)
        if (v < ground.mesh.vertex_count())
          ground.mesh.for_ring(v, [&](HalfEdgeId h) {
            if (label == 0 && ground.mesh.face(h) != no_id)
              label = ground.partitions.label(ground.mesh.face(h));
          });
      if (label != 0) outcome.adapted = "The mesh has changed since; found by a vertex.";
    }
    if (label == 0)
      return fail("Where partition " + std::to_string(id) + " was, no face is assigned now.");
  }
  for (const PartitionPtr& partition : ground.partitions.partitions)
    if (partition->id == label) return partition;
  return fail("There is no partition " + std::to_string(id) + ".");
}

void remove_paths(Ground& ground, const std::vector<Path>& paths, const nlohmann::json& spared,
                  Round round) {
  std::unordered_set<EdgeId> kept;
  for (const auto& pair : spared)
    if (const auto e = ground.mesh.find_edge(pair[0], pair[1])) kept.insert(*e);
  LineChanges changes;
  for (const Path& path : paths) {
    const LineChanges own = remove_path(ground.mesh, ground.lines, path);
    changes.edges.insert(changes.edges.end(), own.edges.begin(), own.edges.end());
    if (round == Round::first) continue;
    for (const EdgeId e : found_near(ground.mesh, ground.lines, path))
      if (!kept.contains(e)) changes.edges.emplace_back(e, Origin::none);
  }
  if (round != Round::first) {  // approved since
    std::vector<EdgeId> meant;
    for (const auto& [e, origin] : changes.edges) meant.push_back(e);
    std::unordered_set<EdgeId> locked;
    for (const std::uint32_t id : lines_through(ground.mesh, ground.lines, meant))
      if (const Line& line = *ground.lines.find(id); line.locked)
        for (const EdgeId e : edges_on(ground.mesh, line.vertices)) locked.insert(e);
    std::erase_if(changes.edges, [&](const auto& change) { return locked.contains(change.first); });
  }
  std::sort(changes.edges.begin(), changes.edges.end());
  changes.edges.erase(std::unique(changes.edges.begin(), changes.edges.end()), changes.edges.end());
  ground.change(changes);
}

Parameter spared_parameter() {
  return {.name = "spared",
          .help = "Edges near by that stay when it is done again.",
          .derived = true,
          .form = "a list of edges [a, b]"};
}

void complete_spared(ParameterReader& reader, const std::vector<Path>& paths) {
  const nlohmann::json& given = reader.given("spared");
  const bool good =
      given.is_array() && std::all_of(given.begin(), given.end(), [](const auto& pair) {
        return pair.is_array() && pair.size() == 2 &&
               std::all_of(pair.begin(), pair.end(), [](const auto& v) {
                 return v.is_number_unsigned() && v.template get<std::uint64_t>() < no_id;
               });
      });
  if (!given.is_null() && !good) reader.fault("spared", form_of(spared_parameter()));
  reader.set("spared", given.is_null() ? spared_near(reader.document(), paths) : given);
}

nlohmann::json spared_near(const Document& document, const std::vector<Path>& paths) {
  std::vector<EdgeId> own, near;
  for (const Path& path : paths) {
    for (const EdgeId e : edges_on(*document.mesh, path)) own.push_back(e);
    for (const EdgeId e : found_near(*document.mesh, document.lines, path)) near.push_back(e);
  }
  std::sort(own.begin(), own.end());
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  nlohmann::json spared = nlohmann::json::array();
  for (const EdgeId e : near)
    if (!std::binary_search(own.begin(), own.end(), e)) spared.push_back(document.mesh->edge(e));
  return spared;
}

}  // namespace arris
