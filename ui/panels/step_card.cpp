#include "ui/panels/step_card.h"

#include <algorithm>

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

QString state_word(StepState state) {
  switch (state) {
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

}  // namespace

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

StepCardFrame::StepCardFrame(const StepCard& card, QWidget* parent) : QWidget(parent), card_(card) {
  auto* column = new QVBoxLayout(this);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  icon_ = new StateIcon(this);
  title_ = new QLabel(this);
  title_->setWordWrap(true);
  head->addWidget(icon_, 0, Qt::AlignTop);
  head->addWidget(title_, 1);
  column->addLayout(head);
  column->setContentsMargins(10, 9, 10, 9);
  column->setSpacing(6);
  QFont bold = font();
  bold.setBold(true);
  title_->setFont(bold);
  build_controls(column);
  show_card(card);
}

void StepCardFrame::build_controls(QVBoxLayout* column) {
  result_ = new QLabel(this);
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(result_);
  if (!card_.parameters.empty()) {
    form_ = new QGridLayout;
    form_->setHorizontalSpacing(8);
    form_->setVerticalSpacing(4);
    form_->setColumnStretch(1, 1);
    column->addLayout(form_);
  }
  for (const StepParameter& parameter : card_.parameters) {
    fields_.push_back(make_step_field(parameter, this));
    StepField* field = fields_.back().get();
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
void StepCardFrame::arrange_form() {
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

bool StepCardFrame::fits(const StepCard& card) const {
  return card.name == card_.name && card.title == card_.title &&
         std::equal(card.parameters.begin(), card.parameters.end(), fields_.begin(), fields_.end(),
                    [](const StepParameter& p, const std::unique_ptr<StepField>& field) {
                      return field->fits(p);
                    });
}

void StepCardFrame::show_card(const StepCard& card) {
  card_ = card;
  setToolTip(card.tooltip);
  title_->setText(card.title);
  result_->setText(card.result);
  result_->setVisible(!card.result.isEmpty());
  for (std::size_t i = 0; i < fields_.size(); ++i)
    if (card.parameters[i].hangs_on.isEmpty()) fields_[i]->update(card.parameters[i].value);
  for (std::size_t i = 0; i < fields_.size(); ++i)
    if (!card.parameters[i].hangs_on.isEmpty() && value_of(i).isValid())
      fields_[i]->update(value_of(i));
  show_hanging();
  allow_run();
  show_state();
}

/// What was edited and not run is not what the document holds.
void StepCardFrame::show_state() {
  const bool ran = card_.state == StepState::done || card_.state == StepState::out_of_date;
  const bool changed = ran && is_edited();
  icon_->set_state(changed ? StepState::out_of_date : card_.state);
  QString state = changed ? QObject::tr("Changed, not run") : state_word(card_.state);
  if (!changed && !card_.time.isEmpty()) state += QStringLiteral(" · ") + card_.time;
  state_->setText(state);
  update();
}

void StepCardFrame::show_hanging() {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (card_.parameters[i].hangs_on.isEmpty()) continue;
    labels_[i]->setVisible(value_of(i).isValid());
    fields_[i]->widget()->setVisible(value_of(i).isValid());
  }
  arrange_form();
}

void StepCardFrame::allow_run() {
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

void StepCardFrame::paintEvent(QPaintEvent*) {
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

}  // namespace arris::ui
