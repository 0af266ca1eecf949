#include "ui/view/colour_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "ui/view/translated.h"

namespace arris::ui {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

// Evenly spaced; colours between are mixed. viridis and cividis are matplotlib's, diverging is
// ColorBrewer's RdBu.
constexpr std::array<Rgb, 3> paper_colours{{{0, 0, 0}, {0, 205, 0}, {235, 10, 0}}};
constexpr std::array<Rgb, 10> viridis_colours{{{0x44, 0x01, 0x54},
                                               {0x48, 0x28, 0x78},
                                               {0x3E, 0x4A, 0x89},
                                               {0x31, 0x68, 0x8E},
                                               {0x26, 0x82, 0x8E},
                                               {0x1F, 0x9E, 0x89},
                                               {0x35, 0xB7, 0x79},
                                               {0x6D, 0xCD, 0x59},
                                               {0xB4, 0xDE, 0x2C},
                                               {0xFD, 0xE7, 0x25}}};
constexpr std::array<Rgb, 10> cividis_colours{{{0x00, 0x20, 0x4D},
                                               {0x00, 0x33, 0x6F},
                                               {0x39, 0x48, 0x6B},
                                               {0x57, 0x5C, 0x6D},
                                               {0x70, 0x71, 0x73},
                                               {0x8A, 0x87, 0x79},
                                               {0xA6, 0x9D, 0x75},
                                               {0xC4, 0xB5, 0x6C},
                                               {0xE4, 0xCF, 0x5B},
                                               {0xFF, 0xEA, 0x46}}};
constexpr std::array<Rgb, 11> diverging_colours{{{0x05, 0x30, 0x61},
                                                 {0x21, 0x66, 0xAC},
                                                 {0x43, 0x93, 0xC3},
                                                 {0x92, 0xC5, 0xDE},
                                                 {0xD1, 0xE5, 0xF0},
                                                 {0xF7, 0xF7, 0xF7},
                                                 {0xFD, 0xDB, 0xC7},
                                                 {0xF4, 0xA5, 0x82},
                                                 {0xD6, 0x60, 0x4D},
                                                 {0xB2, 0x18, 0x2B},
                                                 {0x67, 0x00, 0x1F}}};

std::span<const Rgb> colours_of(ColourMap map) {
  switch (map) {
    case ColourMap::paper:
      return paper_colours;
    case ColourMap::viridis:
      return viridis_colours;
    case ColourMap::cividis:
      return cividis_colours;
    case ColourMap::diverging:
      return diverging_colours;
  }
  return paper_colours;
}

Rgb mix(std::span<const Rgb> colours, double position) {
  const double x = std::clamp(position, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(x), colours.size() - 2);
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c) {
    result[c] = static_cast<std::uint8_t>(std::lround(
        colours[k][c] + (x - static_cast<double>(k)) * (colours[k + 1][c] - colours[k][c])));
  }
  return result;
}

Rgb rgb(const QColor& colour) {
  return {static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
          static_cast<std::uint8_t>(colour.blue())};
}

// Light enough for lines and text to stand out, hue and lightness apart for neighbours.
constexpr std::array<Rgb, 12> soft_colours{{{141, 190, 229},
                                            {249, 192, 122},
                                            {153, 211, 155},
                                            {240, 160, 160},
                                            {194, 176, 228},
                                            {240, 226, 130},
                                            {130, 210, 206},
                                            {233, 170, 214},
                                            {190, 160, 130},
                                            {186, 214, 96},
                                            {115, 150, 200},
                                            {112, 170, 130}}};

// Beyond the table: hues by the golden angle, lightness in three steps.
QColor soft_colour(std::size_t k) {
  if (k < soft_colours.size()) return {soft_colours[k][0], soft_colours[k][1], soft_colours[k][2]};
  const double hue = std::fmod(static_cast<double>(k) * 0.61803398875, 1.0);
  return QColor::fromHslF(static_cast<float>(hue), 0.5F, 0.62F + 0.09F * static_cast<float>(k % 3))
      .toRgb();
}

}  // namespace

QStringList colour_map_names() {
  return {translated("Black, green, red (paper)"), translated("Viridis"), translated("Cividis"),
          translated("Blue, white, red")};
}

double ColourScale::position(double value) const {
  if (std::isnan(value)) return std::numeric_limits<double>::quiet_NaN();
  double low = min;
  double high = max;
  if (logarithmic) {
    if (high <= 0.0) return value < high ? 0.0 : 1.0;
    if (low <= 0.0) low = high / 1e6;
    if (value <= 0.0) return 0.0;
    value = std::log(value);
    low = std::log(low);
    high = std::log(high);
  }
  if (!(high > low)) return value < low ? -1.0 : value > high ? 2.0 : 0.5;
  return (value - low) / (high - low);
}

std::array<std::uint8_t, 3> ColourScale::colour(double value) const {
  if (std::isnan(value)) return rgb(undefined);
  if (value < min && below.isValid()) return rgb(below);
  if (value > max && above.isValid()) return rgb(above);
  double x = std::clamp(position(value), 0.0, 1.0);
  if (bands == 1) {
    x = 0.5;
  } else if (bands > 1) {
    x = std::min(std::floor(x * bands), bands - 1.0) / (bands - 1.0);
  }
  return mix(colours_of(map), reversed ? 1.0 - x : x);
}

std::vector<QColor> partition_colours(std::size_t count,
                                      const std::vector<std::array<std::uint32_t, 2>>& neighbours,
                                      const std::vector<std::optional<QColor>>& given) {
  std::vector<std::vector<std::uint32_t>> adjacent(count);
  for (const auto& [a, b] : neighbours) {
    if (a == b || a >= count || b >= count) continue;
    adjacent[a].push_back(b);
    adjacent[b].push_back(a);
  }
  // The least used colour that no neighbour has, in index order: deterministic, and all colours of
  // the table come to be used, which keeps far partitions apart too.
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> chosen(count, none);
  std::vector<std::size_t> uses(soft_colours.size(), 0);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i]) continue;
    std::size_t k = 0;
    while (k < soft_colours.size() + count && soft_colour(k) != *given[i]) ++k;
    const bool clashes =
        std::ranges::any_of(adjacent[i], [&](std::uint32_t j) { return chosen[j] == k; });
    if (k == soft_colours.size() + count || clashes) continue;
    chosen[i] = k;
    if (k < uses.size()) ++uses[k];
  }
  std::vector<bool> taken;
  for (std::size_t i = 0; i < count; ++i) {
    if (chosen[i] != none) continue;
    taken.assign(soft_colours.size() + adjacent[i].size() + 1, false);
    for (const std::uint32_t j : adjacent[i]) {
      if (chosen[j] != none && chosen[j] < taken.size()) taken[chosen[j]] = true;
    }
    std::size_t best = none;
    for (std::size_t k = 0; k < soft_colours.size(); ++k) {
      if (!taken[k] && (best == none || uses[k] < uses[best])) best = k;
    }
    if (best == none) {
      best = soft_colours.size();
      while (taken[best]) ++best;
    }
    if (best < uses.size()) ++uses[best];
    chosen[i] = best;
  }
  std::vector<QColor> result;
  result.reserve(count);
  for (const std::size_t k : chosen) result.push_back(soft_colour(k));
  return result;
}

}  // namespace arris::ui
