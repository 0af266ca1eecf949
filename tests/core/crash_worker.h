#pragma once

#include <cstdint>

namespace arris::testing {

/// What a process that works on a session has said, at its last word, to be on disk.
struct Acknowledged {
  std::uint32_t rows = 0, head = 0;
};

/// The descriptor that it says so on, beside those of any program.
inline constexpr int to_the_parent = 9;

}  // namespace arris::testing
