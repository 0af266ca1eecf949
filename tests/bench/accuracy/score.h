#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "tests/bench/accuracy/kd_tree.h"
#include "tests/bench/accuracy/part.h"
#include "tests/bench/accuracy/proposals.h"
#include "tests/bench/accuracy/samples.h"
#include "tests/bench/accuracy/turning.h"

namespace arris::accuracy {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Lines against true curves, by length. NaN: the part does not tell.
struct LineScore {
  double precision, recall, f1;
  double length_ratio;  ///< Found over true; doubled and zigzag lines push it over 1.
  std::size_t lines = 0;
  double lines_per_curve;        ///< Found lines for each true curve.
  double long_false_lines;       ///< Over ten edges long, on a part without true lines.
  bool has_corrections = false;  ///< Whether the counts that follow mean something.
  std::size_t adds = 0;     ///< Stretches of three edges and more of a true curve that are missing.
  std::size_t deletes = 0;  ///< Lines that lie mostly beside every true curve.
  std::size_t merges = 0;   ///< A true curve found in n pieces takes n - 1.
  std::size_t curves = 0;   ///< True curves of three edges and more.
};

/// Partitions against true patches, by area. NaN: the part does not tell, or not looked for.
struct PartitionScore {
  double mean_iou = unknown;  ///< Of each true patch with the partition it shares most with.
  double rand = unknown;      ///< Share of pairs of points that truth and partitions agree on.
  double assigned = unknown;  ///< Share of the area that belongs to a partition.
  double largest = unknown;   ///< Share of the area that belongs to the largest partition.
  /// How much borders between partitions that are not lines turn, in the turning of those between
  /// true patches that are no curve to be found: as they run along the edges of the mesh, and with
  /// the zigzag of the mesh averaged away (see Turning). Above 1: more ragged than the truth. NaN
  /// also where there is too little of either, or the truth's are straight.
  double turning = unknown, smoothed_turning = unknown;
  bool has_corrections = false;
  std::size_t connects = 0;  ///< A patch in n pieces takes n - 1.
  std::size_t splits = 0;    ///< A partition that is the main cover of n patches takes n - 1.
  std::size_t restarts = 0;  ///< Patches less than half assigned.
  std::size_t patches = 0;   ///< True patches of at least 1/2000 of the area.
};

struct Score {
  LineScore lines;
  PartitionScore partitions;
  /// Of the worklist; absent: the method has none, or the part does not tell.
  std::optional<std::vector<ProposalCount>> proposals;

  bool has_corrections() const { return lines.has_corrections || partitions.has_corrections; }
  std::size_t corrections() const {
    return lines.adds + lines.deletes + lines.merges + partitions.connects + partitions.splits +
           partitions.restarts;
  }
  /// Corrections for each true curve and patch; on a part with neither, all of them.
  double corrections_per_target() const;
  std::size_t proposals_made() const;  ///< Of all kinds.
  double right_share() const;          ///< Of proposals of all kinds. NaN: there are none.
};

/// Scores results on one part. What depends on the part alone is worked out once.
///
/// The rules are those of the project's Python scorers (score.py and effort.py), to the last digit:
/// lines are cut into pieces of a quarter of the tolerance; a piece is right where a piece of a
/// true curve lies within the tolerance. Turning and proposals are the bench's own.
class Scorer {
 public:
  explicit Scorer(const Part& part);
  /// Errors: those of the document's worklist().
  Result<Score> score(const Found& found) const;

 private:
  LineScore score_lines(const std::vector<Polyline>& lines) const;
  void count_line_corrections(const std::vector<LengthSamples>& samples, LineScore& score) const;
  PartitionScore score_partitions(const std::vector<std::uint32_t>& labels) const;
  double score_rand(const std::vector<std::uint32_t>& labels, double total) const;
  Turning found_turning(const Found& found) const;

  const Part& part_;
  double tolerance_, edge_, mean_edge_;
  LengthSamples due_;  // of the curves that must be found
  KdTree due_tree_;
  KdTree narrow_;            // centres of the faces on surfaces that are too narrow to be seen
  KdTree free_;              // what may be found, and narrow_
  std::vector<char> shown_;  // per piece of due_: whether the scan can show it
  Turning true_turning_;
  ProposalJudge judge_;
  std::vector<double> areas_;
};

}  // namespace arris::accuracy
