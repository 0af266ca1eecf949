#pragma once

#include <QToolBar>

class QLabel;
class QSlider;

namespace arris::ui {

class NumberBox;

/// Moves the section plane: a slider over the part and the position as a length.
class SectionBar : public QToolBar {
  Q_OBJECT
 public:
  explicit SectionBar(QWidget* parent = nullptr);

  /// `name`: "X", "view direction"; positions run from `low` to `high`, which is larger.
  void show_plane(const QString& name, double low, double high, double position);
  double position() const;
  /// " mm", or empty.
  void set_unit_suffix(const QString& suffix);

 signals:
  void moved(double position);
  void flip_wanted();
  void off_wanted();

 private:
  void take(double position);

  QLabel* name_;
  QSlider* slider_;
  NumberBox* box_;
  double low_ = 0.0, high_ = 1.0;
  bool showing_ = false;
};

}  // namespace arris::ui
