#include "ui/window/docks.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QTabWidget>

namespace arris::ui {

void add_docks(QMainWindow& window, const std::vector<Panel>& panels) {
  // Tabs only once all places are there: a tab cannot be split any more.
  for (const bool tabs : {false, true})
    for (const Panel& panel : panels) {
      if (tabs != (panel.behind != nullptr)) continue;
      auto* dock = new QDockWidget(panel.title, &window);
      dock->setObjectName(panel.name);
      dock->setWidget(panel.content);
      window.addDockWidget(panel.area, dock);
      if (panel.behind) window.tabifyDockWidget(find_dock(window, panel.behind), dock);
    }
  for (const Panel& panel : panels)
    if (!panel.behind) find_dock(window, panel.name)->raise();
  for (const Qt::DockWidgetArea area : {Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea})
    window.setTabPosition(area, QTabWidget::North);
}

QDockWidget* find_dock(const QMainWindow& window, const char* name) {
  return window.findChild<QDockWidget*>(name);
}

void bring_up(const QMainWindow& window, const char* name) {
  QDockWidget* dock = find_dock(window, name);
  dock->show();
  dock->raise();
}

}  // namespace arris::ui
