#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/scan.h"

namespace arris {
struct Document;
}

namespace arris::accuracy {

/// Points joined by straight segments; a closed one repeats its first point at the end.
using Polyline = std::vector<Point>;

/// What a result owes to a true curve.
enum class Demand : std::uint8_t {
  must,  ///< A jump of 25 degrees or more: to be found.
  may,   ///< A gentler one, or the border of a blend: found or not counts neither way.
};

struct TrueCurve {
  Polyline points;
  Demand demand = Demand::must;
  /// Jump of the normal across the curve in degrees, the largest along it.
  double angle = 0.0;
};

/// Jumps from here on must be found, from `may_angle` on they may be (degrees).
inline constexpr double must_angle = 25.0, may_angle = 10.0;

/// What is true of a part. Labels have one entry for each face of the scan's mesh.
struct Truth {
  std::vector<TrueCurve> curves;
  std::vector<std::uint32_t> patches;  ///< The target for partitions; empty: not known.
  /// The surface of the CAD part a face lies on; empty: not known. A surface narrower than three
  /// edges counts neither way, nor do the lines beside it.
  std::vector<std::uint32_t> surfaces;
};

/// How the lines of a part are scored.
enum class Scoring : std::uint8_t {
  curves,  ///< Against true curves, those that may be found left out.
  pair,    ///< Against the sharp edges of a clean mesh: length alone, no corrections.
};

/// A part with what is true of it.
struct Part {
  ScanPtr scan;
  Truth truth;
  Scoring scoring = Scoring::curves;
  /// Distance in mm at which a found line lies on a true one.
  double tolerance = 0.0;
  /// What the counts of corrections take for an edge, in mm: three of them are a gap.
  double edge = 0.0;
};

/// A part that is read or made when its turn comes.
struct Case {
  std::string name;
  /// The rows of the summary that it counts in.
  std::vector<std::string> groups;
  std::function<Result<Part>()> make;
};

/// What a method found.
struct Found {
  std::vector<Polyline> lines;
  /// The edges of the scan's mesh that the lines run along, ascending; absent: the lines run on
  /// another mesh.
  std::optional<std::vector<EdgeId>> line_edges;
  std::vector<std::uint32_t>
      labels;  ///< Per face of the scan's mesh, 0: none; empty: not looked for.
  /// What has a worklist; null: the method is not one of operations on a document.
  std::shared_ptr<const Document> document;
  double seconds = 0.0;  ///< From the mesh in memory to lines and labels.
};

/// Mean length of the edges with two faces, in mm.
double mean_inner_edge(const Mesh& mesh);

/// A scan that never was a file. Errors: those of make_scan().
Result<ScanPtr> scan_of(std::vector<Point> points, const std::vector<Triangle>& triangles);

}  // namespace arris::accuracy
