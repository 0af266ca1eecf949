#pragma once

#include <QObject>

#include "ui/panels/history_panel.h"
#include "ui/window/session.h"

class QAction;
class QMenu;

namespace arris::ui {

class ComparisonPresenter;

/// The history in its panel, and undo and redo.
class HistoryPresenter : public QObject {
  Q_OBJECT
 public:
  HistoryPresenter(Session* session, HistoryPanel* panel, ComparisonPresenter* comparison,
                   QObject* parent);

  void add_actions(QMenu* menu);
  QAction* undo() const { return undo_; }
  QAction* redo() const { return redo_; }

 private:
  void refresh();
  void refresh_actions();

  Session* session_;
  HistoryPanel* panel_;
  QAction *undo_ = nullptr, *redo_ = nullptr;
};

}  // namespace arris::ui
