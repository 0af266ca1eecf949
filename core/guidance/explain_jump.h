#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/guidance/explain.h"
#include "core/mesh/length_unit.h"
#include "core/sharp_lines/jump_profile.h"
#include "core/sharp_lines/line_evidence.h"
#include "core/sharp_lines/sharp_lines.h"

namespace arris {

/// What the method of the normal jump says about an edge.
struct JumpTests {
  std::vector<ExplainedTest> tests;
  std::optional<std::string>
      failed;  ///< Why the step leaves it out, as a clause; absent: it does not.
  JumpProfile profile;
};

/// Degrees, convex positive, by which an edge is told to be on a line: of its border as a whole
/// where regions meet along it, else of the place alone. The one number to say of an edge.
double jump_that_counts(const LineEvidence& evidence, EdgeId e);

/// Tests edge e of a mesh as find_sharp_edges() does under `options`, from the evidence on it.
/// Lengths are told in `unit`.
JumpTests test_by_jump(const Mesh& mesh, const LineEvidence& evidence,
                       const SharpLineOptions& options, LengthUnit unit, EdgeId e);

}  // namespace arris
