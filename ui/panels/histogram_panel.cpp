#include "ui/panels/histogram_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <ranges>

#include <QFocusEvent>
#include <QHelpEvent>
#include <QImage>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QTimer>
#include <QToolTip>
#include <QWheelEvent>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int margin = 6;         // around everything
constexpr int gap = 6;            // between labels
constexpr int strip_height = 10;  // colour map under the axis
constexpr int reach = 6;          // pixels beside a handle's line that still catch it
constexpr int dead_zone = 3;      // a click or double click that trembles is no drag
constexpr int settle_time = 500;  // ms after the last key or turn of the wheel
constexpr double fine = 0.1;      // dragging with Shift

/// The value axis: increasing, finite and, where logarithmic, positive.
struct Axis {
  double min = 0.0, max = 1.0;
  bool logarithmic = false;

  double warp(double value) const { return logarithmic ? std::log10(value) : value; }
  /// 0 at min, 1 at max; values below a logarithmic axis are at 0.
  double position(double value) const {
    if (logarithmic && value <= min) return 0.0;
    return (warp(value) - warp(min)) / (warp(max) - warp(min));
  }
  double value(double position) const {
    const double warped = warp(min) + position * (warp(max) - warp(min));
    return logarithmic ? std::pow(10.0, warped) : warped;
  }
};

/// Step 1, 2 or 5 times a power of ten, not below `least`.
double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

/// At most about `count` readable numbers on the axis, increasing.
std::vector<double> tick_values(const Axis& axis, int count) {
  std::vector<double> ticks;
  count = std::max(count, 2);
  if (axis.logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(axis.min) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(axis.max) + 1e-9));
    const int decades = last - first + 1;
    if (decades >= 3) {
      const int stride = (decades + count - 1) / count;
      for (int d = first; d <= last; d += stride) ticks.push_back(std::pow(10.0, d));
      return ticks;
    }
    for (int d = first - 1; d <= last; ++d) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, d);
        if (value >= axis.min * (1 - 1e-9) && value <= axis.max * (1 + 1e-9)) {
          ticks.push_back(value);
        }
      }
    }
    if (ticks.size() >= 2) return ticks;
    ticks.clear();
  }
  const double step = nice_step((axis.max - axis.min) / count);
  const double first = std::ceil(axis.min / step - 1e-9);
  for (double k = first; k * step <= axis.max + 1e-9 * step && ticks.size() < 100; ++k) {
    ticks.push_back(k * step);
  }
  return ticks;
}

}  // namespace

class HistogramPanel::Private {
 public:
  explicit Private(HistogramPanel* panel) : q(panel) {}

  struct Move {
    enum class By { mouse, steps } by = By::mouse;
    int handle = 0;
    double original = 0.0;
    double x = 0.0;  // Where the line would be without any limit; mouse only.
    QPoint press, last;
    bool begun = false;  // Something was emitted.
  };

  /// Where things are; worked out from size, font and handles.
  struct Layout {
    QRect plot, strip;
    std::vector<QRect> labels;
    std::vector<bool> with_reading;
  };

  HistogramPanel* q;
  Histogram histogram;
  ColourScale scale;
  HistogramCurve curve;
  Axis axis;
  std::vector<ThresholdHandle> handles;
  int focused = 0;
  int hovered = -1;
  std::optional<Move> move;
  int wheel_rest = 0;
  QTimer* settle = nullptr;
  NumberEdit* editor = nullptr;
  int edited = -1;

  // The distribution has bins, they increase, and all is finite.
  bool shown() const { return !histogram.weights.empty(); }
  bool valid(int handle) const { return handle >= 0 && handle < static_cast<int>(handles.size()); }

  void take(const Histogram& given) {
    histogram = given;
    const auto& edges = histogram.edges;
    bool good = edges.size() >= 2 && edges.size() == histogram.weights.size() + 1;
    for (std::size_t i = 0; good && i < edges.size(); ++i) {
      good = std::isfinite(edges[i]) && (i == 0 || edges[i] > edges[i - 1]);
    }
    axis = Axis{};
    if (!good) {
      histogram.weights.clear();
      return;
    }
    axis.min = edges.front();
    axis.max = edges.back();
    axis.logarithmic = histogram.logarithmic && axis.max > 0.0;
    if (axis.logarithmic && axis.min <= 0.0) {
      const auto positive =
          std::find_if(edges.begin(), edges.end(), [](double e) { return e > 0; });
      axis.min = *positive < axis.max ? *positive : axis.max * 1e-6;
    }
  }

