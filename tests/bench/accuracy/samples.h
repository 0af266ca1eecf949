#pragma once

#include <vector>

#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// Midpoints of equal pieces of segments, each standing for the length of its piece.
struct LengthSamples {
  std::vector<Point> points;
  std::vector<double> lengths;
};

/// Adds those of a line, each segment cut into pieces no longer than `step` mm.
void add_samples(const Polyline& line, double step, LengthSamples& samples);

}  // namespace arris::accuracy
