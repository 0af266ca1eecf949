#pragma once

#include <string>

#include "core/base/result.h"
#include "core/document/document.h"

namespace arris {

/// Vertex properties K H Kabs IK IH IKabs as binary PLY. Errors: those of write_ply().
Result<void> write_curvature_ply(const std::string& path, const Document& document);

}  // namespace arris
