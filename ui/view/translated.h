#pragma once

#include <QCoreApplication>
#include <QString>

namespace arris::ui {

/// A text of the view in the user's language.
inline QString translated(const char* text) {
  return QCoreApplication::translate("arris::ui::View", text);
}

}  // namespace arris::ui