  // ---- layout ----

  QString value_text(int i) const { return number_text(handles[i].value); }

  QFont name_font() const {
    QFont font = q->font();
    font.setBold(true);
    return font;
  }

  int label_width(int i, bool with_reading) const {
    const QFontMetrics plain(q->font());
    int width = QFontMetrics(name_font()).horizontalAdvance(handles[i].name) +
                plain.horizontalAdvance(QStringLiteral("  ") + value_text(i)) + 18;
    if (with_reading && !handles[i].reading.isEmpty()) {
      width += plain.horizontalAdvance(QStringLiteral("   ") + handles[i].reading);
    }
    return width;
  }

  bool with_title() const { return q->height() >= 120; }

  // ---- the second curve ----

  /// Full height of its scale, which is logarithmic as the bars are: halving the count looks alike
  /// whatever the count.
  double most_count() const {
    double most = 1.0;
    for (const QPointF& point : curve.points) most = std::max(most, point.y());
    return 1.1 * most;
  }

  static QString tick_text(double count) { return count_text(std::llround(count)); }

  /// Room for its scale, the same for most counts so that nothing moves when the curve comes.
  int curve_width(const QFontMetrics& metrics) const {
    if (curve.label.isEmpty()) return 0;
    return std::max(metrics.horizontalAdvance(tick_text(most_count())),
                    metrics.horizontalAdvance(QStringLiteral("1,000"))) +
           4;
  }

  QColor curve_colour() const {
    const bool dark = q->palette().color(QPalette::Base).lightness() < 128;
    return dark ? QColor(229, 160, 84) : QColor(178, 92, 10);
  }

  int curve_y(double count, const QRect& plot) const {
    const double share = std::log10(1.0 + count) / std::log10(1.0 + most_count());
    return plot.bottom() - static_cast<int>(std::lround(share * (plot.height() - 3)));
  }

  void paint_plateau(QPainter& painter, const QRect& plot) const {
    if (curve.points.empty() || !curve.plateau) return;
    const int from = line_x(curve.plateau->first, plot), to = line_x(curve.plateau->second, plot);
    QColor colour = curve_colour();
    colour.setAlpha(50);
    painter.fillRect(QRect(from, plot.top(), std::max(to - from, 1), plot.height()), colour);
  }

