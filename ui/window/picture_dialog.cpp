#include "ui/window/picture_dialog.h"

#include <cmath>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSpinBox>

namespace arris::ui {

namespace {

QSpinBox* pixels(int value, QWidget* parent) {
  auto* box = new QSpinBox(parent);
  box->setRange(64, 8192);
  box->setSuffix(QObject::tr(" px"));
  box->setValue(value);
  box->setGroupSeparatorShown(false);
  return box;
}

}  // namespace

PictureDialog::PictureDialog(const PictureOptions& options, QSize view_size, bool named_views,
                             QWidget* parent)
    : QDialog(parent) {
  setWindowTitle(tr("Save picture"));
  auto* form = new QFormLayout(this);
  width_ = pixels(options.size.width(), this);
  height_ = pixels(options.size.height(), this);
  keep_proportion_ = new QCheckBox(tr("Proportion of the view"), this);
  keep_proportion_->setChecked(true);
  scalar_bar_ = new QCheckBox(tr("Scalar bar"), this);
  scalar_bar_->setChecked(options.scalar_bar);
  scale_bar_ = new QCheckBox(tr("Scale bar"), this);
  scale_bar_->setChecked(options.scale_bar);
  marker_ = new QCheckBox(tr("Orientation marker"), this);
  marker_->setChecked(options.orientation_marker);
  background_ = new QComboBox(this);
  background_->addItem(tr("White"), QColor(Qt::white));
  background_->addItem(tr("Transparent"), QColor(Qt::transparent));
  background_->addItem(tr("Dark"), QColor(38, 40, 44));
  form->addRow(tr("Width"), width_);
  form->addRow(tr("Height"), height_);
  form->addRow(QString(), keep_proportion_);
  form->addRow(tr("Ground"), background_);
  form->addRow(QString(), scalar_bar_);
  form->addRow(QString(), scale_bar_);
  form->addRow(QString(), marker_);
  each_view_ = new QCheckBox(tr("One for each named view"), this);
  each_view_->setObjectName("each_view");
  each_view_->setEnabled(named_views);
  each_view_->setToolTip(named_views ? tr("All of them at once, into a folder")
                                     : tr("No view was kept yet: View ▸ Named views"));
  form->addRow(QString(), each_view_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Save)->setText(tr("Save as…"));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

  const double proportion =
      view_size.height() > 0 ? double(view_size.width()) / view_size.height() : 4.0 / 3.0;
  const auto follow = [this, proportion](QSpinBox* to, bool to_width) {
    if (!keep_proportion_->isChecked()) return;
    const QSignalBlocker quiet(to);
    to->setValue(static_cast<int>(
        std::lround(to_width ? height_->value() * proportion : width_->value() / proportion)));
  };
  connect(width_, &QSpinBox::valueChanged, this, [=, this] { follow(height_, false); });
  connect(height_, &QSpinBox::valueChanged, this, [=, this] { follow(width_, true); });
  connect(keep_proportion_, &QCheckBox::toggled, this, [=, this] { follow(height_, false); });
  follow(height_, false);
}

bool PictureDialog::each_view() const { return each_view_->isChecked(); }

PictureOptions PictureDialog::options() const {
  PictureOptions options;
  options.size = {width_->value(), height_->value()};
  options.scalar_bar = scalar_bar_->isChecked();
  options.scale_bar = scale_bar_->isChecked();
  options.orientation_marker = marker_->isChecked();
  options.background = background_->currentData().value<QColor>();
  return options;
}

}  // namespace arris::ui
