#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/document/document.h"

namespace arris {

/// What one of two versions has and the other has not.
struct Departure {
  /// Stretches of its borderlines, each along one boundary, in the order of the boundaries.
  std::vector<std::vector<VertexId>> stretches;
  double sharp_length = 0.0;  ///< mm of them on sharp lines (C0).
  double soft_length = 0.0;   ///< mm of them between or about partitions (Gn, undefined).
};

/// Two versions of one part, compared.
struct Comparison {
  double tolerance = 0.0;  ///< mm within which borderlines count as the same.
  std::array<Departure, 2> only;
  /// Partitions that stand for each other, by their ids: those that share most area first. Each
  /// partition is in one pair at most.
  std::vector<std::array<std::uint32_t, 2>> partitions;
  /// Share of the area, 0 to 1, on which the two disagree: it belongs to partitions that do not
  /// stand for each other, or to one in one version only. Of the mesh where both have one mesh,
  /// else of the scan. Absent where partitions were not found in both.
  std::optional<double> divided_otherwise;
};

/// Whether both are of one scan; false where one of them has no part open.
bool are_of_one_scan(const Document& left, const Document& right);

/// Where two versions of a part divide it otherwise. A sharp line agrees with a sharp line, any
/// other borderline with any borderline, where both ends and the middle of its edge lie within 1.5
/// mean edges (of the coarser of the two meshes) of it: as far as a veto reaches (document.md,
/// rule 6). Free borders of the scan are not compared; where partitions were not found in both, as
/// while lines are tuned, only sharp lines are. Errors: the versions are not of one scan;
/// cancelled.
Result<Comparison> compare(const Document& left, const Document& right,
                           const Context& context = {});

}  // namespace arris
