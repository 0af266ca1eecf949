#include "core/guidance/explain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_set>

#include "core/base/words.h"
#include "core/document/operations/stages.h"
#include "core/document/treatments/treatment.h"
#include "core/guidance/explain_jump.h"
#include "core/partitions/front_rule.h"
#include "core/sharp_lines/automatic_treatments.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

namespace {

std::string short_text(double value) { return number_text(value, 3); }
constexpr const char* corrected_away = "the step finds it, so a correction took it away afterwards";

std::string vertex_text(VertexId v) { return "vertex " + std::to_string(v); }

// ---- edges ----

/// The line through an edge; 0: there is none.
std::uint32_t line_through(const Mesh& mesh, const SharpLines& lines, EdgeId e) {
  const auto [a, b] = mesh.edge(e);
  for (const LinePtr& line : lines.lines) {
    const std::vector<VertexId>& path = line->vertices;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      if ((path[i] == a && path[i + 1] == b) || (path[i] == b && path[i + 1] == a)) return line->id;
  }
  return 0;
}

std::string origin_text(Origin origin) {
  switch (origin) {
    case Origin::extended:
      return "extended";
    case Origin::merged:
      return "bridging a gap";
    case Origin::drawn:
      return "drawn by hand";
    case Origin::found:
    case Origin::none:
      break;
  }
  return "found";
}

/// The tests of one edge on one mesh by the walk. `Sharp(e)` tells which edges count as sharp.
class EdgeTests {
 public:
  EdgeTests(const Mesh& mesh, const Curvatures& curvatures, const SharpLineOptions& options,
            LengthUnit unit, EdgeId e)
      : mesh_(mesh),
        curvatures_(curvatures),
        options_(options),
        unit_(unit),
        e_(e),
        angle_(std::abs(curvatures.beta[e]) * 180.0 / std::numbers::pi),
        tv_ik_(ikabs_of_straight_edge(options.angle * std::numbers::pi / 180.0)) {}

  template <class Sharp>
  std::vector<ExplainedTest> all(const Sharp& is_sharp) const {
    std::vector<ExplainedTest> tests;
    const bool inside = !mesh_.is_border_edge(e_);
    tests.push_back({"Inside the scan", nothing, nothing, "", inside,
                     inside
                         ? "The edge has a face on both sides."
                         : "The scan ends at this edge, and such edges have no exterior angle."});
    const bool sharp = above_angle();
    tests.push_back({"|IHe|", angle_, options_.angle, "°", sharp,
                     "Its exterior angle of " + degrees_in_words(angle_) + " is " +
                         (sharp ? "above" : "not above") + " TV_IH, " +
                         degrees_in_words(options_.angle) + "."});
    if (options_.max_angle < 180.0 || options_.convexity != Convexity::any)
      tests.push_back({"Bounds", angle_, options_.max_angle, "°", within_bounds(),
                       "Lines are looked for up to " + degrees_in_words(options_.max_angle) +
                           (options_.convexity == Convexity::convex    ? ", convex ones only."
                            : options_.convexity == Convexity::concave ? ", concave ones only."
                                                                       : ".")});
    for (const VertexId v : mesh_.edge(e_)) {
      const double ikabs = curvatures_.ikabs[v];
      const bool passed = ikabs > tv_ik_;
      tests.push_back({"IKabs of " + vertex_text(v), ikabs, tv_ik_, "", passed,
                       "IKabs of " + vertex_text(v) + ", " + short_text(ikabs) + ", is " +
                           (passed ? "above" : "not above") + " TV_IK, " + short_text(tv_ik_) +
                           "."});
    }
    for (const VertexId v : mesh_.edge(e_)) {
      const std::size_t rank = rank_at(v, is_sharp);
      const auto candidates = static_cast<std::size_t>(options_.candidates);
      tests.push_back({"Rank at " + vertex_text(v), static_cast<double>(rank),
                       static_cast<double>(candidates), "", rank <= candidates,
                       "Of the free edges at " + vertex_text(v) + " it is number " +
                           std::to_string(rank) + " by |IHe|; the first " +
                           std::to_string(candidates) + " are candidates."});
    }
    const std::size_t triangles = triangles_made(is_sharp);
    tests.push_back({"No sharp triangle", static_cast<double>(triangles), 0.0, "", triangles == 0,
                     triangles == 0 ? "It makes no triangle with two sharp edges."
                                    : "It would make a triangle with two sharp edges."});
    return tests;
  }

