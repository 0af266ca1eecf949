#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace arris {

/// Bytes that this process can have at most: the computer's memory, or what it was allowed of it
/// (control group, limit of the address space). 0: not known.
std::uint64_t machine_memory();

/// An error that says that `what` needs about `bytes` and this computer has less, so that nobody
/// tries and drives the machine into swapping, or is killed. Nothing where it is not known.
Result<void> check_memory(const std::string& what, std::uint64_t bytes,
                          std::uint64_t machine = machine_memory());

}  // namespace arris
