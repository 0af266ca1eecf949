#pragma once

#include <vector>

#include <QString>
#include <Qt>

class QDockWidget;
class QMainWindow;
class QWidget;

namespace arris::ui {

/// A panel of the window, and where it is at first.
struct Panel {
  const char* name;  ///< As the layout is kept.
  QString title;
  QWidget* content;
  Qt::DockWidgetArea area;
  const char* behind = nullptr;  ///< A tab with the panel of this name; null: a place of its own.
};

/// Puts panels in docks, which are named as they are; those with a place of their own from top to
/// bottom.
void add_docks(QMainWindow& window, const std::vector<Panel>& panels);

QDockWidget* find_dock(const QMainWindow& window, const char* name);
/// Shows a panel, in front of those it shares its place with.
void bring_up(const QMainWindow& window, const char* name);

}  // namespace arris::ui
