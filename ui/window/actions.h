#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMenu>
#include <QString>

namespace arris::ui {

/// The same icon-free look everywhere: text with shortcut, tooltip that says what it does.
QAction* action(QMenu* menu, const QString& text, const QKeySequence& shortcut,
                const QString& tooltip);

/// Enables an action, or disables it and says why in its tooltip.
void set_available(QAction* action, bool available, const QString& why_not);

}  // namespace arris::ui
