#pragma once

#include "core/base/json.h"

namespace arris {

/// The operation table as a JSON schema (draft 2020-12) of one operation: what a program that
/// writes or checks recipes has to know. Ranges that depend on a part (lengths) are open above;
/// ids, vertices and anchors are checked for their form only.
nlohmann::json operation_schema();

}  // namespace arris
