#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"
#include "core/sharp_lines/sharp_lines.h"

/// The interactive treatments of section 6.3.2. Each works out what changes; edit_lines() then
/// changes it. The cost follows what is treated and not the mesh.
namespace arris {

/// Which ends of a line a treatment is for: where its path starts, where it stops.
enum class EndsToExtend { both, first, last };

/// The ends of `line` go on by the candidate rule of figure 26 under `angle` (degrees), until there
/// is no candidate or a line or the border is reached. No changes where neither end goes on, or the
/// line is closed.
LineChanges extend_line(const Mesh& mesh, const Curvatures& curvatures, const SharpLines& lines,
                        const Line& line, EndsToExtend ends, double angle, int candidates);

/// The cheapest path from a loose end of `a` to a loose end of `b` that meets no other line;
/// `angle` (degrees): how sharp an edge has to be to draw the path. Errors: a line without loose
/// end, no path within four times the straight way.
Result<std::vector<VertexId>> bridge_between(const Mesh& mesh, const Curvatures& curvatures,
                                             const SharpLines& lines, const Line& a, const Line& b,
                                             double angle);

/// The cheapest path through `points` in their order, snapping to edges that are sharper than
/// `angle` (degrees), over edges for which `may_use` holds. Sharp edges may be used: drawn again
/// they stay what they are. Errors: fewer than two points, a point that is not in the mesh or that
/// no such path reaches.
Result<std::vector<VertexId>> path_through(
    const Mesh& mesh, const Curvatures& curvatures, const std::vector<VertexId>& points,
    double angle, const std::function<bool(EdgeId)>& may_use = [](EdgeId) { return true; });

/// The edges of `path` that are not sharp yet become sharp with this origin.
LineChanges add_path(const Mesh& mesh, const SharpLines& lines, const std::vector<VertexId>& path,
                     Origin origin);
/// The edges of `path` are no longer sharp.
LineChanges remove_path(const Mesh& mesh, const SharpLines& lines,
                        const std::vector<VertexId>& path);

/// Found edges both of whose ends lie within 1.5 mean edges of `path` along the surface, and which
/// are not on `path`: what a deletion holds down when lines are found again (document.md, rule 6).
std::vector<EdgeId> found_near(const Mesh& mesh, const SharpLines& lines,
                               const std::vector<VertexId>& path);

/// The vertex of a line nearest to a point (tie: the first along it).
VertexId nearest_on(const Mesh& mesh, const Line& line, const Point& point);

/// The stretch of a line on both sides of its vertex `at` that gives way when that is moved by
/// `distance` (mm): twice as far along the line, and at least two edges, up to the line's ends.
/// First and last vertex of the stretch.
std::pair<VertexId, VertexId> stretch_round(const Mesh& mesh, const Line& line, VertexId at,
                                            double distance);

/// A region brushed on the surface: the vertices that are joined to one of the stroke by edges, all
/// of which lie within `radius` (mm) of a vertex of the stroke.
struct BrushedRegion {
  std::vector<VertexId> stroke;
  double radius = 0.0;
};
/// Vertices of the region. Vertices of the stroke that the mesh does not have are passed over.
std::unordered_set<VertexId> vertices_of(const Mesh& mesh, const BrushedRegion& region);

/// Finds the sharp edges inside a region again under thresholds of its own: found edges with both
/// ends inside go, but for those of locked lines, and are found anew by options.method (`evidence`:
/// as find_sharp_edges()); isolated lines that lie inside altogether and are shorter than
/// options.min_length go.
LineChanges recompute_region(const Mesh& mesh, const Curvatures& curvatures,
                             const LineEvidence* evidence, const SharpLines& lines,
                             const std::unordered_set<VertexId>& region,
                             const SharpLineOptions& options);

}  // namespace arris
