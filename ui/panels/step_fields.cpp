#include "ui/panels/step_fields.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <QApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

bool StepField::fits(const StepParameter& other) const {
  return parameter_.key == other.key && parameter_.kind == other.kind &&
         parameter_.label == other.label && parameter_.tooltip == other.tooltip &&
         parameter_.least == other.least && parameter_.most == other.most &&
         parameter_.decimals == other.decimals && parameter_.suffix == other.suffix &&
         parameter_.choices == other.choices && parameter_.choice_labels == other.choice_labels &&
         parameter_.hangs_on == other.hangs_on;
}

void StepField::update(const QVariant& value) {
  if (value == parameter_.value) return;
  parameter_.value = value;
  const QWidget* focus = QApplication::focusWidget();
  const bool focused = focus != nullptr && (focus == widget() || widget()->isAncestorOf(focus));
  if (touched_ && focused) return;
  touched_ = false;
  show();
}

namespace {

QString with_range(const StepParameter& p) {
  if (p.most <= p.least) return p.tooltip;
  const QString range =
      QObject::tr("From %1 to %2%3.").arg(shown_number(p.least), shown_number(p.most), p.suffix);
  return p.tooltip.isEmpty() ? range : p.tooltip + QLatin1Char('\n') + range;
}

/// Values that nobody typed, such as defaults from the part, are not rounded: they are shown with
/// three significant digits. Typed ones are shown whole.
double shown(double value) {
  return round_significant(value, 6) == value ? value : round_significant(value, 3);
}

NumberBox* number_box(const StepParameter& p, QWidget* parent) {
  auto* box = new NumberBox(parent);
  box->setDecimals(p.decimals);
  box->setRange(p.least, std::max(p.least, p.most));
  box->setToolTip(with_range(p));
  box->setAccessibleName(p.label);
  return box;
}

class RealField : public StepField {
 public:
  RealField(const StepParameter& parameter, QWidget* parent)
      : StepField(parameter), box_(number_box(parameter, parent)) {
    box_->setSuffix(parameter.suffix);
    show();
    QObject::connect(box_, &NumberBox::edited, box_, [this] { touch(); });
    QObject::connect(box_, &NumberBox::editingFinished, &alive_, [this] { enter(); });
  }
  QWidget* widget() const override { return box_; }

 protected:
  QVariant read() override {
    box_->interpretText();
    return box_->value();
  }
  QVariant typed() const override { return box_->valueFromText(box_->text()); }
  void show() override { box_->setValue(shown(parameter_.value.toDouble())); }

 private:
  NumberBox* box_;
};

class WholeField : public StepField {
 public:
  WholeField(const StepParameter& parameter, QWidget* parent)
      : StepField(parameter), box_(new WholeBox(parent)) {
    box_->setRange(static_cast<int>(parameter.least),
                   static_cast<int>(std::max(parameter.least, parameter.most)));
    box_->setSuffix(parameter.suffix);
    box_->setToolTip(with_range(parameter));
    box_->setAccessibleName(parameter.label);
    show();
    QObject::connect(box_, &WholeBox::edited, box_, [this] { touch(); });
    QObject::connect(box_, &WholeBox::editingFinished, &alive_, [this] { enter(); });
  }
  QWidget* widget() const override { return box_; }

 protected:
  QVariant read() override {
    box_->interpretText();
    return box_->value();
  }
  QVariant typed() const override { return box_->cleanText().toInt(); }
  void show() override { box_->setValue(parameter_.value.toInt()); }

 private:
  WholeBox* box_;
};

class ChoiceField : public StepField {
 public:
  ChoiceField(const StepParameter& parameter, QWidget* parent)
      : StepField(parameter), box_(new QuietCombo(parent)) {
    for (int i = 0; i < parameter.choices.size(); ++i) {
      const QString& key = parameter.choices[i];
      box_->addItem(parameter.choice_labels.value(i, key), key);
      box_->setItemData(i, box_->itemText(i), Qt::ToolTipRole);
    }
    box_->setToolTip(parameter.tooltip);
    box_->setAccessibleName(parameter.label);
    show();
    QObject::connect(box_, &QComboBox::activated, box_, [this] { touch(); });
  }
  QWidget* widget() const override { return box_; }

