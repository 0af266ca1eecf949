#include "core/base/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>

#include <sys/resource.h>
#include <unistd.h>

#include "core/base/number_text.h"

namespace arris {

namespace {

std::string gigabytes(std::uint64_t bytes) {
  const double size = static_cast<double>(bytes) / 1e9;
  return (size < 9.95 ? fixed_text(size, 1) : fixed_text(size, 0)) + " GB";
}

}  // namespace

std::uint64_t machine_memory() {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0)
    least = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  // Of a container; "max", which is no number, where there is no limit.
  for (const char* limit :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::uint64_t bytes = 0;
    if (std::ifstream(limit) >> bytes && bytes > 0) least = std::min(least, bytes);
  }
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    least = std::min<std::uint64_t>(least, space.rlim_cur);
  return least == std::numeric_limits<std::uint64_t>::max() ? 0 : least;
}

Result<void> check_memory(const std::string& what, std::uint64_t bytes, std::uint64_t machine) {
  if (machine == 0 || bytes <= machine) return {};
  return fail(what + " needs about " + gigabytes(bytes) + " of memory; this computer has " +
              gigabytes(machine) + ".");
}

}  // namespace arris
