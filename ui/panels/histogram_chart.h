#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <QColor>
#include <QFont>
#include <QPointF>
#include <QRect>
#include <QString>

#include "ui/panels/histogram_axis.h"
#include "ui/view/colour_scale.h"

class QFontMetrics;
class QPainter;
class QWidget;

namespace arris::ui {

/// Distribution of the shown field, weighted by area.
struct Histogram {
  std::vector<double> edges;    ///< n + 1 bin edges, increasing.
  std::vector<double> weights;  ///< n bins: share of the area, 0 to 1.
  QString title;                ///< "Kabs (1/mm²)".
  bool logarithmic = false;     ///< Bin edges are spaced evenly in the logarithm.
  QString why_none;             ///< Said where there are no bins; empty: that there are none.
};

/// A threshold as a handle on the histogram.
struct ThresholdHandle {
  QString name;     ///< "TV_IH", "Kmin", "Kmax".
  QString tooltip;  ///< What it does.
  double value = 0.0;
  double least = 0.0, most = 1.0;  ///< Range it may be dragged in.
  /// Second reading beside the number, e.g. "r = 12.3 mm", of whatever value it has; may be empty.
  std::function<QString(double value)> reading;
};

/// A second curve over the same axis, on a scale of its own at the right: what each threshold would
/// give.
struct HistogramCurve {
  QString label;                ///< "lines"; empty: there is no curve.
  std::vector<QPointF> points;  ///< Threshold and count, by increasing threshold; none: to come.
  std::optional<std::pair<double, double>> plateau;  ///< Where the count hardly changes.
  QString plateau_text;                              ///< "steady from 24° to 31°"
};

/// What a histogram panel shows, where it is, and how it is painted; the panel moves the handles.
class HistogramChart {
 public:
  /// Painted in the size, font and palette of `widget`.
  static constexpr int margin = 6;  ///< Pixels around everything.

  explicit HistogramChart(const QWidget* on) : widget(on) {}

  /// Where things are; worked out from size, font and handles.
  struct Layout {
    QRect plot, strip;
    std::vector<QRect> labels;
    std::vector<bool> with_reading;
  };

  const QWidget* widget;
  Histogram histogram;
  ColourScale scale;
  HistogramCurve curve;
  ValueAxis axis;
  std::vector<ThresholdHandle> handles;
  int focused = 0;
  int hovered = -1;
  int held = -1;  ///< The handle that is being moved.

  /// The distribution has bins, they increase, and all is finite.
  bool shown() const { return !histogram.weights.empty(); }
  bool valid(int handle) const { return handle >= 0 && handle < static_cast<int>(handles.size()); }
  /// A distribution that is none (too few bins, not increasing, not finite) is shown as none.
  void take(const Histogram& given);
  QString value_text(int i) const;
  /// The second reading of its value now; empty: it has none.
  QString reading_text(int i) const;
  Layout layout() const;
  int line_x(int i, const QRect& plot) const { return line_x(handles[i].value, plot); }
  int line_x(double value, const QRect& plot) const;
  /// The value drawn at x.
  double value_at(double x, const QRect& plot) const;
  /// The handle under a point: its label, or its line within reach.
  int handle_at(const QPoint& point, const Layout& at) const;
  QString range_text(std::size_t bin) const;
  /// The bin over a place on the axis.
  std::optional<std::size_t> bin_at(int x, const QRect& plot) const;
  void paint(QPainter& painter) const;

 private:
  QFont name_font() const;
  int label_width(int i, bool with_reading) const;
  bool with_title() const;
  /// Full height of its scale, which is logarithmic as the bars are: halving the count looks alike
  /// whatever the count.
  double most_count() const;
  static QString tick_text(double count);
  /// Room for its scale, the same for most counts so that nothing moves when the curve comes.
  int curve_width(const QFontMetrics& metrics) const;
  QColor curve_colour() const;
  int curve_y(double count, const QRect& plot) const;
  void paint_plateau(QPainter& painter, const QRect& plot) const;
  void paint_curve(QPainter& painter, const QRect& plot) const;
  /// Decades of the area axis: 10^first to 10^last, as shares.
  std::array<int, 2> decades() const;
  void paint_bars(QPainter& painter, const QRect& plot, const QColor& colour) const;
  void paint_area_axis(QPainter& painter, const QRect& plot) const;
  void paint_value_axis(QPainter& painter, const Layout& at) const;
  void paint_strip(QPainter& painter, const QRect& strip) const;
  void paint_handle(QPainter& painter, int i, const Layout& at) const;
  void paint_label(QPainter& painter, int i, const Layout& at) const;
};

}  // namespace arris::ui
