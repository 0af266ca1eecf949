#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/mesh/mesh.h"

/// What the measures over windows of faces have in common.
namespace arris {

/// exp(-x) for x >= 0 by table, 0 from 12 on. The same on every machine, and fast.
class FallingExponential {
 public:
  FallingExponential() {
    for (std::size_t k = 0; k < table_.size(); ++k)
      table_[k] = static_cast<float>(std::exp(-(static_cast<double>(k) + 0.5) / steps));
  }
  float operator()(float x) const {
    const auto k = static_cast<std::size_t>(x * steps);
    return k < table_.size() ? table_[k] : 0.0F;
  }

 private:
  static constexpr float steps = 256.0F;
  std::array<float, 12 * 256> table_;
};

/// angle / sin(angle) for 1 - cos(angle) = z, z in [0, 0.8], to 0.1 %.
inline float angle_over_sine(float z) {
  return 1.0F +
         z * (1.0F / 3 +
              z * (2.0F / 15 +
                   z * (2.0F / 35 + z * (8.0F / 315 + z * (8.0F / 693 + z * (16.0F / 3003 +
                                                                             z * 16.0F / 6435))))));
}

/// A face of a window, copied so that they lie side by side.
struct WindowFace {
  Eigen::Vector3f from_place, normal;
  float area;
};

}  // namespace arris