 protected:
  QVariant read() override { return box_->currentData().toString(); }
  QVariant typed() const override { return box_->currentData().toString(); }
  void show() override { box_->setCurrentIndex(box_->findData(parameter_.value.toString())); }

 private:
  QuietCombo* box_;
};

/// Rows of "from – to" with a button to drop each, and one to add.
class IntervalsField : public StepField {
 public:
  IntervalsField(const StepParameter& parameter, QWidget* parent)
      : StepField(parameter), frame_(new QWidget(parent)), column_(new QVBoxLayout(frame_)) {
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(3);
    add_ = new QToolButton(frame_);
    add_->setText(QObject::tr("+ Add interval"));
    add_->setToolTip(
        QObject::tr("One more interval; they run one after the other over what is "
                    "left."));
    add_->setFocusPolicy(Qt::StrongFocus);
    add_->setAutoRaise(true);
    column_->addWidget(add_, 0, Qt::AlignLeft);
    show();
    QObject::connect(add_, &QToolButton::clicked, frame_, [this] {
      double low = parameter_.least, high = parameter_.most;
      if (!rows_.empty()) {
        const Row& last = rows_.back();
        low = last.high->is_unlimited() ? last.low->value() : last.high->value();
        high = parameter_.most;
      }
      add_row(low, std::max(low, high));
      rows_.back().low->setFocus();
      touch();
    });
  }

  QWidget* widget() const override { return frame_; }
  bool wide() const override { return true; }

  QString mistake() const override {
    for (const Row& row : rows_) {
      if (number(row.low) > number(row.high)) {
        return QObject::tr("An interval must end above where it begins.");
      }
    }
    return rows_.empty() ? QObject::tr("Add an interval first.") : QString();
  }

 protected:
  QVariant read() override {
    QVariantList list;
    for (const Row& row : rows_) {
      row.low->interpretText();
      row.high->interpretText();
      list.append(QVariant(
          QVariantList{row.low->value(), row.high->is_unlimited() ? qInf() : row.high->value()}));
    }
    return list;
  }

  QVariant typed() const override {
    QVariantList list;
    for (const Row& row : rows_) {
      const double high = number(row.high);
      list.append(
          QVariant(QVariantList{number(row.low), high >= row.high->maximum() ? qInf() : high}));
    }
    return list;
  }
  void show() override {
    const QVariantList list = parameter_.value.toList();
    while (rows_.size() > static_cast<std::size_t>(list.size())) drop_row(rows_.back().frame);
    for (int i = 0; i < list.size(); ++i) {
      const QVariantList ends = list[i].toList();
      const double low = shown(ends.value(0).toDouble()), high = shown(ends.value(1).toDouble());
      if (i < static_cast<int>(rows_.size())) {
        rows_[i].low->setValue(low);
        rows_[i].high->setValue(high);
      } else {
        add_row(low, high);
      }
    }
  }

 private:
  struct Row {
    QWidget* frame;
    NumberBox *low, *high;
    QToolButton* drop;
  };

  /// The number as typed so far.
  static double number(const NumberBox* box) { return box->valueFromText(box->text()); }

  void add_row(double low, double high) {
    auto* frame = new QWidget(frame_);
    auto* line = new QHBoxLayout(frame);
    line->setContentsMargins(0, 0, 0, 0);
    line->setSpacing(4);
    Row row{frame, number_box(parameter_, frame), number_box(parameter_, frame),
            new QToolButton(frame)};
    for (NumberBox* box : {row.low, row.high}) {
      box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    }
    row.low->setAccessibleName(QObject::tr("Interval from"));
    row.high->setAccessibleName(QObject::tr("Interval to"));
    row.high->set_unlimited(true);
    row.high->setToolTip(QObject::tr("Empty: no upper end."));
    row.low->setValue(low);
    row.high->setValue(high);
    row.drop->setText(QStringLiteral("−"));
    row.drop->setToolTip(QObject::tr("Drops this interval."));
    row.drop->setAccessibleName(QObject::tr("Drop interval"));
    row.drop->setFocusPolicy(Qt::StrongFocus);
    row.drop->setAutoRaise(true);
    line->addWidget(row.low);
    line->addWidget(new QLabel(QStringLiteral("–"), frame));
    line->addWidget(row.high);
    line->addWidget(row.drop);
    rows_.push_back(row);
    column_->insertWidget(column_->count() - 1, frame);
    QWidget::setTabOrder(row.drop, add_);
    for (NumberBox* box : {row.low, row.high}) {
      QObject::connect(box, &NumberBox::edited, frame_, [this] { touch(); });
    }
    QObject::connect(row.drop, &QToolButton::clicked, frame_, [this, frame] {
      drop_row(frame);
      touch();
    });
    allow_drop();
  }

