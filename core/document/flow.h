#pragma once

#include <cstdint>
#include <vector>

#include "core/document/operation.h"

namespace arris {

/// The ways from an opened scan to its partitions.
enum class Flow : std::uint8_t {
  scan,   ///< Sharp lines by the normal jump and partitions, on the scan's own mesh: the default.
  paper,  ///< Figure 2: simplification, sharp lines by the walk, equilateralisation, partitions.
};

/// Its operations after "open", each with the defaults that the part gives.
std::vector<Operation> operations_of(Flow flow);

}  // namespace arris
