#include "ui/panels/wrapped_tree.h"

#include <algorithm>

#include <QHeaderView>
#include <QPainter>
#include <QStyle>
#include <QStyledItemDelegate>

#include "ui/panels/controls.h"

namespace arris::ui {

namespace {

/// A tree view asks for heights without telling widths, so they are worked out here.
class Delegate : public QStyledItemDelegate {
 public:
  explicit Delegate(QTreeWidget* tree) : QStyledItemDelegate(tree), tree_(tree) {}

 protected:
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    constexpr int padding = 6;
    QStyleOptionViewItem styled = option;
    initStyleOption(&styled, index);
    const QFontMetrics metrics(styled.font);
    if (index.column() != 0)
      return {metrics.horizontalAdvance(styled.text) + 2 * padding, metrics.height() + padding};
    int depth = tree_->rootIsDecorated() ? 1 : 0;
    for (QModelIndex up = index.parent(); up.isValid(); up = up.parent()) ++depth;
    const int margins = 2 * (tree_->style()->pixelMetric(QStyle::PM_FocusFrameHMargin) + 1);
    const int width = std::max(tree_->columnWidth(0) - depth * tree_->indentation() - margins, 40);
    const QRect box =
        metrics.boundingRect(QRect(0, 0, width, 10000), Qt::TextWordWrap, styled.text);
    return {width, box.height() + padding};
  }

 private:
  QTreeWidget* tree_;
};

}  // namespace

WrappedTree::WrappedTree(QWidget* parent) : QTreeWidget(parent) {
  setItemDelegate(new Delegate(this));
  setWordWrap(true);
  setTextElideMode(Qt::ElideNone);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  setAlternatingRowColors(false);
  header()->setStretchLastSection(false);
}

void WrappedTree::set_empty_text(const QString& text) {
  empty_text_ = text;
  viewport()->update();
}

void WrappedTree::paintEvent(QPaintEvent* event) {
  QTreeWidget::paintEvent(event);
  if (topLevelItemCount() > 0) return;
  QPainter painter(viewport());
  painter.setPen(muted_text(palette()));
  painter.drawText(viewport()->rect().adjusted(12, 12, -12, -12),
                   Qt::AlignCenter | Qt::TextWordWrap, empty_text_);
}

void WrappedTree::resizeEvent(QResizeEvent* event) {
  QTreeWidget::resizeEvent(event);
  scheduleDelayedItemsLayout();
}

}  // namespace arris::ui
