// The interactive treatments of partitions and boundaries (section 7.2).

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/treatments/partition_targets.h"
#include "core/partitions/four_sided_cuts.h"

namespace arris {

namespace {

using nlohmann::json;

std::string words_of_connect(const json& parameters) { return of_partition("Connect", parameters); }
std::string words_of_restart(const json& parameters) {
  return of_partition("Restart", parameters) + interval_after_comma(parameters);
}
std::string words_of_partition_recompute(const json& parameters) {
  return "Find partitions again in a region" + interval_after_comma(parameters);
}
std::string words_of_partition_split(const json& parameters) {
  return of_partition("Split", parameters);
}
std::string words_of_four_sides(const json& parameters) {
  return of_partition("Cut", parameters) + " into four sides";
}
std::string words_of_smooth(const json& parameters) {
  return of_partition("Smooth the boundaries of", parameters);
}

/// New partitions from the areas that pass the interval among `faces`.
void find_again(Ground& ground, const std::vector<FaceId>& faces, const CurvatureInterval& interval,
                std::uint32_t min_faces) {
  FaceLabels labels;
  std::vector<Partition> fresh;
  for (const std::vector<FaceId>& area :
       find_areas(ground.partition_ground(), faces, interval, min_faces)) {
    fresh.push_back(ground.new_partition(interval));
    for (const FaceId f : area) labels.emplace_back(f, fresh.back().id);
  }
  ground.change(labels, fresh);
}

void complete_connect(ParameterReader& reader) {
  const Document& document = reader.document();
  const std::vector<std::uint32_t> ids = ids_of(reader.resolved("partitions"));
  const auto meant = [&](std::uint32_t id) {
    return std::binary_search(ids.begin(), ids.end(), id);
  };
  std::vector<Path> paths;
  if (reader.resolved("lines") == "remove")
    for (const BoundaryPtr& boundary : *document.boundaries)
      if (boundary->type == BoundaryType::c0 && boundary->left != boundary->right &&
          meant(boundary->left) && meant(boundary->right)) {
        if (document.lines.find(boundary->line)->locked)
          reader.fault("lines", "\"keep\": line " + std::to_string(boundary->line) + " is locked");
        paths.push_back(boundary->vertices);
      }
  const json& removed = reader.given("removed");
  if (!removed.is_null() && removed != json(paths))
    reader.fault("removed", "the paths of the sharp lines between the partitions");
  reader.set("removed", paths);
  complete_spared(reader, paths);
}

Result<TreatmentOutcome> connect(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  const bool removes = parameters.at("lines") == "remove";
  if (round == Round::after_lines) {
    remove_paths(ground, paths_of(parameters.at("removed")), parameters.at("spared"), round);
    return outcome;
  }
  const std::vector<PartitionPtr> partitions = find_all(ground, parameters, round, outcome);
  if (partitions.size() < 2)
    return round == Round::first || !outcome.adapted.empty()
               ? Result<TreatmentOutcome>(
                     fail("Two partitions are needed to connect them. " + outcome.adapted))
               : Result<TreatmentOutcome>(TreatmentOutcome{"They are one partition already."});
  // Which of them have a boundary in common.
  std::vector<std::size_t> group(partitions.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto place = [&](std::uint32_t id) {
    const auto it = std::find_if(partitions.begin(), partitions.end(),
                                 [&](const PartitionPtr& p) { return p->id == id; });
    return static_cast<std::size_t>(it - partitions.begin());
  };
  for (const BoundaryPtr& boundary : ground.boundaries) {
    const std::size_t a = place(boundary->left), b = place(boundary->right);
    if (a == partitions.size() || b == partitions.size() || group[a] == group[b]) continue;
    const std::size_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
    std::replace(group.begin(), group.end(), from, to);
  }
  for (std::size_t k = 1; k < group.size(); ++k)
    if (group[k] != group[0])
      return fail("Partitions " + std::to_string(partitions[0]->id) + " and " +
                  std::to_string(partitions[k]->id) +
                  " have no common boundary, so they cannot be connected.");
  const PartitionPtr largest = *std::max_element(
      partitions.begin(), partitions.end(), [](const PartitionPtr& a, const PartitionPtr& b) {
        return a->area != b->area ? a->area < b->area : a->id > b->id;
      });
  FaceLabels labels;
  for (const PartitionPtr& partition : partitions)
    if (partition != largest)
      for (const FaceId f : faces_of(ground.mesh, ground.partitions, *partition))
        labels.emplace_back(f, largest->id);
  ground.change(labels);
  if (removes && round == Round::first)
    remove_paths(ground, paths_of(parameters.at("removed")), parameters.at("spared"), round);
  return outcome;
}

bool connect_belongs(const json& parameters, Round round) {
  return round == Round::after_partitions ||
         (round == Round::after_lines && parameters.at("lines") == "remove");
}

Result<TreatmentOutcome> restart(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  const std::vector<PartitionPtr> partitions = find_all(ground, parameters, round, outcome);
  if (partitions.empty()) return fail(outcome.adapted);
  std::vector<FaceId> faces;
  for (const PartitionPtr& partition : partitions) {
    const std::vector<FaceId> own = faces_of(ground.mesh, ground.partitions, *partition);
    faces.insert(faces.end(), own.begin(), own.end());
  }
  std::sort(faces.begin(), faces.end());
  const std::vector<FaceId> area = with_unassigned_round(ground.partition_ground(), faces);
  ground.change(labelled(faces, 0));
  find_again(ground, area, interval_of(parameters.at("interval")), parameters.at("min_faces"));
  return outcome;
}

/// Faces of a region but for those of locked partitions.
std::vector<FaceId> open_faces(const Ground& ground, const BrushedRegion& region,
                               const SharpLines* stop_at) {
  std::vector<FaceId> faces = faces_touched(ground.mesh, region, stop_at);
  std::unordered_map<std::uint32_t, bool> locked;
  std::erase_if(faces, [&](FaceId f) {
    const std::uint32_t label = ground.partitions.label(f);
    if (label == 0) return false;
    const auto it = locked.find(label);
    if (it != locked.end()) return it->second;
    const bool is_locked = ground.partitions.find(label)->locked;
    locked[label] = is_locked;
    return is_locked;
  });
  return faces;
}

Result<TreatmentOutcome> recompute_partition(Ground& ground, const json& parameters, Round) {
  const std::vector<FaceId> faces = open_faces(ground, region_of(parameters.at("region")), nullptr);
  if (faces.empty())
    return fail("There is no face in the region that is not locked: brush a wider one.");
  ground.change(labelled(faces, 0));
  find_again(ground, faces, interval_of(parameters.at("interval")), parameters.at("min_faces"));
  return TreatmentOutcome{};
}

Result<TreatmentOutcome> split_partition(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  const Result<PartitionPtr> partition = find_one(ground, parameters, round, outcome);
  if (!partition) return tl::unexpected<Error>(partition.error());
  const auto is_inside = [&](EdgeId e) {
    const auto faces = ground.mesh.edge_faces(e);
    return std::all_of(faces.begin(), faces.end(), [&](FaceId f) {
      return f != no_id && ground.partitions.label(f) == (*partition)->id;
    });
  };
  const Path points = path_of(parameters.at("vertices"));
  const auto is_beside = [&](VertexId v) {
    bool beside = v >= ground.mesh.vertex_count();
    if (!beside)
      ground.mesh.for_ring(v, [&](HalfEdgeId h) {
        const FaceId f = ground.mesh.face(h);
        beside = beside || (f != no_id && ground.partitions.label(f) == (*partition)->id);
      });
    return beside;
  };
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!is_beside(points[k]))
      return fail((points.size() == 2 ? std::string(k == 0 ? "The first" : "The second")
                                      : "Point " + std::to_string(k + 1)) +
                  (points.size() == 2 ? " point" : "") +
                  " is on another partition. Click from one boundary of partition " +
                  std::to_string((*partition)->id) + " to another.");
  const Result<Path> path =
      path_through(ground.mesh, ground.measures(), points, parameters.at("angle"), is_inside);
  if (!path) return tl::unexpected<Error>(path.error());
  const Result<std::vector<FaceId>> part = cut_off(ground.partition_ground(), **partition, *path);
  if (!part) return tl::unexpected<Error>(part.error());
  const Partition fresh = ground.new_partition((*partition)->interval);
  ground.change(labelled(*part, fresh.id), {fresh});
  return outcome;
}

/// Whether there may be a cut for it at all.
bool wants_cuts(const Partition& partition, const Outline& outline) {
  return !partition.locked && !outline.loops.empty() && outline.handles == 0 &&
         !outline.is_four_sided();
}

/// All that have more sides, or holes, where none are named.
Result<json> understood_four_sides(const Document& document, json given) {
  if (given.contains("partitions")) return given;
  std::vector<std::uint32_t> ids;
  const std::vector<Outline> outlines =
      outlines_of(*document.mesh, document.lines, document.partitions);
  for (std::size_t k = 0; k < outlines.size(); ++k)
    if (const Partition& partition = *document.partitions.partitions[k];
        wants_cuts(partition, outlines[k]))
      ids.push_back(partition.id);
  if (ids.empty())
    return nothing_to_do(
        "Every partition that is not locked has at most four sides: nothing to cut.");
  given["partitions"] = ids;
  if (!given.contains("neighbours")) given["neighbours"] = true;
  return given;
}

/// What cutting one partition made of it.
struct CutPartition {
  std::vector<std::uint32_t> pieces;
  std::string obstacle;        ///< Why one of them keeps more than four sides; empty: none does.
  std::vector<VertexId> ends;  ///< Of the cuts.
};

Result<CutPartition> cut_to_four_sides(Ground& ground, std::uint32_t id) {
  CutPartition result;
  result.pieces.push_back(id);
  const std::uint32_t first_new = ground.next_id;
  const Result<FourSidedPlan> plan =
      four_sided_cuts(ground.mesh, ground.curvatures, ground.lines, ground.partitions,
                      *ground.partitions.find(id), {}, ground.context);
  if (!plan) return tl::unexpected<Error>(plan.error());
  result.obstacle = plan->obstacle;
  for (const FourSidedCut& cut : plan->cuts) {
    const Partition& piece =
        *ground.partitions.find(partition_along(ground.mesh, ground.partitions, cut.path));
    const Result<std::vector<FaceId>> part = cut_off(ground.partition_ground(), piece, cut.path);
    const Partition fresh = ground.new_partition(piece.interval);
    ground.change(labelled(*part, fresh.id), {fresh});
    for (const Path& stroke : cut.strokes)
      result.ends.insert(result.ends.end(), {stroke.front(), stroke.back()});
  }
  for (std::uint32_t piece = first_new; piece < ground.next_id; ++piece)
    result.pieces.push_back(piece);
  return result;
}

/// Partitions at these vertices that may be cut to four sides, too.
std::set<std::uint32_t> to_cut_at(const Ground& ground, const std::vector<VertexId>& vertices) {
  std::set<std::uint32_t> ids;
  for (const VertexId v : vertices)
    ground.mesh.for_ring(v, [&](HalfEdgeId h) {
      if (ground.mesh.face(h) != no_id) ids.insert(ground.partitions.label(ground.mesh.face(h)));
    });
  ids.erase(0);
  std::erase_if(ids, [&](std::uint32_t id) {
    const Partition& partition = *ground.partitions.find(id);
    return !wants_cuts(partition,
                       outline_of(ground.mesh, ground.lines, ground.partitions, partition));
  });
  return ids;
}

Result<TreatmentOutcome> split_to_four_sides(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  std::set<std::uint32_t> ids;
  const std::vector<PartitionPtr> partitions = find_all(ground, parameters, round, outcome);
  for (const PartitionPtr& partition : partitions)
    if (partition->locked)
      outcome.adapted =
          "Partition " + std::to_string(partition->id) + " is locked; it is left as it is.";
    else
      ids.insert(partition->id);
  if (partitions.empty()) return fail(outcome.adapted);
  // A cut may end in a side of another piece or partition, which thereby gets a corner more.
  constexpr int rounds = 4;
  std::map<std::uint32_t, std::string> why;  // of pieces of partitions that do not come out whole
  std::set<std::uint32_t> all = ids, settled;
  bool any = false;
  std::size_t done = 0;
  for (int k = 0; k < rounds && !ids.empty(); ++k) {
    std::vector<VertexId> ends;
    for (const std::uint32_t id : ids) {
      if (k == 0)
        ground.context.report(static_cast<double>(done++) / static_cast<double>(ids.size()),
                              "four sides");
      const Result<CutPartition> cut = cut_to_four_sides(ground, id);
      if (!cut) return tl::unexpected<Error>(cut.error());
      all.insert(cut->pieces.begin(), cut->pieces.end());
      ends.insert(ends.end(), cut->ends.begin(), cut->ends.end());
      if (cut->ends.empty()) settled.insert(id);
      for (const std::uint32_t piece : cut->pieces) why[piece] = cut->obstacle;
    }
    any = any || !ends.empty();
    ids = to_cut_at(ground, ends);
    std::erase_if(ids, [&](std::uint32_t id) {
      return settled.contains(id) || !(parameters.at("neighbours") || all.contains(id));
    });
  }
  std::string kept;
  std::size_t more = 0;
  for (const std::uint32_t id : all) {
    const Outline outline =
        outline_of(ground.mesh, ground.lines, ground.partitions, *ground.partitions.find(id));
    if (outline.is_four_sided()) continue;
    if (!kept.empty()) {
      ++more;
      continue;
    }
    kept = "Partition " + std::to_string(id) + " is left with " + outline.text();
    if (const std::string& obstacle = why[id]; !obstacle.empty()) kept += ": " + obstacle;
    kept += ".";
  }
  if (more > 0) kept += " " + std::to_string(more) + " more are like it.";
  if (!any && !kept.empty()) return fail(kept);
  if (!any && round == Round::first)
    return nothing_to_do(
        all.size() == 1
            ? "Partition " + std::to_string(*all.begin()) +
                  " has at most four sides already: nothing to cut."
            : std::string("These partitions have at most four sides already: nothing to "
                          "cut."));
  if (!any && outcome.adapted.empty())
    outcome.adapted = "What is found there now has at most four sides already.";
  if (!kept.empty()) outcome.adapted = kept;
  return outcome;
}

Result<TreatmentOutcome> paint(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  std::uint32_t label = 0;
  if (parameters.at("partition") != 0u) {
    const Result<PartitionPtr> partition = find_one(ground, parameters, round, outcome);
    if (!partition) return tl::unexpected<Error>(partition.error());
    label = (*partition)->id;
  }
  std::vector<FaceId> faces = open_faces(ground, region_of(parameters.at("region")), &ground.lines);
  if (label != 0) faces = joined_to(ground.partition_ground(), faces, label);
  std::erase_if(faces, [&](FaceId f) { return ground.partitions.label(f) == label; });
  if (faces.empty() && round == Round::first)
    return nothing_to_do(label == 0 ? "Every face under the brush is unassigned or locked already."
                                    : "The brush touches no face beside partition " +
                                          std::to_string(label) + " that could join it.");
  ground.change(labelled(faces, label));
  return outcome;
}

std::string words_of_paint(const json& parameters) {
  if (!parameters.contains("partition")) return "Paint partitions";
  return parameters.at("partition") == 0u ? std::string("Paint out of partitions")
                                          : of_partition("Paint into", parameters);
}

Result<TreatmentOutcome> smooth(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  std::unordered_set<std::uint32_t> ids;
  for (const PartitionPtr& partition : find_all(ground, parameters, round, outcome))
    ids.insert(partition->id);
  if (ids.empty() && !parameters.at("partitions").empty()) return fail(outcome.adapted);
  ground.change(smooth_boundaries(ground.partition_ground(), ground.boundaries, ids,
                                  parameters.at("rounds")));
  return outcome;
}

Parameter region_parameter() {
  return {.name = "region", .kind = ParameterKind::region, .help = "What was brushed."};
}

}  // namespace

std::vector<OperationKind> partition_treatment_rows() {
  Parameter several = partitions_parameter();
  several.count = 2;
  Parameter into = partition_parameter();
  into.help = "The partition that they join; 0: they are in none any more.";
  into.or_none = true;
  return {
      {.name = "connect_partitions",
       .title = "Connect partitions",
       .help = "Makes one of adjacent partitions.",
       .parameters = {several,
                      {.name = "lines",
                       .kind = ParameterKind::choice,
                       .label = "Lines",
                       .help = "What becomes of the sharp lines between the partitions",
                       .choices = {{"keep", "Sharp line between them stays"},
                                   {"remove", "Sharp line between them goes"}},
                       .otherwise = "keep"},
                      {.name = "removed",
                       .help = "The paths of the lines that go.",
                       .derived = true,
                       .form = "the paths of the sharp lines between the partitions"},
                      spared_parameter()},
       .words = words_of_connect,
       .ready = needs_partitions,
       .complete = complete_connect,
       .treat = connect,
       .belongs = connect_belongs},
      {.name = "restart_partitions",
       .title = "Restart partitions",
       .help = "Finds partitions, and what is unassigned round them, under another interval.",
       .parameters = {partitions_parameter(), interval_parameter(), min_faces_parameter()},
       .words = words_of_restart,
       .ready = needs_partitions,
       .treat = restart,
       .belongs = after_partitions},
      {.name = "recompute_partitions",
       .title = "Recompute partitions",
       .help = "Finds partitions again in a region, under an interval of their own.",
       .parameters = {region_parameter(), interval_parameter(), min_faces_parameter()},
       .words = words_of_partition_recompute,
       .treat = recompute_partition,
       .belongs = after_partitions},
      {.name = "split_partition",
       .title = "Split partition",
       .help = "Parts a partition along a path through vertices.",
       .parameters = {partition_parameter(),
                      {.name = "vertices",
                       .kind = ParameterKind::path,
                       .help = "From one boundary of the partition to another.",
                       .count = 2},
                      {.name = "angle",
                       .kind = ParameterKind::real,
                       .help = "What counts as sharp for the way between points.",
                       .unit = "°",
                       .least = 0.1,
                       .most = 179.9,
                       .otherwise = SharpLineOptions().angle}},
       .words = words_of_partition_split,
       .treat = split_partition,
       .belongs = after_partitions},
      {.name = "split_to_four_sides",
       .title = "Split to four sides",
       .help = "Cuts partitions so that none has more than four sides or a hole; all that have "
               "where none are named.",
       .parameters = {partitions_parameter(),
                      {.name = "neighbours",
                       .kind = ParameterKind::flag,
                       .help = "Partitions that get a fifth side by the cuts beside them are cut, "
                               "too; true where none are named.",
                       .otherwise = false}},
       .words = words_of_four_sides,
       .ready = needs_partitions,
       .understood = understood_four_sides,
       .treat = split_to_four_sides,
       .belongs = after_partitions},
      {.name = "paint_partition",
       .title = "Paint partition",
       .help = "Brushed faces join a partition, or leave theirs; the brush stops at sharp lines.",
       .parameters = {into, region_parameter()},
       .words = words_of_paint,
       .ready = needs_partitions,
       .treat = paint,
       .belongs = after_partitions},
      {.name = "smooth_boundaries",
       .title = "Smooth boundaries",
       .help = "Takes the teeth off the boundaries of partitions, or of all.",
       .parameters = {{.name = "partitions",
                       .kind = ParameterKind::partitions,
                       .help = "The partitions that are meant; none: all.",
                       .count = 0,
                       .otherwise = Default::empty_list(),
                       .may_be_locked = true,
                       .anchors = "anchors"},
                      {.name = "rounds",
                       .kind = ParameterKind::whole,
                       .help = "How often each border is gone over.",
                       .least = 1,
                       .most = 1000,
                       .otherwise = 10}},
       .words = words_of_smooth,
       .ready = needs_partitions,
       .treat = smooth,
       .belongs = after_partitions}};
}

}  // namespace arris
