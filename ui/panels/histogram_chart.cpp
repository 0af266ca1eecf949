#include "ui/panels/histogram_chart.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <QFontMetrics>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <QWidget>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int gap = 6;            // between labels
constexpr int strip_height = 10;  // colour map under the axis
constexpr int reach = 6;          // pixels beside a handle's line that still catch it

}  // namespace

void HistogramChart::take(const Histogram& given) {
  histogram = given;
  const auto& edges = histogram.edges;
  bool good = edges.size() >= 2 && edges.size() == histogram.weights.size() + 1;
  for (std::size_t i = 0; good && i < edges.size(); ++i) {
    good = std::isfinite(edges[i]) && (i == 0 || edges[i] > edges[i - 1]);
  }
  axis = ValueAxis{};
  if (!good) {
    histogram.weights.clear();
    return;
  }
  axis.min = edges.front();
  axis.max = edges.back();
  axis.logarithmic = histogram.logarithmic && axis.max > 0.0;
  if (axis.logarithmic && axis.min <= 0.0) {
    const auto positive = std::find_if(edges.begin(), edges.end(), [](double e) { return e > 0; });
    axis.min = *positive < axis.max ? *positive : axis.max * 1e-6;
  }
}

QString HistogramChart::value_text(int i) const { return shown_number(handles[i].value); }

QString HistogramChart::reading_text(int i) const {
  return handles[i].reading ? handles[i].reading(handles[i].value) : QString();
}

bool HistogramChart::with_title() const { return widget->height() >= 120; }

QString HistogramChart::tick_text(double count) { return count_text(std::llround(count)); }

QFont HistogramChart::name_font() const {
  QFont font = widget->font();
  font.setBold(true);
  return font;
}

int HistogramChart::label_width(int i, bool with_reading) const {
  const QFontMetrics plain(widget->font());
  int width = QFontMetrics(name_font()).horizontalAdvance(handles[i].name) +
              plain.horizontalAdvance(QStringLiteral("  ") + value_text(i)) + 18;
  if (const QString reading = reading_text(i); with_reading && !reading.isEmpty()) {
    width += plain.horizontalAdvance(QStringLiteral("   ") + reading);
  }
  return width;
}

double HistogramChart::most_count() const {
  double most = 1.0;
  for (const QPointF& point : curve.points) most = std::max(most, point.y());
  return 1.1 * most;
}

int HistogramChart::curve_width(const QFontMetrics& metrics) const {
  if (curve.label.isEmpty()) return 0;
  return std::max(metrics.horizontalAdvance(tick_text(most_count())),
                  metrics.horizontalAdvance(QStringLiteral("1,000"))) +
         4;
}

QColor HistogramChart::curve_colour() const {
  const bool dark = widget->palette().color(QPalette::Base).lightness() < 128;
  return dark ? QColor(229, 160, 84) : QColor(178, 92, 10);
}

int HistogramChart::curve_y(double count, const QRect& plot) const {
  const double share = std::log10(1.0 + count) / std::log10(1.0 + most_count());
  return plot.bottom() - static_cast<int>(std::lround(share * (plot.height() - 3)));
}

void HistogramChart::paint_plateau(QPainter& painter, const QRect& plot) const {
  if (curve.points.empty() || !curve.plateau) return;
  const int from = line_x(curve.plateau->first, plot), to = line_x(curve.plateau->second, plot);
  QColor colour = curve_colour();
  colour.setAlpha(50);
  painter.fillRect(QRect(from, plot.top(), std::max(to - from, 1), plot.height()), colour);
}

