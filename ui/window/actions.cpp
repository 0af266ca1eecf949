#include "ui/window/actions.h"

namespace arris::ui {

QAction* action(QMenu* menu, const QString& text, const QKeySequence& shortcut,
                const QString& tooltip) {
  QAction* result = menu->addAction(text);
  result->setShortcut(shortcut);
  result->setToolTip(tooltip);
  result->setStatusTip(tooltip);
  return result;
}

void set_available(QAction* action, bool available, const QString& why_not) {
  action->setEnabled(available);
  // The status tip keeps what the action does.
  action->setToolTip(available ? action->statusTip() : action->statusTip() + "\n" + why_not);
}

}  // namespace arris::ui
