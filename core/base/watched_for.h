#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "core/base/context.h"
#include "core/base/parallel.h"

namespace arris {

/// parallel_for() in slices, between which the work is told and asked whether it goes on, by the
/// thread that calls. False: cancelled, and not all calls were made.
template <class Body>
bool watched_for(std::size_t count, const Context& context, std::string_view what, const Body& body,
                 std::size_t grain = 1024) {
  constexpr std::size_t slices = 40;
  const std::size_t slice = std::max({(count + slices - 1) / slices, 4 * grain, std::size_t{1}});
  for (std::size_t begin = 0; begin < count; begin += slice) {
    if (context.cancelled()) return false;
    context.report(static_cast<double>(begin) / static_cast<double>(count), what);
    parallel_for(
        std::min(slice, count - begin), [&](std::size_t i) { body(begin + i); }, grain);
  }
  return !context.cancelled();
}

}  // namespace arris
