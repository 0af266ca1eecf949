#include "core/base/keyed_hash.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace arris {

namespace {

std::uint64_t word_at(const char* bytes) {
  std::uint64_t word = 0;
  for (int k = 7; k >= 0; --k) word = word << 8 | static_cast<unsigned char>(bytes[k]);
  return word;
}

struct State {
  std::uint64_t v0, v1, v2, v3;

  void round() {
    v0 += v1;
    v1 = std::rotl(v1, 13) ^ v0;
    v0 = std::rotl(v0, 32);
    v2 += v3;
    v3 = std::rotl(v3, 16) ^ v2;
    v0 += v3;
    v3 = std::rotl(v3, 21) ^ v0;
    v2 += v1;
    v1 = std::rotl(v1, 17) ^ v2;
    v2 = std::rotl(v2, 32);
  }
  void take(std::uint64_t word) {
    v3 ^= word;
    round();
    round();
    v0 ^= word;
  }
  std::uint64_t finish(std::uint64_t& v, std::uint64_t with) {
    v ^= with;
    for (int k = 0; k < 4; ++k) round();
    return v0 ^ v1 ^ v2 ^ v3;
  }
};

}  // namespace

std::string keyed_hash(std::string_view key, std::string_view bytes) {
  const std::uint64_t k0 = word_at(key.data()), k1 = word_at(key.data() + 8);
  State state{k0 ^ 0x736f6d6570736575u, k1 ^ 0x646f72616e646f6du ^ 0xee, k0 ^ 0x6c7967656e657261u,
              k1 ^ 0x7465646279746573u};
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) state.take(word_at(bytes.data() + at));
  char last[8]{};
  std::memcpy(last, bytes.data() + at, bytes.size() - at);
  last[7] = static_cast<char>(bytes.size() & 0xFF);
  state.take(word_at(last));
  const std::uint64_t words[2]{state.finish(state.v2, 0xee), state.finish(state.v1, 0xdd)};
  std::string hash;
  for (const std::uint64_t word : words)
    for (int k = 0; k < 8; ++k) hash += static_cast<char>(word >> (8 * k) & 0xFF);
  return hash;
}

}  // namespace arris
