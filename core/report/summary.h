#pragma once

#include "core/base/json.h"
#include "core/document/history.h"

namespace arris {

/// What a program reads of a result (summary.json of the command line): load report, noise,
/// parameters of the steps, figures of lines, partitions, sides, boundaries and surfaces, the hash
/// of the document and the names of its versions.
nlohmann::json summary_of(const History& history);

/// By how many degrees noise turns the normals of the scan, from which its default threshold comes.
double normal_noise_of(const Document& document);
double default_angle_of(const Document& document);

}  // namespace arris
