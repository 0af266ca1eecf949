#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/document/document.h"
#include "core/mesh/mesh.h"

namespace arris {

/// What is left to do, in the order in which it is best done: what is wrong with lines first, since
/// it spoils the partitions; then what the partitions leave out; then what is merely odd.
enum class WorkKind : std::uint8_t {
  leak,                ///< A gap through which a front ran (core/guidance/leaks.h).
  loose_end,           ///< A line just stops inside the scan, instead of fading out.
  unassigned_area,     ///< Connected faces of no partition.
  undefined_boundary,  ///< A partition ends, and no other begins.
  sliver,              ///< A partition narrow compared with its length, of no surface.
  many_borders,        ///< A partition with more than four sides, or with a hole: no fault, but
                       ///< what has to be cut where patches are to be four-sided.
};

std::string_view name_of(WorkKind kind);  ///< "leak", "loose_end", ...

/// A way to go on from a loose end.
struct Continuation {
  std::vector<VertexId> vertices;  ///< From the loose end on.
  double length = 0.0;             ///< mm
  double sharpness = 0.0;          ///< Mean of how sharp it is against TV_IH, 0 to 1.
  double score = 0.0;      ///< 0 to 1: how sharp, straight and short it is, and what it arrives at.
  std::uint32_t line = 0;  ///< The line it arrives at; 0: the border, or nothing.
  bool arrives = false;    ///< False for a walk that fades out.
};

struct WorkItem {
  WorkKind kind = WorkKind::leak;
  std::string sentence;
  /// Score of the leak; length of the line that stops, mm; area, mm^2; length of the boundary, mm;
  /// number of sides; length over width.
  double size = 0.0;
  /// What it changes, as a length in mm, by which items rank: of the line that stops, of the
  /// boundary, of the sliver; or the root of the area that is parted, unassigned or to be cut.
  double extent = 0.0;
  bool small = false;              ///< Its extent is that of noise: it comes after all that is not.
  std::vector<VertexId> vertices;  ///< To zoom to: the paths, or what spans the area.
  std::vector<std::uint32_t> lines, partitions;
  /// leak: the gaps, to be closed together. many_borders: none; see with_cuts().
  std::vector<std::vector<VertexId>> paths;
  FaceId face = no_id;                      ///< unassigned_area: its lowest face.
  std::vector<Continuation> continuations;  ///< loose_end: the best first.
};

struct WorklistOptions {
  std::size_t most_per_kind = 100000;  ///< Beyond any real part: counts are true.
  /// Loose ends of lines found by the walk for which ways on are looked for, the longest first: on
  /// a noisy scan there are thousands.
  std::size_t most_with_ways = 200;
  std::size_t most_continuations = 3;
  double small_edges = 5.0;   ///< An item is small where its extent is under this many mean edges
  double small_share = 0.05;  ///< and under this share of the part's diagonal.
  double reach = 15.0;        ///< Of leaks and continuations, in mean edge lengths.
  int most_borderlines = 4;   ///< A partition with more, counted between corners, is listed.
  double sliver_ratio = 8.0;  ///< A partition is a sliver where length / width is above this
  double sliver_width = 3.0;  ///< and its width below this many mean edge lengths.
};

/// Whether an item is something that is left to mend.
bool is_left(const WorkItem& item);

/// What is left to do on a document: by kind, within a kind by decreasing extent, ties by the
/// lowest vertex; then what is small, in the same order; partitions to be cut, which are no fault,
/// at the end. Steps that were not run leave out what depends on them. Errors: cancelled.
Result<std::vector<WorkItem>> worklist(const Document& document,
                                       const WorklistOptions& options = {},
                                       const Context& context = {});

/// An item of kind many_borders with the cuts that split_to_four_sides would make as its paths, and
/// with what they would leave in its sentence. Any other as it is. Errors: cancelled.
Result<WorkItem> with_cuts(const Document& document, WorkItem item, const Context& context = {});

}  // namespace arris
