// What partitions gain and lose: they are extended into what is unassigned, removed, and what is in
// none of them is given to the ones beside it (section 7.2).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/words.h"
#include "core/document/operations/operations.h"
#include "core/document/treatments/partition_targets.h"
#include "core/mesh/geometry.h"
#include "core/partitions/fill_areas.h"

namespace arris {

namespace {

using nlohmann::json;

/// Beyond this many times the area that a correction was made for it has flooded: under other
/// thresholds, what once stopped it is gone.
constexpr double far_larger = 2.0;

/// Extends one partition after the other; areas gained, in their order.
Result<std::vector<double>> extend_all(Ground& ground, const std::vector<PartitionPtr>& partitions,
                                       const CurvatureInterval& interval) {
  std::vector<double> gained;
  bool any = false;
  std::string why;
  for (const PartitionPtr& partition : partitions) {
    const Result<std::vector<FaceId>> faces =
        extend_partition(ground.partition_ground(), *ground.partitions.find(partition->id),
                         ground.boundaries, interval);
    gained.push_back(0.0);
    if (!faces) {
      why = faces.error().message;
      continue;
    }
    any = true;
    for (const FaceId f : *faces) gained.back() += face_area(ground.mesh, f);
    ground.change(labelled(*faces, partition->id));
  }
  if (!any) return fail(why);
  return gained;
}

/// "partition" and "anchor" as lists of one: a single one may be named, too.
json with_lists(json parameters) {
  for (const auto& [one, many] : {std::pair{"partition", "partitions"}, {"anchor", "anchors"}})
    if (const auto single = parameters.find(one); single != parameters.end()) {
      const json list = json::array({*single});
      parameters.erase(one);
      parameters[many] = list;
    }
  return parameters;
}

Result<json> understood_extend(const Document&, json given) { return with_lists(std::move(given)); }

/// From the smallest to the largest end of theirs.
json interval_of_partitions(const DefaultFrom& from) {
  const Partitions& partitions = from.document.partitions;
  const std::vector<std::uint32_t> ids = ids_of(from.resolved.at("partitions"));
  CurvatureInterval own = partitions.find(ids[0])->interval;
  for (const std::uint32_t id : ids) {
    const CurvatureInterval& interval = partitions.find(id)->interval;
    own = {std::min(own.min, interval.min), std::max(own.max, interval.max)};
  }
  return {own.min, std::isfinite(own.max) ? json(own.max) : json()};
}

Parameter areas_parameter(std::string_view help) {
  return {.name = "areas", .help = help, .derived = true, .form = "an area for each partition"};
}

/// Those given, or `own` where none are.
void complete_areas(ParameterReader& reader, const json& own) {
  const json& areas = reader.given("areas");
  const bool good =
      areas.is_array() && areas.size() == reader.resolved("partitions").size() &&
      std::all_of(areas.begin(), areas.end(), [](const json& a) { return a.is_number(); });
  if (!areas.is_null() && !good) reader.fault("areas", form_of(areas_parameter("")));
  reader.set("areas", areas.is_null() ? own : areas);
}

/// As a journal can hold them: areas of a part of absurd size are infinite, or no numbers.
json listed(std::vector<double> areas) {
  constexpr double largest = std::numeric_limits<double>::max();
  for (double& area : areas)
    if (!(area < largest)) area = largest;
  return areas;
}

void complete_extend(ParameterReader& reader) {
  json own;
  if (reader.given("areas").is_null()) {
    Ground ground = ground_of(reader.document());
    const std::vector<std::uint32_t> ids = ids_of(reader.resolved("partitions"));
    std::vector<PartitionPtr> partitions;
    for (const PartitionPtr& partition : reader.document().partitions.partitions)
      if (std::binary_search(ids.begin(), ids.end(), partition->id))
        partitions.push_back(partition);
    if (const auto gained =
            extend_all(ground, partitions, interval_of(reader.resolved("interval"))))
      own = listed(*gained);
  }
  complete_areas(reader, own);
}

Result<TreatmentOutcome> extend_partition(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  const std::vector<PartitionPtr> partitions = find_all(ground, parameters, round, outcome);
  if (partitions.empty()) return fail(outcome.adapted);
  Ground tried = ground;
  const Result<std::vector<double>> gained =
      extend_all(tried, partitions, interval_of(parameters.at("interval")));
  if (!gained) return tl::unexpected<Error>(gained.error());
  const json& areas = parameters.at("areas");
  if (round != Round::first && areas.is_array()) {
    const double meant =
        std::accumulate(areas.begin(), areas.end(), 0.0,
                        [](double sum, const json& a) { return sum + a.get<double>(); });
    const double now = std::accumulate(gained->begin(), gained->end(), 0.0);
    const double least = 3.0 * ground.mesh.mean_edge_length() * ground.mesh.mean_edge_length();
    if (now > far_larger * std::max(meant, least))
      return fail("With these thresholds it would run over " +
                  (meant > 0.0 ? measure_text(now / meant) + " times the area that it was made for"
                               : "an area, where it was made for none") +
                  "; it is left out.");
  }
  ground.change_to(std::move(tried));
  return outcome;
}

/// Version 1 extended a single partition.
json upgrade_extend(int, json parameters) { return with_lists(std::move(parameters)); }

std::string words_of_partition_extend(const json& parameters) {
  return of_partition("Extend", parameters) + interval_after_comma(parameters);
}

void complete_remove(ParameterReader& reader) {
  std::vector<double> own;
  for (const std::uint32_t id : ids_of(reader.resolved("partitions")))
    own.push_back(reader.document().partitions.find(id)->area);
  complete_areas(reader, listed(std::move(own)));
}

Result<TreatmentOutcome> remove(Ground& ground, const json& parameters, Round round) {
  TreatmentOutcome outcome;
  const std::vector<std::uint32_t> ids = ids_of(parameters.at("partitions"));
  FaceLabels labels;
  std::size_t found = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const Result<PartitionPtr> partition =
        find_partition(ground, ids[k], parameters.at("anchors")[k].get<Triangle>(), round, outcome);
    if (!partition) {
      outcome.adapted = partition.error().message;
      continue;
    }
    // Under other thresholds it may have run together with what was never meant.
    if (round != Round::first &&
        (*partition)->area > far_larger * parameters.at("areas")[k].get<double>()) {
      outcome.adapted = "Where partition " + std::to_string(ids[k]) +
                        " was, there is one more than twice as large; it is left as it is.";
      continue;
    }
    ++found;
    const FaceLabels own = labelled(faces_of(ground.mesh, ground.partitions, **partition), 0);
    labels.insert(labels.end(), own.begin(), own.end());
  }
  if (found == 0) return fail(outcome.adapted);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  ground.change(labels);
  return outcome;
}

std::string words_of_remove(const json& parameters) { return of_partition("Remove", parameters); }

/// Gives the areas that the unassigned among `faces` (ascending) form, up to `most` faces each, to
/// the partitions they belong to.
Result<TreatmentOutcome> fill(Ground& ground, const std::vector<FaceId>& faces, std::size_t most) {
  const FilledAreas filled = fill_areas(ground.partition_ground(), faces, most);
  ground.change(filled.labels);
  if (filled.enclosed == 0) return TreatmentOutcome{};
  return TreatmentOutcome{counted(filled.enclosed, "area has", "areas have") +
                          " no partition beside it but over sharp lines, and stays in none."};
}

std::vector<FaceId> unassigned_faces(const Mesh& mesh, const Partitions& partitions) {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (partitions.label(f) == 0) faces.push_back(f);
  return faces;
}

Result<TreatmentOutcome> fill_unassigned(Ground& ground, const json& parameters, Round round) {
  const std::vector<FaceId> faces = unassigned_faces(ground.mesh, ground.partitions);
  if (faces.empty() && round == Round::first)
    return nothing_to_do("Every face is in a partition already.");
  return fill(ground, faces, parameters.at("faces"));
}

std::string words_of_fill(const json& parameters) {
  std::string what = "Give unassigned areas to their neighbours";
  if (!parameters.contains("faces") || parameters["faces"].get<std::int64_t>() >= most_faces)
    return what;
  return what + ", up to " + parameters["faces"].dump() + " faces";
}

Result<TreatmentOutcome> remove_small(Ground& ground, const json& parameters, Round round) {
  const std::uint32_t least = parameters.at("faces");
  FaceLabels labels;
  for (const PartitionPtr& partition : ground.partitions.partitions)
    if (partition->faces < least && !partition->locked)
      for (const FaceId f : faces_of(ground.mesh, ground.partitions, *partition))
        labels.emplace_back(f, 0u);
  if (labels.empty() && round == Round::first) {
    std::uint32_t smallest = most_faces;
    for (const PartitionPtr& partition : ground.partitions.partitions)
      if (!partition->locked) smallest = std::min(smallest, partition->faces);
    return nothing_to_do(
        "No partition that is not locked has fewer than " + std::to_string(least) + " faces" +
        (smallest < most_faces ? "; the smallest has " + std::to_string(smallest) + "."
                               : std::string(".")));
  }
  ground.change(labels);
  if (!parameters.at("fill")) return TreatmentOutcome{};
  std::vector<FaceId> freed;
  for (const auto& [f, label] : labels) freed.push_back(f);
  std::sort(freed.begin(), freed.end());
  return fill(ground, freed, std::numeric_limits<std::size_t>::max());
}

/// Versions up to 1 left holes.
json upgrade_remove_small(int, json parameters) {
  parameters["fill"] = false;
  return parameters;
}

std::string words_of_remove_small(const json& parameters) {
  if (!parameters.contains("faces")) return "Remove small partitions";
  const std::string under = "partitions under " + parameters.at("faces").dump() + " faces";
  return parameters.value("fill", false) ? "Give " + under + " to their neighbours"
                                         : "Remove " + under;
}

}  // namespace

