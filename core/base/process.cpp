#include "core/base/process.h"

#ifdef _WIN32
#include <io.h>
#else
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace arris {

std::uint64_t peak_memory() {
#ifdef _WIN32
  return 0;
#else
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
  constexpr std::uint64_t unit = 1;
#else
  constexpr std::uint64_t unit = 1024;
#endif
  return unit * static_cast<std::uint64_t>(usage.ru_maxrss);
#endif
}

bool is_error_on_a_terminal() {
#ifdef _WIN32
  return ::_isatty(2) != 0;
#else
  return ::isatty(2) != 0;
#endif
}

}  // namespace arris