  bool above_angle() const {  // as identification compares, in radians
    return std::abs(curvatures_.beta[e_]) > options_.angle * (std::numbers::pi / 180.0);
  }
  bool within_bounds() const {
    return !above_angle() || may_be_sharp(curvatures_.beta[e_], options_);
  }
  /// The first condition that every found edge meets and this one does not, as a clause.
  std::optional<std::string> failed() const {
    if (mesh_.is_border_edge(e_)) return "the scan ends at this edge";
    if (!above_angle())
      return "its angle of " + degrees_in_words(angle_) + " is not above the threshold of " +
             degrees_in_words(options_.angle);
    if (!within_bounds()) return "its angle is outside the bounds that were asked for";
    for (const VertexId v : mesh_.edge(e_))
      if (!(curvatures_.ikabs[v] > tv_ik_))
        return "IKabs of " + vertex_text(v) + ", " + short_text(curvatures_.ikabs[v]) +
               ", is not above TV_IK, " + short_text(tv_ik_);
    return std::nullopt;
  }

  /// Why an edge that failed() knows nothing against is not sharp: runs the step again.
  std::string looked_up() const {
    std::vector<Origin> edges = identify_sharp_edges(mesh_, curvatures_, options_);
    const auto is_sharp = [&](EdgeId other) { return edges[other] != Origin::none; };
    if (!is_sharp(e_)) return not_identified(is_sharp);
    if (options_.parallel_distance > 0) {
      remove_parallel_lines(mesh_, curvatures_, options_.parallel_distance, edges);
      if (!is_sharp(e_))
        return "it was found, but its line doubled a stronger one of the same sign at most " +
               counted(static_cast<std::size_t>(options_.parallel_distance), "edge", "edges") +
               " away";
    }
    if (options_.bridge_gap > 0.0) bridge_gaps(mesh_, curvatures_, options_.bridge_gap, edges);
    if (options_.min_length > 0.0) {
      remove_short_lines(mesh_, curvatures_, options_.min_length, edges);
      if (!is_sharp(e_))
        return "it was found, but its line and what it touches are shorter than min_length, " +
               with_unit(short_text(options_.min_length), unit_);
    }
    return corrected_away;
  }

 private:
  /// Its place by |IHe| among the free edges at v, from 1.
  template <class Sharp>
  std::size_t rank_at(VertexId v, const Sharp& is_sharp) const {
    const float own = std::abs(curvatures_.beta[e_]);
    const VertexId own_end = other_end(v);
    std::size_t rank = 1;
    mesh_.for_ring(v, [&](HalfEdgeId h) {
      const EdgeId e = h >> 1;
      if (e == e_ || is_sharp(e) || mesh_.is_border_edge(e)) return;
      const float theirs = std::abs(curvatures_.beta[e]);
      if (theirs > own || (theirs == own && mesh_.to(h) < own_end)) ++rank;
    });
    return rank;
  }

  template <class Sharp>
  std::size_t triangles_made(const Sharp& is_sharp) const {
    std::size_t count = 0;
    for (const HalfEdgeId h : {2 * e_, 2 * e_ + 1})
      count += mesh_.face(h) != no_id && is_sharp(mesh_.next(h) >> 1) &&
               is_sharp(mesh_.previous(h) >> 1);
    return count;
  }

  /// An interior vertex above TV_IK that is on no line in the end was a seed without a candidate,
  /// and an edge with both ends on lines was refused by the closing pass; that leaves these.
  template <class Sharp>
  std::string not_identified(const Sharp& is_sharp) const {
    if (triangles_made(is_sharp) > 0) return "it would make a triangle with two sharp edges";
    for (const VertexId v : mesh_.edge(e_)) {
      bool on_line = false;
      mesh_.for_ring(v, [&](HalfEdgeId h) { on_line |= is_sharp(h >> 1); });
      const std::size_t rank = rank_at(v, is_sharp);
      if (!on_line && rank > static_cast<std::size_t>(options_.candidates))
        return counted(rank - 1, "free edge", "free edges") + " at " + vertex_text(v) +
               (rank == 2 ? " has" : " have") + " a larger |IHe|, and only " +
               std::to_string(options_.candidates) +
               (options_.candidates == 1 ? " is a candidate" : " are candidates");
    }
    return "it ends on the border, where no walk starts, and no walk that came by chose it";
  }