  void paint_curve(QPainter& painter, const QRect& plot) const {
    if (curve.label.isEmpty()) return;
    const QPalette& palette = q->palette();
    const QFontMetrics metrics(q->font());
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
    int free_above = q->height();
    for (double count = 0.0; count <= most; count = count > 0.0 ? 10.0 * count : 1.0) {
      const int y = curve_y(count, plot);
      const QRect box(plot.right() + 4, y - metrics.height() / 2, q->width() - plot.right() - 5,
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
    const int middle =
        (line_x(curve.plateau->first, plot) + line_x(curve.plateau->second, plot)) / 2;
    const int width = metrics.horizontalAdvance(curve.plateau_text);
    const int room = metrics.horizontalAdvance(curve.label) + 16;
    const int left = std::clamp(middle - width / 2, text.left(),
                                std::max(text.left(), text.right() - room - width));
    write(curve.plateau_text, QRect(left, text.top(), width + 1, metrics.height()),
          Qt::AlignLeft | Qt::AlignTop);
  }

  /// Decades of the area axis: 10^first to 10^last, as shares.
  std::array<int, 2> decades() const {
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

  Layout layout() const {
    Layout result;
    const QFontMetrics metrics(q->font());
    const int line = metrics.height();
    const int count = static_cast<int>(handles.size());
    const int width = q->width() - 2 * margin;

    int widest = 0;
    const auto [first, last] = decades();
    for (int d = first; d <= last; ++d) {
      widest = std::max(widest, metrics.horizontalAdvance(percent_text(std::pow(10.0, d))));
    }
    result.plot.setLeft(margin + widest + 8);
    result.plot.setRight(q->width() - margin - 6 - curve_width(metrics));

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
    result.plot.setBottom(std::max(q->height() - below - strip_height - 2, top + 12));
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
      int right = q->width() - margin;
      for (const int i : members | std::views::reverse) {
        QRect& label = result.labels[i];
        if (label.x() + label.width() > right) label.moveLeft(right - label.width());
        right = label.x() - gap;
      }
    }
    return result;
  }

  int line_x(int i, const QRect& plot) const { return line_x(handles[i].value, plot); }
  int line_x(double value, const QRect& plot) const {
    const double position = std::clamp(axis.position(value), 0.0, 1.0);
    return plot.left() + static_cast<int>(std::lround(position * (plot.width() - 1)));
  }
  double value_at(double x, const QRect& plot) const {
    return axis.value((x - plot.left()) / std::max(plot.width() - 1, 1));
  }

  /// The handle under a point: its label, or its line within reach.
  int handle_at(const QPoint& point, const Layout& at) const {
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

  // ---- moving ----

  /// The value as it may be: rounded to what the label shows, and within the handle's range.
  double allowed(int i, double value) const {
    const ThresholdHandle& handle = handles[i];
    return std::clamp(round_significant(value), handle.least, handle.most);
  }

  void change(double value) {
    const int handle = move->handle;
    if (value == handles[handle].value) return;
    move->begun = true;
    handles[handle].value = value;
    q->update();
    emit q->threshold_dragged(handle, value);
  }

  void finish() {
    settle->stop();
    if (!move) return;
    const Move done = *move;
    move.reset();
    q->update();
    if (done.begun) emit q->threshold_finished(done.handle, handles[done.handle].value);
  }

  bool cancel() {
    settle->stop();
    if (!move) return false;
    const Move done = *move;
    move.reset();
    handles[done.handle].value = done.original;
    q->update();
    if (done.begun) emit q->threshold_cancelled(done.handle);
    return done.begun || done.by == Move::By::mouse;
  }

  void drag_to(const QPoint& point, bool finer) {
    const int dx = point.x() - move->last.x();
    if (!move->begun && std::abs(point.x() - move->press.x()) < dead_zone) return;
    move->last = point;
    move->x += finer ? fine * dx : dx;
    const QRect plot = layout().plot;
    const double x = std::clamp<double>(move->x, plot.left(), plot.right());
    const double least = handles[move->handle].least;
    const bool lowest = axis.logarithmic && least <= 0.0 && move->x <= plot.left();
    change(lowest ? least : allowed(move->handle, value_at(x, plot)));
  }

  /// One step of the keyboard or the wheel is a 200th of the axis, a large one a 20th.
  void step(int i, int direction, bool large) {
    if (move && (move->by == Move::By::mouse || move->handle != i)) finish();
    if (!move) move = Move{Move::By::steps, i, handles[i].value, 0.0, {}, {}, false};
    const double now = handles[i].value;
    const double span = axis.warp(axis.max) - axis.warp(axis.min);
    double next = now;
    if (axis.logarithmic) {
      const double from = std::max(now, axis.min);
      const bool lowest = direction < 0 && now <= axis.min;
      next = lowest ? handles[i].least
                    : from * std::pow(10.0, direction * span / (large ? 20.0 : 200.0));
    } else {
      const double size = nice_step(span / (large ? 20.0 : 200.0));
      next = now + direction * size;
    }
    const double rounded = allowed(i, next);
    // A step finer than four digits is still a step.
    change(rounded != now ? rounded : std::clamp(next, handles[i].least, handles[i].most));
    if (move) settle->start(settle_time);
  }

  // ---- typing ----

  void edit(int i, const QString& start) {
    finish();
    if (!valid(i)) return;
    edited = i;
    focused = i;
    QRect box = layout().labels[i];
    const int width = std::max(box.width(), QFontMetrics(q->font()).averageCharWidth() * 14);
    box.setWidth(width);
    box.moveLeft(std::clamp(box.left(), margin, std::max(margin, q->width() - margin - width)));
    editor->setGeometry(box.adjusted(0, -2, 0, 2));
    editor->set_mistake({});
    editor->set_help(
        QObject::tr("%1 from %2 to %3; Enter sets it, Esc leaves it as it was.")
            .arg(handles[i].name, number_text(handles[i].least), number_text(handles[i].most)));
    editor->setAccessibleName(handles[i].name);
    if (start.isEmpty()) {
      editor->setText(edit_text(handles[i].value, 10));
      editor->selectAll();
    } else {
      editor->setText(start);
    }
    editor->show();
    editor->setFocus();
    if (!start.isEmpty()) editor->end(false);
    q->update();
  }

  void close_editor() {
    if (edited < 0) return;
    edited = -1;
    const bool had_focus = editor->hasFocus();
    editor->hide();
    if (had_focus) q->setFocus();
    q->update();
  }

  /// False and the editor stays open, saying why, where the text is not a value of the handle.
  bool enter_text() {
    if (!valid(edited)) return true;
    const ThresholdHandle& handle = handles[edited];
    const auto value = parse_number(editor->text());
    if (!value || *value < handle.least || *value > handle.most) {
      const QString range =
          QObject::tr("from %1 to %2").arg(number_text(handle.least), number_text(handle.most));
      editor->set_mistake(
          value ? QObject::tr("%1 goes %2.").arg(handle.name, range)
                : QObject::tr("Type a number %1, with a point for the decimals.").arg(range));
      QToolTip::showText(editor->mapToGlobal(QPoint(0, editor->height())), editor->toolTip(),
                         editor);
      return false;
    }
    const int i = edited;
    const bool changed = *value != handle.value;
    handles[i].value = *value;
    close_editor();
    if (changed) emit q->threshold_finished(i, *value);
    return true;
  }

  // ---- painting ----

  QString range_text(std::size_t bin) const {
    return QStringLiteral("%1 – %2").arg(number_text(histogram.edges[bin]),
                                         number_text(histogram.edges[bin + 1]));
  }

  std::optional<std::size_t> bin_at(int x, const QRect& plot) const {
    if (!shown() || x < plot.left() || x > plot.right()) return std::nullopt;
    const double value = value_at(x + 0.5, plot);
    const auto& edges = histogram.edges;
    const auto above = std::upper_bound(edges.begin(), edges.end(), value);
    const auto index = std::distance(edges.begin(), above) - 1;
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(index, 0, std::ssize(histogram.weights) - 1));
  }

  void paint_bars(QPainter& painter, const QRect& plot, const QColor& colour) const {
    const auto [first, last] = decades();
    for (std::size_t i = 0; i < histogram.weights.size(); ++i) {
      const double weight = histogram.weights[i];
      if (!(weight > 0.0) || !std::isfinite(weight)) continue;
      const int left = line_x(histogram.edges[i], plot);
      int width = line_x(histogram.edges[i + 1], plot) - left;
      width = std::max(width >= 5 ? width - 1 : width, 1);
      const double share = std::clamp((std::log10(weight) - first) / (last - first), 0.0, 1.0);
      const int height = std::max(static_cast<int>(std::lround(share * (plot.height() - 1))), 1);
      painter.fillRect(left, plot.bottom() + 1 - height, width, height, colour);
    }
  }

  void paint_area_axis(QPainter& painter, const QRect& plot) const {
    const QPalette& palette = q->palette();
    const QFontMetrics metrics(q->font());
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

  void paint_value_axis(QPainter& painter, const Layout& at) const {
    const QPalette& palette = q->palette();
    const QFontMetrics metrics(q->font());
    painter.setPen(muted_text(palette));
    const int y = at.strip.bottom() + 1;
    int free_from = 0;
    for (const double tick : tick_values(axis, at.plot.width() / 80)) {
      const QString text = number_text(tick);
      const int x = line_x(tick, at.plot);
      const int width = metrics.horizontalAdvance(text);
      const int left = std::clamp(x - width / 2, 0, std::max(0, q->width() - width - 3));
      painter.drawLine(x, y, x, y + 3);
      if (left < free_from) continue;
      painter.drawText(QRect(left, y + 5, width + 1, metrics.height()), Qt::AlignLeft, text);
      free_from = left + width + 10;
    }
    if (!with_title()) return;
    const QString note = QObject::tr("share of the area in each bin, logarithmic");
    const QRect box(at.plot.left(), y + 5 + metrics.height(), at.plot.width(),
                    metrics.height() + 2);
    const int title_width = std::min(metrics.horizontalAdvance(histogram.title), box.width());
    const int note_width = metrics.horizontalAdvance(note);
    painter.setPen(palette.color(QPalette::WindowText));
    painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(histogram.title, Qt::ElideRight, box.width()));
    if (title_width + 24 + note_width > box.width()) return;
    painter.setPen(muted_text(palette));
    painter.drawText(box, Qt::AlignRight | Qt::AlignVCenter, note);
  }

  void paint_strip(QPainter& painter, const QRect& strip) const {
    QImage colours(strip.width(), 1, QImage::Format_RGB32);
    for (int x = 0; x < strip.width(); ++x) {
      const auto c = scale.colour(value_at(strip.left() + x, strip));
      colours.setPixel(x, 0, qRgb(c[0], c[1], c[2]));
    }
    painter.drawImage(strip, colours);
  }

  void paint_handle(QPainter& painter, int i, const Layout& at) const {
    const QPalette& palette = q->palette();
    const bool active = q->hasFocus() && focused == i;
    const bool near = hovered == i || (move && move->handle == i);
    const QColor ink =
        active || near ? palette.color(QPalette::Highlight) : palette.color(QPalette::Text);
    const QColor paper = palette.color(QPalette::Base);
    const QRect& label = at.labels[i];
    const int x = line_x(i, at.plot);

    painter.setRenderHint(QPainter::Antialiasing, true);
    const double middle = std::clamp<double>(x, label.left() + 6, label.right() - 6) + 0.5;
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
    QPolygonF grip{{x + 0.5, top},
                   {x + 6.5, top + 7},
                   {x + 6.5, bottom},
                   {x - 5.5, bottom},
                   {x - 5.5, top + 7}};
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

  void paint_label(QPainter& painter, int i, const Layout& at) const {
    const QPalette& palette = q->palette();
    const bool active = q->hasFocus() && focused == i;
    const bool near = hovered == i || (move && move->handle == i);
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
    write(q->font(), ink, QStringLiteral("  ") + value_text(i));
    if (at.with_reading[i] && !handles[i].reading.isEmpty()) {
      write(q->font(), mix(ink, paper, 0.32), QStringLiteral("   ") + handles[i].reading);
    }
    painter.setFont(q->font());
  }

  void paint(QPainter& painter) const {
    const QPalette& palette = q->palette();
    const Layout at = layout();
    const QColor base = palette.color(QPalette::Base);
    const QColor highlight = palette.color(QPalette::Highlight);
    painter.fillRect(q->rect(), palette.color(QPalette::Window));
    painter.fillRect(at.plot, base);
    if (!shown()) {
      painter.setPen(muted_text(palette));
      painter.drawText(at.plot, Qt::AlignCenter | Qt::TextWordWrap,
                       QObject::tr("No distribution to show"));
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

  void hover(int handle) {
    if (handle == hovered) return;
    hovered = handle;
    if (valid(handle)) {
      q->setCursor(Qt::SizeHorCursor);
    } else {
      q->unsetCursor();
    }
    q->update();
  }

  void announce() {
    if (!valid(focused)) return;
    q->setAccessibleDescription(
        QStringLiteral("%1 %2 %3")
            .arg(handles[focused].name, value_text(focused), handles[focused].reading));
  }
};

HistogramPanel::HistogramPanel(QWidget* parent)
    : QWidget(parent), p_(std::make_unique<Private>(this)) {
  setMouseTracking(true);
  setAccessibleName(tr("Histogram with thresholds"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  p_->settle = new QTimer(this);
  p_->settle->setSingleShot(true);
  connect(p_->settle, &QTimer::timeout, this, [this] { p_->finish(); });
  p_->editor = new NumberEdit(this);
  p_->editor->hide();
  p_->editor->installEventFilter(this);
}

HistogramPanel::~HistogramPanel() = default;

void HistogramPanel::set_histogram(const Histogram& histogram, const ColourScale& scale) {
  p_->take(histogram);
  p_->scale = scale;
  if (p_->move) p_->move->x = p_->line_x(p_->move->handle, p_->layout().plot);
  update();
}

void HistogramPanel::set_curve(HistogramCurve curve) {
  p_->curve = std::move(curve);
  if (p_->move) p_->move->x = p_->line_x(p_->move->handle, p_->layout().plot);
  update();
}

const HistogramCurve& HistogramPanel::curve() const { return p_->curve; }

void HistogramPanel::set_handles(std::vector<ThresholdHandle> handles) {
  const bool same = std::equal(
      handles.begin(), handles.end(), p_->handles.begin(), p_->handles.end(),
      [](const ThresholdHandle& a, const ThresholdHandle& b) { return a.name == b.name; });
  if (!same) {
    p_->settle->stop();
    p_->move.reset();
    p_->close_editor();
    p_->hovered = -1;
    p_->focused = 0;
  } else if (p_->move) {
    handles[p_->move->handle].value = p_->handles[p_->move->handle].value;
  }
  for (ThresholdHandle& handle : handles) handle.most = std::max(handle.least, handle.most);
  p_->handles = std::move(handles);
  setFocusPolicy(p_->handles.empty() ? Qt::NoFocus : Qt::StrongFocus);
  p_->announce();
  update();
}

const std::vector<ThresholdHandle>& HistogramPanel::handles() const { return p_->handles; }

QPoint HistogramPanel::handle_position(int handle) const {
  const QRect plot = p_->layout().plot;
  return p_->valid(handle) ? QPoint(p_->line_x(handle, plot), plot.center().y()) : QPoint();
}

QRect HistogramPanel::label_rectangle(int handle) const {
  return p_->valid(handle) ? p_->layout().labels[handle] : QRect();
}

QSize HistogramPanel::sizeHint() const { return QSize(900, 180); }
QSize HistogramPanel::minimumSizeHint() const {
  return QSize(240, 6 * fontMetrics().height() + 24);
}

bool HistogramPanel::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    // Keys that mean something here are not to set off a shortcut of the window.
    auto* key = static_cast<QKeyEvent*>(event);
    const bool typed =
        key->text().size() == 1 && QStringLiteral("0123456789.-").contains(key->text());
    const bool steps = key->key() == Qt::Key_Left || key->key() == Qt::Key_Right ||
                       key->key() == Qt::Key_Up || key->key() == Qt::Key_Down;
    const bool plain = !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    if ((key->key() == Qt::Key_Escape && p_->move) ||
        (p_->valid(p_->focused) && plain && (typed || steps))) {
      event->accept();
      return true;
    }
  }
  if (event->type() == QEvent::ToolTip) {
    const QPoint point = static_cast<QHelpEvent*>(event)->pos();
    const Private::Layout at = p_->layout();
    const int handle = p_->handle_at(point, at);
    const auto bin = p_->bin_at(point.x(), at.plot);
    const bool over = at.plot.united(at.strip).contains(point);
    QString text;
    if (handle >= 0) {
      const ThresholdHandle& h = p_->handles[handle];
      text = tr("<b>%1</b> %2 %3<br>%4<br><i>Drag, or double-click to type. Shift: finer.</i>")
                 .arg(h.name.toHtmlEscaped(), number_text(h.value), h.reading.toHtmlEscaped(),
                      h.tooltip.toHtmlEscaped());
    } else if (bin && over) {
      text = tr("%1\n%2 of the area")
                 .arg(p_->range_text(*bin), percent_text(p_->histogram.weights[*bin]));
    }
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, this,
                       QRect(point - QPoint(2, 2), QSize(5, 5)));
    return true;
  }
  return QWidget::event(event);
}

bool HistogramPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched != p_->editor || p_->edited < 0) return QWidget::eventFilter(watched, event);
  if (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
    if (enter || key == Qt::Key_Escape) {
      event->accept();
      if (event->type() == QEvent::ShortcutOverride) return true;
      if (enter) {
        p_->enter_text();
      } else {
        p_->close_editor();
      }
      return true;
    }
  }
  if (event->type() == QEvent::FocusOut) {
    // Looking something up in another window is no answer yet.
    const auto reason = static_cast<QFocusEvent*>(event)->reason();
    if (reason != Qt::ActiveWindowFocusReason && reason != Qt::PopupFocusReason &&
        !p_->enter_text()) {
      p_->close_editor();
    }
  }
  return QWidget::eventFilter(watched, event);
}

bool HistogramPanel::focusNextPrevChild(bool next) {
  if (p_->edited >= 0) {
    if (!p_->enter_text()) return true;
    setFocus();
  }
  const int to = p_->focused + (next ? 1 : -1);
  if (!hasFocus() || !p_->valid(to)) return QWidget::focusNextPrevChild(next);
  p_->finish();
  p_->focused = to;
  p_->announce();
  update();
  return true;
}

void HistogramPanel::focusInEvent(QFocusEvent* event) {
  if (event->reason() == Qt::TabFocusReason) p_->focused = 0;
  if (event->reason() == Qt::BacktabFocusReason) {
    p_->focused = std::max(0, static_cast<int>(p_->handles.size()) - 1);
  }
  p_->announce();
  update();
}

void HistogramPanel::focusOutEvent(QFocusEvent*) {
  if (p_->move && p_->move->by == Private::Move::By::steps) p_->finish();
  update();
}

void HistogramPanel::hideEvent(QHideEvent* event) {
  p_->cancel();
  p_->close_editor();
  QWidget::hideEvent(event);
}

void HistogramPanel::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  if (key == Qt::Key_Escape && p_->cancel()) return;
  const bool dragging = p_->move && p_->move->by == Private::Move::By::mouse;
  if (dragging || !p_->valid(p_->focused)) return QWidget::keyPressEvent(event);
  const bool large = event->modifiers() & Qt::ShiftModifier;
  const bool plain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
  if (plain && (key == Qt::Key_Left || key == Qt::Key_Down)) {
    p_->step(p_->focused, -1, large);
  } else if (plain && (key == Qt::Key_Right || key == Qt::Key_Up)) {
    p_->step(p_->focused, 1, large);
  } else if (plain && (key == Qt::Key_PageDown || key == Qt::Key_PageUp)) {
    p_->step(p_->focused, key == Qt::Key_PageUp ? 1 : -1, true);
  } else if (key == Qt::Key_Return || key == Qt::Key_Enter) {
    if (p_->move) {
      p_->finish();
    } else {
      p_->edit(p_->focused, {});
    }
  } else if (key == Qt::Key_F2) {
    p_->edit(p_->focused, {});
  } else if (plain && event->text().size() == 1 &&
             QStringLiteral("0123456789.,-").contains(event->text())) {
    const bool comma = event->text() == QLatin1String(",");
    p_->edit(p_->focused, comma ? QStringLiteral(".") : event->text());
  } else {
    return QWidget::keyPressEvent(event);
  }
  p_->announce();
}

void HistogramPanel::leaveEvent(QEvent*) {
  if (!p_->move) p_->hover(-1);
}

void HistogramPanel::mouseDoubleClickEvent(QMouseEvent* event) {
  const int handle = p_->handle_at(event->pos(), p_->layout());
  if (event->button() != Qt::LeftButton || handle < 0) return;
  p_->move.reset();
  p_->edit(handle, {});
}

void HistogramPanel::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  p_->finish();
  const Private::Layout at = p_->layout();
  const int handle = p_->handle_at(event->pos(), at);
  if (handle < 0) return;
  p_->focused = handle;
  setFocus(Qt::MouseFocusReason);
  p_->move = Private::Move{Private::Move::By::mouse,
                           handle,
                           p_->handles[handle].value,
                           static_cast<double>(p_->line_x(handle, at.plot)),
                           event->pos(),
                           event->pos(),
                           false};
  p_->announce();
  update();
}

