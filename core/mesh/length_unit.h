#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace arris {

/// What a length of 1 in a file stands for. Nothing is computed from it: results are the same
/// whatever the unit, which only tells how lengths, areas and curvatures are said.
enum class LengthUnit : std::uint8_t {
  unknown,
  micrometre,
  millimetre,
  centimetre,
  metre,
  inch,
  foot
};

struct LengthUnitInfo {
  LengthUnit unit;
  std::string_view key;     ///< As in operations and on the command line: "mm".
  std::string_view symbol;  ///< As shown: "mm", "µm"; empty where unknown.
  std::string_view name;    ///< "millimetres".
  double millimetres;       ///< Of one; 0 where unknown.
};

/// All of them in the order of the enumeration, `unknown` first.
std::span<const LengthUnitInfo> length_unit_table();
const LengthUnitInfo& info_of(LengthUnit unit);
/// By key, symbol or any usual name ("mm", "millimeter", "Inches"), upper or lower case; "unknown"
/// is one of them. Absent: no such unit.
std::optional<LengthUnit> find_length_unit(std::string_view name);
/// "um, mm, cm, m, in, ft or unknown", for messages.
std::string length_unit_keys();

/// "mm", "mm²", "1/mm", "1/mm²" for the powers 1, 2, -1 and -2; empty where the unit is unknown.
std::string unit_text(LengthUnit unit, int power = 1);
/// "3.2 mm", "12 mm²" in a sentence, as measure_text() says numbers; "3.2 units", "12 units²" where
/// the unit is unknown.
std::string length_in_words(double length, LengthUnit unit);
std::string area_in_words(double area, LengthUnit unit);
/// A number with the unit after it; alone where the unit is unknown.
std::string with_unit(std::string number, LengthUnit unit, int power = 1);

/// Units in which something of this size would be a part that people scan: the likeliest first,
/// then those that cannot be excluded. Never empty; more than one: there is doubt.
std::vector<LengthUnit> likely_units(const Eigen::Vector3d& size);
/// "0.18 × 0.33 × 0.03".
std::string size_in_words(const Eigen::Vector3d& size);

}  // namespace arris
