#pragma once

#include "core/mesh/load_report.h"

class QWidget;

namespace arris::ui {

/// What a file held and what was mended in it.
void show_load_report(const LoadReport& report, QWidget* window);

}  // namespace arris::ui
