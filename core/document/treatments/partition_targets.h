#pragma once

#include <string>
#include <vector>

#include "core/document/treatments/treatment.h"

/// What the treatments of partitions have in common.
namespace arris {

inline bool after_partitions(const nlohmann::json&, Round round) {
  return round == Round::after_partitions;
}

/// The partitions meant by "partitions" and "anchors"; those no longer there are noted.
std::vector<PartitionPtr> find_all(const Ground& ground, const nlohmann::json& parameters,
                                   Round round, TreatmentOutcome& outcome);
/// The one meant by "partition" and "anchor".
Result<PartitionPtr> find_one(const Ground& ground, const nlohmann::json& parameters, Round round,
                              TreatmentOutcome& outcome);
FaceLabels labelled(const std::vector<FaceId>& faces, std::uint32_t label);
/// The partitions that a treatment is of, which may not be locked, and the one.
Parameter partitions_parameter();
Parameter partition_parameter();
/// An interval of its own, and the least faces of what is found with it.
Parameter interval_parameter();
Parameter min_faces_parameter();
/// Errors: partitions were not found yet.
Result<void> needs_partitions(const Document& document);

/// "Extend partition 7"
std::string of_partition(const std::string& done, const nlohmann::json& parameters);
/// ", 0 to 0.236" where there is an interval.
std::string interval_after_comma(const nlohmann::json& parameters);

}  // namespace arris
