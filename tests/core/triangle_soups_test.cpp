// Whatever the triangles, each step gives a value or one sentence.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/base/random.h"
#include "tests/support/soups.h"
#include "tests/support/whole_flow.h"

namespace arris {
namespace {

class TriangleSoups : public ::testing::TestWithParam<int> {};

TEST_P(TriangleSoups, GoThroughTheWholeFlow) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(1000 * static_cast<std::uint64_t>(GetParam()) + seed);
    const testing::Triangles soup =
        testing::random_soup(static_cast<testing::SoupKind>(GetParam()), random);
    EXPECT_EQ(testing::fault_of_whole_flow(testing::ply_bytes(soup)), "") << "seed " << seed;
  }
}

std::string name_of_kind(const ::testing::TestParamInfo<int>& kind) {
  constexpr const char* names[] = {"Cloud", "Surface", "Fans", "Little"};
  return names[kind.param];
}

INSTANTIATE_TEST_SUITE_P(Random, TriangleSoups, ::testing::Range(0, testing::soup_kinds),
                         name_of_kind);

}  // namespace
}  // namespace arris
