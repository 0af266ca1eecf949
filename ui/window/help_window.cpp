#include "ui/window/help_window.h"

#include <algorithm>
#include <map>

#include <QDockWidget>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QMainWindow>
#include <QScrollBar>
#include <QSplitter>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>
#include <QVBoxLayout>

#include "core/document/operation.h"
#include "ui/panels/controls.h"
#include "ui/panels/step_card.h"
#include "ui/view/mesh_view.h"
#include "ui/window/help_pages.h"

namespace arris::ui {

namespace {

/// The page of a panel that has none of its own name.
QString page_of_dock(const QString& dock) {
  return dock == "lines" || dock == "partitions" || dock == "boundaries" ? "tables" : dock;
}

QString title_of_operation(const QString& operation) {
  const OperationKind* kind = find_operation(operation.toStdString());
  return kind ? shown_text(kind->title) : QString();
}

}  // namespace

HelpWindow::HelpWindow(QMainWindow* window)
    : QDialog(window),
      window_(window),
      list_(new QListWidget(this)),
      text_(new QTextBrowser(this)),
      find_(new QLineEdit(this)) {
  setWindowTitle(tr("Manual – Arris"));
  setObjectName("manual");
  resize(820, 640);
  for (const HelpPage& page : help_pages()) {
    auto* item = new QListWidgetItem(page.title, list_);
    item->setData(Qt::UserRole, page.name);
  }
  list_->setAccessibleName(tr("Pages"));
  list_->setSpacing(2);
  text_->setOpenLinks(false);
  text_->setAccessibleName(tr("Page"));
  find_->setPlaceholderText(tr("Find in the manual, Enter goes on"));
  find_->setClearButtonEnabled(true);
  auto* split = new QSplitter(this);
  split->addWidget(list_);
  split->addWidget(text_);
  split->setStretchFactor(1, 1);
  split->setSizes({200, 620});
  auto* column = new QVBoxLayout(this);
  column->addWidget(find_);
  column->addWidget(split, 1);
  connect(list_, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
    if (item) show_page(item->data(Qt::UserRole).toString());
  });
  connect(text_, &QTextBrowser::anchorClicked, this,
          [this](const QUrl& link) { show_page(link.path()); });
  connect(find_, &QLineEdit::returnPressed, this, &HelpWindow::find_next);
}

void HelpWindow::show_page(const QString& name, const QString& heading) {
  const QString text = help_text(name, *window_->menuBar());
  if (text.isEmpty()) return;
  if (name != page_) {
    page_ = name;
    constexpr double margin = 12.0;
    text_->setMarkdown(text);
    text_->document()->setDocumentMargin(margin);
    for (int row = 0; row < list_->count(); ++row)
      if (list_->item(row)->data(Qt::UserRole) == name) {
        const QSignalBlocker quiet(list_);
        list_->setCurrentRow(row);
      }
  }
  go_to_heading(heading);
}

bool HelpWindow::show_operation(const QString& operation) {
  for (const HelpPage& page : help_pages())
    if (help_operations(page.name).contains(operation)) {
      show_page(page.name, title_of_operation(operation));
      return true;
    }
  return false;
}

void HelpWindow::show_place(const QWidget* widget) {
  for (const QWidget* at = widget; at; at = at->parentWidget()) {
    if (const auto* card = dynamic_cast<const StepCardFrame*>(at); card && card->card().runnable)
      if (show_operation(card->card().name)) return;
    if (const auto* dock = qobject_cast<const QDockWidget*>(at))
      return show_page(page_of_dock(dock->objectName()));
    if (qobject_cast<const MeshView*>(at)) return show_page("view");
  }
  show_page("overview");
}

void HelpWindow::go_to_heading(const QString& heading) {
  QTextBlock block = text_->document()->begin();
  while (block.isValid() && (block.blockFormat().headingLevel() == 0 || block.text() != heading))
    block = block.next();
  QTextCursor cursor(block.isValid() ? block : text_->document()->begin());
  text_->setTextCursor(cursor);
  text_->verticalScrollBar()->setValue(text_->verticalScrollBar()->maximum());
  text_->ensureCursorVisible();
}

void HelpWindow::find_next() {
  const QString wanted = find_->text().trimmed();
  if (wanted.isEmpty() || text_->find(wanted)) return;
  // On from the next page, round to this one.
  const int here = list_->currentRow(), count = list_->count();
  for (int k = 1; k <= count; ++k) {
    const QString name = list_->item((here + k) % count)->data(Qt::UserRole).toString();
    if (!help_text(name, *window_->menuBar()).contains(wanted, Qt::CaseInsensitive)) continue;
    show_page(name);
    text_->moveCursor(QTextCursor::Start);
    if (text_->find(wanted)) return;
  }
}

}  // namespace arris::ui
