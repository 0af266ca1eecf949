#include "ui/panels/corrections_panel.h"

#include <limits>

#include <QCheckBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"
#include "ui/panels/wrapped_tree.h"

namespace arris::ui {

namespace {

constexpr std::uint32_t no_correction = std::numeric_limits<std::uint32_t>::max();
constexpr int id_role = Qt::UserRole;
constexpr int state_role = Qt::UserRole + 1;

QColor colour_of(CorrectionRow::State state, const QPalette& palette) {
  const bool dark = palette.color(QPalette::Base).lightness() < 128;
  switch (state) {
    case CorrectionRow::State::applied:
      return dark ? QColor(120, 200, 140) : QColor(20, 112, 60);
    case CorrectionRow::State::adapted:
      return dark ? QColor(232, 180, 90) : QColor(146, 84, 0);
    case CorrectionRow::State::failed:
      return mistake_colour(palette);
    case CorrectionRow::State::off:
      break;
  }
  return muted_text(palette);
}

}  // namespace

CorrectionsPanel::CorrectionsPanel(QWidget* parent) : QWidget(parent) {
  list_ = new WrappedTree(this);
  list_->setHeaderLabels({tr("Correction"), tr("State")});
  list_->setRootIsDecorated(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  list_->header()->setSectionsClickable(false);
  list_->setAccessibleName(tr("Corrections"));
  list_->set_empty_text(
      tr("No corrections yet. What you change by hand on lines and partitions is listed here, and "
         "done again when they are found again."));
  lift_ = new QPushButton(tr("Lift"), this);
  lift_->setToolTip(
      tr("Takes the correction back, as if it had never been made; the others stay."));
  show_ = new QPushButton(tr("Show"), this);
  show_->setToolTip(tr("Zooms to where the correction was made (double click, Enter)."));
  again_ = new QCheckBox(tr("Apply corrections when finding again"), this);
  again_->setToolTip(
      tr("Off: lines and partitions are found as the thresholds say, and the "
         "corrections wait in the list."));
  again_->setChecked(true);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(4);
  buttons->addWidget(show_);
  buttons->addWidget(lift_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->setSpacing(6);
  column->addWidget(list_, 1);
  column->addLayout(buttons);
  column->addWidget(again_);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this] { refresh_buttons(); });
  connect(list_, &QTreeWidget::itemActivated, this, [this] { emit show_wanted(current()); });
  connect(show_, &QPushButton::clicked, this, [this] { emit show_wanted(current()); });
  connect(lift_, &QPushButton::clicked, this, [this] { emit lift_wanted(current()); });
  connect(again_, &QCheckBox::toggled, this, &CorrectionsPanel::applied_again_changed);
  refresh_buttons();
}

void CorrectionsPanel::set_rows(std::vector<CorrectionRow> rows) {
  const std::uint32_t before = current();
  list_->clear();
  for (const CorrectionRow& row : rows) {
    const QString text = row.message.isEmpty() ? row.text : row.text + "\n" + row.message;
    auto* item = new QTreeWidgetItem(list_, {text, row.state_text});
    item->setData(0, id_role, row.id);
    item->setData(0, state_role, static_cast<int>(row.state));
    if (!row.message.isEmpty()) item->setTextAlignment(1, Qt::AlignTop | Qt::AlignLeft);
    if (row.id == before) list_->setCurrentItem(item);
  }
  refresh_colours();
  refresh_buttons();
}

void CorrectionsPanel::set_applied_again(bool applied) {
  const QSignalBlocker blocker(again_);
  again_->setChecked(applied);
}

void CorrectionsPanel::set_busy(bool busy) {
  busy_ = busy;
  refresh_buttons();
}

void CorrectionsPanel::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) refresh_colours();
  QWidget::changeEvent(event);
}

void CorrectionsPanel::refresh_colours() {
  for (int k = 0; k < list_->topLevelItemCount(); ++k) {
    QTreeWidgetItem* item = list_->topLevelItem(k);
    const auto state = static_cast<CorrectionRow::State>(item->data(0, state_role).toInt());
    item->setForeground(1, colour_of(state, palette()));
    QFont font = list_->font();
    font.setBold(state == CorrectionRow::State::failed);
    item->setFont(1, font);
  }
}

void CorrectionsPanel::refresh_buttons() {
  const bool any = current() != no_correction;
  show_->setEnabled(any);
  lift_->setEnabled(any && !busy_);
}

std::uint32_t CorrectionsPanel::current() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item ? item->data(0, id_role).toUInt() : no_correction;
}

}  // namespace arris::ui
