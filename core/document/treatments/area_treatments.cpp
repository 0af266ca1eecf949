// What partitions gain and lose: they are extended into what is unassigned, removed, and what is in
// none of them is given to the ones beside it (section 7.2).

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/words.h"
#include "core/document/treatments/partition_targets.h"
#include "core/document/treatments/treatments.h"
#include "core/mesh/geometry.h"
#include "core/partitions/fill_areas.h"

namespace arris {

namespace {

using nlohmann::json;

// extend_partition: {partitions: [ids], interval: [min, max], areas: mm² that each gained}

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

/// "partition" and "anchor" as lists of one.
json with_lists(json parameters) {
  for (const auto& [one, many] : {std::pair{"partition", "partitions"}, {"anchor", "anchors"}})
    if (const auto single = parameters.find(one); single != parameters.end()) {
      const json list = json::array({*single});
      parameters.erase(one);
      parameters[many] = list;
    }
  return parameters;
}

Result<json> resolve_extend(const Document& document, const json& given) {
  const json complete = with_lists(given);  // a single one may be named, too
  ParameterReader reader("extend_partition", complete);
  if (const auto found = needs_partitions(document); !found)
    return tl::unexpected<Error>(found.error());
  read_partitions(reader, document, "partitions", "anchors", false);
  const json areas = reader.raw("areas");
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  const std::vector<std::uint32_t> ids = ids_of(reader.resolved("partitions"));
  CurvatureInterval own = document.partitions.find(ids[0])->interval;
  for (const std::uint32_t id : ids) {
    const CurvatureInterval& interval = document.partitions.find(id)->interval;
    own = {std::min(own.min, interval.min), std::max(own.max, interval.max)};
  }
  read_interval(reader, "interval", own);
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  reader.set("areas", areas);
  if (!areas.is_null()) {
    if (!areas.is_array() || areas.size() != ids.size() ||
        !std::all_of(areas.begin(), areas.end(), [](const json& a) { return a.is_number(); }))
      reader.fault("areas", "an area for each partition");
    return reader.finish();
  }
  Ground ground = ground_of(document);
  std::vector<PartitionPtr> partitions;
  for (const PartitionPtr& partition : document.partitions.partitions)
    if (std::binary_search(ids.begin(), ids.end(), partition->id)) partitions.push_back(partition);
  if (const auto gained = extend_all(ground, partitions, interval_of(reader.resolved("interval"))))
    reader.set("areas", *gained);
  return reader.finish();
}

Result<Outcome> extend(Ground& ground, const json& parameters, Round round) {
  Outcome outcome;
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

std::string words_of_extend(const json& parameters) {
  return of_partition("Extend", parameters) + interval_after_comma(parameters);
}

// remove_partitions: {partitions: [ids]}

Result<json> resolve_remove(const Document& document, const json& given) {
  ParameterReader reader("remove_partitions", given);
  read_partitions(reader, document, "partitions", "anchors", false);
  const json areas = reader.raw("areas");
  if (const auto checked = reader.check(); !checked) return tl::unexpected<Error>(checked.error());
  json own = json::array();
  for (const std::uint32_t id : ids_of(reader.resolved("partitions")))
    own.push_back(document.partitions.find(id)->area);
  if (!areas.is_null() &&
      (!areas.is_array() || areas.size() != own.size() ||
       !std::all_of(areas.begin(), areas.end(), [](const json& a) { return a.is_number(); })))
    reader.fault("areas", "an area for each partition");
  reader.set("areas", areas.is_null() ? own : areas);
  return reader.finish();
}

Result<Outcome> remove(Ground& ground, const json& parameters, Round round) {
  Outcome outcome;
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

// fill_unassigned: {faces: n}: areas in no partition of at most so many faces go to neighbours

/// Gives the areas that the unassigned among `faces` (ascending) form, up to `most` faces each, to
/// the partitions they belong to.
Result<Outcome> fill(Ground& ground, const std::vector<FaceId>& faces, std::size_t most) {
  const FilledAreas filled = fill_areas(ground.partition_ground(), faces, most);
  ground.change(filled.labels);
  if (filled.enclosed == 0) return Outcome{};
  return Outcome{counted(filled.enclosed, "area has", "areas have") +
                 " no partition beside it but over sharp lines, and stays in none."};
}

std::vector<FaceId> unassigned_faces(const Mesh& mesh, const Partitions& partitions) {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (partitions.label(f) == 0) faces.push_back(f);
  return faces;
}

Result<json> resolve_fill(const Document& document, const json& given) {
  ParameterReader reader("fill_unassigned", given);
  if (const auto found = needs_partitions(document); !found)
    return tl::unexpected<Error>(found.error());
  reader.whole("faces", most_faces, 1, most_faces);
  return reader.finish();
}

Result<Outcome> fill_unassigned(Ground& ground, const json& parameters, Round round) {
  const std::vector<FaceId> faces = unassigned_faces(ground.mesh, ground.partitions);
  if (faces.empty() && round == Round::first)
    return nothing_to_do("Every face is in a partition already.");
  return fill(ground, faces, parameters.at("faces"));
}

std::string words_of_fill(const json& parameters) {
  const std::string what = "Give unassigned areas to their neighbours";
  if (!parameters.contains("faces") || parameters["faces"].get<std::int64_t>() >= most_faces)
    return what;
  return what + ", up to " + parameters["faces"].dump() + " faces";
}

// remove_small_partitions: {faces: n, fill: whether what they covered goes to their neighbours}

Result<json> resolve_remove_small(const Document& document, const json& given) {
  ParameterReader reader("remove_small_partitions", given);
  if (const auto found = needs_partitions(document); !found)
    return tl::unexpected<Error>(found.error());
  if (!reader.has("faces")) reader.fault("faces", "a number of faces");
  reader.whole("faces", 1, 1, most_faces);
  reader.flag("fill", false);
  return reader.finish();
}

Result<Outcome> remove_small(Ground& ground, const json& parameters, Round round) {
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
  if (!parameters.at("fill")) return Outcome{};
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
  const std::string under = "partitions under " + parameters["faces"].dump() + " faces";
  return parameters.value("fill", false) ? "Give " + under + " to their neighbours"
                                         : "Remove " + under;
}

}  // namespace

const Treatment extend_partition_treatment{"extend_partition", after_partitions, extend};
const Treatment remove_partitions_treatment{"remove_partitions", after_partitions, remove};
const Treatment remove_small_partitions_treatment{"remove_small_partitions", after_partitions,
                                                  remove_small};
const Treatment fill_unassigned_treatment{"fill_unassigned", after_partitions, fill_unassigned};

const OperationKind extend_partition_operation{"extend_partition",
                                               "Extend partitions",
                                               2,
                                               resolve_extend,
                                               perform_once<extend_partition_treatment>,
                                               words_of_extend,
                                               upgrade_extend};
const OperationKind remove_partitions_operation{"remove_partitions",
                                                "Remove partitions",
                                                1,
                                                resolve_remove,
                                                perform_once<remove_partitions_treatment>,
                                                words_of_remove};
const OperationKind remove_small_partitions_operation{
    "remove_small_partitions",
    "Remove small partitions",
    2,
    resolve_remove_small,
    perform_once<remove_small_partitions_treatment>,
    words_of_remove_small,
    upgrade_remove_small};
const OperationKind fill_unassigned_operation{"fill_unassigned",
                                              "Fill unassigned areas",
                                              1,
                                              resolve_fill,
                                              perform_once<fill_unassigned_treatment>,
                                              words_of_fill};

}  // namespace arris
