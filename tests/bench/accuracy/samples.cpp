#include "tests/bench/accuracy/samples.h"

#include <algorithm>
#include <cmath>

namespace arris::accuracy {

void add_samples(const Polyline& line, double step, LengthSamples& samples) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point along = line[i + 1] - line[i];
    const double length = along.norm();
    const double pieces = std::max(1.0, std::ceil(length / step));
    for (double k = 0.0; k < pieces; ++k) {
      samples.points.push_back(line[i] + along * ((k + 0.5) / pieces));
      samples.lengths.push_back(length / pieces);
    }
  }
}

}  // namespace arris::accuracy
