#include "ui/window/picture_dialog.h"

#include <algorithm>
#include <cmath>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>

namespace arris::ui {

namespace {

constexpr double least_pixels = 64.0, most_pixels = 16000.0;
constexpr double inch = 25.4;  // mm

struct Scale {
  const char* text;
  double factor;  // mm of paper for one of the part
};

constexpr Scale scales[] = {{"10:1", 10.0}, {"5:1", 5.0},   {"2:1", 2.0},  {"1:1", 1.0},
                            {"1:2", 0.5},   {"1:5", 0.2},   {"1:10", 0.1}, {"1:20", 0.05},
                            {"1:50", 0.02}, {"1:100", 0.01}};

}  // namespace

PictureDialog::PictureDialog(const PictureOptions& options, const Part& part, QWidget* parent)
    : QDialog(parent), part_(part), given_(options) {
  setWindowTitle(tr("Save picture"));
  setObjectName("picture_dialog");
  const QSettings settings;
  auto* form = new QFormLayout(this);
  unit_ = new QComboBox(this);
  unit_->setObjectName("picture_unit");
  unit_->addItems({tr("Pixels"), tr("Millimetres")});
  const auto length = [this](const char* name) {
    auto* box = new QDoubleSpinBox(this);
    box->setObjectName(name);
    box->setGroupSeparatorShown(false);
    return box;
  };
  width_ = length("picture_width");
  height_ = length("picture_height");
  dots_ = new QSpinBox(this);
  dots_->setObjectName("picture_dots");
  dots_->setRange(50, 1200);
  dots_->setSuffix(tr(" dpi"));
  dots_->setValue(settings.value("pictures/dots", 300).toInt());
  scale_ = new QComboBox(this);
  scale_->setObjectName("picture_scale");
  scale_->addItem(tr("As in the view"), 0.0);
  for (const Scale& one : scales) scale_->addItem(one.text, one.factor);
  pixels_ = new QLabel(this);
  pixels_->setObjectName("picture_pixels");
  pixels_->setWordWrap(true);
  pixels_->setAlignment(Qt::AlignTop);
  pixels_->setMinimumHeight(3 * fontMetrics().lineSpacing());  // that the part does not fit
  keep_proportion_ = new QCheckBox(tr("Proportion of the view"), this);
  keep_proportion_->setChecked(true);
  scalar_bar_ = new QCheckBox(tr("Scalar bar"), this);
  scale_bar_ = new QCheckBox(tr("Scale bar"), this);
  marker_ = new QCheckBox(tr("Orientation marker"), this);
  legend_ = new QCheckBox(tr("Legend of the lines"), this);
  titled_ = new QCheckBox(tr("Title"), this);
  titled_->setObjectName("picture_titled");
  title_ = new QLineEdit(part.title, this);
  title_->setObjectName("picture_title");
  thresholds_ = new QCheckBox(tr("Thresholds"), this);
  thresholds_->setObjectName("picture_thresholds");
  thresholds_->setEnabled(!part.thresholds.isEmpty());
  thresholds_->setToolTip(part.thresholds.isEmpty() ? tr("Nothing was found yet.")
                                                    : part.thresholds);
  for (const auto& [key, box] : contents())
    box->setChecked(settings.value(key, box != titled_ && box != thresholds_).toBool());
  title_->setEnabled(titled_->isChecked());
  connect(titled_, &QCheckBox::toggled, title_, &QWidget::setEnabled);
  background_ = new QComboBox(this);
  background_->addItem(tr("White"), QColor(Qt::white));
  background_->addItem(tr("Transparent"), QColor(Qt::transparent));
  background_->addItem(tr("Dark"), QColor(38, 40, 44));
  background_->setCurrentIndex(settings.value("pictures/ground", 0).toInt());
  form->addRow(tr("Size in"), unit_);
  form->addRow(tr("Width"), width_);
  form->addRow(tr("Height"), height_);
  form->addRow(tr("Resolution"), dots_);
  form->addRow(tr("Scale"), scale_);
  form->addRow(pixels_);
  form->addRow(QString(), keep_proportion_);
  form->addRow(tr("Ground"), background_);
  form->addRow(QString(), scalar_bar_);
  form->addRow(QString(), scale_bar_);
  form->addRow(QString(), marker_);
  form->addRow(QString(), legend_);
  form->addRow(titled_, title_);
  form->addRow(QString(), thresholds_);
  each_view_ = new QCheckBox(tr("One for each named view"), this);
  each_view_->setObjectName("each_view");
  each_view_->setEnabled(part.named_views);
  each_view_->setToolTip(part.named_views ? tr("All of them at once, into a folder")
                                          : tr("No view was kept yet: View ▸ Named views"));
  form->addRow(QString(), each_view_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Save)->setText(tr("Save as…"));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

  refresh();
  width_->setValue(options.size.width());
  height_->setValue(options.size.height());
  const double proportion =
      part.view_size.height() > 0
          ? static_cast<double>(part.view_size.width()) / part.view_size.height()
          : 4.0 / 3.0;
  const auto follow = [this, proportion](QDoubleSpinBox* to, bool to_width) {
    if (!keep_proportion_->isChecked()) return;
    const QSignalBlocker quiet(to);
    to->setValue(to_width ? height_->value() * proportion : width_->value() / proportion);
  };
  connect(width_, &QDoubleSpinBox::valueChanged, this, [=, this] {
    follow(height_, false);
    refresh();
  });
  connect(height_, &QDoubleSpinBox::valueChanged, this, [=, this] {
    follow(width_, true);
    refresh();
  });
  connect(keep_proportion_, &QCheckBox::toggled, this, [=, this] {
    follow(height_, false);
    refresh();
  });
  connect(dots_, &QSpinBox::valueChanged, this, &PictureDialog::refresh);
  connect(scale_, &QComboBox::currentIndexChanged, this, &PictureDialog::refresh);
  connect(unit_, &QComboBox::currentIndexChanged, this, &PictureDialog::change_unit);
  follow(height_, false);
  if (settings.value("pictures/millimetres", false).toBool()) unit_->setCurrentIndex(1);
  refresh();
}

bool PictureDialog::in_millimetres() const { return unit_->currentIndex() == 1; }

double PictureDialog::dots_per_millimetre() const {
  return in_millimetres() ? dots_->value() / inch : 1.0;
}

void PictureDialog::change_unit() {
  const bool now = in_millimetres();
  if (now == were_millimetres_) return;
  were_millimetres_ = now;
  const double factor = now ? inch / dots_->value() : dots_->value() / inch;
  const double width = width_->value() * factor, height = height_->value() * factor;
  const QSignalBlocker quiet_width(width_), quiet_height(height_);
  refresh();  // with the ranges that these are in
  width_->setValue(width);
  height_->setValue(height);
  refresh();
}

void PictureDialog::refresh() {
  const bool millimetres = in_millimetres();
  for (QDoubleSpinBox* box : {width_, height_}) {
    const QSignalBlocker quiet(box);
    box->setDecimals(millimetres ? 1 : 0);
    box->setSuffix(millimetres ? tr(" mm") : tr(" px"));
    box->setRange(least_pixels / dots_per_millimetre(), most_pixels / dots_per_millimetre());
  }
  dots_->setEnabled(millimetres);
  const bool to_scale = millimetres && part_.millimetres > 0.0;
  scale_->setEnabled(to_scale);
  scale_->setToolTip(to_scale      ? tr("Of lengths on paper to those of the part")
                     : millimetres ? tr("The unit of the part is not known: Part ▸ Unit of lengths")
                                   : tr("Pixels have no length: choose millimetres"));
  const QSize size = options().size;
  QString text = tr("%1 × %2 pixels").arg(size.width()).arg(size.height());
  const double scale = to_scale ? scale_->currentData().toDouble() : 0.0;
  const QSizeF on_paper = part_.extent * (scale * part_.millimetres);
  if (on_paper.width() > width_->value() || on_paper.height() > height_->value())
    text += tr(". The part does not fit: at %1 it takes %2 × %3 mm.")
                .arg(scale_->currentText())
                .arg(std::ceil(on_paper.width()))
                .arg(std::ceil(on_paper.height()));
  pixels_->setText(text);
}

PictureOptions PictureDialog::options() const {
  PictureOptions options = given_;
  const auto pixels = [this](const QDoubleSpinBox* box) {
    return static_cast<int>(
        std::lround(std::clamp(box->value() * dots_per_millimetre(), least_pixels, most_pixels)));
  };
  options.size = {pixels(width_), pixels(height_)};
  options.dots_per_inch = in_millimetres() ? dots_->value() : 0.0;
  const double scale = scale_->isEnabled() ? scale_->currentData().toDouble() : 0.0;
  options.height =
      scale > 0.0 ? options.size.height() / dots_per_millimetre() / scale / part_.millimetres : 0.0;
  options.scalar_bar = scalar_bar_->isChecked();
  options.scale_bar = scale_bar_->isChecked();
  options.orientation_marker = marker_->isChecked();
  options.legend = legend_->isChecked();
  QStringList caption;
  if (titled_->isChecked() && !title_->text().trimmed().isEmpty())
    caption << title_->text().trimmed();
  if (thresholds_->isChecked() && !part_.thresholds.isEmpty()) caption << part_.thresholds;
  options.caption = caption.join('\n');
  options.background = background_->currentData().value<QColor>();
  return options;
}

bool PictureDialog::each_view() const { return each_view_->isChecked(); }

std::vector<std::pair<QString, QCheckBox*>> PictureDialog::contents() const {
  return {{"pictures/scalar_bar", scalar_bar_}, {"pictures/scale_bar", scale_bar_},
          {"pictures/marker", marker_},         {"pictures/legend", legend_},
          {"pictures/titled", titled_},         {"pictures/thresholds", thresholds_}};
}

void PictureDialog::accept() {
  QSettings settings;
  for (const auto& [key, box] : contents()) settings.setValue(key, box->isChecked());
  settings.setValue("pictures/ground", background_->currentIndex());
  settings.setValue("pictures/millimetres", in_millimetres());
  settings.setValue("pictures/dots", dots_->value());
  QDialog::accept();
}

}  // namespace arris::ui
