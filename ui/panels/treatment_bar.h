#pragma once

#include <QToolBar>

class QComboBox;
class QLabel;
class QPushButton;
class QSlider;

namespace arris::ui {

class NumberBox;

/// The treatment that goes on: its name, its own threshold as a slider, a choice, what it would
/// give, Accept and Cancel. What is dragged or typed is shown; Accept or Enter takes it.
class TreatmentBar : public QToolBar {
  Q_OBJECT
 public:
  explicit TreatmentBar(QWidget* parent = nullptr);

  struct Number {
    double low = 0.0, high = 1.0, value = 0.5;
    bool logarithmic = false;  ///< The slider runs over the logarithm; `low` is above 0.
    QString unit, tooltip;
    bool whole = false;  ///< Of whole numbers.
  };
  struct Choice {
    QStringList texts;
    QString tooltip;
  };
  /// Shows a treatment; without number or choice these are hidden.
  void show_treatment(const QString& name, const Number* number, const Choice* choice);
  /// What the preview gave, or why there is none.
  void set_result(const QString& text, bool refused);
  void set_acceptable(bool acceptable);

  /// Reads what is typed and was not taken yet, with changed() where it is another value.
  void take_typed();
  double value() const;
  int choice() const;

 signals:
  void changed();  ///< Another value or choice: preview it.
  void accepted();
  void cancelled();

 private:
  void take_slider();
  void set_slider(double value);

  QLabel* name_;
  QSlider* slider_;
  NumberBox* box_;
  QComboBox* choice_;
  QLabel* result_;
  QPushButton* accept_;
  QAction *slider_action_, *box_action_, *choice_action_;
  Number number_;
  bool showing_ = false;
};

}  // namespace arris::ui
