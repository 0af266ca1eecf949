#include "core/guidance/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>

#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/curvature/distribution.h"
#include "core/mesh/geometry.h"
#include "core/partitions/front_rule.h"

namespace arris {

namespace {

constexpr double least_angle = 1.0, most_low = 30.0, most_angle = 120.0;  // degrees

std::vector<double> angles_of(const Curvatures& curvatures, std::size_t count) {
  float sharpest = 0.0f;
  for (const float beta : curvatures.beta) sharpest = std::max(sharpest, std::abs(beta));
  const double low = std::max(least_angle, std::min(1.5 * angle_noise(curvatures), most_low));
  // A little beyond, so that the curve comes down to nothing where it does.
  const double high =
      std::clamp(1.05 * sharpest * 180.0 / std::numbers::pi, low + least_angle, most_angle);
  std::vector<double> thresholds;
  for (std::size_t k = 0; k < count; ++k)
    thresholds.push_back(low + (high - low) * static_cast<double>(k) /
                                   static_cast<double>(std::max<std::size_t>(count - 1, 1)));
  return thresholds;
}

/// Edge-connected groups of faces, grown one face after the other.
class Growing {
 public:
  Growing(std::size_t faces, std::uint32_t min_faces)
      : parent_(faces), size_(faces, 0), area_(faces, 0.0), min_faces_(min_faces) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  bool has(FaceId f) const { return size_[f] > 0; }
  void add(FaceId f, double area) {
    size_[f] = 1;
    area_[f] = area;
    count(f, 1);
  }
  void join(FaceId a, FaceId b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    count(a, -1);
    count(b, -1);
    parent_[b] = a;
    size_[a] += size_[b];
    area_[a] += area_[b];
    count(a, 1);
  }
  std::size_t partitions() const { return static_cast<std::size_t>(partitions_); }
  double covered() const { return covered_; }

 private:
  FaceId find(FaceId f) {
    while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
    return f;
  }
  void count(FaceId root, int sign) {
    if (size_[root] < min_faces_) return;
    partitions_ += sign;
    covered_ += sign * area_[root];
  }

  std::vector<FaceId> parent_;
  std::vector<std::uint32_t> size_;
  std::vector<double> area_;
  const std::uint32_t min_faces_;
  std::int64_t partitions_ = 0;
  double covered_ = 0.0;
};

}  // namespace

Result<StabilityCurve> line_stability(const Mesh& mesh, const Curvatures& curvatures,
                                      const LineEvidence* evidence, const SharpLineOptions& options,
                                      std::vector<double> thresholds, std::size_t count,
                                      const Context& context) {
  const bool by_jump = options.method == LineMethod::normal_jump;
  const Curvatures& measures = by_jump ? *evidence->measures : curvatures;
  if (thresholds.empty()) thresholds = angles_of(measures, count);
  std::sort(thresholds.begin(), thresholds.end());
  StabilityCurve curve;
  curve.trivial = mesh.diagonal() / 2.0;  // a few short lines somewhere
  curve.usual = by_jump ? jump_threshold(evidence->noise)
                        : default_sharp_angle(mesh, curvatures, LineMethod::walk);
  curve.points.resize(thresholds.size());
  std::mutex reporting;
  std::size_t done = 0;
  context.report(0.0, "stability of lines");
  parallel_for(
      thresholds.size(),
      [&](std::size_t k) {
        SharpLineOptions own = options;
        own.angle = thresholds[k];
        const Result<std::vector<Origin>> edges =
            find_sharp_edges(mesh, curvatures, evidence, own, context.silent());
        if (!edges) return;  // cancelled
        StabilityPoint& point = curve.points[k];
        point.threshold = thresholds[k];
        for (const Line& line : derive_lines(mesh, measures, *edges)) {
          ++point.count;
          point.size += line.length;
        }
        const std::lock_guard lock(reporting);
        context.report(static_cast<double>(++done) / static_cast<double>(thresholds.size()),
                       "stability of lines");
      },
      1);
  if (context.cancelled()) return cancelled();
  return curve;
}

Result<StabilityCurve> partition_stability(const Mesh& mesh, const std::vector<double>& values,
                                           const SharpLines& lines, const PartitionOptions& options,
                                           std::vector<double> thresholds, std::size_t count,
                                           const Context& context) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  context.report(0.0, "stability of partitions");
  const double least = options.intervals.empty() ? 0.0 : options.intervals.front().min;
  FrontRule rule(mesh, values, lines);
  rule.count_all_votes();
  std::vector<double> area(mesh.face_count()), key(mesh.face_count(), infinite);
  std::vector<std::uint8_t> votes = rule.all_votes();  // and, below, those of bare areas
  parallel_for(mesh.face_count(), [&](std::size_t i) {
    const FaceId f = static_cast<FaceId>(i);
    area[f] = face_area(mesh, f);
    double lowest = infinite, highest = -infinite;
    for (const VertexId v : mesh.triangle(f)) {
      if (!rule.is_regular(v)) continue;
      lowest = std::min(lowest, values[v]);
      highest = std::max(highest, values[v]);
    }
    if (votes[f] && lowest >= least) key[f] = highest;
  });
  if (options.bare_areas)
    for (const BareArea& bare : find_bare_areas(mesh, lines, votes, options.criterion))
      for (const FaceId f : bare.faces) {
        votes[f] = 1;
        if (bare.value >= least) key[f] = bare.value;
      }
  double whole = 0.0;
  for (const double a : area) whole += a;
  if (context.cancelled()) return cancelled();

