#include "core/guidance/explain_jump.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "core/base/words.h"

namespace arris {

namespace {

bool contains(const std::vector<EdgeId>& edges, EdgeId e) {
  return std::binary_search(edges.begin(), edges.end(), e);
}

/// Connected chosen edges.
struct Group {
  double length = 0.0;  // in the mesh's unit
  bool exact = false;   // one of them is an exact crease
};

Group group_of(const Mesh& mesh, const CandidateGraph& candidates,
               const std::vector<EdgeId>& chosen, EdgeId e) {
  Group group;
  std::vector<EdgeId> front{e};
  std::unordered_set<EdgeId> seen{e};
  for (std::size_t i = 0; i < front.size(); ++i) {
    group.length += mesh.edge_length(front[i]);
    group.exact |= candidates.find(front[i])->exact;
    for (const VertexId v : mesh.edge(front[i]))
      mesh.for_ring(v, [&](HalfEdgeId h) {
        if (contains(chosen, h >> 1) && seen.insert(h >> 1).second) front.push_back(h >> 1);
      });
  }
  return group;
}

}  // namespace

double jump_that_counts(const LineEvidence& evidence, EdgeId e) {
  const double here = evidence.jump[e];
  const BorderEdge* border = evidence.candidates.find(e);
  if (!border || !(border->height > 0.0F)) return here;
  return std::copysign(border->height, here);
}

JumpTests test_by_jump(const Mesh& mesh, const LineEvidence& evidence,
                       const SharpLineOptions& options, LengthUnit unit, EdgeId e) {
  JumpTests result;
  const auto add = [&](ExplainedTest test) { result.tests.push_back(std::move(test)); };
  const bool inside = !mesh.is_border_edge(e);
  add({"Inside the scan", nothing, nothing, "", inside,
       inside ? "The edge has a face on both sides."
              : "The scan ends at this edge, and nothing can be measured across it."});
  if (!inside) {
    result.failed = "the scan ends at this edge";
    return result;
  }
  result.profile = profile_across(mesh, evidence.candidates, e);
  const std::string threshold = degrees_in_words(options.angle);
  const BorderEdge* border = evidence.candidates.find(e);
  const double here = std::abs(evidence.jump[e]);
  if (!border) {
    add({"Region border", nothing, nothing, "", false,
         "No border between regions runs here: the jump has its crest elsewhere, or is too weak to "
         "part two regions."});
    add({"Normal jump", here, options.angle, "°", here > options.angle,
         "By so much the mean normal jumps here; off the borders between regions it counts for "
         "nothing."});
    result.failed = "no border between regions runs here";
    return result;
  }
  const BorderPlace& place = border->place;
  SharpLineOptions of_any_length = options;
  of_any_length.min_length = 0.0;
  const std::vector<EdgeId> chosen = choose_sharp_edges(mesh, evidence, of_any_length);
  const bool is_chosen = contains(chosen, e);
  const bool above = border->height > static_cast<float>(options.angle);
  // A crest parts no regions at any threshold; a border may at this one have none beside it.
  const bool reaches = place.value >= static_cast<float>(options.angle);
  const bool is_crest = border->height <= 0.0F && !border->exact;
  const bool is_open = is_crest || (is_chosen && !above && reaches);
  if (border->exact) {
    add({"Region border", nothing, nothing, "", true,
         "The mesh has no noise here, so that each edge counts by its own exterior angle."});
    add({"Exterior angle", border->height, options.angle, "°", above,
         std::string("The angle between the faces of the edge is ") +
             (above ? "above" : "not above") + " TV_IH."});
  } else {
    add({"Region border", nothing, nothing, "", !is_open || is_chosen,
         is_open ? "It parts no two regions, but lies on a crest of the jump, as a step does that "
                   "fades out."
                 : "It lies on a border between two regions."});
    if (is_open)
      add({"Normal jump", place.value, options.angle, "°", reaches,
           std::string("A line that parts no two regions counts by its own jump") +
               (is_chosen && !reaches ? ". It closes a short gap between two lines."
                                      : ". It has to be the longer the less it jumps.")});
    else
      add({"Normal jump", border->height, options.angle, "°", above,
           std::string("By so much the mean normal jumps along this border as a whole: ") +
               (above ? "above" : "not above") + " TV_IH." +
               (is_chosen && !above ? " It closes a short gap between two lines." : "")});
    const double jump = std::abs(place.jump), turn = std::abs(place.turn);
    const double least = BorderTestOptions().least_ratio;
    if (turn > 0.0)
      add({"Jump to turn", rounded(jump / turn, 2), least, "", jump >= least * turn,
           "Of what the surface turns here, this share lies at the line itself and the rest in "
           "what "
           "surrounds it; a fillet turns over a distance."});
  }
  const bool within = std::abs(place.value) <= options.max_angle &&
                      (options.convexity == Convexity::any ||
                       (place.turn >= 0.0F) == (options.convexity == Convexity::convex));
  if (options.max_angle < 180.0 || options.convexity != Convexity::any)
    add({"Bounds", place.value, options.max_angle, "°", within,
         "Lines are looked for up to " + degrees_in_words(options.max_angle) +
             (options.convexity == Convexity::convex    ? ", convex ones only."
              : options.convexity == Convexity::concave ? ", concave ones only."
                                                        : ".")});
  if (!is_chosen) {
    if (!within)
      result.failed = "its jump is outside the bounds that were asked for";
    else if (is_crest)
      result.failed = reaches ? "it parts no two regions, and for that its crest is too short or "
                                "jumps too little"
                              : "it parts no two regions, and its own jump of " +
                                    degrees_in_words(place.value) +
                                    " is not above the threshold of " + threshold;
    else if (!above)
      result.failed =
          (border->exact ? "its exterior angle of " : "its border as a whole reads ") +
          degrees_in_words(border->height) +
          (border->exact ? " is not above the threshold of " : ", not above the threshold of ") +
          threshold;
    else
      result.failed =
          "it is on a branch with a free end, or a rung between two lines, shorter than " +
          number_text(LineChoiceOptions().spur, 2) + " edges";
    return result;
  }
  const Group group = group_of(mesh, evidence.candidates, chosen, e);
  const bool kept = contains(choose_sharp_edges(mesh, evidence, options), e);
  add({"Length", group.length, options.min_length, unit_text(unit), kept,
       "Its line and what it touches are " + length_in_words(group.length, unit) + " long; " +
           (group.exact && group.length < options.min_length
                ? "without noise even short ones stay."
                : "shorter than " + length_in_words(options.min_length, unit) + " they go.")});
  if (!kept)
    result.failed = "its line and what it touches are " + length_in_words(group.length, unit) +
                    " long, shorter than min_length, " + length_in_words(options.min_length, unit);
  return result;
}

}  // namespace arris
