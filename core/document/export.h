#pragma once

#include <string>

#include "core/base/result.h"
#include "core/document/document.h"

namespace arris {

/// The C0 lines as Wavefront OBJ: one group a line, "line_12_convex", each one `l` polyline.
std::string lines_obj(const Document& document);

/// All boundaries as OBJ: one group each, "boundary_3_Gn_p4_p7" (number, type, partitions; for C0
/// the line's id, too).
std::string boundaries_obj(const Document& document);

/// Vertex properties K H Kabs IK IH IKabs as binary PLY. Errors: those of write_ply().
Result<void> write_curvature_ply(const std::string& path, const Document& document);

}  // namespace arris
