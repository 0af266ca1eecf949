#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/document/document.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/jump_profile.h"

namespace arris {

/// One test that an edge or face went through.
struct ExplainedTest {
  std::string name;      ///< "|IHe|", "IKabs of vertex 12"
  double value = 0.0;    ///< What was measured; NaN where there is nothing to measure.
  double threshold = 0;  ///< What it was held against; NaN where there is none.
  std::string unit;      ///< Of both: "°", "1/mm²", or empty.
  bool passed = false;
  std::string sentence;
};

/// In a test: nothing to measure, or nothing to hold it against.
inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Why an edge is, or is not, on a line; why a face is, or is not, in a partition.
struct Explanation {
  bool holds = false;    ///< The edge is sharp; the face is in a partition.
  std::string headline;  ///< One sentence: "On line 12, found; convex 34.2 degrees."
  std::vector<ExplainedTest> tests;
  /// How the surface turns across the edge; absent where lines are found by the walk, or nothing
  /// can be measured.
  std::optional<JumpProfile> profile;
};

/// The tests that decide about an edge, with the parameters of the last find_sharp_lines, on the
/// mesh that step ran on (an equilateralised mesh still has its sharp edges, but other curvatures).
///
/// By the normal jump: whether a border between regions runs there, what the border as a whole
/// reads, and what became of it when lines were chosen. Looks at the candidates of the whole mesh,
/// some 50 ms on a million faces; evidence that is not known yet is worked out first.
///
/// By the walk, the tests of section 6.1: an edge can only be sharp where it lies inside the scan,
/// its |IHe| is above TV_IH and the IKabs of both its ends is above TV_IK; such tests look at the
/// edge's neighbourhood only. An edge that passes them all and is not sharp all the same is looked
/// up by running identification and the automatic treatments again: about as long as
/// find_sharp_lines takes.
Explanation explain_edge(const Document& document, EdgeId e);

/// The tests of section 7.1 on a face, with the parameters of the last find_partitions. Looks at
/// the face, its neighbours and at most min_faces faces around it.
Explanation explain_face(const Document& document, FaceId f);

}  // namespace arris
