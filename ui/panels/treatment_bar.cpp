#include "ui/panels/treatment_bar.h"

#include <algorithm>
#include <cmath>

#include <QLabel>
#include <QPushButton>
#include <QSlider>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int slider_steps = 1000;

}  // namespace

TreatmentBar::TreatmentBar(QWidget* parent) : QToolBar(parent) {
  setMovable(false);
  name_ = new QLabel(this);
  name_->setContentsMargins(6, 0, 6, 0);
  QFont bold = name_->font();
  bold.setBold(true);
  name_->setFont(bold);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setRange(0, slider_steps);
  slider_->setPageStep(slider_steps / 20);
  slider_->setFixedWidth(170);
  slider_->setAccessibleName(tr("Threshold of the treatment"));
  box_ = new NumberBox(this);
  box_->setFixedWidth(96);
  box_->setAccessibleName(tr("Threshold of the treatment, typed"));
  choice_ = new QuietCombo(this);
  result_ = new MutedLabel({}, this);
  result_->setContentsMargins(8, 0, 8, 0);
  accept_ = new QPushButton(tr("Accept"), this);
  accept_->setToolTip(tr("Makes it one step of the history (Enter)"));
  auto* cancel = new QPushButton(tr("Cancel"), this);
  cancel->setToolTip(tr("Leaves everything as it was (Esc)"));
  for (QPushButton* button : {accept_, cancel}) button->setAutoDefault(false);
  addWidget(name_);
  slider_action_ = addWidget(slider_);
  box_action_ = addWidget(box_);
  choice_action_ = addWidget(choice_);
  addWidget(result_);
  addWidget(accept_);
  addWidget(cancel);
  connect(slider_, &QSlider::valueChanged, this, [this] {
    if (!showing_) take_slider();
  });
  connect(box_, &NumberBox::valueChanged, this, [this](double value) {
    if (showing_) return;
    set_slider(value);
    emit changed();
  });
  connect(choice_, &QComboBox::currentIndexChanged, this, [this] {
    if (!showing_) emit changed();
  });
  connect(accept_, &QPushButton::clicked, this, &TreatmentBar::accepted);
  connect(cancel, &QPushButton::clicked, this, &TreatmentBar::cancelled);
}

void TreatmentBar::show_treatment(const QString& name, const Number* number, const Choice* choice) {
  showing_ = true;
  name_->setText(name);
  slider_action_->setVisible(number);
  box_action_->setVisible(number);
  choice_action_->setVisible(choice);
  if (number) {
    number_ = *number;
    const double span = number_.logarithmic ? number_.low : number_.high - number_.low;
    box_->setDecimals(
        number_.whole ? 0
                      : std::clamp(static_cast<int>(std::ceil(-std::log10(span * 1e-3))), 0, 12));
    box_->setRange(number_.low, number_.high);
    box_->setSuffix(number_.unit);
    box_->setValue(number_.value);
    slider_->setToolTip(number_.tooltip);
    box_->setToolTip(number_.tooltip);
    set_slider(number_.value);
  }
  if (choice) {
    choice_->clear();
    choice_->addItems(choice->texts);
    choice_->setToolTip(choice->tooltip);
  }
  showing_ = false;
  set_result({}, false);
}

void TreatmentBar::set_result(const QString& text, bool refused) {
  result_->setText(text);
  accept_->setEnabled(!refused);
}

void TreatmentBar::set_acceptable(bool acceptable) { accept_->setEnabled(acceptable); }

void TreatmentBar::take_typed() {
  if (box_action_->isVisible()) box_->interpretText();
}

double TreatmentBar::value() const { return box_->value(); }

int TreatmentBar::choice() const { return choice_->currentIndex(); }

void TreatmentBar::take_slider() {
  const double share = static_cast<double>(slider_->value()) / slider_steps;
  const double value = number_.logarithmic
                           ? number_.low * std::pow(number_.high / number_.low, share)
                           : number_.low + (number_.high - number_.low) * share;
  showing_ = true;
  box_->setValue(number_.whole ? std::round(value) : round_significant(value, 3));
  showing_ = false;
  emit changed();
}

void TreatmentBar::set_slider(double value) {
  const bool before = showing_;
  showing_ = true;
  const double share = number_.logarithmic
                           ? std::log(value / number_.low) / std::log(number_.high / number_.low)
                           : (value - number_.low) / (number_.high - number_.low);
  slider_->setValue(static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * slider_steps)));
  showing_ = before;
}

}  // namespace arris::ui
