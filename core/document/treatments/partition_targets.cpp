#include "core/document/treatments/partition_targets.h"

#include <algorithm>

namespace arris {

using nlohmann::json;

std::vector<PartitionPtr> find_all(const Ground& ground, const json& parameters, Round round,
                                   TreatmentOutcome& outcome) {
  std::vector<PartitionPtr> found;
  const std::vector<std::uint32_t> ids = ids_of(parameters.at("partitions"));
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const Result<PartitionPtr> partition =
        find_partition(ground, ids[k], parameters.at("anchors")[k].get<Triangle>(), round, outcome);
    if (!partition)
      outcome.adapted = partition.error().message;
    else if (std::find(found.begin(), found.end(), *partition) == found.end())
      found.push_back(*partition);
  }
  return found;
}

Result<PartitionPtr> find_one(const Ground& ground, const json& parameters, Round round,
                              TreatmentOutcome& outcome) {
  return find_partition(ground, parameters.at("partition"), parameters.at("anchor").get<Triangle>(),
                        round, outcome);
}

FaceLabels labelled(const std::vector<FaceId>& faces, std::uint32_t label) {
  FaceLabels labels;
  for (const FaceId f : faces) labels.emplace_back(f, label);
  return labels;
}

Parameter partitions_parameter() {
  return {.name = "partitions",
          .kind = ParameterKind::partitions,
          .help = "The partitions that are meant.",
          .anchors = "anchors"};
}

Parameter partition_parameter() {
  return {.name = "partition",
          .kind = ParameterKind::partition,
          .help = "The partition that is meant.",
          .anchors = "anchor"};
}

Parameter interval_parameter() {
  return {.name = "interval",
          .kind = ParameterKind::interval,
          .label = "Kmax",
          .help = "The largest value of the criterion."};
}

Parameter min_faces_parameter() {
  return {.name = "min_faces",
          .kind = ParameterKind::whole,
          .help = "Smaller partitions are not kept.",
          .unit = "faces",
          .least = 1,
          .most = most_faces,
          .otherwise = 1};
}

Result<void> needs_partitions(const Document& document) {
  if (document.partitions.labels.empty()) return fail("Find partitions first: there are none yet.");
  return {};
}

std::string of_partition(const std::string& done, const json& parameters) {
  return done + " " + targets_in_words(parameters, "partition", "partitions");
}

std::string interval_after_comma(const json& parameters) {
  if (!parameters.contains("interval") || !parameters["interval"].is_array()) return "";
  return ", " + interval_in_words(interval_of(parameters["interval"]));
}

}  // namespace arris
