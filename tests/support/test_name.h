#pragma once

#include <cctype>
#include <string>

namespace arris::testing {

/// `words` as GoogleTest takes them for the name of a case: what is no letter or digit becomes `_`.
inline std::string test_name(std::string words) {
  for (char& c : words)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return words;
}

}  // namespace arris::testing
