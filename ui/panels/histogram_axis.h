#pragma once

#include <cmath>
#include <vector>

namespace arris::ui {

/// The value axis: increasing, finite and, where logarithmic, positive.
struct ValueAxis {
  double min = 0.0, max = 1.0;
  bool logarithmic = false;

  double warp(double value) const { return logarithmic ? std::log10(value) : value; }
  /// 0 at min, 1 at max; values below a logarithmic axis are at 0.
  double position(double value) const {
    if (logarithmic && value <= min) return 0.0;
    return (warp(value) - warp(min)) / (warp(max) - warp(min));
  }
  double value(double position) const {
    const double warped = warp(min) + position * (warp(max) - warp(min));
    return logarithmic ? std::pow(10.0, warped) : warped;
  }
};

/// Step 1, 2 or 5 times a power of ten, not below `least`.
double nice_step(double least);

/// At most about `count` readable numbers on the axis, increasing.
std::vector<double> tick_values(const ValueAxis& axis, int count);

}  // namespace arris::ui