  VertexId other_end(VertexId v) const {
    const auto [a, b] = mesh_.edge(e_);
    return v == a ? b : a;
  }

  const Mesh& mesh_;
  const Curvatures& curvatures_;
  const SharpLineOptions& options_;
  const LengthUnit unit_;
  const EdgeId e_;
  const double angle_;  // degrees
  const double tv_ik_;
};

// ---- faces ----

/// What find_partitions decides by, as it was last run on a document.
class FaceRules {
 public:
  FaceRules(const Document& document, const nlohmann::json& parameters)
      : document_(document),
        mesh_(*document.mesh),
        criterion_(parameters.at("criterion") == "kabs" ? Criterion::kabs : Criterion::ikabs),
        values_(values_of(*document.shown_curvatures(), criterion_)),
        rule_(mesh_, values_, document.lines),
        min_faces_(parameters.at("min_faces")),
        fill_holes_(parameters.at("fill_holes")) {
    for (const auto& interval : parameters.at("intervals"))
      intervals_.push_back({interval[0], interval[1].is_null()
                                             ? std::numeric_limits<double>::infinity()
                                             : interval[1].get<double>()});
  }

  const std::vector<CurvatureInterval>& intervals() const { return intervals_; }
  std::uint32_t min_faces() const { return min_faces_; }
  std::uint32_t fill_holes() const { return fill_holes_; }
  double value(VertexId v) const { return values_[v]; }
  std::string name() const { return criterion_ == Criterion::kabs ? "Kabs" : "IKabs"; }
  std::string unit() const {
    return criterion_ == Criterion::kabs ? unit_text(length_unit_of(document_), -2) : "";
  }
  std::string text(double value) const {
    return unit().empty() ? short_text(value) : short_text(value) + " " + unit();
  }

  bool on_line(VertexId v) const { return is_on_line(mesh_, document_.lines, v); }
  const FrontRule& front() const { return rule_; }
  /// The interval whose front could have taken f: the first in which all its votes lie.
  const CurvatureInterval* passed_interval(FaceId f) const {
    for (const CurvatureInterval& interval : intervals_)
      if (rule_.passes(f, interval)) return &interval;
    return nullptr;
  }
  /// The interval that fails fewest of the votes of f (tie: the first).
  const CurvatureInterval* nearest_interval(FaceId f) const {
    const CurvatureInterval* best = nullptr;
    int fewest = 4;
    for (const CurvatureInterval& interval : intervals_) {
      int failed = 0;
      for (const VertexId v : mesh_.triangle(f))
        failed += rule_.is_regular(v) && !interval.holds(values_[v]);
      if (failed < fewest) {
        fewest = failed;
        best = &interval;
      }
    }
    return best;
  }
  /// True where each vote of f lies in an interval, whichever.
  bool each_vote_held(FaceId f) const {
    return std::ranges::all_of(mesh_.triangle(f), [&](VertexId v) {
      return !rule_.is_regular(v) ||
             std::ranges::any_of(intervals_,
                                 [&](const CurvatureInterval& i) { return i.holds(values_[v]); });
    });
  }
  /// Faces that a front from f covers under `interval`, counted up to `limit`; those that the front
  /// of another interval took do not count.
  std::uint32_t front_size(FaceId f, const CurvatureInterval& interval, std::uint32_t limit) const {
    const auto open = [&](FaceId x) {
      if (!rule_.passes(x, interval)) return false;
      const Partition* taken = document_.partitions.find(document_.partitions.label(x));
      return !taken || taken->interval == interval || !rule_.passes(x, taken->interval);
    };
    std::vector<FaceId> front{f};
    std::unordered_set<FaceId> seen{f};
    for (std::size_t next = 0; next < front.size() && front.size() < limit; ++next) {
      for (const HalfEdgeId h : mesh_.sides(front[next])) {
        const FaceId x = mesh_.face(Mesh::opposite(h));
        if (x != no_id && !document_.lines.is_sharp(h >> 1) && !seen.contains(x) && open(x)) {
          seen.insert(x);
          front.push_back(x);
        }
      }
    }
    return static_cast<std::uint32_t>(std::min<std::size_t>(front.size(), limit));
  }

