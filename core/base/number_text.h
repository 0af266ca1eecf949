#pragma once

#include <charconv>
#include <string>

namespace arris {

/// A number as text with `digits` significant digits and a decimal point, whatever the locale.
inline std::string number_text(double value, int digits = 6) {
  char text[64];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

/// Digits of coordinates and measures in files for other programs.
inline constexpr int file_digits = 12;

/// The same with `decimals` digits after the point.
inline std::string fixed_text(double value, int decimals) {
  char text[400];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr;
  return {text, end};
}

/// `value` rounded to `digits` significant digits, so that a default reads like a number.
inline double rounded(double value, int digits) {
  const std::string text = number_text(value, digits);
  double result = value;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

}  // namespace arris
