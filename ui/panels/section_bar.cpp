#include "ui/panels/section_bar.h"

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

SectionBar::SectionBar(QWidget* parent) : QToolBar(parent) {
  setMovable(false);
  name_ = new QLabel(this);
  name_->setContentsMargins(6, 0, 6, 0);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setRange(0, slider_steps);
  slider_->setPageStep(slider_steps / 20);
  slider_->setFixedWidth(220);
  slider_->setToolTip(tr("Moves the section through the part; arrow keys move it finely."));
  slider_->setAccessibleName(tr("Position of the section"));
  box_ = new NumberBox(this);
  box_->setFixedWidth(110);
  box_->setToolTip(tr("Position of the section along its direction."));
  box_->setAccessibleName(tr("Position of the section as a number"));
  auto* flip = new QPushButton(tr("Flip"), this);
  flip->setToolTip(tr("Cuts away the other side (Shift+F)"));
  auto* off = new QPushButton(tr("Off"), this);
  off->setToolTip(tr("Shows the whole part again"));
  for (QPushButton* button : {flip, off}) button->setAutoDefault(false);
  for (QWidget* widget : std::initializer_list<QWidget*>{name_, slider_, box_, flip, off})
    addWidget(widget);
  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    if (!showing_) take(low_ + (high_ - low_) * step / slider_steps);
  });
  connect(box_, &NumberBox::valueChanged, this, [this](double value) {
    if (!showing_) take(value);
  });
  connect(flip, &QPushButton::clicked, this, &SectionBar::flip_wanted);
  connect(off, &QPushButton::clicked, this, &SectionBar::off_wanted);
}

void SectionBar::show_plane(const QString& name, double low, double high, double position) {
  showing_ = true;
  low_ = low;
  high_ = high;
  name_->setText(tr("Section %1").arg(name));
  const int decimals =
      std::clamp(static_cast<int>(std::ceil(-std::log10((high - low) * 1e-4))), 0, 9);
  box_->setDecimals(decimals);
  box_->setRange(low, high);
  box_->setSingleStep(std::pow(10.0, std::floor(std::log10((high - low) / 50.0))));
  box_->setValue(position);
  slider_->setValue(static_cast<int>(std::lround((position - low) / (high - low) * slider_steps)));
  showing_ = false;
}

void SectionBar::set_unit_suffix(const QString& suffix) { box_->setSuffix(suffix); }

double SectionBar::position() const { return box_->value(); }

void SectionBar::take(double position) {
  showing_ = true;
  box_->setValue(position);
  slider_->setValue(
      static_cast<int>(std::lround((position - low_) / (high_ - low_) * slider_steps)));
  showing_ = false;
  emit moved(position);
}

}  // namespace arris::ui
