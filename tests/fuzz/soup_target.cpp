// Triangles, as the bytes say, through the whole flow. Three bytes make a point of a lattice (or
// something odd), three more a triangle.

#include <array>
#include <cmath>
#include <limits>

#include "core/base/thread_limit.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/whole_flow.h"

namespace {

double coordinate(std::uint8_t byte) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr std::array odd{infinite, -infinite, std::numeric_limits<double>::quiet_NaN(),
                                  1e30,     -1e30,     1e-30,
                                  5e-324,   1e308};
  if (byte >= 256 - odd.size()) return odd[byte - (256 - odd.size())];
  return (byte - 124) / 8.0;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arris;
  if (size < 2) return 0;
  static const ThreadLimit one_thread(1);
  testing::Triangles soup;
  const std::size_t points = data[0] % 64;
  const double scale = std::pow(10.0, data[1] < 128 ? 0 : (data[1] - 192) * 2);
  std::size_t at = 2;
  for (std::size_t k = 0; k < points && at + 3 <= size; ++k, at += 3)
    soup.points.push_back(
        scale * Point(coordinate(data[at]), coordinate(data[at + 1]), coordinate(data[at + 2])));
  for (; at + 3 <= size && soup.triangles.size() < 200; at += 3)
    soup.triangles.push_back({data[at], data[at + 1], data[at + 2]});
  fuzz::require_none(testing::fault_of_whole_flow(testing::ply_bytes(soup)));
  return 0;
}
