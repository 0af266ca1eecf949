#include "ui/panels/steps_panel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <QApplication>
#include <QEvent>
#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

QString state_word(StepState state) {
  switch (state) {
    case StepState::unavailable:
      return QObject::tr("Coming later");
    case StepState::not_run:
      return QObject::tr("Not run");
    case StepState::done:
      return QObject::tr("Done");
    case StepState::out_of_date:
      return QObject::tr("Out of date");
  }
  return {};
}

QColor state_colour(StepState state, const QPalette& palette) {
  const bool dark = palette.color(QPalette::Base).lightness() < 128;
  switch (state) {
    case StepState::done:
      return dark ? QColor(80, 175, 100) : QColor(38, 128, 60);
    case StepState::out_of_date:
      return dark ? QColor(235, 170, 60) : QColor(190, 110, 0);
    default:
      return muted_text(palette);
  }
}

/// The state as a mark that differs by shape, not by colour alone.
class StateIcon : public QWidget {
 public:
  explicit StateIcon(QWidget* parent) : QWidget(parent) { setFixedSize(18, 18); }

  void set_state(StepState state) {
    state_ = state;
    setToolTip(state_word(state));
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor colour = state_colour(state_, palette());
    const QColor paper = card_ground(palette());
    const QRectF circle(1.5, 1.5, 15, 15);
    switch (state_) {
      case StepState::unavailable:
        painter.setPen(QPen(colour, 1.4, Qt::DotLine));
        painter.drawEllipse(circle);
        return;
      case StepState::not_run:
        painter.setPen(QPen(colour, 1.6));
        painter.drawEllipse(circle);
        return;
      case StepState::done: {
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour);
        painter.drawEllipse(circle.adjusted(-0.5, -0.5, 0.5, 0.5));
        painter.setPen(QPen(paper, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        const QPointF check[] = {{5.2, 9.4}, {8.0, 12.2}, {13.0, 6.4}};
        painter.drawPolyline(check, 3);
        return;
      }
      case StepState::out_of_date: {
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour);
        const QPointF triangle[] = {{9, 1}, {17.5, 16.5}, {0.5, 16.5}};
        painter.drawPolygon(triangle, 3);
        painter.setPen(QPen(paper, 2.0, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(QPointF(9, 6.8), QPointF(9, 11));
        painter.drawPoint(QPointF(9, 14));
        return;
      }
    }
  }

 private:
  StepState state_ = StepState::not_run;
};

/// The way from one step to the next.
class Arrow : public QWidget {
 public:
  explicit Arrow(QWidget* parent) : QWidget(parent) { setFixedHeight(10); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor colour =
        mix(palette().color(QPalette::Window), palette().color(QPalette::WindowText), 0.4);
    const double x = 19.0;
    painter.setPen(QPen(colour, 1.4));
    painter.drawLine(QPointF(x, 0), QPointF(x, 6));
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    const QPointF head[] = {{x - 4, 4.5}, {x + 4, 4.5}, {x, 9.5}};
    painter.drawPolygon(head, 3);
  }
};

/// A parameter's editor. Until the user changes it, its value is the very value it was given, with
/// all the digits that the editor does not show.
class Field {
 public:
  explicit Field(StepParameter parameter) : parameter_(std::move(parameter)) {}
  virtual ~Field() = default;

  virtual QWidget* widget() const = 0;
  virtual bool wide() const { return false; }  // Takes a line of its own under the label.
  /// What is wrong with the values, as a sentence; empty if nothing is.
  virtual QString mistake() const { return {}; }

  QVariant value() { return touched_ ? read() : parameter_.value; }
  void ran() {
    parameter_.value = value();
    touched_ = false;
  }
  void touch() {
    touched_ = true;
    if (edited) edited();
  }

  bool fits(const StepParameter& other) const {
    return parameter_.key == other.key && parameter_.kind == other.kind &&
           parameter_.label == other.label && parameter_.tooltip == other.tooltip &&
           parameter_.least == other.least && parameter_.most == other.most &&
           parameter_.decimals == other.decimals && parameter_.suffix == other.suffix &&
           parameter_.choices == other.choices && parameter_.choice_labels == other.choice_labels &&
           parameter_.hangs_on == other.hangs_on;
  }

  /// A new value from the document is shown unless the user is at work here. The same value again
  /// is no news: what the user has edited and not yet run stays.
  void update(const QVariant& value) {
    if (value == parameter_.value) return;
    parameter_.value = value;
    const QWidget* focus = QApplication::focusWidget();
    const bool focused = focus != nullptr && (focus == widget() || widget()->isAncestorOf(focus));
    if (touched_ && focused) return;
    touched_ = false;
    show();
  }

  /// Another choice was made that this parameter hangs on: what was edited stays.
  void rebase(const QVariant& value) {
    parameter_.value = value;
    if (!touched_) show();
  }

  /// Whether it shows another value than the document has.
  bool is_edited() const { return touched_ && typed() != parameter_.value; }

  std::function<void()> edited;
  std::function<void()> entered;           // a number, whole
  std::function<void()> dragged, settled;  // of a slider, which is followed at once

 protected:
  virtual QVariant read() = 0;
  virtual QVariant typed() const = 0;  ///< As far as it was typed.
  virtual void show() = 0;
  void enter() {
    if (is_edited() && entered) entered();
  }

  StepParameter parameter_;
  QObject alive_;  // editors that lose the focus in their end still tell that they are finished

 private:
  bool touched_ = false;
};

QString with_range(const StepParameter& p) {
  if (p.most <= p.least) return p.tooltip;
  const QString range =
      QObject::tr("From %1 to %2%3.").arg(number_text(p.least), number_text(p.most), p.suffix);
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

class RealField : public Field {
 public:
  RealField(const StepParameter& parameter, QWidget* parent)
      : Field(parameter), box_(number_box(parameter, parent)) {
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

class WholeField : public Field {
 public:
  WholeField(const StepParameter& parameter, QWidget* parent)
      : Field(parameter), box_(new WholeBox(parent)) {
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

class ChoiceField : public Field {
 public:
  ChoiceField(const StepParameter& parameter, QWidget* parent)
      : Field(parameter), box_(new QuietCombo(parent)) {
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
class IntervalsField : public Field {
 public:
  IntervalsField(const StepParameter& parameter, QWidget* parent)
      : Field(parameter), frame_(new QWidget(parent)), column_(new QVBoxLayout(frame_)) {
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
class ScaleField : public Field {
 public:
  ScaleField(const StepParameter& parameter, QWidget* parent)
      : Field(parameter),
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

std::unique_ptr<Field> make_field(const StepParameter& parameter, QWidget* parent) {
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

/// One step. The frame is painted from the palette, so that it follows light and dark.
class CardFrame : public QWidget {
 public:
  CardFrame(const StepCard& card, QWidget* parent);

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
  bool available() const { return card_.state != StepState::unavailable; }
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
  std::vector<std::unique_ptr<Field>> fields_;
  std::vector<bool> beside_;  // The editor stands beside its label, not under it.
};

CardFrame::CardFrame(const StepCard& card, QWidget* parent) : QWidget(parent), card_(card) {
  auto* column = new QVBoxLayout(this);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  icon_ = new StateIcon(this);
  title_ = available() ? new QLabel(this) : new MutedLabel({}, this);
  title_->setWordWrap(true);
  head->addWidget(icon_, 0, available() ? Qt::AlignTop : Qt::AlignVCenter);
  head->addWidget(title_, 1);
  column->addLayout(head);
  if (available()) {
    column->setContentsMargins(10, 9, 10, 9);
    column->setSpacing(6);
    QFont bold = font();
    bold.setBold(true);
    title_->setFont(bold);
    build_controls(column);
  } else {
    column->setContentsMargins(10, 3, 10, 3);
    state_ = new MutedLabel({}, this);
    head->addWidget(state_);
  }
  show_card(card);
}

void CardFrame::build_controls(QVBoxLayout* column) {
  result_ = new QLabel(this);
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(result_);
  form_ = new QGridLayout;
  form_->setHorizontalSpacing(8);
  form_->setVerticalSpacing(4);
  form_->setColumnStretch(1, 1);
  for (const StepParameter& parameter : card_.parameters) {
    fields_.push_back(make_field(parameter, this));
    Field* field = fields_.back().get();
    field->edited = [this, chooses = parameter.kind == StepParameter::Kind::choice] {
      if (chooses) follow_choices();
      allow_run();
      show_state();
      if (edited) edited();
    };
    field->entered = [this] {
      if (entered && !busy_) entered();
    };
    field->dragged = [this] {
      if (dragged && !busy_) dragged();
    };
    field->settled = [this] {
      if (settled && !busy_) settled();
    };
    const bool unit = field->wide() && !parameter.suffix.trimmed().isEmpty();
    auto* label =
        new QLabel(unit ? QStringLiteral("%1 (%2)").arg(parameter.label, parameter.suffix.trimmed())
                        : parameter.label,
                   this);
    label->setToolTip(parameter.tooltip);
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    if (!field->wide()) label->setBuddy(field->widget());
    labels_.push_back(label);
  }
  if (!fields_.empty()) column->addLayout(form_);
  arrange_form();
  auto* foot = new QHBoxLayout;
  state_ = new MutedLabel({}, this);
  state_->setWordWrap(true);
  run_ = new QPushButton(QObject::tr("Run"), this);
  run_->setAutoDefault(false);
  run_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  run_->setAccessibleName(QObject::tr("Run %1").arg(card_.title));
  // A click would make it the focus, and running disables it: the next editor would then take the
  // keys that are meant for the view.
  run_->setFocusPolicy(Qt::TabFocus);
  foot->addWidget(state_, 1, Qt::AlignVCenter);
  foot->addWidget(run_);
  run_->setVisible(card_.runnable);
  column->addLayout(foot);
  QObject::connect(run_, &QPushButton::clicked, this, [this] {
    allow_run();
    if (run_->isEnabled() && run) run();
  });
}

/// Editors stand beside their labels in two columns; one that would be cut there goes under its
/// label, over the whole width.
void CardFrame::arrange_form() {
  if (form_ == nullptr) return;
  const QMargins margins = contentsMargins() + layout()->contentsMargins();
  const int room = width() - margins.left() - margins.right() - form_->horizontalSpacing();
  const auto label_width = [this](std::size_t i) {
    return fontMetrics().horizontalAdvance(labels_[i]->text()) + 2;
  };
  const auto editor_width = [this](std::size_t i) {
    return fields_[i]->widget()->sizeHint().width();
  };
  std::vector<bool> beside(fields_.size());
  for (std::size_t i = 0; i < fields_.size(); ++i) beside[i] = !fields_[i]->wide();
  int labels = 0;
  while (true) {
    labels = 0;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (beside[i] && value_of(i).isValid()) labels = std::max(labels, label_width(i));
    }
    // The row that needs most goes first, until the others fit.
    std::size_t worst = fields_.size();
    bool cut = false;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (!beside[i] || !value_of(i).isValid()) continue;
      cut = cut || labels + editor_width(i) > room;
      if (worst == fields_.size() ||
          label_width(i) + editor_width(i) > label_width(worst) + editor_width(worst)) {
        worst = i;
      }
    }
    if (!cut) break;
    beside[worst] = false;
  }
  // Each call asks for a new layout, even one that changes nothing, and a layout leads here again.
  if (form_->columnMinimumWidth(0) != labels) form_->setColumnMinimumWidth(0, labels);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const bool wraps = label_width(i) > room;
    if (labels_[i]->wordWrap() != wraps) labels_[i]->setWordWrap(wraps);
  }
  if (beside == beside_) return;
  beside_ = beside;
  int row = 0;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    QWidget* editor = fields_[i]->widget();
    form_->removeWidget(labels_[i]);
    form_->removeWidget(editor);
    form_->addWidget(labels_[i], row, 0, 1, beside[i] ? 1 : 2);
    if (!beside[i]) ++row;
    form_->addWidget(editor, row++, beside[i] ? 1 : 0, 1, beside[i] ? 1 : 2);
  }
}

bool CardFrame::fits(const StepCard& card) const {
  return card.name == card_.name && card.title == card_.title &&
         (card.state == StepState::unavailable) == !available() &&
         (!available() ||
          std::equal(card.parameters.begin(), card.parameters.end(), fields_.begin(), fields_.end(),
                     [](const StepParameter& p, const std::unique_ptr<Field>& field) {
                       return field->fits(p);
                     }));
}

void CardFrame::show_card(const StepCard& card) {
  card_ = card;
  setToolTip(card.tooltip);
  title_->setText(card.title);
  if (available()) {
    result_->setText(card.result);
    result_->setVisible(!card.result.isEmpty());
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (card.parameters[i].hangs_on.isEmpty()) fields_[i]->update(card.parameters[i].value);
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (!card.parameters[i].hangs_on.isEmpty() && value_of(i).isValid())
        fields_[i]->update(value_of(i));
    show_hanging();
    allow_run();
  }
  show_state();
}

/// What was edited and not run is not what the document holds.
void CardFrame::show_state() {
  const bool ran = card_.state == StepState::done || card_.state == StepState::out_of_date;
  const bool changed = ran && is_edited();
  icon_->set_state(changed ? StepState::out_of_date : card_.state);
  QString state = changed ? QObject::tr("Changed, not run") : state_word(card_.state);
  if (available() && !changed && !card_.time.isEmpty()) state += QStringLiteral(" · ") + card_.time;
  state_->setText(state);
  update();
}

void CardFrame::show_hanging() {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (card_.parameters[i].hangs_on.isEmpty()) continue;
    labels_[i]->setVisible(value_of(i).isValid());
    fields_[i]->widget()->setVisible(value_of(i).isValid());
  }
  arrange_form();
}

void CardFrame::allow_run() {
  if (run_ == nullptr) return;
  QString mistake;
  for (const auto& field : fields_) {
    if (mistake.isEmpty()) mistake = field->mistake();
  }
  run_->setEnabled(!busy_ && mistake.isEmpty());
  run_->setToolTip(!mistake.isEmpty() ? mistake
                                      : (busy_ ? QObject::tr("Another step is at work.")
                                               : QObject::tr("Runs this step with these values.")));
}

void CardFrame::paintEvent(QPaintEvent*) {
  if (!available()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor paper = card_ground(palette());
  const bool late =
      card_.state == StepState::out_of_date || (card_.state == StepState::done && is_edited());
  painter.setPen(late ? QPen(state_colour(StepState::out_of_date, palette()), 1.4)
                      : QPen(mix(paper, palette().color(QPalette::Text), 0.28), 1.0));
  painter.setBrush(paper);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.7, 0.7, -0.7, -0.7), 5, 5);
}

}  // namespace

class StepsPanel::Private {
 public:
  StepsPanel* q = nullptr;
  QPushButton* run_late = nullptr;
  QScrollArea* scroll = nullptr;
  QWidget* content = nullptr;
  QVBoxLayout* column = nullptr;
  std::vector<CardFrame*> frames;
  std::vector<Arrow*> arrows;
  bool busy = false;

  CardFrame* make(const StepCard& card) {
    auto* frame = new CardFrame(card, content);
    frame->set_busy(busy);
    frame->run = [this, frame] { emit q->run_requested(frame->card().name, frame->values()); };
    frame->edited = [this] { emit q->edited(); };
    frame->entered = [this, frame] { emit q->entered(frame->card().name, frame->values()); };
    frame->dragged = [this, frame] { emit q->dragged(frame->card().name, frame->values()); };
    frame->settled = [this, frame] { emit q->settled(frame->card().name, frame->values()); };
    return frame;
  }

  static void discard(QWidget* widget) {
    // Maybe it is one of its own buttons that leads here.
    widget->hide();
    widget->deleteLater();
  }

  void rebuild(const std::vector<StepCard>& cards) {
    for (CardFrame* frame : frames) discard(frame);
    for (Arrow* arrow : arrows) discard(arrow);
    frames.clear();
    arrows.clear();
    while (QLayoutItem* item = column->takeAt(0)) delete item;
    for (const StepCard& card : cards) {
      if (!frames.empty()) {
        arrows.push_back(new Arrow(content));
        column->addWidget(arrows.back());
      }
      frames.push_back(make(card));
      column->addWidget(frames.back());
    }
    column->addStretch(1);
  }
};

StepsPanel::StepsPanel(QWidget* parent) : QWidget(parent), p_(std::make_unique<Private>()) {
  p_->q = this;
  p_->run_late = new QPushButton(tr("Run all out of date"), this);
  p_->run_late->setFocusPolicy(Qt::TabFocus);
  p_->run_late->setToolTip(
      tr("Runs again, from top to bottom, each step that is out of date because an earlier one "
         "changed."));
  p_->run_late->setAutoDefault(false);
  p_->run_late->hide();
  p_->content = new QWidget;
  p_->column = new QVBoxLayout(p_->content);
  p_->column->setContentsMargins(6, 6, 6, 6);
  p_->column->setSpacing(0);
  p_->scroll = new QScrollArea(this);
  p_->scroll->setWidgetResizable(true);
  p_->scroll->setFrameShape(QFrame::NoFrame);
  p_->scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  p_->scroll->setFocusPolicy(Qt::NoFocus);
  p_->scroll->setWidget(p_->content);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* head = new QVBoxLayout;
  head->setContentsMargins(6, 6, 6, 0);
  head->addWidget(p_->run_late);
  column->addLayout(head);
  column->addWidget(p_->scroll, 1);
  setMinimumWidth(240);
  connect(p_->run_late, &QPushButton::clicked, this, &StepsPanel::run_out_of_date_requested);
}

StepsPanel::~StepsPanel() {
  // What loses the focus in the end tells nobody any more.
  for (CardFrame* frame : p_->frames) frame->entered = nullptr;
}

void StepsPanel::set_cards(const std::vector<StepCard>& cards) {
  const bool same = std::equal(
      cards.begin(), cards.end(), p_->frames.begin(), p_->frames.end(),
      [](const StepCard& card, const CardFrame* frame) { return card.name == frame->card().name; });
  if (!same) {
    const int down = p_->scroll->verticalScrollBar()->value();
    p_->rebuild(cards);
    p_->scroll->verticalScrollBar()->setValue(down);
  } else {
    for (std::size_t i = 0; i < cards.size(); ++i) {
      if (p_->frames[i]->fits(cards[i])) {
        p_->frames[i]->show_card(cards[i]);
        continue;
      }
      CardFrame* old = p_->frames[i];
      p_->frames[i] = p_->make(cards[i]);
      delete p_->column->replaceWidget(old, p_->frames[i]);
      Private::discard(old);
    }
  }
  p_->run_late->setVisible(std::any_of(cards.begin(), cards.end(), [](const StepCard& card) {
    return card.state == StepState::out_of_date;
  }));
}

void StepsPanel::set_busy(bool busy) {
  p_->busy = busy;
  p_->run_late->setEnabled(!busy);
  for (CardFrame* frame : p_->frames) frame->set_busy(busy);
}

bool StepsPanel::is_edited(const QString& step) const {
  return std::ranges::any_of(p_->frames, [&](const CardFrame* frame) {
    return frame->card().name == step && frame->is_edited();
  });
}

QVariantMap StepsPanel::values(const QString& step) const {
  for (const CardFrame* frame : p_->frames) {
    if (frame->card().name == step) return frame->values();
  }
  return {};
}

}  // namespace arris::ui
