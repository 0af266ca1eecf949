#pragma once

#include <cstdint>

namespace arris {

/// Bytes of memory that this process has had at most so far. 0: not known.
std::uint64_t peak_memory();

/// Whether somebody reads standard error as it is written: on a terminal, not in a file.
bool is_error_on_a_terminal();

}  // namespace arris
