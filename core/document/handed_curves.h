#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/document/document.h"

namespace arris {

/// A line or boundary as other programs get it.
struct HandedCurve {
  std::string name;        ///< "line_12_convex", "boundary_3_Gn_p4_p7".
  std::string_view layer;  ///< What kind it is, in a word that every CAD program takes: "CONVEX".
  const std::vector<VertexId>* path = nullptr;  ///< A closed one repeats its first vertex.
  bool closed = false;
  std::vector<double> values;  ///< Of the columns of its set.
};

/// Curves of one document, valid as long as that is. Those that meet share the vertex where they
/// do.
struct HandedCurves {
  const Mesh& mesh;
  LengthUnit unit;
  std::string title;  ///< "lines", "boundaries".
  std::vector<std::string_view> columns;
  std::vector<HandedCurve> curves;
};

/// The C0 lines: id, 1 for a convex one, mean angle in degrees (positive: convex), length, 1 for a
/// closed one.
HandedCurves handed_lines(const Document& document);

/// "millimetres", or "the unit of the scan" where it is not known: what lengths in a file are in.
std::string lengths_in(LengthUnit unit);

/// All boundaries: number, the partitions left and right of it (0: none), id of the C0 line that it
/// lies on (0: none), mean angle, length, 1 for a closed one.
HandedCurves handed_boundaries(const Document& document);

}  // namespace arris
