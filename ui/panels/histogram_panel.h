#pragma once

#include <memory>
#include <vector>

#include <QWidget>

#include "ui/panels/histogram_chart.h"

namespace arris::ui {

/// The bottom panel: histogram with the colour map under it, log counts, and the thresholds as
/// handles. Handles move by mouse (with Shift ten times finer), by wheel and by keyboard (Tab to a
/// handle, arrows, Shift+arrows for larger steps, typing a number and Enter). Values set by
/// dragging or stepping are rounded to the four significant digits that the label shows. The axis
/// spans the histogram; a handle outside of it is shown at the end, and the low end of a
/// logarithmic axis stands for `least` where that is not above 0.
class HistogramPanel : public QWidget {
  Q_OBJECT
 public:
  explicit HistogramPanel(QWidget* parent = nullptr);
  ~HistogramPanel() override;

  void set_histogram(const Histogram& histogram, const ColourScale& scale);
  void set_curve(HistogramCurve curve);
  const HistogramCurve& curve() const;
  /// While a handle is being moved, its own value stays with the user and the rest (reading, range,
  /// other handles) is taken over. Handles with other names end the move without a signal.
  void set_handles(std::vector<ThresholdHandle> handles);
  const std::vector<ThresholdHandle>& handles() const;
  /// Position of a handle in widget pixels, for tests.
  QPoint handle_position(int handle) const;
  /// Rectangle of a handle's label in widget pixels.
  QRect label_rectangle(int handle) const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  /// While a handle is moved: at each mouse move, arrow key or turn of the wheel.
  void threshold_dragged(int handle, double value);
  /// Once for each move: when the mouse lets go, half a second after the last key or turn of the
  /// wheel (or when the focus goes), or when a typed number is entered.
  void threshold_finished(int handle, double value);
  /// Esc while moving: back to the value before the move.
  void threshold_cancelled(int handle);

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool focusNextPrevChild(bool next) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  class Private;
  std::unique_ptr<Private> p_;
};

}  // namespace arris::ui
