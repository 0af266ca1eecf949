#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace arris {

/// Random numbers that are the same on every platform, which those of <random>'s distributions are
/// not: splitmix64 (Steele, Lea, Flood 2014), and Box-Muller for Gaussian ones.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  /// Evenly spread over [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// Evenly spread over [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Gaussian, mean 0, standard deviation 1.
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace arris
