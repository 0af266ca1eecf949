#pragma once

#include <optional>
#include <vector>

#include <QImage>
#include <QPointF>
#include <QPolygonF>
#include <QRectF>
#include <QString>
#include <QStringList>

class QPainter;

namespace arris::ui {

/// What tools and marks draw over the part, in logical pixels of the view. It follows the pointer,
/// so it is a picture of its own, no larger than need be.
struct ToolOverlay {
  struct Mark {
    QPointF at;
    QString text;
    bool behind = false;  ///< The part hides the point.
    bool operator==(const Mark&) const = default;
  };
  bool dark = false;
  std::optional<QRectF> band;
  QPolygonF ring;  ///< Of the brush, closed.
  std::vector<QPointF> points;
  std::vector<QPointF> measured;  ///< Ends of the measured segment, none to two.
  QStringList measured_text;      ///< Beside the segment, line by line; the first is the main one.
  std::optional<Mark> mark;
  bool operator==(const ToolOverlay&) const = default;
};

/// Paints into a view of `size`.
void paint_tools(QPainter& painter, QSizeF size, const ToolOverlay& tools);

/// The part of the view that paint_tools() changes; null: nothing.
QRectF bounds_of(const ToolOverlay& tools, QSizeF size);

}  // namespace arris::ui
