#include "ui/panels/unit_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>

namespace arris::ui {

UnitBar::UnitBar(QWidget* parent) : QFrame(parent) {
  setObjectName("unit_bar");
  setFrameShape(QFrame::NoFrame);
  setAutoFillBackground(true);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setAccessibleName(tr("What the lengths of this scan are in"));
  question_ = new QLabel(this);
  // It gives way where there is little room, the answers do not.
  question_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  other_ = new QToolButton(this);
  other_->setText(tr("Other"));
  other_->setToolTip(tr("Another unit"));
  other_->setPopupMode(QToolButton::InstantPopup);
  other_->setMenu(new QMenu(other_));
  auto* leave = new QPushButton(tr("Not known"), this);
  leave->setObjectName("unit_not_known");
  leave->setToolTip(
      tr("Lengths are told without a unit; Part ▸ Unit of lengths can still say it. It is not "
         "asked again."));
  leave->setAutoDefault(false);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->setSpacing(6);
  row->addWidget(question_, 1);
  answers_ = new QHBoxLayout;
  answers_->setSpacing(6);
  row->addLayout(answers_);
  row->addWidget(other_);
  row->addWidget(leave);
  connect(leave, &QPushButton::clicked, this, &UnitBar::dismissed);
  hide();
}

void UnitBar::ask(const QString& question, const QStringList& likely, const QStringList& others) {
  question_->setText(question);
  question_->setToolTip(
      tr("%1\nThe file does not say what its lengths are in. Nothing is computed from the unit: it "
         "only tells how results are said.")
          .arg(question));
  while (QLayoutItem* item = answers_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  QWidget* before = question_;
  for (const QString& name : likely) {
    auto* button = new QPushButton(name, this);
    button->setAutoDefault(false);
    button->setToolTip(tr("The lengths of this scan are %1").arg(name.toLower()));
    connect(button, &QPushButton::clicked, this, [this, name] { emit answered(name); });
    answers_->addWidget(button);
    setTabOrder(before, button);
    before = button;
  }
  setTabOrder(before, other_);
  other_->menu()->clear();
  for (const QString& name : others)
    connect(other_->menu()->addAction(name), &QAction::triggered, this,
            [this, name] { emit answered(name); });
  show();
}

void UnitBar::set_answerable(bool answerable) { setEnabled(answerable); }

}  // namespace arris::ui