void HistogramChart::paint_curve(QPainter& painter, const QRect& plot) const {
  if (curve.label.isEmpty()) return;
  const QPalette& palette = widget->palette();
  const QFontMetrics metrics(widget->font());
  const QColor colour = curve_colour();
  if (curve.points.empty()) {
    painter.setPen(muted_text(palette));
    painter.drawText(plot.adjusted(6, 2, -6, -2), Qt::AlignRight | Qt::AlignTop,
                     curve.label + QStringLiteral(" …"));
    return;
  }
  QPolygonF line;
  for (const QPointF& point : curve.points)
    if (point.x() >= axis.min && point.x() <= axis.max)
      line << QPointF(line_x(point.x(), plot) + 0.5, curve_y(point.y(), plot) + 0.5);
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setClipRect(plot);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(palette.color(QPalette::Base), 3.5));  // a rim, to stand out from the bars
  painter.drawPolyline(line);
  painter.setPen(QPen(colour, 1.6));
  painter.drawPolyline(line);
  painter.setClipping(false);
  painter.setRenderHint(QPainter::Antialiasing, false);

  painter.setPen(colour);
  const double most = most_count();
  // 0 at the bottom, then powers of ten as far as they have room.
  int free_above = widget->height();
  for (double count = 0.0; count <= most; count = count > 0.0 ? 10.0 * count : 1.0) {
    const int y = curve_y(count, plot);
    const QRect box(plot.right() + 4, y - metrics.height() / 2, widget->width() - plot.right() - 5,
                    metrics.height());
    painter.drawLine(plot.right() + 1, y, plot.right() + 3, y);
    if (box.bottom() > free_above) continue;
    painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter, tick_text(count));
    free_above = box.top();
  }
  const auto write = [&](const QString& text, QRect box, Qt::Alignment alignment) {
    box = metrics.boundingRect(box, alignment, text);
    painter.fillRect(box.adjusted(-3, 0, 3, 0), [&] {
      QColor ground = palette.color(QPalette::Base);
      ground.setAlpha(200);
      return ground;
    }());
    painter.drawText(box, alignment, text);
  };
  const QRect text = plot.adjusted(6, 2, -6, -2);
  write(curve.label, text, Qt::AlignRight | Qt::AlignTop);
  if (!curve.plateau) return;
  const int middle = (line_x(curve.plateau->first, plot) + line_x(curve.plateau->second, plot)) / 2;
  const int width = metrics.horizontalAdvance(curve.plateau_text);
  const int room = metrics.horizontalAdvance(curve.label) + 16;
  if (text.width() < width + room) return;
  // Over the plateau, or as near to it as no handle's line crosses the words.
  const int most_left = std::max(text.left(), text.right() - room - width);
  const int wanted = std::clamp(middle - width / 2, text.left(), most_left);
  constexpr int clear = 7;
  std::vector<int> places{wanted};
  for (int i = 0; i < static_cast<int>(handles.size()); ++i) {
    places.push_back(line_x(i, plot) + clear);
    places.push_back(line_x(i, plot) - clear - width);
  }
  const auto is_free = [&](int place) {
    if (place < text.left() || place > most_left) return false;
    for (int i = 0; i < static_cast<int>(handles.size()); ++i)
      if (const int x = line_x(i, plot); x > place - clear && x < place + width + clear)
        return false;
    return true;
  };
  std::erase_if(places, [&](int place) { return !is_free(place); });
  const auto nearest = std::ranges::min_element(
      places, {}, [wanted](int place) { return std::abs(place - wanted); });
  const int left = nearest == places.end() ? wanted : *nearest;
  write(curve.plateau_text, QRect(left, text.top(), width + 1, metrics.height()),
        Qt::AlignLeft | Qt::AlignTop);
}

std::array<int, 2> HistogramChart::decades() const {
  double least = 1.0, most = 0.0;
  for (const double w : histogram.weights) {
    if (!(w > 0.0) || !std::isfinite(w)) continue;
    least = std::min(least, w);
    most = std::max(most, w);
  }
  if (most <= 0.0) return {-2, 0};
  const int last = static_cast<int>(std::ceil(std::log10(most) - 1e-9));
  const int first = static_cast<int>(std::floor(std::log10(0.7 * least)));
  return {std::clamp(first, last - 5, last - 1), last};
}

