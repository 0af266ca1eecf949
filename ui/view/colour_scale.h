#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <QColor>
#include <QString>
#include <QStringList>

namespace arris::ui {

enum class ColourMap {
  paper,  ///< The paper's: black (0) through green to red (high), figures 9 and 31.
  viridis,
  cividis,    ///< Reads the same for the colour-blind.
  diverging,  ///< Blue, white, red: for signed fields.
};

/// Names for a combo box, in the order of ColourMap.
QStringList colour_map_names();

/// From a value to a colour.
struct ColourScale {
  ColourMap map = ColourMap::paper;
  double min = 0.0;
  double max = 1.0;
  bool logarithmic = false;  ///< For fields that are never negative; values <= 0 take the low end.
  bool reversed = false;
  int bands = 0;                             ///< 0: smooth; else that many flat colours.
  QColor below;                              ///< Invalid: the colour of the low end.
  QColor above;                              ///< Invalid: the colour of the high end.
  QColor undefined = QColor(150, 150, 150);  ///< NaN.

  /// Position of a value on the scale, 0 to 1 where it lies between min and max; NaN for NaN.
  /// Smallest value shown on a logarithmic scale with min <= 0 is max / 1e6.
  double position(double value) const;
  std::array<std::uint8_t, 3> colour(double value) const;
  bool operator==(const ColourScale&) const = default;
};

/// Soft, distinct colours for partitions: neighbours never alike. `neighbours` lists the adjacent
/// pairs of partition indices (0 .. count-1); the result has one colour for each. `given` (empty,
/// or one for each) are kept, but for those that a neighbour before has, too.
std::vector<QColor> partition_colours(std::size_t count,
                                      const std::vector<std::array<std::uint32_t, 2>>& neighbours,
                                      const std::vector<std::optional<QColor>>& given = {});

}  // namespace arris::ui
