#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "core/base/result.h"

namespace arris {

/// What `work` returns, or an error that says `what` does not fit into memory: nothing in core/
/// throws across its public functions.
template <class Work>
auto within_memory(const std::string& what, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return fail(what + " does not fit into the memory of this computer.");
}

}  // namespace arris