HistogramChart::Layout HistogramChart::layout() const {
  Layout result;
  const QFontMetrics metrics(widget->font());
  const int line = metrics.height();
  const int count = static_cast<int>(handles.size());
  const int width = widget->width() - 2 * margin;

  int widest = 0;
  const auto [first, last] = decades();
  for (int d = first; d <= last; ++d) {
    widest = std::max(widest, metrics.horizontalAdvance(percent_text(std::pow(10.0, d))));
  }
  result.plot.setLeft(margin + widest + 8);
  result.plot.setRight(widget->width() - margin - 6 - curve_width(metrics));

  std::vector<int> widths(count), order(count);
  result.with_reading.resize(count);
  for (int i = 0; i < count; ++i) {
    result.with_reading[i] = label_width(i, true) <= width;
    widths[i] = std::min(label_width(i, result.with_reading[i]), width);
  }
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return axis.position(handles[a].value) < axis.position(handles[b].value);
  });
  // As few rows as hold them: neighbours go to different rows in turn.
  int rows = std::min(count, 1);
  for (; rows < count; ++rows) {
    std::vector<int> used(rows, -gap);
    int row = 0;
    for (const int i : order) used[row++ % rows] += widths[i] + gap;
    if (*std::max_element(used.begin(), used.end()) <= width) break;
  }
  const int label_height = line + 6;
  const int top = margin + rows * (label_height + 3);
  const int below = 5 + line + (with_title() ? line + 2 : 0) + margin - 2;
  result.plot.setTop(top + 4);
  result.plot.setBottom(std::max(widget->height() - below - strip_height - 2, top + 12));
  result.strip =
      QRect(result.plot.left(), result.plot.bottom() + 2, result.plot.width(), strip_height);

  result.labels.resize(count);
  for (int row = 0; row < rows; ++row) {
    std::vector<int> members;
    for (int k = row; k < count; k += rows) members.push_back(order[k]);
    int left = margin;
    for (const int i : members) {
      const int wanted = line_x(i, result.plot) - widths[i] / 2;
      left = std::max(left, wanted);
      result.labels[i] = QRect(left, margin + row * (label_height + 3), widths[i], label_height);
      left += widths[i] + gap;
    }
    int right = widget->width() - margin;
    for (auto member = members.rbegin(); member != members.rend(); ++member) {
      QRect& label = result.labels[*member];
      if (label.x() + label.width() > right) label.moveLeft(right - label.width());
      right = label.x() - gap;
    }
  }
  return result;
}

int HistogramChart::line_x(double value, const QRect& plot) const {
  const double position = std::clamp(axis.position(value), 0.0, 1.0);
  return plot.left() + static_cast<int>(std::lround(position * (plot.width() - 1)));
}

double HistogramChart::value_at(double x, const QRect& plot) const {
  return axis.value((x - plot.left()) / std::max(plot.width() - 1, 1));
}

int HistogramChart::handle_at(const QPoint& point, const Layout& at) const {
  for (int i = 0; i < static_cast<int>(handles.size()); ++i) {
    if (at.labels[i].contains(point)) return i;
  }
  if (point.y() < at.plot.top() - 4 || point.y() > at.strip.bottom() + 8) return -1;
  int best = -1, best_distance = reach + 1;
  for (int i = 0; i < static_cast<int>(handles.size()); ++i) {
    const int x = line_x(i, at.plot);
    const int distance = std::abs(point.x() - x);
    // Of two on one spot, the one that has room to move away.
    const bool tie_to_later = x < at.plot.center().x();
    if (distance < best_distance || (distance == best_distance && best >= 0 && tie_to_later)) {
      best = i;
      best_distance = distance;
    }
  }
  return best;
}

QString HistogramChart::range_text(std::size_t bin) const {
  return QStringLiteral("%1 – %2").arg(shown_number(histogram.edges[bin]),
                                       shown_number(histogram.edges[bin + 1]));
}

std::optional<std::size_t> HistogramChart::bin_at(int x, const QRect& plot) const {
  if (!shown() || x < plot.left() || x > plot.right()) return std::nullopt;
  const double value = value_at(x + 0.5, plot);
  const auto& edges = histogram.edges;
  const auto above = std::upper_bound(edges.begin(), edges.end(), value);
  const auto index = std::distance(edges.begin(), above) - 1;
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(index, 0, std::ssize(histogram.weights) - 1));
}

void HistogramChart::paint_bars(QPainter& painter, const QRect& plot, const QColor& colour) const {
  const auto [first, last] = decades();
  // Between all bars or none: some of them a pixel wider would be parted and others not.
  const int gap = plot.width() >= 6 * static_cast<int>(histogram.weights.size()) ? 1 : 0;
  for (std::size_t i = 0; i < histogram.weights.size(); ++i) {
    const double weight = histogram.weights[i];
    if (!(weight > 0.0) || !std::isfinite(weight)) continue;
    const int left = line_x(histogram.edges[i], plot);
    const int width = std::max(line_x(histogram.edges[i + 1], plot) - left - gap, 1);
    const double share = std::clamp((std::log10(weight) - first) / (last - first), 0.0, 1.0);
    const int height = std::max(static_cast<int>(std::lround(share * (plot.height() - 1))), 1);
    painter.fillRect(left, plot.bottom() + 1 - height, width, height, colour);
  }
}

