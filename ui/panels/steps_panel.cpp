#include "ui/panels/steps_panel.h"

#include <algorithm>

#include <QPainter>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

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

}  // namespace

class StepsPanel::Private {
 public:
  StepsPanel* q = nullptr;
  QPushButton* run_late = nullptr;
  QScrollArea* scroll = nullptr;
  QWidget* content = nullptr;
  QVBoxLayout* column = nullptr;
  std::vector<StepCardFrame*> frames;
  std::vector<Arrow*> arrows;
  bool busy = false;

  StepCardFrame* make(const StepCard& card) {
    auto* frame = new StepCardFrame(card, content);
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
    for (StepCardFrame* frame : frames) discard(frame);
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
  for (StepCardFrame* frame : p_->frames) frame->entered = nullptr;
}

void StepsPanel::set_cards(const std::vector<StepCard>& cards) {
  const bool same = std::equal(cards.begin(), cards.end(), p_->frames.begin(), p_->frames.end(),
                               [](const StepCard& card, const StepCardFrame* frame) {
                                 return card.name == frame->card().name;
                               });
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
      StepCardFrame* old = p_->frames[i];
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
  for (StepCardFrame* frame : p_->frames) frame->set_busy(busy);
}

bool StepsPanel::is_edited(const QString& step) const {
  return std::ranges::any_of(p_->frames, [&](const StepCardFrame* frame) {
    return frame->card().name == step && frame->is_edited();
  });
}

QVariantMap StepsPanel::values(const QString& step) const {
  for (const StepCardFrame* frame : p_->frames) {
    if (frame->card().name == step) return frame->values();
  }
  return {};
}

}  // namespace arris::ui