 private:
  const Document& document_;
  const Mesh& mesh_;
  Criterion criterion_;
  const std::vector<double>& values_;
  FrontRule rule_;
  std::uint32_t min_faces_, fill_holes_;
  std::vector<CurvatureInterval> intervals_;
};

std::string interval_text(const FaceRules& rules, const CurvatureInterval& interval) {
  return std::isfinite(interval.max) ? short_text(interval.min) + " to " + rules.text(interval.max)
                                     : "above " + rules.text(interval.min);
}

/// The bound that a value breaks, or else the nearer one.
double bound_for(const CurvatureInterval& interval, double value) {
  if (value < interval.min) return interval.min;
  if (value > interval.max || !std::isfinite(interval.max)) return interval.max;
  return value - interval.min < interval.max - value ? interval.min : interval.max;
}

ExplainedTest vertex_test(const Mesh& mesh, const FaceRules& rules, VertexId v,
                          const CurvatureInterval* interval) {
  ExplainedTest test{
      rules.name() + " of " + vertex_text(v), nothing, nothing, rules.unit(), true, ""};
  const std::string where = "Vertex " + std::to_string(v);
  if (!rules.front().is_regular(v)) {
    test.sentence = where +
                    (mesh.is_border(v)  ? " lies on the border"
                     : rules.on_line(v) ? " lies on a sharp line"
                                        : " has no curvature") +
                    " and does not vote.";
    return test;
  }
  test.value = rules.value(v);
  const std::string measured = where + " has " + rules.name() + " " + rules.text(test.value);
  if (!interval) {
    test.passed = false;
    test.sentence = measured + "; no interval is in force.";
    return test;
  }
  test.threshold = bound_for(*interval, test.value);
  test.passed = interval->holds(test.value);
  const std::string range = interval_text(rules, *interval);
  if (test.passed)
    test.sentence = measured + ", inside " + range + ".";
  else
    test.sentence = measured + ", " + rules.text(std::abs(test.value - test.threshold)) +
                    (test.value > interval->max ? " over " : " below ") + range + ".";
  return test;
}

/// What the front met across half-edge h of a face with label `own`.
ExplainedTest side_test(const Document& document, HalfEdgeId h, std::uint32_t own) {
  const Mesh& mesh = *document.mesh;
  const auto [a, b] = mesh.edge(h >> 1);
  ExplainedTest test{
      "Side " + std::to_string(a) + "-" + std::to_string(b), nothing, nothing, "", false, ""};
  const std::string across = "Across " + std::to_string(a) + "-" + std::to_string(b) + " ";
  const FaceId f = mesh.face(Mesh::opposite(h));
  if (f == no_id) {
    test.sentence = across + "the scan ends.";
  } else if (document.lines.is_sharp(h >> 1)) {
    test.sentence = across + "sharp line " +
                    std::to_string(line_through(mesh, document.lines, h >> 1)) +
                    " stops every front.";
  } else {
    const std::uint32_t label = document.partitions.label(f);
    test.passed = label == own && own != 0;
    test.sentence = label == 0    ? across + "the face is in no partition."
                    : test.passed ? across + "its own partition goes on."
                                  : across + "lies partition " + std::to_string(label) + ".";
  }
  return test;
}

}  // namespace

