#include "core/mesh/coordinate_step.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace arris {

namespace {

/// With more digits than this a decimal number is no longer one that somebody rounded.
constexpr int most_digits = 12;

/// How many significant decimal digits give just this number; most_digits + 1 for more.
int digits_of(double value) {
  for (int digits = 1; digits <= most_digits; ++digits) {
    char text[64];
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1)
            .ptr;
    double again = 0.0;
    std::from_chars(text, end, again);
    if (again == value) return digits;
  }
  return most_digits + 1;
}

bool is_float(double value) {
  return std::abs(value) <= std::numeric_limits<float>::max() &&
         static_cast<double>(static_cast<float>(value)) == value;
}

/// Whether a number is a 32-bit one that was written with so many digits.
bool is_written_float(double value, int digits) {
  if (std::abs(value) > std::numeric_limits<float>::max()) return false;
  const auto text = [&](double number, char* to) {
    return std::to_chars(to, to + 64, number, std::chars_format::scientific, digits - 1).ptr;
  };
  char a[64], b[64];
  const char* const a_end = text(value, a);
  const char* const b_end = text(static_cast<double>(static_cast<float>(value)), b);
  return std::string_view(a, a_end) == std::string_view(b, b_end);
}

}  // namespace

double coordinate_step(std::span<const Point> points) {
  constexpr std::size_t looked_at = 4096;
  std::vector<double> values;
  double largest = 0.0;
  for (const Point& p : points)
    if (p.allFinite()) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  if (!(largest > 0.0)) return 0.0;
  const std::size_t stride = 1 + points.size() / looked_at;
  for (std::size_t v = 0; v < points.size(); v += stride)
    for (const double x : points[v])
      if (std::isfinite(x) && x != 0.0) values.push_back(x);
  const bool floats = std::all_of(values.begin(), values.end(), is_float);
  const double float_step =
      largest <= std::numeric_limits<float>::max()
          ? std::ldexp(1.0, std::ilogb(largest) - (std::numeric_limits<float>::digits - 1))
          : 0.0;
  if (floats) return float_step;
  // The last digit of rounded numbers is hardly ever 0; where it mostly is, the numbers are round
  // themselves and say nothing of how finely they could be written.
  int digits = 1, decimals = std::numeric_limits<int>::min();
  std::vector<std::array<int, 2>> found;
  for (const double x : values) {
    const int all = digits_of(x);
    if (all > most_digits) return 0.0;
    const int after_point = all - 1 - static_cast<int>(std::floor(std::log10(std::abs(x))));
    found.push_back({all, after_point});
    digits = std::max(digits, all);
    decimals = std::max(decimals, after_point);
  }
  const auto share = [&](std::size_t k, int last) {
    return static_cast<double>(std::count_if(found.begin(), found.end(),
                                             [&](const auto& d) { return d[k] == last; })) /
           static_cast<double>(found.size());
  };
  constexpr double least_share = 0.3;
  if (share(0, digits) < least_share && share(1, decimals) < least_share) return 0.0;
  const double decimal_step = std::pow(10.0, std::floor(std::log10(largest)) - digits + 1);
  const bool written_floats = digits >= 7 && digits <= 9 &&
                              std::all_of(values.begin(), values.end(),
                                          [&](double x) { return is_written_float(x, digits); });
  return written_floats ? std::max(float_step, decimal_step) : decimal_step;
}

}  // namespace arris
