#pragma once

#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/partitions/boundaries.h"
#include "core/partitions/front_rule.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/interactive_treatments.h"
#include "core/sharp_lines/lines.h"

/// The interactive treatments of section 7.2. Each works out which faces get another label;
/// edit_partitions() then gives it. The cost follows what is treated and not the mesh.
namespace arris {

/// What a treatment works on: one mesh, its criterion per vertex, its lines and partitions.
struct PartitionGround {
  const Mesh& mesh;
  const std::vector<double>& values;
  const SharpLines& lines;
  const Partitions& partitions;

  FrontRule rule() const { return {mesh, values, lines}; }
};

using FaceLabels = std::vector<std::pair<FaceId, std::uint32_t>>;  ///< Face, its new label.

/// All faces of a partition, ascending.
std::vector<FaceId> faces_of(const Mesh& mesh, const Partitions& partitions,
                             const Partition& partition);

/// Unassigned faces that a partition reaches from its undefined boundaries under an interval of its
/// own, not over sharp edges. Errors: it has no undefined boundary, so there is nothing to extend
/// into (the paper's condition).
Result<std::vector<FaceId>> extend_partition(const PartitionGround& ground,
                                             const Partition& partition,
                                             const Boundaries& boundaries,
                                             const CurvatureInterval& interval);

/// Areas that pass `interval` among the unassigned of `faces` (ascending), found as section 7.1
/// does but not beyond them; those with fewer than `min_faces` are left out. Faces without a
/// regular vertex join them. By decreasing highest value.
std::vector<std::vector<FaceId>> find_areas(const PartitionGround& ground,
                                            const std::vector<FaceId>& faces,
                                            const CurvatureInterval& interval,
                                            std::uint32_t min_faces);

/// The part of a partition that a path of vertices cuts off: the smaller side. Errors: the path
/// does not part it.
Result<std::vector<FaceId>> cut_off(const PartitionGround& ground, const Partition& partition,
                                    const std::vector<VertexId>& path);

/// The faces a brushed region touches: those that reach into a sphere of its radius about a vertex
/// of the stroke and hang together with the faces round the stroke through others that do, not over
/// sharp edges where `stop_at` is given. Ascending. Vertices of the stroke that the mesh does not
/// have are passed over.
std::vector<FaceId> faces_touched(const Mesh& mesh, const BrushedRegion& region,
                                  const SharpLines* stop_at = nullptr);

/// Those of `faces` that a partition reaches through faces of `faces`, not over sharp edges.
std::vector<FaceId> joined_to(const PartitionGround& ground, const std::vector<FaceId>& faces,
                              std::uint32_t partition);

/// `faces` and the unassigned areas beside them, not over sharp edges; ascending.
std::vector<FaceId> with_unassigned_round(const PartitionGround& ground,
                                          const std::vector<FaceId>& faces);

/// Teeth of the Gn boundaries between the partitions `ids` (all where empty) and their neighbours:
/// a face goes over to the partition with which it shares the greater length, where that leaves
/// both connected and makes the boundary shorter. Never over sharp edges; locked partitions stay as
/// they are. Round after round, at most `rounds`.
FaceLabels smooth_boundaries(const PartitionGround& ground, const Boundaries& boundaries,
                             const std::unordered_set<std::uint32_t>& ids, int rounds);

/// Pieces, but the largest, into which sharp lines have parted the partitions beside `edges`, by
/// id; only pieces that lie beside these edges.
std::vector<std::pair<std::uint32_t, std::vector<std::vector<FaceId>>>> parted_by_lines(
    const PartitionGround& ground, const std::vector<EdgeId>& edges);

/// What edit_partitions() makes of changed labels.
struct EditedPartitions {
  Partitions partitions;
  std::vector<EdgeId> touched;  ///< Edges of changed faces, ascending.
};

/// Gives faces their new labels. `fresh`: partitions for labels that are new, with id, criterion
/// and interval set. Partitions keep their number of faces, area, mean and an anchor; one that is
/// parted goes on as its largest piece, and the others get ids from `next_id` on; one that is left
/// without a face goes.
EditedPartitions edit_partitions(const PartitionGround& ground, const FaceLabels& changes,
                                 const std::vector<Partition>& fresh, std::uint32_t& next_id);

}  // namespace arris
