#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/document/operation.h"

namespace arris {

/// The ways from an opened scan to its partitions.
enum class Flow : std::uint8_t {
  scan,   ///< The steps that nobody has to ask for, on the scan's own mesh: the default.
  paper,  ///< Figure 2: simplification, sharp lines by the walk, equilateralisation, partitions.
};

/// Parameters of steps by their names.
using StepParameters = std::map<std::string, nlohmann::json, std::less<>>;

/// Its operations after "open", in the order of the chain, each with the defaults that the part
/// gives. `wanted`: parameters that count before those of the flow, and steps besides.
std::vector<Operation> operations_of(Flow flow, const StepParameters& wanted = {});

}  // namespace arris
