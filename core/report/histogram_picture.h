#pragma once

#include <string>
#include <vector>

#include "core/curvature/distribution.h"

namespace arris {

/// A value at which a step divides, marked in a histogram.
struct MarkedValue {
  double value = 0.0;
  std::string text;  ///< "threshold 27°".
};

struct HistogramPicture {
  std::string title;  ///< Of the axis along: "Normal jump (°)".
  double low = 0.0, high = 1.0;
  std::vector<MarkedValue> marks;
};

/// The distribution as an SVG drawing: shares of the area in bins between `low` and `high`, on a
/// logarithmic axis, since what is sharp is a thousandth of a part; marked values as vertical
/// lines.
std::string histogram_svg(const Distribution& distribution, const HistogramPicture& picture);

}  // namespace arris
