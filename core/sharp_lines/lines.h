#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/chunked_array.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"

namespace arris {

/// How a sharp edge came to be one.
enum class Origin : std::uint8_t { none, found, extended, merged, drawn };

/// Class of a vertex by its boundary edges (section 5 and method.md 5: a chain ends at 1, too).
enum class VertexClass : std::uint8_t { partition, boundary, extremity };

/// A sharp line: a chain of sharp edges between two extremity vertices, or closed. It is at the
/// same time the C0 boundary of section 5.
struct Line {
  std::uint32_t id = 0;
  std::vector<VertexId> vertices;  ///< A closed line repeats its first vertex at the end.
  bool closed = false;
  double length = 0.0;            ///< mm
  double mean_angle = 0.0;        ///< Degrees: mean of IHe weighted by length; positive: convex.
  Origin origin = Origin::found;  ///< The latest of its edges.

  bool convex() const { return mean_angle >= 0.0; }
  bool operator==(const Line&) const = default;
};

using LinePtr = std::shared_ptr<const Line>;

/// The set of sharp edges (what is stored) and the lines (derived from it; only their ids are new).
struct SharpLines {
  ChunkedArray<Origin> edges;  ///< Per edge of the mesh; empty: never found.
  std::vector<LinePtr> lines;  ///< By id.

  bool is_sharp(EdgeId e) const { return !edges.empty() && edges[e] != Origin::none; }
  const Line* find(std::uint32_t id) const;
};

/// Links sharp edges into lines, without ids (0), in the order of their lowest edge.
/// `edges`: per edge of the mesh.
std::vector<Line> derive_lines(const Mesh& mesh, const Curvatures& curvatures,
                               const std::vector<Origin>& edges);

/// A document's lines from a new set of sharp edges: each line keeps the id of the line of
/// `previous` with which it shares most length (tie: the lower id); the others get ids from
/// `next_id` on.
SharpLines relink_lines(const Mesh& mesh, const Curvatures& curvatures,
                        const std::vector<Origin>& edges, const SharpLines& previous,
                        std::uint32_t& next_id);

}  // namespace arris