Explanation explain_edge(const Document& document, EdgeId e) {
  Explanation result;
  if (!document.mesh || e >= document.mesh->edge_count()) {
    result.headline = "There is no such edge.";
    return result;
  }
  const Mesh& mesh = *document.mesh;
  result.holds = document.lines.is_sharp(e);
  const std::optional<Step>& step = document.step("find_sharp_lines");
  // Out of date, the step's own mesh is gone: the tests tell of the current one.
  const bool out_of_date = step && step->out_of_date;
  const Result<LineEvidencePtr> known = line_evidence_of(document);
  const double measured =
      *known ? jump_that_counts(**known, e)
             : static_cast<double>(document.curvatures->beta[e]) * 180.0 / std::numbers::pi;
  const auto on_line_text = [&](double angle) {
    return "On line " + std::to_string(line_through(mesh, document.lines, e)) + ", " +
           origin_text(document.lines.edges[e]) + "; " +
           (measured >= 0.0 ? "convex " : "concave ") + degrees_in_words(std::abs(angle)) +
           (out_of_date ? ", from before an earlier step changed." : ".");
  };
  if (result.holds) result.headline = on_line_text(measured);
  if (!step) {
    if (!result.holds) result.headline = "Not on a line: sharp lines were not looked for yet.";
    return result;
  }
  Stage base{document.mesh, document.curvatures, nullptr, document.evidence};
  std::optional<EdgeId> there = e;
  if (!out_of_date) {
    const Stage before = stage_before(document, "find_sharp_lines");
    if (before.mesh != document.mesh) {
      const std::optional<EdgeId> found = before.mesh->find_edge(mesh.edge(e)[0], mesh.edge(e)[1]);
      if (found && before.curvatures) base = before;
      there = found;
    }
  }
  const SharpLineOptions options = line_options_of(step->parameters);
  const LengthUnit unit = length_unit_of(document);
  const auto headline_of = [&](const std::optional<std::string>& failed, const auto& looked_up) {
    std::string reason;
    if (!there)
      reason = "equilateralisation made this edge after the lines were found";
    else if (failed)
      reason = *failed;
    else if (out_of_date)
      reason = "the lines are from before an earlier step changed; find them again";
    else
      reason = looked_up();
    return "Not on a line: " + reason + ".";
  };
  if (options.method == LineMethod::normal_jump) {
    if (!base.evidence)
      base.evidence = std::make_shared<const SharedLineEvidence>(base.mesh, base.curvatures);
    JumpTests jump =
        test_by_jump(*base.mesh, **base.evidence->get(), options, unit, there.value_or(e));
    result.tests = std::move(jump.tests);
    // The headline says the very value that decides.
    if (result.holds)
      for (const ExplainedTest& test : result.tests)
        if (test.name == "Normal jump" || test.name == "Exterior angle")
          result.headline = on_line_text(test.value);
    if (!jump.profile.dots.empty()) result.profile = std::move(jump.profile);
    if (!result.holds)
      result.headline = headline_of(jump.failed, [] { return std::string(corrected_away); });
    return result;
  }
  const EdgeTests tests(*base.mesh, *base.curvatures, options, unit, there.value_or(e));
  // Sharp edges keep their vertices from mesh to mesh; both meshes share the vertices.
  result.tests = tests.all([&](EdgeId other) {
    if (base.mesh == document.mesh) return document.lines.is_sharp(other);
    const auto [a, b] = base.mesh->edge(other);
    const std::optional<EdgeId> now = mesh.find_edge(a, b);
    return now && document.lines.is_sharp(*now);
  });
  if (!result.holds)
    result.headline = headline_of(tests.failed(), [&] { return tests.looked_up(); });
  return result;
}

namespace {

Explanation explain_by_surfaces(const Document& document, const Step& step, FaceId f) {
  const std::uint32_t label = document.partitions.label(f);
  Explanation result;
  result.holds = label != 0;
  for (const HalfEdgeId side : document.mesh->sides(f))
    result.tests.push_back(side_test(document, side, label));
  const std::string detail = short_text(step.parameters.value("detail", 1.0));
  const std::string old = step.out_of_date ? ", from before an earlier step changed" : "";
  result.headline = !result.holds
                        ? "In no partition: a correction took it away" + old + "."
                        : "In partition " + std::to_string(label) +
                              ", of faces that one surface explains at detail " + detail +
                              ", or that no kink of curvature parts (a free area)" + old + ".";
  return result;
}

/// What fronts made of a face.
struct FaceVerdict {
  const CurvatureInterval* passed;  ///< Null: it passes none.
  const Partition* partition;       ///< Null: it is in none.
  int votes;                        ///< Of its vertices.
  std::uint32_t front;              ///< Faces of the front through it.
  const ExplainedTest* worst;       ///< Of its vertices that do not pass; null: all do.
};

/// How a face came into its partition.
std::string why_held(const Document& document, const FaceRules& rules, FaceId f,
                     const FaceVerdict& verdict) {
  const Partition* partition = verdict.partition;
  if (verdict.passed && partition && verdict.passed == &partition->interval &&
      verdict.front >= rules.min_faces())
    return "; " + rules.name() + " lies in the interval " + interval_text(rules, *verdict.passed);
  if (const auto anchor = partition ? document.mesh->find_face(partition->anchor) : std::nullopt;
      verdict.votes == 0 && anchor && rules.front().votes(*anchor) == 0)
    return ", an area between lines without a vertex inside, judged as a whole";
  if (const FaceId across = rules.front().across_longest(f);
      verdict.votes == 0 && across != no_id &&
      document.partitions.label(across) == document.partitions.label(f))
    return ", joined without a vote across its longest side";
  if (rules.fill_holes() > 0)
    return ", filled as part of a hole of fewer than " +
           counted(rules.fill_holes(), "face", "faces");
  return " by a correction";
}

/// Why a face is in no partition.
std::string why_unassigned(const FaceRules& rules, FaceId f, const FaceVerdict& verdict) {
  if (rules.intervals().empty()) return "no interval is in force";
  if (verdict.votes == 0)
    return "all its vertices lie on lines or the border, and no partition lies across its longest "
           "side";
  if (verdict.passed && verdict.front < rules.min_faces())
    return "the front here covers " + counted(verdict.front, "face", "faces") +
           ", fewer than the " + std::to_string(rules.min_faces()) + " that make a partition";
  if (verdict.passed) return "it passes, so a correction took it away afterwards";
  if (rules.each_vote_held(f))
    return "its vertices lie in different intervals, and no interval holds all of them";
  if (!verdict.worst) return {};
  std::string reason = verdict.worst->sentence;
  reason.pop_back();
  reason[0] = 'v';
  return reason;
}

ExplainedTest test_of_votes(int votes) {
  return {
      "Regular vertices",
      static_cast<double>(votes),
      1.0,
      "",
      votes > 0,
      votes > 0
          ? std::to_string(votes) + " of its vertices lie inside, off lines and border, and vote."
          : "All its vertices lie on lines or the border: it neither starts nor carries a "
            "front."};
}

ExplainedTest test_of_front(std::uint32_t front, std::uint32_t least) {
  const bool enough = front >= least;
  return {"Faces of its front",
          static_cast<double>(front),
          static_cast<double>(least),
          "",
          enough,
          enough ? "A front through it covers at least the " + counted(least, "face", "faces") +
                       " that make a partition."
                 : "A front through it covers " + counted(front, "face", "faces") +
                       ", fewer than the " + std::to_string(least) + " that make a partition."};
}

}  // namespace

