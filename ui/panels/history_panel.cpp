#include "ui/panels/history_panel.h"

#include <QEvent>
#include <QKeyEvent>
#include <QListWidget>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int sequence_role = Qt::UserRole;
constexpr int current_role = Qt::UserRole + 1;
constexpr int undone_role = Qt::UserRole + 2;

/// Bold for the current row, grey for the undone ones, from the palette at the time of painting.
class Delegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    option->font.setBold(index.data(current_role).toBool());
    option->fontMetrics = QFontMetrics(option->font);
    if (index.data(undone_role).toBool()) {
      option->font.setItalic(true);
      option->palette.setColor(QPalette::Text, mix(option->palette.color(QPalette::Text),
                                                   option->palette.color(QPalette::Base), 0.45));
    }
  }

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return QSize(QStyledItemDelegate::sizeHint(option, index).width(),
                 option.fontMetrics.height() + 8);
  }
};

}  // namespace

HistoryPanel::HistoryPanel(QWidget* parent) : QWidget(parent), list_(new QListWidget(this)) {
  list_->setItemDelegate(new Delegate(list_));
  list_->setUniformItemSizes(true);
  list_->setTextElideMode(Qt::ElideRight);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setAccessibleName(tr("History"));
  list_->setToolTip(tr("Click a row to go to the state after it."));
  list_->installEventFilter(this);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->addWidget(list_);
  connect(list_, &QListWidget::itemClicked, this, &HistoryPanel::go);
}

void HistoryPanel::set_rows(const std::vector<HistoryRow>& rows) {
  // In place, since this is often called from within a click on one of the items.
  while (list_->count() > static_cast<int>(rows.size())) delete list_->takeItem(list_->count() - 1);
  int current = -1;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    if (i >= list_->count()) list_->addItem(QString());
    const HistoryRow& row = rows[i];
    QListWidgetItem* item = list_->item(i);
    item->setText(row.text);
    item->setToolTip(row.tooltip.isEmpty() ? row.text : row.tooltip);
    item->setData(sequence_role, row.sequence);
    item->setData(current_role, row.current);
    item->setData(undone_role, row.undone);
    if (row.current) current = i;
  }
  list_->setCurrentRow(current);
  if (current >= 0) list_->scrollToItem(list_->item(current));
}

bool HistoryPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == list_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Return || key == Qt::Key_Enter) {
      go(list_->currentItem());
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

void HistoryPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (list_->currentItem() != nullptr) list_->scrollToItem(list_->currentItem());
}

void HistoryPanel::go(const QListWidgetItem* item) {
  if (item == nullptr || item->data(current_role).toBool()) return;
  emit travel(item->data(sequence_role).toUInt());
}

}  // namespace arris::ui
