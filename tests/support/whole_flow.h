#pragma once

#include <string>

#include "core/document/document.h"
#include "core/mesh/polygon_file.h"
#include "tests/support/meshes.h"

namespace arris::testing {

/// The bytes of a binary PLY file of these points and triangles, whatever they are: points in
/// doubles, indices that need not be there.
std::string ply_bytes(const Triangles& triangles);

/// What read_polygon_content() promises of any file: each error is one sentence that names the
/// file, and what is read holds together. Gives what does not hold, or nothing.
std::string fault_of_reading(const std::string& path, const std::string& bytes,
                             Result<PolygonFile>& read);

/// Opens a part from the bytes of a file and leads it through all that window and command line do
/// with one: both flows and every step of the chain, fields, worklist, explanations, stability
/// curves, outlines and tangent lines, treatments that need no pointing, labels on the scan, text
/// of the exports, and the snapshot of a session. Gives what does not hold, or nothing: results are
/// values or errors that are a sentence, what is measured of a finite part is no NaN where none may
/// be, and documents keep their invariants.
std::string fault_of_whole_flow(const std::string& bytes);

}  // namespace arris::testing
