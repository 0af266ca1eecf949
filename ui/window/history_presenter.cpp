#include "ui/window/history_presenter.h"

#include <algorithm>
#include <vector>

#include <QMenu>

#include "ui/window/actions.h"
#include "ui/window/comparison_presenter.h"

namespace arris::ui {

HistoryPresenter::HistoryPresenter(Session* session, HistoryPanel* panel,
                                   ComparisonPresenter* comparison, QObject* parent)
    : QObject(parent), session_(session), panel_(panel) {
  connect(panel_, &HistoryPanel::travel, session_, &Session::travel);
  connect(panel_, &HistoryPanel::name_wanted, comparison, &ComparisonPresenter::ask_name);
  connect(panel_, &HistoryPanel::compare_wanted, comparison, &ComparisonPresenter::compare_with);
  connect(session_, &Session::names_changed, this, &HistoryPresenter::refresh);
  connect(session_, &Session::changed, this, [this] {
    if (session_->is_previewing()) return;
    refresh();
    refresh_actions();
  });
  connect(session_, &Session::busy_changed, this, &HistoryPresenter::refresh_actions);
}

void HistoryPresenter::add_actions(QMenu* menu) {
  undo_ = action(menu, tr("&Undo"), QKeySequence::Undo, tr("Take back the last operation"));
  connect(undo_, &QAction::triggered, session_, &Session::undo);
  redo_ = action(menu, tr("&Redo"), QKeySequence::Redo, tr("Do it again"));
  connect(redo_, &QAction::triggered, session_, &Session::redo);
  refresh_actions();
}

void HistoryPresenter::refresh() {
  std::vector<HistoryRow> rows;
  const History& history = session_->history();
  const auto row_of = [&](std::uint32_t sequence) {
    const Operation& operation = history.entries()[sequence - 1].operation;
    HistoryRow row;
    row.sequence = sequence;
    row.text = QString::fromStdString(describe(operation));
    row.tooltip = QString::fromStdString(operation.to_json().dump(1));
    return row;
  };
  bool undone = false;
  for (const std::uint32_t sequence : history.line_of_travel()) {
    HistoryRow row = row_of(sequence);
    row.current = sequence == history.head();
    row.undone = undone;
    undone = undone || row.current;
    rows.push_back(row);
  }
  for (const auto& [sequence, name] : history.names()) {
    auto row = std::ranges::find(rows, sequence, &HistoryRow::sequence);
    if (row == rows.end()) {
      row = rows.insert(rows.end(), row_of(sequence));
      row->elsewhere = true;
    }
    row->name = QString::fromStdString(name);
  }
  panel_->set_rows(rows);
}

void HistoryPresenter::refresh_actions() {
  const bool part = !session_->current().document.empty();
  const QString no_part = tr("Open a part first.");
  if (!session_->travelling()) {  // else more of them are taken, and done one after the other
    const QString wait = part ? tr("Wait until the work that runs is done.") : no_part;
    set_available(undo_, false, wait);
    set_available(redo_, false, wait);
  }
  if (session_->busy()) return;  // the history belongs to the work that runs
  const History& history = session_->history();
  const auto name = [&](std::uint32_t sequence) {
    return QString::fromStdString(describe(history.entries()[sequence - 1].operation));
  };
  undo_->setStatusTip(part ? tr("Take back the last operation on %1").arg(session_->part_name())
                           : tr("Take back the last operation"));
  // The first row is the opening of the part: there is nothing before it to go back to.
  set_available(undo_, history.head() > 1, part ? tr("There is nothing to undo.") : no_part);
  undo_->setText(history.head() > 1 ? tr("Undo: %1").arg(name(history.head())) : tr("Undo"));
  set_available(redo_, history.can_redo(), part ? tr("There is nothing to redo.") : no_part);
  redo_->setText(tr("Redo"));
  const std::vector<std::uint32_t> rows = history.line_of_travel();
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    if (rows[k] == history.head()) redo_->setText(tr("Redo: %1").arg(name(rows[k + 1])));
  undo_->setIconText(tr("Undo"));
  redo_->setIconText(tr("Redo"));
}

}  // namespace arris::ui
