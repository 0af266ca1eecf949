#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace arris {

/// 64-bit content hash (XXH3) of plain values without padding.
std::uint64_t hash_bytes(const void* data, std::size_t size);

/// Streaming 128-bit content hash (XXH3), the same on every machine of the same byte order.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void bytes(const void* data, std::size_t size);
  void text(std::string_view value);  ///< Length first, so that neighbours cannot run together.
  void number(std::uint64_t value) { bytes(&value, sizeof value); }

  /// 32 hexadecimal digits.
  std::string hex() const;

 private:
  void* state_;
};

}  // namespace arris
