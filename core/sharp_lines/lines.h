#pragma once

#include <cstdint>
#include <memory>
#include <utility>
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
  bool locked = false;            ///< Approved: no finding changes it.

  bool convex() const { return mean_angle >= 0.0; }
  bool operator==(const Line&) const = default;
};

using LinePtr = std::shared_ptr<const Line>;

/// The set of sharp edges (what is stored) and the lines (derived from it; only their ids and locks
/// are new).
struct SharpLines {
  ChunkedArray<Origin> edges;  ///< Per edge of the mesh; empty: never found.
  /// Vertices where a line was split by hand, ascending: a chain does not go on through them.
  std::vector<VertexId> cuts;
  std::vector<LinePtr> lines;  ///< By id.

  bool is_sharp(EdgeId e) const { return !edges.empty() && edges[e] != Origin::none; }
  bool is_cut(VertexId v) const;
  const Line* find(std::uint32_t id) const;
};

/// Sharp edges at v, as outgoing half-edges.
std::vector<HalfEdgeId> sharp_edges_at(const Mesh& mesh, const SharpLines& lines, VertexId v);
/// Whether there is one.
bool is_on_line(const Mesh& mesh, const SharpLines& lines, VertexId v);

/// The edges along a path of vertices, as half-edges; stretches that the mesh does not have are
/// left out.
std::vector<HalfEdgeId> half_edges_of(const Mesh& mesh, const std::vector<VertexId>& path);

/// Links sharp edges into lines, without ids (0), in the order of their lowest edge.
/// `edges`: per edge of the mesh.
std::vector<Line> derive_lines(const Mesh& mesh, const Curvatures& curvatures,
                               const std::vector<Origin>& edges,
                               const std::vector<VertexId>& cuts = {});

/// A document's lines from a new set of sharp edges, cut where `previous` is: each line keeps the
/// id of the line of `previous` with which it shares most length (tie: the lower id); the others
/// get ids from `next_id` on. A line that lies on locked lines for most of its length is locked.
SharpLines relink_lines(const Mesh& mesh, const Curvatures& curvatures,
                        const std::vector<Origin>& edges, const SharpLines& previous,
                        std::uint32_t& next_id);

/// What a treatment changes.
struct LineChanges {
  std::vector<std::pair<EdgeId, Origin>> edges;  ///< New origin of each; none: no longer sharp.
  std::vector<VertexId> new_cuts;
};

/// The same result as relink_lines() for the changed set, at a cost that follows the lines touched
/// and not the mesh. `previous.edges` is empty or belongs to `mesh`.
SharpLines edit_lines(const Mesh& mesh, const Curvatures& curvatures, const SharpLines& previous,
                      const LineChanges& changes, std::uint32_t& next_id);

/// The ids of the lines through these edges, by length of edges they hold, longest first (tie: the
/// lower id). Edges that are not sharp are passed over.
std::vector<std::uint32_t> lines_through(const Mesh& mesh, const SharpLines& lines,
                                         const std::vector<EdgeId>& edges);

}  // namespace arris
