// Work does not suffer from what drawing leaves in the registers.

#include "core/base/vector_state.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#if defined(__x86_64__) && defined(__GNUC__)

namespace arris {
namespace {

// In plain assembly: what a compiler makes of vector types clears the registers by itself.
void make_register_7_dirty() {
  const std::array<std::uint64_t, 4> bits{1, 2, 3, 4};
  asm volatile("vmovdqu %0, %%ymm7" : : "m"(bits) : "xmm7");
}

std::array<std::uint64_t, 2> upper_half_of_register_7() {
  std::array<std::uint64_t, 2> half{};
  asm volatile("vextractf128 $1, %%ymm7, %0" : "=m"(half));
  return half;
}

TEST(VectorState, IsClearedToTheUpperHalves) {
  clear_vector_state();  // does no harm where there are no such registers
  if (!__builtin_cpu_supports("avx")) return;
  make_register_7_dirty();
  const std::array<std::uint64_t, 2> dirty = upper_half_of_register_7();
  make_register_7_dirty();
  clear_vector_state();
  const std::array<std::uint64_t, 2> cleared = upper_half_of_register_7();
  EXPECT_EQ(dirty, (std::array<std::uint64_t, 2>{3, 4}));
  EXPECT_EQ(cleared, (std::array<std::uint64_t, 2>{0, 0}));
}

}  // namespace
}  // namespace arris
#endif