void HistogramPanel::mouseMoveEvent(QMouseEvent* event) {
  const bool dragging = p_->move && p_->move->by == Private::Move::By::mouse;
  if (dragging && (event->buttons() & Qt::LeftButton)) {
    p_->drag_to(event->pos(), event->modifiers() & Qt::ShiftModifier);
  } else if (!(event->buttons() & Qt::LeftButton)) {
    p_->hover(p_->handle_at(event->pos(), p_->layout()));
  }
}

void HistogramPanel::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !p_->move) return;
  p_->finish();
  p_->announce();
  p_->hover(p_->handle_at(event->pos(), p_->layout()));
}

void HistogramPanel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  p_->paint(painter);
}

void HistogramPanel::resizeEvent(QResizeEvent*) { p_->close_editor(); }

void HistogramPanel::wheelEvent(QWheelEvent* event) {
  const int handle = p_->handle_at(event->position().toPoint(), p_->layout());
  const bool dragging = p_->move && p_->move->by == Private::Move::By::mouse;
  if (handle < 0 || dragging) return event->ignore();
  p_->wheel_rest +=
      event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
  const int notches = p_->wheel_rest / 120;
  p_->wheel_rest -= 120 * notches;
  for (int k = 0; k < std::abs(notches) && p_->valid(handle); ++k) {
    p_->step(handle, notches > 0 ? 1 : -1, event->modifiers() & Qt::ShiftModifier);
  }
  event->accept();
}

}  // namespace arris::ui