void HistogramChart::paint_area_axis(QPainter& painter, const QRect& plot) const {
  const QPalette& palette = widget->palette();
  const QFontMetrics metrics(widget->font());
  const auto [first, last] = decades();
  const double decade_height = double(plot.height() - 1) / (last - first);
  const int stride =
      std::max(1, static_cast<int>(std::ceil((metrics.height() + 2) / decade_height)));
  for (int d = last; d >= first; d -= stride) {
    const int y = plot.bottom() - static_cast<int>(std::lround((d - first) * decade_height));
    painter.setPen(mix(palette.color(QPalette::Base), palette.color(QPalette::Text), 0.14));
    if (d > first) painter.drawLine(plot.left(), y, plot.right(), y);
    painter.setPen(muted_text(palette));
    const QRect box(0, y - metrics.height() / 2, plot.left() - 6, metrics.height());
    painter.drawText(box, Qt::AlignRight | Qt::AlignVCenter, percent_text(std::pow(10.0, d)));
  }
}

void HistogramChart::paint_value_axis(QPainter& painter, const Layout& at) const {
  const QPalette& palette = widget->palette();
  const QFontMetrics metrics(widget->font());
  painter.setPen(muted_text(palette));
  const int y = at.strip.bottom() + 1;
  int free_from = 0;
  for (const double tick : tick_values(axis, at.plot.width() / 80)) {
    const QString text = shown_number(tick);
    const int x = line_x(tick, at.plot);
    const int width = metrics.horizontalAdvance(text);
    const int left = std::clamp(x - width / 2, 0, std::max(0, widget->width() - width - 3));
    painter.drawLine(x, y, x, y + 3);
    if (left < free_from) continue;
    painter.drawText(QRect(left, y + 5, width + 1, metrics.height()), Qt::AlignLeft, text);
    free_from = left + width + 10;
  }
  if (!with_title()) return;
  const QString note = QObject::tr("share of the area in each bin, logarithmic");
  const QRect box(at.plot.left(), y + 5 + metrics.height(), at.plot.width(), metrics.height() + 2);
  const int title_width = std::min(metrics.horizontalAdvance(histogram.title), box.width());
  const int note_width = metrics.horizontalAdvance(note);
  painter.setPen(palette.color(QPalette::WindowText));
  painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter,
                   metrics.elidedText(histogram.title, Qt::ElideRight, box.width()));
  if (title_width + 24 + note_width > box.width()) return;
  painter.setPen(muted_text(palette));
  painter.drawText(box, Qt::AlignRight | Qt::AlignVCenter, note);
}

void HistogramChart::paint_strip(QPainter& painter, const QRect& strip) const {
  QImage colours(strip.width(), 1, QImage::Format_RGB32);
  for (int x = 0; x < strip.width(); ++x) {
    const auto c = scale.colour(value_at(strip.left() + x, strip));
    colours.setPixel(x, 0, qRgb(c[0], c[1], c[2]));
  }
  painter.drawImage(strip, colours);
}

void HistogramChart::paint_handle(QPainter& painter, int i, const Layout& at) const {
  const QPalette& palette = widget->palette();
  const bool active = widget->hasFocus() && focused == i;
  const bool near = hovered == i || held == i;
  const QColor ink =
      active || near ? palette.color(QPalette::Highlight) : palette.color(QPalette::Text);
  const QColor paper = palette.color(QPalette::Base);
  const QRect& label = at.labels[i];
  const int x = line_x(i, at.plot);

  painter.setRenderHint(QPainter::Antialiasing, true);
  const double inset = std::min(6.0, 0.5 * (label.width() - 1));  // of a narrow panel's labels less
  const double middle = std::clamp<double>(x, label.left() + inset, label.right() - inset) + 0.5;
  const QPointF foot(x + 0.5, at.plot.top() - 1);
  QPainterPath path(QPointF(middle, label.bottom() + 1));
  if (std::abs(middle - foot.x()) < 1.0) path.moveTo(foot.x(), label.bottom() + 1);
  path.lineTo(foot);
  path.lineTo(foot.x(), at.strip.bottom());
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(paper, 4.0));
  painter.drawPath(path);
  painter.setPen(QPen(ink, active || near ? 2.0 : 1.4));
  painter.drawPath(path);

  // The grip is a pointer on the colour strip, bent outwards where the value lies off the axis.
  const double top = at.strip.top() - 4.0, bottom = at.strip.bottom() + 2.5;
  QPolygonF grip{
      {x + 0.5, top}, {x + 6.5, top + 7}, {x + 6.5, bottom}, {x - 5.5, bottom}, {x - 5.5, top + 7}};
  if (handles[i].value < axis.min || handles[i].value > axis.max) {
    const double side = handles[i].value < axis.min ? -1.0 : 1.0;
    const double centre = (top + bottom) / 2;
    grip = QPolygonF{
        {x + 0.5 + side * 6, centre}, {x + 0.5 - side * 5, top}, {x + 0.5 - side * 5, bottom}};
  }
  painter.setPen(QPen(paper, 3.5));
  painter.drawPolygon(grip);
  painter.setPen(QPen(ink, 1.4));
  painter.setBrush(paper);
  painter.drawPolygon(grip);
}

