#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace arris {

/// Walks over text word by word and counts lines. A line ends with LF, CR LF or a lone CR.
class TextScanner {
 public:
  struct Style {
    bool hash_comments = false;    ///< A word that begins with # hides the rest of its line.
    bool hash_ends_words = false;  ///< So does a # within a word, which ends there.
    bool continued_lines = false;  ///< A backslash at the end of a line continues it.
  };

  TextScanner(std::string_view text, Style style, std::size_t first_line = 1)
      : at_(text.data()), end_(text.data() + text.size()), style_(style), line_(first_line) {}

  /// Line of the word read last, from 1.
  std::size_t line() const { return line_; }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

  /// The next word on the same line; empty at its end.
  std::string_view word_in_line() {
    skip_blanks();
    const char* const begin = at_;
    while (at_ != end_ && !is_space(*at_) && !is_continuation() &&
           !(style_.hash_ends_words && *at_ == '#'))
      ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }

  /// The next word on this line or a later one; empty at the end of the text.
  std::string_view word() {
    std::string_view result = word_in_line();
    while (result.empty() && at_ != end_) {
      end_line();
      result = word_in_line();
    }
    return result;
  }

  /// Goes to the beginning of the next line. A continued line counts as one.
  void skip_line() {
    while (at_ != end_ && !is_newline(*at_)) {
      if (is_continuation()) {
        ++at_;
        end_line();
      } else {
        ++at_;
      }
    }
    if (at_ != end_) end_line();
  }

 private:
  static bool is_newline(char c) { return c == '\n' || c == '\r'; }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  bool is_continuation() const {
    return style_.continued_lines && *at_ == '\\' && at_ + 1 != end_ && is_newline(at_[1]);
  }
  void end_line() {
    if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
  }
  void skip_blanks() {
    while (at_ != end_) {
      if (is_continuation()) {
        ++at_;
        end_line();
      } else if (is_space(*at_) && !is_newline(*at_)) {
        ++at_;
      } else {
        break;
      }
    }
    if (style_.hash_comments && at_ != end_ && *at_ == '#')
      while (at_ != end_ && !is_newline(*at_)) ++at_;
  }

  const char* at_;
  const char* end_;
  Style style_;
  std::size_t line_;
};

/// A number in any form a mesh file may have it, whatever the locale: also "+1", "nan", "-inf" and
/// the "1.#QNAN" of old Windows programs. Too large is infinite, too small is 0.
inline std::optional<double> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  double value = 0.0;
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if (result.ec == std::errc() && result.ptr == end) return value;
  const bool negative = !word.empty() && word[0] == '-';
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    const std::string_view digits = word.substr(negative ? 1 : 0);
    const std::size_t exponent = digits.find_first_of("eE");
    const bool tiny = exponent == std::string_view::npos
                          ? digits.starts_with("0") || digits.starts_with(".")
                          : digits.substr(exponent + 1).starts_with("-");
    const double size = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return negative ? -size : size;
  }
  const std::string_view special = word.substr(negative ? 1 : 0);
  if (special.starts_with("1.#INF"))
    return negative ? -std::numeric_limits<double>::infinity()
                    : std::numeric_limits<double>::infinity();
  if (special.starts_with("1.#")) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

inline std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t value = 0;
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

/// Whether a word is a number but for a comma in the place of its point: "1,5", "-,25e3".
inline bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || word.find('.') != std::string_view::npos) return false;
  std::string with_point(word);
  with_point[comma] = '.';
  return comma + 1 < word.size() && parse_number(with_point).has_value();
}

/// The same, but numbers may be set apart by commas: "1.5," is 1.5.
inline std::optional<double> parse_listed_number(std::string_view word) {
  if (word.size() > 1 && word.ends_with(',')) word.remove_suffix(1);
  return parse_number(word);
}

/// The word in quotation marks for a message: shortened, and without bytes that are not plain text.
inline std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 32;
  std::string text = "\"";
  for (const char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > longest) text += "...";
  return text + "\"";
}

/// What stands where a number should, for a message: `found "x".`
inline std::string found_instead(std::string_view word) {
  if (word.empty()) return "found the end of the line.";
  return "found " + quoted(word) +
         (has_decimal_comma(word) ? ", a decimal comma: numbers need a decimal point." : ".");
}

}  // namespace arris
