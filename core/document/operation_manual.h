#pragma once

#include "core/base/manual_page.h"

namespace arris {

/// All operations of the table with their parameters, as sections of a page.
void add_operations(ManualPage& page);

}  // namespace arris
