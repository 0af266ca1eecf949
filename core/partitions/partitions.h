#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/base/chunked_array.h"
#include "core/base/context.h"
#include "core/base/result.h"
#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// Absolute curvature that decides over a partition: Kabs on dense meshes, its invariant on sparse
/// ones (section 7.1).
enum class Criterion : std::uint8_t { kabs, ikabs };

std::string_view name_of(Criterion criterion);  ///< "kabs" or "ikabs", as in operations.

/// The values the criterion reads, per vertex.
const std::vector<double>& values_of(const Curvatures& curvatures, Criterion criterion);

/// How partitions are found.
enum class PartitionMethod : std::uint8_t {
  surfaces,  ///< Areas that one surface explains (core/partitions/area_tree.h). Our addition.
  fronts,    ///< The paper's: fronts under intervals of curvature (section 7.1).
};

/// [Kmin, Kmax], both ends included; 1/mm^2 for Kabs, without unit for IKabs.
struct CurvatureInterval {
  double min = 0.0;
  double max = 0.0;
  bool holds(double value) const { return value >= min && value <= max; }
  bool operator==(const CurvatureInterval&) const = default;
};

/// Section 7. Lengths in the mesh's unit.
struct PartitionOptions {
  Criterion criterion = Criterion::kabs;     // the paper's for dense meshes
  std::vector<CurvatureInterval> intervals;  // run one after the other over what is left
  std::uint32_t min_faces = 1;               // partitions with fewer faces are not kept
  /// Unassigned areas with fewer faces join the partition with which they share the longest border
  /// that is not sharp: the specks that noise leaves. Our addition; 0 is the plain algorithm.
  std::uint32_t fill_holes = 0;
  /// Areas without any regular vertex (find_bare_areas()) are partitions, too, under the first
  /// interval that their own value lies in. Our addition; false is the plain algorithm, which
  /// leaves the sides of a cube of 12 triangles unassigned.
  bool bare_areas = false;
};

/// A partition: an edge-connected set of faces of slowly varying curvature.
struct Partition {
  std::uint32_t id = 0;
  Triangle anchor{};  ///< Vertices of its seed face; finds it again (document.md, rule 4).
  std::uint32_t faces = 0;
  double area = 0.0;        ///< mm^2
  double mean_value = 0.0;  ///< Mean of the criterion over its regular vertices; after an edit
                            ///< carried on by the area of the faces that came and went.
  Criterion criterion = Criterion::kabs;
  CurvatureInterval interval;  ///< That it was found under.
  bool locked = false;         ///< Approved: no finding changes it.
  bool operator==(const Partition&) const = default;
};

using PartitionPtr = std::shared_ptr<const Partition>;

/// The partitions of a document.
struct Partitions {
  ChunkedArray<std::uint32_t>
      labels;  ///< Per face: partition id; 0: unassigned. Empty: never found.
  std::vector<PartitionPtr> partitions;  ///< By id.

  std::uint32_t label(FaceId f) const { return labels.empty() ? 0 : labels[f]; }
  const Partition* find(std::uint32_t id) const;
};

/// Front propagation of section 7.1: labels 1, 2, ... per face in the order in which the partitions
/// were found, 0 where no interval passes. A face passes where each of its regular vertices
/// (interior, on no sharp line) lies in the interval; a face without one joins afterwards across
/// its longest edge that is not sharp. The front never crosses a sharp edge. `values`: the
/// criterion per vertex. `taken`: faces that are not to be had, one flag each, or empty. Errors:
/// cancelled.
struct FoundPartitions {
  std::vector<std::uint32_t> labels;
  std::vector<Partition> partitions;  ///< [k] has label k + 1; ids are still 0.
};
Result<FoundPartitions> propagate_fronts(const Mesh& mesh, const std::vector<double>& values,
                                         const SharpLines& lines, const PartitionOptions& options,
                                         const Context& context = {},
                                         const std::vector<bool>& taken = {});

/// An area that sharp lines and the border enclose with no regular vertex inside: the side of a
/// coarsely cut block, the wall of a cylinder without a ring of vertices between its ends.
struct BareArea {
  std::vector<FaceId> faces;
  /// The criterion of the area as a whole, from H (eq. 5) or IH with the sums over the stars of all
  /// its vertices, as far as they lie in it, and angles without sign. With no vertex inside it can
  /// be unrolled, so that K and IK are 0.
  double value = 0.0;
};
/// All of them, by their lowest face. `votes`: regular vertices per face.
std::vector<BareArea> find_bare_areas(const Mesh& mesh, const SharpLines& lines,
                                      const std::vector<std::uint8_t>& votes, Criterion criterion);

/// A document's partitions from found ones: each keeps the id of the partition of `previous` with
/// which it shares most area (tie: the lower id); the others get ids from `next_id` on. `previous`
/// belongs to the same mesh, or is empty.
Partitions number_partitions(const Mesh& mesh, const FoundPartitions& found,
                             const Partitions& previous, std::uint32_t& next_id);

}  // namespace arris
