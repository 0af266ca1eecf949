#include "ui/panels/profile_chart.h"

#include <algorithm>
#include <cmath>

#include <QPainter>

#include "ui/panels/controls.h"
#include "ui/panels/histogram_axis.h"

namespace arris::ui {

namespace {

constexpr double least_span = 24.0;  // degrees: noise alone does not fill the chart
constexpr int gap = 4;               // pixels between texts and what they stand beside

/// Degrees that the chart spans.
ValueAxis turn_axis(const JumpProfile& profile) {
  double low = 0.0, high = 0.0;
  const auto take = [&](double turn) {
    low = std::min(low, turn);
    high = std::max(high, turn);
  };
  for (const JumpProfile::Dot& dot : profile.dots) take(dot.turn);
  for (const JumpProfile::Side& side : profile.sides)
    if (side.fitted) take(side.at_line);
  const double missing = std::max(0.0, least_span - (high - low));
  const double room = 0.08 * std::max(high - low, least_span);
  return {low - missing / 2.0 - room, high + missing / 2.0 + room, false};
}

QColor jump_colour(const QPalette& palette) {
  const bool dark = palette.color(QPalette::Base).lightness() < 128;
  return dark ? QColor(240, 150, 60) : QColor(200, 90, 0);
}

}  // namespace

ProfileChart::ProfileChart(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Turn of the surface across the edge"));
  setToolTip(tr(
      "How the normals turn across the edge, over the distance from it in mean edges. Each dot "
      "is the mean of the faces in half an edge. The straight lines go through the faces of "
      "either side, in the shaded strips; what they leave at the edge is the jump, what "
      "the sides turn besides is the surround. A sharp line is a jump, a fillet is two slopes."));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

void ProfileChart::set_profile(std::optional<JumpProfile> profile) {
  profile_ = std::move(profile);
  setAccessibleDescription(
      profile_ && profile_->fitted()
          ? tr("Jump %1°, turn between the sides %2°")
                .arg(shown_number(profile_->jump(), 3), shown_number(profile_->turn(), 3))
          : QString());
  update();
}

/// Where turns and distances lie in the plot, and its colours.
struct ProfileChart::Plot {
  QRect area;
  ValueAxis turns;
  int line;     ///< Height of a line of text.
  int numbers;  ///< Width of a number.
  QColor ground, ink, muted;

  double x_of(double distance) const {
    const ValueAxis distances{-JumpProfile::reach, JumpProfile::reach, false};
    return area.left() + distances.position(distance) * area.width();
  }
  double y_of(double turn) const { return area.bottom() - turns.position(turn) * area.height(); }
};

void ProfileChart::paintEvent(QPaintEvent*) {
  if (!profile_) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QFontMetrics metrics = fontMetrics();
  const int line = metrics.height();
  const int numbers = metrics.horizontalAdvance(QStringLiteral("−180"));
  const Plot plot{rect().adjusted(line + gap + numbers + gap, gap + line / 2, -gap - line / 2,
                                  -2 * line - 2 * gap),
                  turn_axis(*profile_),
                  line,
                  numbers,
                  palette().color(QPalette::Base),
                  palette().color(QPalette::Text),
                  muted_text(palette())};
  paint_axes(painter, plot);
  painter.setClipRect(plot.area.adjusted(-3, -3, 3, 3));
  paint_sides(painter, plot);
  if (profile_->fitted()) paint_jump(painter, plot);
}

void ProfileChart::paint_axes(QPainter& painter, const Plot& plot) const {
  const int line = plot.line;
  const int numbers = plot.numbers;
  const QColor &ground = plot.ground, &ink = plot.ink, &muted = plot.muted;
  painter.fillRect(plot.area, ground);
  for (const double side : {-1.0, 1.0}) {
    const double from = plot.x_of(side * profile_->near), to = plot.x_of(side * profile_->far);
    painter.fillRect(
        QRectF(std::min(from, to), plot.area.top(), std::abs(to - from), plot.area.height()),
        mix(ground, ink, 0.06));
  }

  // Axes.
  painter.setPen(muted);
  for (const double turn : tick_values(plot.turns, std::max(2, plot.area.height() / (2 * line)))) {
    const double y = plot.y_of(turn);
    painter.setPen(mix(ground, ink, turn == 0.0 ? 0.4 : 0.12));
    painter.drawLine(QPointF(plot.area.left(), y), QPointF(plot.area.right(), y));
    painter.setPen(muted);
    painter.drawText(QRectF(plot.area.left() - gap - numbers, y - line / 2.0, numbers, line),
                     Qt::AlignRight | Qt::AlignVCenter, shown_number(turn, 3));
  }
  for (int distance = -4; distance <= 4; distance += 2) {
    const double x = plot.x_of(distance);
    painter.drawLine(QPointF(x, plot.area.bottom()), QPointF(x, plot.area.bottom() + 3));
    painter.drawText(QRectF(x - numbers, plot.area.bottom() + gap, 2.0 * numbers, line),
                     Qt::AlignHCenter | Qt::AlignTop, shown_number(distance));
  }
  painter.drawText(QRect(plot.area.left(), height() - line - 1, plot.area.width(), line),
                   Qt::AlignCenter, tr("distance (edges)"));
  painter.save();
  painter.translate(0, plot.area.bottom());
  painter.rotate(-90.0);
  painter.drawText(QRect(0, 0, plot.area.height(), line), Qt::AlignCenter, tr("turn (°)"));
  painter.restore();
  painter.setPen(mix(ground, ink, 0.4));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(plot.area);
  painter.setPen(QPen(mix(ground, ink, 0.4), 1.0, Qt::DotLine));
  painter.drawLine(QPointF(plot.x_of(0.0), plot.area.top()),
                   QPointF(plot.x_of(0.0), plot.area.bottom()));
}

void ProfileChart::paint_sides(QPainter& painter, const Plot& plot) const {
  const QColor &ground = plot.ground, &ink = plot.ink;
  const QColor fit = palette().color(QPalette::Highlight);
  for (std::size_t k = 0; k < 2; ++k) {
    const JumpProfile::Side& side = profile_->sides[k];
    if (!side.fitted) continue;
    const auto at = [&](double t) {
      return QPointF(plot.x_of(k == 0 ? -t : t), plot.y_of(side.at_line + side.slope * t));
    };
    painter.setPen(QPen(fit, 1.6, Qt::DashLine));
    painter.drawLine(at(0.0), at(profile_->near));
    painter.setPen(QPen(fit, 2.2, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(at(profile_->near), at(profile_->far));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(mix(ground, ink, 0.75));
  for (const JumpProfile::Dot& dot : profile_->dots)
    painter.drawEllipse(QPointF(plot.x_of(dot.distance), plot.y_of(dot.turn)), 3.0, 3.0);
}

void ProfileChart::paint_jump(QPainter& painter, const Plot& plot) const {
  const int line = plot.line;
  const QColor& muted = plot.muted;
  // As far as it counts: lines that cross before they meet the edge leave none.
  const double middle = (profile_->sides[0].at_line + profile_->sides[1].at_line) / 2.0;
  const double half = profile_->jump() / 2.0;
  painter.setPen(QPen(jump_colour(palette()), 4.0, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(QPointF(plot.x_of(0.0), plot.y_of(middle - half)),
                   QPointF(plot.x_of(0.0), plot.y_of(middle + half)));
  // In the corner where the surface is not: a convex one rises to the right.
  const double top = half >= 0.0 ? plot.area.bottom() - 2 * line - gap : plot.area.top() + gap;
  const auto write = [&](int row, const QColor& colour, const QString& text) {
    painter.setPen(colour);
    const double left = plot.x_of(0.0) + 2 * gap;
    painter.drawText(QRectF(left, top + row * line, plot.area.right() - left, line),
                     Qt::AlignLeft | Qt::AlignVCenter, text);
  };
  const double surround = profile_->turn() - profile_->jump();
  write(1, muted, tr("surround %1°").arg(shown_number(half >= 0.0 ? surround : -surround, 3)));
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  write(0, jump_colour(palette()), tr("here %1°").arg(shown_number(std::abs(profile_->jump()), 3)));
}

}  // namespace arris::ui
