#include "ui/panels/histogram_axis.h"

#include <algorithm>

namespace arris::ui {

double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> tick_values(const ValueAxis& axis, int count) {
  std::vector<double> ticks;
  count = std::max(count, 2);
  if (axis.logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(axis.min) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(axis.max) + 1e-9));
    const int decades = last - first + 1;
    if (decades >= 3) {
      const int stride = (decades + count - 1) / count;
      for (int d = first; d <= last; d += stride) ticks.push_back(std::pow(10.0, d));
      return ticks;
    }
    for (int d = first - 1; d <= last; ++d) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, d);
        if (value >= axis.min * (1 - 1e-9) && value <= axis.max * (1 + 1e-9)) {
          ticks.push_back(value);
        }
      }
    }
    if (ticks.size() >= 2) return ticks;
    ticks.clear();
  }
  const double step = nice_step((axis.max - axis.min) / count);
  const double first = std::ceil(axis.min / step - 1e-9);
  for (double k = first; k * step <= axis.max + 1e-9 * step && ticks.size() < 100; ++k) {
    ticks.push_back(k * step);
  }
  return ticks;
}

}  // namespace arris::ui
