#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/lines.h"

/// How many sides a partition has, counted between the corners of its border, as a surface patch
/// over it would have (the paper's further work: none with more than four borderlines).
namespace arris {

/// What counts as a corner. Lengths in mean edges of the mesh, angles in degrees.
struct SideOptions {
  /// The border on each side of a place over which its direction is taken: a mesh's zigzag swings
  /// about it. At most an eighth of the loop, so that small loops keep their corners.
  double window = 4.0;
  /// The least turn of a corner where no borderline ends: a hexagon has 60, zigzag and arcs that
  /// a few edges resolve stay below.
  double strong_turn = 40.0;
  /// The least turn that makes a corner of an extremity whose two borderlines look alike (same
  /// neighbour, same type), as where a line ends at the border.
  double slight_turn = 20.0;
  /// Extremities nearer to each other along the border are one corner: noise leaves specks that
  /// touch a border with an edge or two.
  double least_side = 2.0;
};

/// A closed loop of a partition's border, the partition on its left.
struct BorderLoop {
  std::vector<HalfEdgeId> half_edges;  ///< In order, from the lowest one on.
  /// Ascending places in `half_edges`: a corner is where that half-edge starts.
  std::vector<std::size_t> corners;
  double length = 0.0;  ///< mm

  /// A loop without a corner is one side.
  std::size_t sides() const { return corners.empty() ? 1 : corners.size(); }
};

/// The border of one partition. Its loops never branch: where it touches itself in a vertex, they
/// keep to the faces on their left.
struct Outline {
  std::vector<BorderLoop> loops;  ///< The longest first (tie: the lower half-edge).
  std::uint32_t handles = 0;      ///< Of the partition as a surface: 0 for a disc or a ring.

  /// Of all loops; 0 for a partition that is closed.
  std::size_t sides() const;
  std::string text() const;  ///< "6 sides and 2 holes"
  /// One loop of at most four sides round a disc: what a four-sided patch covers.
  bool is_four_sided() const {
    return loops.size() == 1 && handles == 0 && loops.front().sides() <= 4;
  }
};

/// The outline of one partition, at a cost that follows the partition.
///
/// A corner is an extremity of a borderline where the neighbour or the type of the border changes,
/// or where the border turns by `slight_turn` at least; and a turn by `strong_turn` anywhere. A
/// turn is measured between straight lines fitted to the border on both sides, above what an arc
/// makes of it. Candidates nearer than a window count once: the one that turns most, extremities
/// first.
Outline outline_of(const Mesh& mesh, const SharpLines& lines, const Partitions& partitions,
                   const Partition& partition, const SideOptions& options = {});
/// The same where the faces of the partition are known.
Outline outline_of(const Mesh& mesh, const SharpLines& lines, const Partitions& partitions,
                   std::uint32_t id, const std::vector<FaceId>& faces,
                   const SideOptions& options = {});

/// Those of all partitions, in their order, in one pass over the mesh.
std::vector<Outline> outlines_of(const Mesh& mesh, const SharpLines& lines,
                                 const Partitions& partitions, const SideOptions& options = {});

/// Share of the assigned area that is four-sided, 0 to 1; 0 where nothing is assigned. `outlines`:
/// of all partitions.
double four_sided_share(const Partitions& partitions, const std::vector<Outline>& outlines);

}  // namespace arris