std::vector<OperationKind> area_treatment_rows() {
  Parameter interval = interval_parameter();
  interval.otherwise = {"the intervals of the partitions", interval_of_partitions};
  constexpr std::string_view leaves = "Larger areas stay in no partition.";
  return {
      {.name = "extend_partition",
       .title = "Extend partitions",
       .help = "Partitions grow over their undefined boundaries under an interval of their own.",
       .version = 2,
       .parameters = {partitions_parameter(), interval,
                      areas_parameter("What each gained: done again, it may not flood.")},
       .words = words_of_partition_extend,
       .ready = needs_partitions,
       .understood = understood_extend,
       .complete = complete_extend,
       .upgrade = upgrade_extend,
       .treat = extend_partition,
       .belongs = after_partitions},
      {.name = "remove_partitions",
       .title = "Remove partitions",
       .help = "Their faces are in no partition any more.",
       .parameters = {partitions_parameter(),
                      areas_parameter("What each had: one far larger is not the one meant.")},
       .words = words_of_remove,
       .complete = complete_remove,
       .treat = remove,
       .belongs = after_partitions},
      {.name = "remove_small_partitions",
       .title = "Remove small partitions",
       .help = "Partitions under a number of faces go to their neighbours, or are removed.",
       .version = 2,
       .parameters = {{.name = "faces",
                       .kind = ParameterKind::whole,
                       .label = "Faces",
                       .help = "Partitions with fewer faces go.",
                       .unit = "faces",
                       .least = 1,
                       .most = most_faces,
                       .from = 2.0,
                       .to = 10000.0,
                       .logarithmic = true},
                      {.name = "fill",
                       .kind = ParameterKind::flag,
                       .help = "What becomes of the faces they had: their neighbours take them.",
                       .otherwise = false}},
       .words = words_of_remove_small,
       .ready = needs_partitions,
       .upgrade = upgrade_remove_small,
       .treat = remove_small,
       .belongs = after_partitions},
      {.name = "fill_unassigned",
       .title = "Fill unassigned areas",
       .help = "Areas in no partition go to the neighbours they belong to: by curvature, then by "
               "the longest border.",
       .parameters = {{.name = "faces",
                       .kind = ParameterKind::whole,
                       .label = "Faces",
                       .help = leaves,
                       .unit = "faces",
                       .least = 1,
                       .most = most_faces,
                       .otherwise = static_cast<int>(most_faces),
                       .logarithmic = true}},
       .words = words_of_fill,
       .ready = needs_partitions,
       .treat = fill_unassigned,
       .belongs = after_partitions}};
}

}  // namespace arris
