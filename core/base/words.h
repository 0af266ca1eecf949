#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/number_text.h"

/// Counts, lists and measures as they are said to the user.
namespace arris {

/// "11,730"
template <class Count>
std::string grouped(Count count) {
  std::string text = std::to_string(count);
  for (std::size_t k = text.size(); k > 3 && text[k - 4] != '-'; k -= 3) text.insert(k - 3, 1, ',');
  return text;
}

/// "1 line", "24 lines".
template <class Count>
std::string counted(Count count, const std::string& one, const std::string& many) {
  return grouped(count) + " " + (count == 1 ? one : many);
}

/// "line 3", "lines 3 and 4", "lines 3, 4 and 7", "24 lines".
inline std::string named(const std::vector<std::uint32_t>& ids, const std::string& one,
                         const std::string& many) {
  constexpr std::size_t most_named = 3;
  if (ids.empty()) return "no " + one;
  if (ids.size() == 1) return one + " " + std::to_string(ids[0]);
  if (ids.size() > most_named) return counted(ids.size(), one, many);
  std::string text = many + " " + std::to_string(ids[0]);
  for (std::size_t k = 1; k < ids.size(); ++k)
    text += (k + 1 < ids.size() ? ", " : " and ") + std::to_string(ids[k]);
  return text;
}

/// A length, an area, a curvature: three significant digits, whole from 100 on.
inline std::string measure_text(double value) {
  return std::abs(value) < 99.95 ? number_text(value, 3) : fixed_text(value, 0);
}

/// "23.3°", "3.76°", "90°": three digits, but no finer than a hundredth.
inline std::string degrees_in_words(double degrees) {
  const double size = std::abs(degrees);
  const double unit = size < 9.995 ? 100.0 : size < 99.95 ? 10.0 : 1.0;
  const double shown = std::round(degrees * unit) / unit;
  return number_text(shown == 0.0 ? 0.0 : shown, 3) + "°";
}

}  // namespace arris
