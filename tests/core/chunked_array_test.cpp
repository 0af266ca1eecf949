// Arrays that share what is equal: their value is what they hold, however they came to hold it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/chunked_array.h"
#include "core/base/random.h"

namespace arris {
namespace {

using Array = ChunkedArray<std::uint32_t>;
constexpr std::size_t chunk = Array::chunk_size;

TEST(ChunkedArray, TheHashIsOfTheValuesWhateverTheHistory) {
  Random random(4);
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, chunk - 1, chunk, chunk + 1,
                                 2 * chunk, 2 * chunk + 100, 5 * chunk + 3}) {
    const std::uint32_t common = 6;
    std::vector<std::uint32_t> values(size, common);
    for (int k = 0; k < 3; ++k)
      values[static_cast<std::size_t>(random.uniform() * static_cast<double>(size))] = 9;
    const Array plain(values, {});

    Array filled(size, common);
    static_cast<void>(filled.hash());
    for (std::size_t i = 0; i < size; ++i) filled.set(i, values[i]);
    std::vector<Array> equals{filled};
    // Beside arrays that go on, or end earlier, with and without a hash that is known already.
    for (const std::size_t other : {size + 1, size + chunk / 2, size + 2 * chunk, size - size / 3})
      for (const bool hashed : {false, true}) {
        std::vector<std::uint32_t> longer(values);
        longer.resize(other, common);
        const Array previous(longer, {}), all_common(other, common);
        if (hashed) static_cast<void>(previous.hash() + all_common.hash());
        equals.emplace_back(values, previous);
        equals.emplace_back(values, all_common);
      }
    for (const Array& equal : equals) {
      EXPECT_TRUE(equal == plain) << size;
      EXPECT_EQ(equal.hash(), plain.hash()) << size;
    }
    Array changed = plain;
    changed.set(size - 1, 77);
    EXPECT_FALSE(changed == plain) << size;
    EXPECT_NE(changed.hash(), plain.hash()) << size;
  }
}

TEST(ChunkedArray, OneValueFilledInHasOneHash) {
  for (const std::size_t size : {chunk / 3, chunk + 1, 3 * chunk + 5}) {
    const Array filled(size, 2U);
    const Array listed(std::vector<std::uint32_t>(size, 2U), {});
    EXPECT_EQ(filled.hash(), listed.hash()) << size;
  }
}

TEST(ChunkedArray, CopiesShareUntilTheyAreWritten) {
  const Array before(4 * chunk, 1U);
  Array after = before;
  EXPECT_EQ(after.bytes_beyond(before), 0u);
  after.set(chunk + 1, 5U);
  EXPECT_EQ(before[chunk + 1], 1u);
  EXPECT_EQ(after[chunk + 1], 5u);
  EXPECT_LT(after.bytes_beyond(before), 2 * chunk * sizeof(std::uint32_t));
}

}  // namespace
}  // namespace arris
