#include "tests/bench/accuracy/score.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/base/parallel.h"
#include "tests/bench/accuracy/narrow.h"

namespace arris::accuracy {

namespace {

LengthSamples samples_of(const Truth& truth, Demand demand, double step) {
  LengthSamples samples;
  for (const TrueCurve& curve : truth.curves)
    if (curve.demand == demand) add_samples(curve.points, step, samples);
  return samples;
}

Point middle_of(const Mesh& mesh, EdgeId e) {
  return (mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0;
}

std::vector<Point> joined(std::vector<Point> a, const std::vector<Point>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The part's true borders that no sharp line shows: those of patches away from the curves that
/// must be found.
Turning true_turning(const Part& part, const KdTree& due, double mean_edge) {
  if (part.truth.patches.empty()) return {};
  const Mesh& mesh = *part.scan->mesh;
  std::vector<EdgeId> edges = edges_between(mesh, part.truth.patches);
  std::erase_if(edges,
                [&](EdgeId e) { return due.has_within(middle_of(mesh, e), part.tolerance); });
  return turning_of(chains_of(mesh, edges), mean_edge);
}

/// NaN where the truth has no turn to speak of.
double ratio(double found, double truth) {
  constexpr double straight = 0.01;  // degrees for each mean edge
  return truth > straight ? found / truth : unknown;
}

/// Area-weighted Rand index of two divisions of the same faces: the share of pairs of points on
/// which they agree. `areas`: of the common part of each two of their pieces, adding up to 1.
double rand_index(const std::map<std::uint32_t, std::map<std::uint32_t, double>>& areas) {
  double pairs = 0.0, first = 0.0, second = 0.0;
  std::map<std::uint32_t, double> columns;
  for (const auto& [row, common] : areas) {
    double whole = 0.0;
    for (const auto& [column, area] : common) {
      pairs += area * area;
      whole += area;
      columns[column] += area;
    }
    first += whole * whole;
  }
  for (const auto& [column, whole] : columns) second += whole * whole;
  return 1.0 + 2.0 * pairs - first - second;
}

/// For each point whether the tree has one within `reach`.
std::vector<char> near_to(const KdTree& tree, const std::vector<Point>& points, double reach) {
  std::vector<char> result(points.size(), 0);
  if (!tree.empty())
    parallel_for(points.size(),
                 [&](std::size_t i) { result[i] = tree.has_within(points[i], reach); });
  return result;
}

}  // namespace

double Score::corrections_per_target() const {
  const std::size_t targets = lines.curves + partitions.patches;
  return static_cast<double>(corrections()) /
         static_cast<double>(std::max<std::size_t>(targets, 1));
}

std::size_t Score::proposals_made() const {
  std::size_t made = 0;
  if (proposals)
    for (const ProposalCount& count : *proposals) made += count.made;
  return made;
}

double Score::right_share() const {
  if (proposals_made() == 0) return unknown;
  double right = 0.0;
  for (const ProposalCount& count : *proposals) right += static_cast<double>(count.right);
  return right / static_cast<double>(proposals_made());
}

Scorer::Scorer(const Part& part)
    : part_(part),
      tolerance_(part.tolerance),
      edge_(part.edge),
      mean_edge_(mean_inner_edge(*part.scan->mesh)),
      due_(samples_of(part.truth, Demand::must, tolerance_ / 4.0)),
      due_tree_(due_.points),
      narrow_(narrow_centres(part)),
      free_(joined(samples_of(part.truth, Demand::may, tolerance_ / 4.0).points, narrow_.points())),
      shown_(near_to(narrow_, due_.points, tolerance_)),
      true_turning_(true_turning(part, due_tree_, mean_edge_)),
      judge_(part) {
  for (char& is_shown : shown_) is_shown = !is_shown;
  const Mesh& mesh = *part.scan->mesh;
  for (const Triangle& t : mesh.triangles())
    areas_.push_back(
        0.5 *
        (mesh.point(t[1]) - mesh.point(t[0])).cross(mesh.point(t[2]) - mesh.point(t[0])).norm());
}

Result<Score> Scorer::score(const Found& found) const {
  Score score{score_lines(found.lines), score_partitions(found.labels), {}};
  if (!found.labels.empty() && !part_.truth.patches.empty()) {
    const Turning turning = found_turning(found);
    score.partitions.turning = ratio(turning.raw, true_turning_.raw);
    score.partitions.smoothed_turning = ratio(turning.smoothed, true_turning_.smoothed);
  }
  if (found.document && !part_.truth.patches.empty()) {
    Result<std::vector<ProposalCount>> proposals = judge_.count(*found.document);
    if (!proposals) return tl::unexpected<Error>(proposals.error());
    score.proposals = std::move(*proposals);
  }
  return score;
}

LineScore Scorer::score_lines(const std::vector<Polyline>& lines) const {
  LineScore score{unknown, unknown, unknown, unknown, lines.size(), unknown, unknown};
  std::vector<LengthSamples> samples;
  LengthSamples all;
  for (const Polyline& line : lines) {
    LengthSamples own;
    add_samples(line, tolerance_ / 4.0, own);
    if (own.points.empty()) continue;
    all.points.insert(all.points.end(), own.points.begin(), own.points.end());
    all.lengths.insert(all.lengths.end(), own.lengths.begin(), own.lengths.end());
    samples.push_back(std::move(own));
  }
  if (part_.scoring == Scoring::curves) count_line_corrections(samples, score);
  if (due_.points.empty()) {
    score.long_false_lines = 0.0;
    for (const LengthSamples& own : samples) {
      double length = 0.0;
      for (const double piece : own.lengths) length += piece;
      if (length > 10.0 * mean_edge_) ++score.long_false_lines;
    }
    return score;
  }
  if (score.curves > 0)
    score.lines_per_curve = static_cast<double>(lines.size()) / static_cast<double>(score.curves);

  const KdTree found_tree(all.points);
  const std::vector<char> hit = near_to(found_tree, due_.points, tolerance_);
  double hit_length = 0.0, due_length = 0.0;
  for (std::size_t k = 0; k < hit.size(); ++k) {
    if (hit[k]) hit_length += due_.lengths[k];
    if (hit[k] || shown_[k]) due_length += due_.lengths[k];
  }
  const std::vector<char> right = near_to(due_tree_, all.points, tolerance_);
  const std::vector<char> free = near_to(free_, all.points, tolerance_);
  double right_length = 0.0, counted_length = 0.0;
  for (std::size_t k = 0; k < right.size(); ++k) {
    if (right[k]) right_length += all.lengths[k];
    if (right[k] || !free[k]) counted_length += all.lengths[k];
  }
  const bool any = !all.points.empty();
  score.precision = any ? right_length / std::max(counted_length, 1e-12) : 0.0;
  score.recall = any ? hit_length / std::max(due_length, 1e-12) : 0.0;
  score.f1 = 2.0 * score.precision * score.recall / std::max(score.precision + score.recall, 1e-9);
  score.length_ratio = counted_length / due_length;
  return score;
}

void Scorer::count_line_corrections(const std::vector<LengthSamples>& samples,
                                    LineScore& score) const {
  score.has_corrections = true;
  std::vector<Point> all;
  std::vector<std::uint32_t> owners;
  for (std::uint32_t line = 0; line < samples.size(); ++line) {
    const LengthSamples& own = samples[line];
    const std::vector<char> right = near_to(due_tree_, own.points, tolerance_);
    const std::vector<char> free = near_to(free_, own.points, tolerance_);
    double right_length = 0.0, counted_length = 0.0;
    for (std::size_t k = 0; k < own.points.size(); ++k) {
      if (right[k]) right_length += own.lengths[k];
      if (right[k] || !free[k]) counted_length += own.lengths[k];
    }
    if (right_length < 0.5 * counted_length) ++score.deletes;
    all.insert(all.end(), own.points.begin(), own.points.end());
    owners.insert(owners.end(), own.points.size(), line);
  }
  const KdTree tree(std::move(all));
  const double gap = 3.0 * edge_;
  for (const TrueCurve& curve : part_.truth.curves) {
    if (curve.demand != Demand::must) continue;
    LengthSamples own;
    add_samples(curve.points, edge_ / 3.0, own);
    if (own.points.empty()) continue;
    double length = 0.0, visible = 0.0, run = 0.0;
    std::size_t missing = 0;
    std::map<std::uint32_t, double> length_by_line;
    for (std::size_t k = 0; k < own.points.size(); ++k) {
      const bool seen = narrow_.empty() || !narrow_.has_within(own.points[k], tolerance_);
      const KdTree::Hit hit = tree.nearest(own.points[k], tolerance_);
      const bool is_hit = hit.index != no_id;
      length += own.lengths[k];
      if (seen || is_hit) visible += own.lengths[k];
      if (is_hit) length_by_line[owners[hit.index]] += own.lengths[k];
      if (!is_hit && seen) run += own.lengths[k];
      if (is_hit || k + 1 == own.points.size()) {
        missing += run >= gap;
        run = 0.0;
      }
    }
    score.curves += length >= gap;
    if (visible < gap) continue;
    score.adds += missing;
    const auto pieces = std::count_if(length_by_line.begin(), length_by_line.end(),
                                      [&](const auto& piece) { return piece.second >= gap; });
    score.merges += static_cast<std::size_t>(std::max<std::ptrdiff_t>(pieces - 1, 0));
  }
}

double Scorer::score_rand(const std::vector<std::uint32_t>& labels, double total) const {
  // A few faces of no partition are pieces of their own, many are one piece.
  constexpr std::ptrdiff_t few = 2000;
  const bool apart = std::ranges::count(labels, 0u) < few;
  std::uint32_t next = labels.empty() ? 0 : std::ranges::max(labels);
  std::map<std::uint32_t, std::map<std::uint32_t, double>> areas;
  for (FaceId f = 0; f < areas_.size(); ++f) {
    const std::uint32_t piece = labels[f] == 0 && apart ? ++next : labels[f];
    areas[part_.truth.patches[f]][piece] += areas_[f] / total;
  }
  return rand_index(areas);
}

Turning Scorer::found_turning(const Found& found) const {
  const Mesh& mesh = *part_.scan->mesh;
  std::vector<EdgeId> edges = edges_between(mesh, found.labels, 0);
  if (found.line_edges) {
    std::vector<EdgeId> soft;
    std::ranges::set_difference(edges, *found.line_edges, std::back_inserter(soft));
    edges = std::move(soft);
  } else {
    LengthSamples lines;
    for (const Polyline& line : found.lines) add_samples(line, tolerance_ / 4.0, lines);
    const KdTree tree(std::move(lines.points));
    std::erase_if(edges, [&](EdgeId e) { return tree.has_within(middle_of(mesh, e), tolerance_); });
  }
  return turning_of(chains_of(mesh, edges), mean_edge_);
}

PartitionScore Scorer::score_partitions(const std::vector<std::uint32_t>& labels) const {
  PartitionScore score;
  const std::vector<std::uint32_t>& patches = part_.truth.patches;
  if (labels.empty()) return score;
  std::map<std::uint32_t, double> partition_areas, patch_areas;
  std::map<std::uint32_t, std::map<std::uint32_t, double>> shared;  // by patch and partition
  double total = 0.0, assigned = 0.0;
  for (FaceId f = 0; f < areas_.size(); ++f) {
    total += areas_[f];
    if (labels[f] != 0) assigned += areas_[f];
    partition_areas[labels[f]] += areas_[f];
    if (patches.empty()) continue;
    patch_areas[patches[f]] += areas_[f];
    shared[patches[f]][labels[f]] += areas_[f];
  }
  score.assigned = assigned / total;
  score.largest = 0.0;
  for (const auto& [partition, area] : partition_areas)
    if (partition != 0) score.largest = std::max(score.largest, area / total);
  if (patches.empty()) return score;

  score.has_corrections = true;
  score.mean_iou = 0.0;
  const double least = total / 2000.0;
  std::map<std::uint32_t, std::size_t> covered;  // patches by their main cover
  for (const auto& [patch, partitions] : shared) {
    const double area = patch_areas[patch];
    double best = 0.0, main_area = 0.0, unassigned = 0.0;
    std::uint32_t main = 0;
    std::size_t mine = 0;
    for (const auto& [partition, common] : partitions) {
      if (partition == 0) {
        unassigned = common;
        continue;
      }
      const double whole = partition_areas[partition];
      best = std::max(best, common / (area + whole - common));
      mine += common > 0.5 * whole && common >= least;
      if (common > main_area) {
        main_area = common;
        main = partition;
      }
    }
    score.mean_iou += best * area / total;
    if (area < least) continue;
    ++score.patches;
    if (unassigned > 0.5 * area) {
      ++score.restarts;
      continue;
    }
    score.connects += mine > 0 ? mine - 1 : 0;
    if (main != 0) ++covered[main];
  }
  for (const auto& [partition, count] : covered) score.splits += count - 1;
  score.rand = score_rand(labels, total);
  return score;
}

}  // namespace arris::accuracy