  if (thresholds.empty() && count > 0) {
    std::vector<double> weights(mesh.vertex_count(), 0.0);
    for (FaceId f = 0; f < mesh.face_count(); ++f)
      for (const VertexId v : mesh.triangle(f))
        if (rule.is_regular(v)) weights[v] += area[f] / 3.0;
    const Distribution distribution(values, weights);
    // Below this all is flat (as default_intervals() sees it): a radius of ten times the part.
    const double flat = options.criterion == Criterion::kabs
                            ? 1.0 / (100.0 * std::max(mesh.diagonal() * mesh.diagonal(), 1e-300))
                            : 1e-4;
    const double low = std::max(distribution.quantile(0.02), flat);
    const double high = std::max(distribution.quantile(0.995), 10.0 * low);
    for (std::size_t k = 0; k < count; ++k)
      thresholds.push_back(
          low * std::pow(high / low, static_cast<double>(k) /
                                         static_cast<double>(std::max<std::size_t>(count, 2) - 1)));
  }
  std::sort(thresholds.begin(), thresholds.end());

  // A face without a vote joins what its chain of longest edges leads to; only its area counts. A
  // chain that comes back to itself leads nowhere.
  std::vector<double> carried = area;
  std::vector<FaceId> carrier(mesh.face_count(), no_id);
  std::vector<std::uint8_t> followed(votes);  // its carrier is known, or being looked for
  std::vector<FaceId> chain;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (votes[f]) carrier[f] = f;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    if (votes[f]) continue;
    chain.clear();
    FaceId end = f;
    for (; end != no_id && !followed[end]; end = rule.across_longest(end)) {
      followed[end] = 1;
      chain.push_back(end);
    }
    for (const FaceId link : chain) carrier[link] = end == no_id ? no_id : carrier[end];
    if (carrier[f] != no_id) carried[carrier[f]] += area[f];
  }

  std::vector<FaceId> order;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (key[f] < infinite) order.push_back(f);
  parallel_sort(order.begin(), order.end(),
                [&](FaceId a, FaceId b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
  StabilityCurve curve;
  curve.logarithmic = true;
  curve.trivial = 0.05;
  curve.trivial_count = 1;
  Growing groups(mesh.face_count(), options.min_faces);
  std::size_t next = 0;
  for (const double threshold : thresholds) {
    if (context.cancelled()) return cancelled();
    for (; next < order.size() && key[order[next]] <= threshold; ++next) {
      const FaceId f = order[next];
      groups.add(f, carried[f]);
      for (const HalfEdgeId h : mesh.sides(f)) {
        const FaceId other = mesh.face(Mesh::opposite(h));
        if (other != no_id && groups.has(other) && !lines.is_sharp(Mesh::edge_of(h)))
          groups.join(f, other);
      }
    }
    curve.points.push_back(
        {threshold, groups.partitions(), whole > 0.0 ? groups.covered() / whole : 0.0});
    context.report(
        static_cast<double>(curve.points.size()) / static_cast<double>(thresholds.size()),
        "stability of partitions");
  }
  return curve;
}

std::optional<Plateau> plateau(const StabilityCurve& curve) {
  const std::vector<StabilityPoint>& points = curve.points;
  const auto place = [&](std::size_t k) {
    return curve.logarithmic ? std::log(std::max(points[k].threshold, 1e-300))
                             : points[k].threshold;
  };
  const auto counts = [&](std::size_t k) {
    return points[k].count > curve.trivial_count && points[k].size >= curve.trivial;
  };
  std::size_t peak = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].count > points[peak].count) peak = k;
  std::size_t begin = peak;
  while (begin < points.size() && counts(begin) && 2 * points[begin].count > points[peak].count)
    ++begin;
  if (begin == points.size() || !counts(begin)) begin = peak;  // nothing but the peak: no noise

  constexpr double most_change = 1.25, far_off = 2.0;
  std::optional<Plateau> best;
  double best_worth = 0.0;
  for (std::size_t i = begin; i < points.size(); ++i) {
    std::size_t fewest = points[i].count, most = points[i].count;
    double size = 0.0;
    for (std::size_t j = i; j < points.size() && counts(j); ++j) {
      size += points[j].size;
      fewest = std::min(fewest, points[j].count);
      most = std::max(most, points[j].count);
      const double change = static_cast<double>(most) / static_cast<double>(fewest);
      if (change > most_change) break;
      if (j < i + 2) continue;
      if (curve.usual > 0.0 && (points[j].threshold < curve.usual / far_off ||
                                points[i].threshold > curve.usual * far_off))
        continue;
      const double worth = (place(j) - place(i)) * std::exp(-4.0 * std::log(change)) * size /
                           static_cast<double>(j - i + 1);
      if (worth <= best_worth) continue;
      best_worth = worth;
      const double middle = (place(i) + place(j)) / 2.0;
      best = Plateau{points[i].threshold, points[j].threshold,
                     curve.logarithmic ? std::exp(middle) : middle};
    }
  }
  return best;
}

}  // namespace arris
