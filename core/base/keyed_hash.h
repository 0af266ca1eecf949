#pragma once

#include <string>
#include <string_view>

namespace arris {

inline constexpr std::size_t hash_key_size = 16;  // bytes

/// SipHash-2-4 with 128 bits (Aumasson and Bernstein, "SipHash: a fast short-input PRF", 2012): who
/// does not have the key can make no bytes that have a given hash, nor the hash of given bytes.
/// `key` has hash_key_size bytes. 16 bytes.
std::string keyed_hash(std::string_view key, std::string_view bytes);

}  // namespace arris
