#pragma once

#include <QString>

#include "core/document/document.h"
#include "ui/view/mesh_view.h"

namespace arris::ui {

/// What lies under the pointer, for the status bar: values of the fields, line and partition. Empty
/// where the document is not the one picked in.
QString hover_text(const Document& document, const Pick& pick);

}  // namespace arris::ui
