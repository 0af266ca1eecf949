#include "core/mesh/length_unit.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/base/words.h"

namespace arris {

namespace {

constexpr std::array table{
    LengthUnitInfo{LengthUnit::unknown, "unknown", "", "unknown", 0.0},
    LengthUnitInfo{LengthUnit::micrometre, "um", "µm", "micrometres", 1e-3},
    LengthUnitInfo{LengthUnit::millimetre, "mm", "mm", "millimetres", 1.0},
    LengthUnitInfo{LengthUnit::centimetre, "cm", "cm", "centimetres", 10.0},
    LengthUnitInfo{LengthUnit::metre, "m", "m", "metres", 1000.0},
    LengthUnitInfo{LengthUnit::inch, "in", "in", "inches", 25.4},
    LengthUnitInfo{LengthUnit::foot, "ft", "ft", "feet", 304.8},
};

struct OtherName {
  std::string_view name;
  LengthUnit unit;
};

/// Beside those of the table; the American ones are those of 3MF.
constexpr std::array other_names{
    OtherName{"micron", LengthUnit::micrometre},
    OtherName{"microns", LengthUnit::micrometre},
    OtherName{"micrometer", LengthUnit::micrometre},
    OtherName{"micrometers", LengthUnit::micrometre},
    OtherName{"micrometre", LengthUnit::micrometre},
    OtherName{"millimeter", LengthUnit::millimetre},
    OtherName{"millimeters", LengthUnit::millimetre},
    OtherName{"millimetre", LengthUnit::millimetre},
    OtherName{"centimeter", LengthUnit::centimetre},
    OtherName{"centimeters", LengthUnit::centimetre},
    OtherName{"centimetre", LengthUnit::centimetre},
    OtherName{"meter", LengthUnit::metre},
    OtherName{"meters", LengthUnit::metre},
    OtherName{"metre", LengthUnit::metre},
    OtherName{"inch", LengthUnit::inch},
    OtherName{"foot", LengthUnit::foot},
    OtherName{"none", LengthUnit::unknown},
};

/// How a part's largest extent is spread that is scanned, and how often files have which unit:
/// wide, since a wrong certainty would cost more than a question.
constexpr double usual_extent = 150.0;  // mm
constexpr double spread = 1.8;          // of its logarithm
struct Share {
  LengthUnit unit;
  double of_files;
};
constexpr std::array shares{
    Share{LengthUnit::millimetre, 0.75}, Share{LengthUnit::metre, 0.12},
    Share{LengthUnit::inch, 0.08},       Share{LengthUnit::centimetre, 0.04},
    Share{LengthUnit::micrometre, 0.01},
};
/// A unit that is less likely than the likeliest by more than this factor is none to ask about.
constexpr double certain = 12.0;

}  // namespace

std::span<const LengthUnitInfo> length_unit_table() { return table; }

const LengthUnitInfo& info_of(LengthUnit unit) { return table[static_cast<std::size_t>(unit)]; }

std::optional<LengthUnit> find_length_unit(std::string_view name) {
  const auto same = [name](std::string_view other) {
    return std::ranges::equal(name, other, [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) ==
             std::tolower(static_cast<unsigned char>(b));
    });
  };
  if (name.empty()) return std::nullopt;
  for (const LengthUnitInfo& info : table)
    if (same(info.key) || same(info.name) || same(info.symbol)) return info.unit;
  for (const OtherName& other : other_names)
    if (same(other.name)) return other.unit;
  return std::nullopt;
}

std::string length_unit_keys() {
  std::string keys;
  for (const LengthUnitInfo& info : table)
    if (info.unit != LengthUnit::unknown)
      keys += (keys.empty() ? "" : ", ") + std::string(info.key);
  return keys + " or " + std::string(info_of(LengthUnit::unknown).key);
}

std::string unit_text(LengthUnit unit, int power) {
  if (unit == LengthUnit::unknown) return {};
  return (power < 0 ? "1/" : "") + std::string(info_of(unit).symbol) +
         (power == 2 || power == -2 ? "²" : "");
}

std::string with_unit(std::string number, LengthUnit unit, int power) {
  if (unit == LengthUnit::unknown) return number;
  return std::move(number) + " " + unit_text(unit, power);
}

std::string length_in_words(double length, LengthUnit unit) {
  const std::string number = measure_text(length);
  return unit == LengthUnit::unknown ? number + " units" : with_unit(number, unit);
}

std::string area_in_words(double area, LengthUnit unit) {
  const std::string number = measure_text(area);
  return unit == LengthUnit::unknown ? number + " units²" : with_unit(number, unit, 2);
}

std::vector<LengthUnit> likely_units(const Eigen::Vector3d& size) {
  const double extent = size.maxCoeff();
  if (!(extent > 0.0) || !std::isfinite(extent)) return {LengthUnit::millimetre};
  struct Chance {
    LengthUnit unit;
    double logarithm;
  };
  std::array<Chance, shares.size()> chances;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double off =
        (std::log(extent) + std::log(info_of(shares[k].unit).millimetres / usual_extent)) / spread;
    chances[k] = {shares[k].unit, std::log(shares[k].of_files) - 0.5 * off * off};
  }
  std::ranges::stable_sort(
      chances, [](const Chance& a, const Chance& b) { return a.logarithm > b.logarithm; });
  std::vector<LengthUnit> units;
  for (const Chance& chance : chances)
    if (chance.logarithm > chances[0].logarithm - std::log(certain)) units.push_back(chance.unit);
  return units;
}

std::string size_in_words(const Eigen::Vector3d& size) {
  return measure_text(size.x()) + " × " + measure_text(size.y()) + " × " + measure_text(size.z());
}

}  // namespace arris