void HistogramChart::paint_label(QPainter& painter, int i, const Layout& at) const {
  const QPalette& palette = widget->palette();
  const bool active = widget->hasFocus() && focused == i;
  const bool near = hovered == i || held == i;
  const QColor paper = palette.color(QPalette::Base);
  const QColor ink = palette.color(QPalette::Text);
  const QColor accent = palette.color(QPalette::Highlight);
  const QRectF box = QRectF(at.labels[i]).adjusted(1, 1, -1, -1);
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setPen(active ? QPen(accent, 2.0) : QPen(near ? accent : mix(paper, ink, 0.45), 1.0));
  painter.setBrush(near ? mix(paper, accent, 0.12) : paper);
  painter.drawRoundedRect(box, 4, 4);
  painter.setRenderHint(QPainter::Antialiasing, false);

  QRect text = at.labels[i].adjusted(7, 0, -7, 0);
  const auto write = [&](const QFont& font, const QColor& colour, const QString& words) {
    const QFontMetrics metrics(font);
    painter.setFont(font);
    painter.setPen(colour);
    painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(words, Qt::ElideRight, text.width()));
    text.setLeft(text.left() + metrics.horizontalAdvance(words));
  };
  write(name_font(), ink, handles[i].name);
  write(widget->font(), ink, QStringLiteral("  ") + value_text(i));
  if (const QString reading = reading_text(i); at.with_reading[i] && !reading.isEmpty()) {
    write(widget->font(), mix(ink, paper, 0.32), QStringLiteral("   ") + reading);
  }
  painter.setFont(widget->font());
}

void HistogramChart::paint(QPainter& painter) const {
  const QPalette& palette = widget->palette();
  const Layout at = layout();
  const QColor base = palette.color(QPalette::Base);
  const QColor highlight = palette.color(QPalette::Highlight);
  painter.fillRect(widget->rect(), palette.color(QPalette::Window));
  painter.fillRect(at.plot, base);
  if (!shown()) {
    painter.setPen(muted_text(palette));
    painter.drawText(
        at.plot, Qt::AlignCenter | Qt::TextWordWrap,
        histogram.why_none.isEmpty() ? QObject::tr("No distribution to show") : histogram.why_none);
    return;
  }
  // Kmin and Kmax: what lies between them is what would be found.
  QRect inside;
  if (handles.size() == 2) {
    const auto [low, high] = std::minmax({line_x(0, at.plot), line_x(1, at.plot)});
    inside = QRect(low, at.plot.top(), high - low + 1, at.plot.height());
    painter.fillRect(inside, mix(base, highlight, 0.13));
  }
  paint_area_axis(painter, at.plot);
  paint_bars(painter, at.plot, mix(base, palette.color(QPalette::Text), 0.42));
  if (!inside.isEmpty()) {
    painter.setClipRect(inside);
    paint_bars(painter, at.plot, mix(highlight, palette.color(QPalette::Text), 0.1));
    painter.setClipping(false);
  }
  paint_plateau(painter, at.plot);
  paint_curve(painter, at.plot);
  paint_strip(painter, at.strip);
  paint_value_axis(painter, at);
  const int count = static_cast<int>(handles.size());
  for (int i = 0; i < count; ++i) {
    if (i != focused) paint_handle(painter, i, at);
  }
  if (valid(focused)) paint_handle(painter, focused, at);
  for (int i = 0; i < count; ++i) paint_label(painter, i, at);
}

}  // namespace arris::ui
