#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// What section 7.1 decides by, for finding, treatments by hand, stability curves and explanations
/// alike. Regular vertices vote, and those alone: a face passes an interval where it has a vote and
/// all its votes lie in it; a face without a vote joins what lies across its longest edge that is
/// not sharp. Fronts never cross sharp edges. Refers to what it is made from.
class FrontRule {
 public:
  /// `values`: the criterion per vertex.
  FrontRule(const Mesh& mesh, const std::vector<double>& values, const SharpLines& lines)
      : mesh_(mesh), values_(values), lines_(lines) {}
  /// Works out the votes of all vertices and faces at once, for work on the whole mesh.
  void count_all_votes();

  /// True for a vertex with a two-sided curvature: inside, on no sharp line.
  bool is_regular(VertexId v) const { return regular_.empty() ? decides(v) : regular_[v] != 0; }
  /// How many vertices of the face are regular.
  int votes(FaceId f) const {
    if (!votes_.empty()) return votes_[f];
    const Triangle& t = mesh_.triangle(f);
    return is_regular(t[0]) + is_regular(t[1]) + is_regular(t[2]);
  }
  /// Of all faces; only after count_all_votes().
  const std::vector<std::uint8_t>& all_votes() const { return votes_; }
  bool passes(FaceId f, const CurvatureInterval& interval) const {
    for (const VertexId v : mesh_.triangle(f))
      if (is_regular(v) && !interval.holds(values_[v])) return false;
    return votes(f) > 0;
  }
  /// The face across the longest edge that is not sharp (the first of equals), which a face without
  /// a vote joins; no_id: there is none.
  FaceId across_longest(FaceId f) const;

 private:
  bool decides(VertexId v) const;

  const Mesh& mesh_;
  const std::vector<double>& values_;
  const SharpLines& lines_;
  std::vector<std::uint8_t> regular_, votes_;  // empty: worked out when asked for
};

}  // namespace arris
