#pragma once

#include <array>
#include <optional>
#include <set>

#include <QRectF>
#include <QSizeF>

#include "ui/view/mesh_view.h"

class QPainter;

namespace arris::ui {

/// What is written over the part.
struct Overlay {
  bool dark = false;
  std::optional<ViewField> field;  ///< Nullopt: no scalar bar.
  bool field_has_undefined = false;
  std::set<LineType> line_types;  ///< In the legend.
  bool scale_bar = true;
  bool orientation_marker = true;
  QString hint;  ///< Lines at the bottom: what the tool does, the caption of a picture.
  double units_per_pixel = 1.0;                        ///< Mesh unit per pixel of the painter.
  LengthUnit unit = LengthUnit::unknown;               ///< What lengths are told in.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< See ViewCamera::axes().
  bool operator==(const Overlay&) const = default;
};

/// Paints into a view of `size`; what does not fit is left out, nothing overlaps.
void paint_overlay(QPainter& painter, QSizeF size, const Overlay& overlay);

/// Where the scalar bar and the legend of lines would be; empty where there is none.
std::array<QRectF, 2> overlay_panels(QSizeF size, const Overlay& overlay);

/// What is written, piece by piece, in the order of painting.
enum class OverlayPiece { panels, orientation, scale_bar, hint };
inline constexpr std::array overlay_pieces{OverlayPiece::panels, OverlayPiece::orientation,
                                           OverlayPiece::scale_bar, OverlayPiece::hint};

/// Paints one piece beside `panels` (those of overlay_panels()); all of it lies in the rectangle
/// returned, which is empty where nothing was painted.
QRectF paint_piece(QPainter& painter, QSizeF size, const Overlay& overlay, OverlayPiece piece,
                   const std::array<QRectF, 2>& panels);

/// What a piece is painted from, the rest as it is by default.
Overlay part_of(const Overlay& overlay, OverlayPiece piece);

/// A number with three significant digits, as an engineer writes it: 0.0123, 4.5·10⁻⁶.
QString short_number(double value);
/// Round values (1, 2, 5 times a power of ten) for about `wanted` ticks between the ends of a
/// scale.
std::vector<double> tick_values(const ColourScale& scale, int wanted);
/// The largest of 1, 2, 5 times a power of ten that is not above `most`.
double round_length(double most);

}  // namespace arris::ui
