#include "ui/view/tool_overlay.h"

#include <algorithm>

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QPainter>

namespace arris::ui {
namespace {

constexpr double ring_radius = 7.0;
constexpr double inset = 7.0;
const QColor ink(20, 26, 36);
const QColor accent(0, 122, 204);  // of what the user draws
const QColor mark_colour(214, 0, 90);

QFont text_font(bool bold) {
  QFont font;
  font.setPixelSize(12);  // the painter scales, so points per inch must not come in
  if (bold) font.setWeight(QFont::DemiBold);
  return font;
}

/// A box of text beside a point, inside the view.
QRectF box_of(const QStringList& lines, const QPointF& beside, QSizeF view) {
  double width = 0.0;
  for (int k = 0; k < lines.size(); ++k)
    width = std::max(width, QFontMetricsF(text_font(k == 0)).horizontalAdvance(lines[k]));
  const double line = QFontMetricsF(text_font(false)).height();
  const QSizeF size(width + 2 * inset, line * static_cast<double>(lines.size()) + inset);
  constexpr double away = 14.0;
  double x = beside.x() + away;
  if (x + size.width() > view.width() - 4.0) x = beside.x() - away - size.width();
  const double y = beside.y() - away - size.height();
  return {std::clamp(x, 4.0, std::max(4.0, view.width() - 4.0 - size.width())),
          std::clamp(y, 4.0, std::max(4.0, view.height() - 4.0 - size.height())), size.width(),
          size.height()};
}

void paint_box(QPainter& painter, const QRectF& box, const QStringList& lines, bool dark) {
  painter.setPen(QPen(dark ? QColor(255, 255, 255, 60) : QColor(20, 30, 50, 70), 1.0));
  painter.setBrush(dark ? QColor(38, 41, 47, 236) : QColor(255, 255, 255, 240));
  painter.drawRoundedRect(box, 5.0, 5.0);
  painter.setPen(dark ? QColor(232, 235, 240) : ink);
  const double line = QFontMetricsF(text_font(false)).height();
  double y = box.top() + inset / 2;
  for (int k = 0; k < lines.size(); ++k, y += line) {
    painter.setFont(text_font(k == 0));
    painter.drawText(QRectF(box.left() + inset, y, box.width(), line),
                     Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine | Qt::TextDontClip,
                     lines[k]);
  }
}

/// Dark and light together stand out from any colour of the surface.
template <class Draw>
void paint_twice(QPainter& painter, const QColor& colour, double width, Qt::PenStyle style,
                 const Draw& draw) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(
      QPen(QColor(255, 255, 255, 225), width + 2.2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  draw();
  painter.setPen(QPen(colour, width, style, Qt::RoundCap, Qt::RoundJoin));
  draw();
}

void paint_dot(QPainter& painter, const QPointF& at, const QColor& colour) {
  painter.setPen(QPen(Qt::white, 1.6));
  painter.setBrush(colour);
  painter.drawEllipse(at, 4.0, 4.0);
}

QString mark_text(const ToolOverlay::Mark& mark) {
  return mark.behind
             ? QCoreApplication::translate("arris::ui::ToolOverlay", "%1 (behind)").arg(mark.text)
             : mark.text;
}

QPointF measured_place(const ToolOverlay& tools) {
  return tools.measured.size() < 2 ? tools.measured.front()
                                   : (tools.measured[0] + tools.measured[1]) / 2;
}

}  // namespace

void paint_tools(QPainter& painter, QSizeF size, const ToolOverlay& tools) {
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  if (tools.mark) {
    const ToolOverlay::Mark& mark = *tools.mark;
    paint_twice(painter, mark_colour, 2.0, mark.behind ? Qt::DotLine : Qt::SolidLine,
                [&] { painter.drawEllipse(mark.at, ring_radius, ring_radius); });
    const QStringList lines{mark_text(mark)};
    paint_box(painter, box_of(lines, mark.at, size), lines, tools.dark);
  }
  if (tools.ring.size() > 2)
    paint_twice(painter, accent, 1.6, Qt::SolidLine, [&] { painter.drawPolygon(tools.ring); });
  for (const QPointF& point : tools.points) paint_dot(painter, point, accent);
  if (tools.measured.size() == 2)
    paint_twice(painter, accent, 1.8, Qt::SolidLine,
                [&] { painter.drawLine(tools.measured[0], tools.measured[1]); });
  for (const QPointF& end : tools.measured) paint_dot(painter, end, accent);
  if (!tools.measured.empty() && !tools.measured_text.isEmpty())
    paint_box(painter, box_of(tools.measured_text, measured_place(tools), size),
              tools.measured_text, tools.dark);
  if (tools.band) {
    painter.fillRect(*tools.band, QColor(accent.red(), accent.green(), accent.blue(), 40));
    paint_twice(painter, accent, 1.4, Qt::SolidLine, [&] { painter.drawRect(*tools.band); });
  }
}

QRectF bounds_of(const ToolOverlay& tools, QSizeF size) {
  QRectF all;
  const auto add = [&](const QRectF& rect) { all = all.united(rect); };
  const auto add_point = [&](const QPointF& at) {
    add(QRectF(at.x() - 12.0, at.y() - 12.0, 24.0, 24.0));
  };
  if (tools.mark) {
    add_point(tools.mark->at);
    add(box_of({mark_text(*tools.mark)}, tools.mark->at, size));
  }
  for (const QPointF& point : tools.ring) add_point(point);
  for (const QPointF& point : tools.points) add_point(point);
  for (const QPointF& point : tools.measured) add_point(point);
  if (!tools.measured.empty() && !tools.measured_text.isEmpty())
    add(box_of(tools.measured_text, measured_place(tools), size));
  if (tools.band) add(*tools.band);
  if (all.isNull()) return {};
  return all.adjusted(-3.0, -3.0, 3.0, 3.0).intersected(QRectF(QPointF(), size));
}

}  // namespace arris::ui
