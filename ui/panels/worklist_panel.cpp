#include "ui/panels/worklist_panel.h"

#include <utility>

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/controls.h"
#include "ui/panels/wrapped_tree.h"

namespace arris::ui {

namespace {

constexpr int row_role = Qt::UserRole;
constexpr int choice_role = Qt::UserRole + 1;

}  // namespace

WorklistPanel::WorklistPanel(QWidget* parent) : QWidget(parent) {
  summary_ = new QLabel(this);
  summary_->setWordWrap(true);
  tree_ = new WrappedTree(this);
  tree_->setHeaderHidden(true);
  tree_->setColumnCount(1);
  tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  tree_->setIndentation(12);
  tree_->setAccessibleName(tr("What is left to do"));
  tree_->installEventFilter(this);
  hint_ = new MutedLabel({}, this);
  hint_->setWordWrap(true);
  const auto button = [this](const QString& text, const QString& tooltip) {
    auto* result = new QPushButton(text, this);
    result->setToolTip(tooltip);
    result->setAutoDefault(false);
    return result;
  };
  previous_ = button(tr("Previous"), tr("Zoom to the one before (Shift+F7)"));
  next_ = button(tr("Next"), tr("Zoom to the next one (F7)"));
  accept_ =
      button(tr("Accept"), tr("Draw the line that is shown dashed (A, or Enter in the list)"));
  dismiss_ = button(tr("Dismiss"), tr("Leave it as it is and take it off the list, as long as this "
                                      "window is open (Shift+A, or Delete in the list)"));
  dismiss_under_ = button(tr("Dismiss all under"),
                          tr("Take everything off the list that changes less than this: lines and "
                             "boundaries shorter, areas of a smaller side"));
  under_ = new NumberBox(this);
  under_->setDecimals(3);
  under_->setRange(0.0, 1e6);
  under_->setAccessibleName(tr("Dismiss all under"));
  auto* steps = new QHBoxLayout;
  steps->setSpacing(4);
  steps->addWidget(previous_);
  steps->addWidget(next_);
  auto* answers = new QHBoxLayout;
  answers->setSpacing(4);
  answers->addWidget(accept_);
  answers->addWidget(dismiss_);
  auto* small = new QHBoxLayout;
  small->setSpacing(4);
  small->addWidget(dismiss_under_);
  small->addWidget(under_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->setSpacing(6);
  column->addWidget(summary_);
  column->addWidget(tree_, 1);
  column->addWidget(hint_);
  column->addLayout(steps);
  column->addLayout(answers);
  column->addLayout(small);
  connect(tree_, &QTreeWidget::currentItemChanged, this, [this] { take_current(); });
  // A click on what is current already shows it again.
  connect(tree_, &QTreeWidget::itemClicked, this, [this] { take_current(); });
  connect(next_, &QPushButton::clicked, this, &WorklistPanel::next_wanted);
  connect(previous_, &QPushButton::clicked, this, &WorklistPanel::previous_wanted);
  connect(accept_, &QPushButton::clicked, this, &WorklistPanel::accept_wanted);
  connect(dismiss_, &QPushButton::clicked, this, &WorklistPanel::dismiss_wanted);
  connect(dismiss_under_, &QPushButton::clicked, this,
          [this] { emit dismiss_under_wanted(under_->value()); });
  set_enabled_buttons(false, false, false);
}

void WorklistPanel::set_rows(std::vector<WorkRow> rows) {
  setting_ = true;
  tree_->clear();
  items_.clear();
  choices_.clear();
  row_ = -1;
  choice_ = 0;
  std::vector<std::pair<QTreeWidgetItem*, int>> groups;
  for (WorkRow& row : rows) {
    if (groups.empty() || groups.back().first->text(0) != row.group) {
      auto* group = new QTreeWidgetItem({row.group});
      QFont bold = font();
      bold.setBold(true);
      group->setFont(0, bold);
      group->setFlags(Qt::ItemIsEnabled);
      group->setData(0, row_role, -1);
      groups.emplace_back(group, 0);
    }
    ++groups.back().second;
    auto* item = new QTreeWidgetItem(groups.back().first, {row.text});
    item->setData(0, row_role, static_cast<int>(items_.size()));
    items_.push_back(item);
    choices_.push_back(std::move(row.choices));
  }
  for (const auto& [group, count] : groups) {
    group->setText(0, QStringLiteral("%1  (%2)").arg(group->text(0), count_text(count)));
    tree_->addTopLevelItem(group);
    group->setExpanded(true);
  }
  hint_->clear();
  setting_ = false;
}

void WorklistPanel::set_text(int row, const QString& text) {
  setting_ = true;
  if (QTreeWidgetItem* item = item_of(row)) item->setText(0, text);
  setting_ = false;
}

void WorklistPanel::set_stale(bool stale) {
  const bool had_focus = tree_->hasFocus() || stale_focus_;
  stale_focus_ = stale && had_focus;  // a disabled list loses it
  tree_->setEnabled(!stale);
  setting_ = true;
  if (stale) tree_->clearSelection();  // greyed on the colour of a selection nothing can be read
  setting_ = false;
  if (!stale && had_focus) tree_->setFocus();
}

void WorklistPanel::set_summary(const QString& summary, const QString& empty_text) {
  summary_->setText(summary);
  tree_->set_empty_text(empty_text);
}

QTreeWidgetItem* WorklistPanel::item_of(int row) const {
  return row >= 0 && row < static_cast<int>(items_.size()) ? items_[static_cast<std::size_t>(row)]
                                                           : nullptr;
}

void WorklistPanel::set_current(int row, int choice) {
  setting_ = true;
  QTreeWidgetItem* item = item_of(row);
  if (QTreeWidgetItem* before = item_of(row_); before && before != item) {
    // Its choices are only there while it is current.
    if (tree_->currentItem() && tree_->currentItem()->parent() == before)
      tree_->setCurrentItem(before);
    qDeleteAll(before->takeChildren());
  }
  row_ = item ? row : -1;
  choice_ = item ? choice : 0;
  hint_->clear();
  if (item) {
    const QStringList& choices = choices_[static_cast<std::size_t>(row)];
    if (item->childCount() == 0 && choices.size() > 1) {
      for (int k = 0; k < choices.size(); ++k) {
        auto* child =
            new QTreeWidgetItem(item, {QStringLiteral("%1   %2").arg(k + 1).arg(choices[k])});
        child->setData(0, row_role, row);
        child->setData(0, choice_role, k);
      }
      item->setExpanded(true);
    }
    for (int k = 0; k < item->childCount(); ++k) {
      QFont chosen = font();
      chosen.setBold(k == choice_);
      item->child(k)->setFont(0, chosen);
    }
    if (choices.size() > 1)
      hint_->setText(
          tr("The ringed way on is accepted; 1 to %1 choose another.").arg(choices.size()));
    QTreeWidgetItem* current = item->childCount() > 0 && choice_ > 0 ? item->child(choice_) : item;
    if (tree_->currentItem() != current &&
        !(choice_ == 0 && item->childCount() > 0 && tree_->currentItem() == item->child(0)))
      tree_->setCurrentItem(current);
    if (item->childCount() > 0) tree_->scrollToItem(item->child(item->childCount() - 1));
    tree_->scrollToItem(tree_->currentItem());
  } else {
    tree_->setCurrentItem(nullptr);
  }
  setting_ = false;
}

void WorklistPanel::set_small_extent(double extent, const QString& suffix) {
  under_->setSuffix(suffix);
  if (!under_->hasFocus()) under_->setValue(extent);
}

void WorklistPanel::set_enabled_buttons(bool step, bool accept, bool dismiss) {
  previous_->setEnabled(step);
  next_->setEnabled(step);
  dismiss_under_->setEnabled(step);
  under_->setEnabled(step);
  accept_->setEnabled(accept);
  dismiss_->setEnabled(dismiss);
}

void WorklistPanel::take_current() {
  if (setting_) return;
  const QTreeWidgetItem* item = tree_->currentItem();
  const int row = item ? item->data(0, row_role).toInt() : -1;
  if (row < 0) return;
  set_current(row, item->data(0, choice_role).toInt());
  emit current_changed(row_, choice_);
}

bool WorklistPanel::eventFilter(QObject* watched, QEvent* event) {
  const bool press = event->type() == QEvent::KeyPress;
  if (!press && event->type() != QEvent::ShortcutOverride)
    return QWidget::eventFilter(watched, event);
  auto* key_event = static_cast<QKeyEvent*>(event);
  if (key_event->modifiers() & ~Qt::KeypadModifier) return QWidget::eventFilter(watched, event);
  const int key = key_event->key();
  // Where there is nothing to choose digits are those of the window: the standard views.
  const qsizetype choices = row_ >= 0 ? choices_[static_cast<std::size_t>(row_)].size() : 0;
  const bool digit = choices > 1 && key >= Qt::Key_1 && key - Qt::Key_1 < choices;
  const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
  if (!digit && !enter && key != Qt::Key_Delete) return QWidget::eventFilter(watched, event);
  event->accept();  // not the window's shortcut for this key
  if (!press) return true;
  if (enter) emit accept_wanted();
  if (key == Qt::Key_Delete) emit dismiss_wanted();
  if (digit) {
    set_current(row_, key - Qt::Key_1);
    emit current_changed(row_, choice_);
  }
  return true;
}

}  // namespace arris::ui
