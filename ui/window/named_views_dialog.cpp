#include "ui/window/named_views_dialog.h"

#include <set>

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

namespace arris::ui {

NamedViewsDialog::NamedViewsDialog(const std::vector<NamedViewsPresenter::NamedView>& views,
                                   QWidget* parent)
    : QDialog(parent), given_(views) {
  setWindowTitle(tr("Named views"));
  setObjectName("named_views_dialog");
  list_ = new QListWidget(this);
  list_->setObjectName("named_views");
  list_->setDragDropMode(QAbstractItemView::InternalMove);
  list_->setToolTip(tr("Double click or F2 to rename; drag to reorder"));
  for (std::size_t k = 0; k < given_.size(); ++k) {
    auto* item = new QListWidgetItem(given_[k].name, list_);
    item->setFlags(item->flags() | Qt::ItemIsEditable);
    item->setData(Qt::UserRole, static_cast<int>(k));
  }
  const auto button = [this](const QString& text) {
    auto* made = new QPushButton(text, this);
    made->setAutoDefault(false);
    return made;
  };
  auto* rename = button(tr("&Rename"));
  up_ = button(tr("&Up"));
  down_ = button(tr("&Down"));
  remove_ = button(tr("Dele&te"));
  auto* side = new QVBoxLayout;
  for (QPushButton* one : {rename, up_, down_, remove_}) side->addWidget(one);
  side->addStretch();
  auto* row = new QHBoxLayout;
  row->addWidget(list_, 1);
  row->addLayout(side);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  auto* column = new QVBoxLayout(this);
  column->addLayout(row);
  column->addWidget(buttons);
  connect(rename, &QPushButton::clicked, this, [this] {
    if (QListWidgetItem* item = list_->currentItem()) list_->editItem(item);
  });
  connect(up_, &QPushButton::clicked, this, [this] { move(-1); });
  connect(down_, &QPushButton::clicked, this, [this] { move(1); });
  connect(remove_, &QPushButton::clicked, this, [this] { delete list_->currentItem(); });
  const auto enable = [this, rename] {
    const int current = list_->currentRow();
    rename->setEnabled(current >= 0);
    remove_->setEnabled(current >= 0);
    up_->setEnabled(current > 0);
    down_->setEnabled(current >= 0 && current + 1 < list_->count());
  };
  connect(list_, &QListWidget::currentRowChanged, this, enable);
  list_->setCurrentRow(0);
  enable();
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

std::vector<NamedViewsPresenter::NamedView> NamedViewsDialog::views() const {
  std::vector<NamedViewsPresenter::NamedView> result;
  std::set<QString> names;
  for (int row = 0; row < list_->count(); ++row) {
    NamedViewsPresenter::NamedView view =
        given_[static_cast<std::size_t>(list_->item(row)->data(Qt::UserRole).toInt())];
    const QString name = list_->item(row)->text().simplified().left(80);
    if (!name.isEmpty() && !names.contains(name)) view.name = name;
    if (names.insert(view.name).second) result.push_back(std::move(view));
  }
  return result;
}

void NamedViewsDialog::move(int by) {
  const int from = list_->currentRow(), to = from + by;
  if (from < 0 || to < 0 || to >= list_->count()) return;
  list_->insertItem(to, list_->takeItem(from));
  list_->setCurrentRow(to);
}

}  // namespace arris::ui
