#include "ui/panels/history_panel.h"

#include <utility>

#include <QAction>
#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QListWidget>
#include <QMenu>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

constexpr int sequence_role = Qt::UserRole;
constexpr int current_role = Qt::UserRole + 1;
constexpr int undone_role = Qt::UserRole + 2;
constexpr int name_role = Qt::UserRole + 3;

/// Bold for the current row, grey for the undone ones, the name of a version as a tag before it,
/// from the palette at the time of painting.
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

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    const QString name = index.data(name_role).toString();
    if (name.isEmpty()) return QStyledItemDelegate::paint(painter, option, index);
    // The row without its text, the tag over it, the text in what room is left.
    QStyleOptionViewItem row = option;
    initStyleOption(&row, index);
    const QString text = std::exchange(row.text, QString());
    const QStyle* style = row.widget ? row.widget->style() : QApplication::style();
    style->drawControl(QStyle::CE_ItemViewItem, &row, painter, row.widget);
    const int most = row.rect.width() * 3 / 5;
    const QString shown = row.fontMetrics.elidedText(name, Qt::ElideRight, most - 16);
    const QRect tag(row.rect.left() + 3, row.rect.top() + 2,
                    row.fontMetrics.horizontalAdvance(shown) + 14, row.rect.height() - 4);
    const bool selected = row.state.testFlag(QStyle::State_Selected);
    const QColor accent = row.palette.color(QPalette::Highlight);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setFont(row.font);
    painter->setPen(QPen(selected ? row.palette.color(QPalette::HighlightedText) : accent, 1.2));
    painter->setBrush(mix(row.palette.color(QPalette::Base), accent, 0.18));
    painter->drawRoundedRect(QRectF(tag).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
    painter->setPen(row.palette.color(QPalette::Active, QPalette::Text));
    painter->drawText(tag, Qt::AlignCenter, shown);
    const QRect rest = row.rect.adjusted(tag.right() - row.rect.left() + 8, 0, -4, 0);
    painter->setPen(row.palette.color(selected ? QPalette::HighlightedText : QPalette::Text));
    painter->drawText(rest, Qt::AlignVCenter,
                      row.fontMetrics.elidedText(text, Qt::ElideRight, rest.width()));
    painter->restore();
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
  list_->setToolTip(tr(
      "Click a row to go to the state after it. F2 names a version; the context menu compares."));
  list_->setContextMenuPolicy(Qt::CustomContextMenu);
  list_->installEventFilter(this);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->addWidget(list_);
  connect(list_, &QListWidget::itemClicked, this, &HistoryPanel::go);
  connect(list_, &QListWidget::customContextMenuRequested, this, &HistoryPanel::context_menu);
}

void HistoryPanel::set_rows(const std::vector<HistoryRow>& rows) {
  // In place, since this is often called from within a click on one of the items.
  int count = 0, current = -1;
  const auto next_item = [&] {
    if (count == list_->count()) list_->addItem(QString());
    return list_->item(count++);
  };
  bool elsewhere = false;
  for (const HistoryRow& row : rows) {
    if (row.elsewhere && !std::exchange(elsewhere, true)) {
      QListWidgetItem* heading = next_item();
      heading->setText(tr("Versions on other branches"));
      heading->setToolTip(tr("Named states that undo and redo do not lead to"));
      heading->setFlags(Qt::NoItemFlags);
      for (const int role : {sequence_role, current_role, undone_role, name_role})
        heading->setData(role, QVariant());
    }
    QListWidgetItem* item = next_item();
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    item->setText(row.text);
    item->setToolTip(row.tooltip.isEmpty() ? row.text : row.tooltip);
    item->setData(sequence_role, row.sequence);
    item->setData(current_role, row.current);
    item->setData(undone_role, row.undone);
    item->setData(name_role, row.name);
    item->setData(Qt::AccessibleTextRole,
                  row.name.isEmpty() ? row.text : tr("%1: %2").arg(row.name, row.text));
    if (row.current) current = count - 1;
  }
  while (list_->count() > count) delete list_->takeItem(list_->count() - 1);
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
    if (key == Qt::Key_F2 && list_->currentItem() != nullptr) {
      emit name_wanted(list_->currentItem()->data(sequence_role).toUInt());
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

void HistoryPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (list_->currentItem() != nullptr) list_->scrollToItem(list_->currentItem());
}

void HistoryPanel::context_menu(const QPoint& at) {
  const QListWidgetItem* item = list_->itemAt(at);
  if (item == nullptr || !item->data(sequence_role).isValid()) return;
  const std::uint32_t sequence = item->data(sequence_role).toUInt();
  const bool current = item->data(current_role).toBool();
  const bool named = !item->data(name_role).toString().isEmpty();
  QMenu menu(this);
  menu.setToolTipsVisible(true);
  QAction* travel_there = menu.addAction(tr("&Go to this state"));
  travel_there->setEnabled(!current);
  QAction* name = menu.addAction(named ? tr("Re&name this version…") : tr("&Name this version…"));
  QAction* compare = menu.addAction(tr("&Compare with this state"));
  compare->setEnabled(!current);
  compare->setToolTip(current ? tr("This is the state you are in; choose another row.")
                              : tr("Show it beside the part as it is now"));
  const QAction* chosen = menu.exec(list_->viewport()->mapToGlobal(at));
  if (chosen == travel_there) emit travel(sequence);
  if (chosen == name) emit name_wanted(sequence);
  if (chosen == compare) emit compare_wanted(sequence);
}

void HistoryPanel::go(const QListWidgetItem* item) {
  if (item == nullptr || !item->data(sequence_role).isValid() || item->data(current_role).toBool())
    return;
  emit travel(item->data(sequence_role).toUInt());
}

}  // namespace arris::ui
