#pragma once

#include <string>

#include "core/document/document.h"

/// The part that operations are tried on: small, so that many are tried.
namespace arris::fuzz {

/// Its file: a box of 108 triangles with a noisy, open side.
std::string part_bytes();
/// As it was opened.
Document opened_part();
/// With lines, partitions and a correction of each.
Document divided_part();

}  // namespace arris::fuzz