Explanation explain_face(const Document& document, FaceId f) {
  Explanation result;
  if (!document.mesh || f >= document.mesh->face_count()) {
    result.headline = "There is no such face.";
    return result;
  }
  const Mesh& mesh = *document.mesh;
  const std::uint32_t label = document.partitions.label(f);
  result.holds = label != 0;
  const std::optional<Step>& step = document.step("find_partitions");
  const std::string in = "In partition " + std::to_string(label);
  if (!step || document.partitions.labels.empty()) {
    result.headline = result.holds ? in + "."
                      : step       ? "In no partition: an earlier step changed; find them again."
                                   : "In no partition: partitions were not looked for yet.";
    return result;
  }
  if (document.partition_method() == PartitionMethod::surfaces)
    return explain_by_surfaces(document, *step, f);
  const Partition* partition = document.partitions.find(label);
  const FaceRules rules(document, step->parameters);
  const CurvatureInterval* passed = partition && rules.front().passes(f, partition->interval)
                                        ? &partition->interval
                                        : rules.passed_interval(f);
  const CurvatureInterval* held = passed      ? passed
                                  : partition ? &partition->interval
                                              : rules.nearest_interval(f);
  FaceVerdict verdict{passed, partition, rules.front().votes(f), 0, nullptr};
  result.tests.push_back(test_of_votes(verdict.votes));
  std::vector<ExplainedTest> of_vertices;
  for (const VertexId v : mesh.triangle(f))
    of_vertices.push_back(vertex_test(mesh, rules, v, held));
  for (const ExplainedTest& test : of_vertices)
    if (const ExplainedTest* worst = verdict.worst;
        !test.passed && (!worst || std::abs(test.value - test.threshold) >
                                       std::abs(worst->value - worst->threshold)))
      verdict.worst = &test;
  result.tests.insert(result.tests.end(), of_vertices.begin(), of_vertices.end());
  if (passed) {
    verdict.front = rules.front_size(f, *passed, rules.min_faces());
    result.tests.push_back(test_of_front(verdict.front, rules.min_faces()));
  }
  for (const HalfEdgeId h : mesh.sides(f)) result.tests.push_back(side_test(document, h, label));
  result.headline = (result.holds ? in + why_held(document, rules, f, verdict)
                                  : "In no partition: " + why_unassigned(rules, f, verdict)) +
                    (step->out_of_date ? ", from before an earlier step changed." : ".");
  return result;
}

}  // namespace arris
