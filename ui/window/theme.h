#pragma once

class QApplication;

namespace arris::ui {

/// Light or dark palette of the whole program, in the Fusion style, which looks the same
/// everywhere.
void set_theme(QApplication& application, bool dark);

}  // namespace arris::ui
