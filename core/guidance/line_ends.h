#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// A vertex where a line just stops: it has one sharp edge and lies inside the scan.
struct LooseEnd {
  VertexId vertex = no_id;
  std::uint32_t line = 0;
  Point ahead = Point::Zero();  ///< Unit vector in which the line leaves off.
  bool convex = true;           ///< Sign of the line.
  double length = 0.0;          ///< Of the line, mm.
};

/// The lines of a document seen from their vertices. Refers to the mesh and the lines it was made
/// from.
class LineEnds {
 public:
  LineEnds(const Mesh& mesh, const SharpLines& lines);

  /// By increasing vertex.
  const std::vector<LooseEnd>& loose() const { return loose_; }
  bool is_loose(VertexId v) const;
  /// Lowest id of the lines through v; 0: there is none.
  std::uint32_t line_at(VertexId v) const;

  /// How many times longer the way round along the lines must be for the short way from a loose end
  /// to a line to count as a gap: from beside its own line, the way back is always short.
  static constexpr double detour = 3.0;
  /// Vertices on lines within `reach` (mm) of a loose end, walking along sharp edges only, and how
  /// far.
  std::unordered_map<VertexId, double> along_lines(const LooseEnd& end, double reach) const;

 private:
  const Mesh& mesh_;
  const SharpLines& lines_;
  std::unordered_map<VertexId, std::uint32_t> line_at_;
  std::vector<LooseEnd> loose_;
};

}  // namespace arris
