#pragma once

#include <cstddef>
#include <vector>

#include "core/partitions/interactive_treatments.h"

namespace arris {

struct FilledAreas {
  FaceLabels labels;         ///< New labels, by face.
  std::size_t enclosed = 0;  ///< Areas with no partition beside them but over sharp lines.
};

/// Gives areas in no partition to the ones beside them. The unassigned among `faces` (ascending)
/// form areas joined over sides that are not sharp; one with more than `most_faces` stays. Of the
/// partitions that an area touches over such sides, and that are not locked, it goes to one whose
/// interval holds the area's mean of the criterion, where there is one, and among these to the one
/// with the longest border (ties: the lower id). Areas are filled by increasing size, so that what
/// lies between two of them may follow.
FilledAreas fill_areas(const PartitionGround& ground, const std::vector<FaceId>& faces,
                       std::size_t most_faces);

}  // namespace arris
