#pragma once

#include <cstdint>
#include <vector>

#include <QString>
#include <QWidget>

class QListWidget;
class QListWidgetItem;

namespace arris::ui {

struct HistoryRow {
  std::uint32_t sequence = 0;
  QString text;         ///< "Find sharp lines, 24.0°".
  QString tooltip;      ///< The whole operation.
  bool undone = false;  ///< Lies after the current state: redo reaches it.
  bool current = false;
  QString name = {};       ///< Of the version; empty: it has none.
  bool elsewhere = false;  ///< On another branch: undo and redo do not come by.
};

/// The list to travel in: click a row to go to the state after it. Named versions bear their names;
/// those on other branches come last, under a heading of their own.
class HistoryPanel : public QWidget {
  Q_OBJECT
 public:
  explicit HistoryPanel(QWidget* parent = nullptr);
  void set_rows(const std::vector<HistoryRow>& rows);

 signals:
  /// Another row than the current one was clicked, or entered with the keyboard.
  void travel(std::uint32_t sequence);
  /// F2 on a row, or from its context menu.
  void name_wanted(std::uint32_t sequence);
  void compare_wanted(std::uint32_t sequence);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void go(const QListWidgetItem* item);
  void context_menu(const QPoint& at);

  QListWidget* list_;
};

}  // namespace arris::ui