  void drop_row(QWidget* frame) {
    std::erase_if(rows_, [frame](const Row& row) { return row.frame == frame; });
    frame->hide();
    frame->deleteLater();
    allow_drop();
  }

  void allow_drop() {
    for (const Row& row : rows_) row.drop->setEnabled(rows_.size() > 1);
  }

  QWidget* frame_;
  QVBoxLayout* column_;
  QToolButton* add_ = nullptr;
  std::vector<Row> rows_;
};

/// A logarithmic slider with the number beside it. The slider is followed at once; a typed number
/// waits for Run, like those of other fields.
class ScaleField : public StepField {
 public:
  ScaleField(const StepParameter& parameter, QWidget* parent)
      : StepField(parameter),
        frame_(new QWidget(parent)),
        slider_(new QSlider(Qt::Horizontal, frame_)),
        box_(number_box(parameter, frame_)) {
    auto* line = new QHBoxLayout(frame_);
    line->setContentsMargins(0, 0, 0, 0);
    line->addWidget(slider_, 1);
    line->addWidget(box_);
    slider_->setRange(0, steps);
    slider_->setPageStep(steps / 10);
    slider_->setToolTip(with_range(parameter));
    slider_->setAccessibleName(parameter.label);
    slider_->setFocusPolicy(Qt::StrongFocus);
    slider_->installEventFilter(&quiet_);
    show();
    QObject::connect(box_, &NumberBox::edited, box_, [this] {
      place_slider(box_->value());
      touch();
    });
    QObject::connect(box_, &NumberBox::editingFinished, &alive_, [this] { enter(); });
    QObject::connect(slider_, &QSlider::valueChanged, frame_, [this](int step) {
      box_->setValue(value_at(step));
      touch();
      if (slider_->isSliderDown()) {
        if (dragged) dragged();
      } else if (settled) {
        settled();
      }
    });
    QObject::connect(slider_, &QSlider::sliderReleased, frame_, [this] {
      if (settled) settled();
    });
  }
  QWidget* widget() const override { return frame_; }
  bool wide() const override { return true; }

 protected:
  QVariant read() override {
    box_->interpretText();
    return box_->value();
  }
  QVariant typed() const override { return box_->valueFromText(box_->text()); }
  void show() override {
    if (slider_->isSliderDown()) return;
    box_->setValue(shown(parameter_.value.toDouble()));
    place_slider(parameter_.value.toDouble());
  }

 private:
  static constexpr int steps = 400;
  /// The wheel scrolls the panel unless the slider has the focus.
  class QuietWheel : public QObject {
   protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
      if (event->type() != QEvent::Wheel || qobject_cast<QWidget*>(watched)->hasFocus())
        return false;
      event->ignore();
      return true;
    }
  };

  double value_at(int step) const {
    const double share = static_cast<double>(step) / steps;
    return round_significant(parameter_.least * std::pow(parameter_.most / parameter_.least, share),
                             3);
  }
  void place_slider(double value) {
    const QSignalBlocker blocker(slider_);
    slider_->setValue(static_cast<int>(std::lround(steps * std::log(value / parameter_.least) /
                                                   std::log(parameter_.most / parameter_.least))));
  }

  QuietWheel quiet_;
  QWidget* frame_;
  QSlider* slider_;
  NumberBox* box_;
};

}  // namespace

std::unique_ptr<StepField> make_step_field(const StepParameter& parameter, QWidget* parent) {
  switch (parameter.kind) {
    case StepParameter::Kind::real:
      return std::make_unique<RealField>(parameter, parent);
    case StepParameter::Kind::whole:
      return std::make_unique<WholeField>(parameter, parent);
    case StepParameter::Kind::choice:
      return std::make_unique<ChoiceField>(parameter, parent);
    case StepParameter::Kind::intervals:
      return std::make_unique<IntervalsField>(parameter, parent);
    case StepParameter::Kind::scale:
      return std::make_unique<ScaleField>(parameter, parent);
  }
  return nullptr;
}

}  // namespace arris::ui
