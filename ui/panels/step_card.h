#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <QEvent>
#include <QString>
#include <QVariantMap>
#include <QWidget>

#include "ui/panels/step_fields.h"

class QGridLayout;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace arris::ui {

class MutedLabel;

enum class StepState { not_run, done, out_of_date };

/// A step of figure 2 as the panel shows it.
struct StepCard {
  QString name;     ///< Operation name: "find_sharp_lines".
  QString title;    ///< "Sharp lines".
  QString tooltip;  ///< What the step does.
  StepState state = StepState::not_run;
  QString result;  ///< "137 lines, 1,203 edges".
  QString time;    ///< "0.12 s".
  std::vector<StepParameter> parameters;
  bool runnable = true;  ///< False: no Run button.
};

class StateIcon;

/// One step. The frame is painted from the palette, so that it follows light and dark.
class StepCardFrame : public QWidget {
 public:
  StepCardFrame(const StepCard& card, QWidget* parent);

  bool fits(const StepCard& card) const;
  void show_card(const StepCard& card);
  /// Shows the parameters that the choices have a use for, and no others.
  void show_hanging();
  void set_busy(bool busy) {
    busy_ = busy;
    allow_run();
  }
  QVariantMap values() const {
    QVariantMap map;
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (value_of(i).isValid()) map.insert(card_.parameters[i].key, fields_[i]->value());
    return map;
  }
  const StepCard& card() const { return card_; }
  bool is_edited() const {
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (fields_[i]->is_edited() && value_of(i).isValid()) return true;
    return false;
  }

  std::function<void()> run, edited, entered, dragged, settled;

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override { arrange_form(); }
  bool event(QEvent* event) override {
    // Editors know their size only once the style has polished them.
    if (event->type() == QEvent::LayoutRequest) arrange_form();
    return QWidget::event(event);
  }

 private:
  void follow_choices() {
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (!card_.parameters[i].hangs_on.isEmpty() && value_of(i).isValid())
        fields_[i]->rebase(value_of(i));
    show_hanging();
  }
  /// The value that the card gives a parameter, by the choice it hangs on; invalid where the choice
  /// has no use for it.
  QVariant value_of(std::size_t i) const {
    const StepParameter& parameter = card_.parameters[i];
    if (parameter.hangs_on.isEmpty()) return parameter.value;
    for (std::size_t k = 0; k < fields_.size(); ++k)
      if (card_.parameters[k].key == parameter.hangs_on)
        return parameter.value_of.value(fields_[k]->value().toString());
    return {};
  }
  void allow_run();
  void show_state();
  void build_controls(QVBoxLayout* column);
  void arrange_form();

  StepCard card_;
  bool busy_ = false;
  StateIcon* icon_ = nullptr;
  QLabel *title_ = nullptr, *result_ = nullptr;
  MutedLabel* state_ = nullptr;
  QPushButton* run_ = nullptr;
  QGridLayout* form_ = nullptr;
  std::vector<QLabel*> labels_;
  std::vector<std::unique_ptr<StepField>> fields_;
  std::vector<bool> beside_;  // The editor stands beside its label, not under it.
};

}  // namespace arris::ui
