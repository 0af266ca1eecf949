// Locks and corrections: what treatments by hand leave when lines and partitions are found again.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/treatments_fixture.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using nlohmann::json;
using testing::applied;
using testing::cube_document;
using testing::expect_invariants;
using testing::sharp_set;

TEST(Lock, NoFindingChangesWhatIsApproved) {
  Document document = cube_document();
  const LinePtr line = document.lines.lines[3];
  const PartitionPtr partition = document.partitions.partitions[1];
  const std::vector<FaceId> faces = faces_of(*document.mesh, document.partitions, *partition);
  document = applied(document, {"lock", {{"lines", {line->id}}, {"partitions", {partition->id}}}});
  EXPECT_FALSE(apply(document, {"delete_lines", {{"lines", {line->id}}}}).has_value());
  EXPECT_FALSE(
      apply(document, {"remove_partitions", {{"partitions", {partition->id}}}}).has_value());
  document = applied(document, {"find_sharp_lines", {{"angle", 120.0}}});
  ASSERT_NE(document.lines.find(line->id), nullptr);
  EXPECT_EQ(document.lines.find(line->id)->vertices, line->vertices);
  EXPECT_TRUE(document.lines.find(line->id)->locked);
  EXPECT_EQ(document.lines.lines.size(), 1u);
  document = applied(
      document,
      {"find_partitions", {{"intervals", {{0.0, 1e9}}}, {"min_faces", 1}, {"fill_holes", 0}}});
  ASSERT_NE(document.partitions.find(partition->id), nullptr);
  EXPECT_TRUE(document.partitions.find(partition->id)->locked);
  EXPECT_EQ(faces_of(*document.mesh, document.partitions, *document.partitions.find(partition->id)),
            faces);
  expect_invariants(document);
  document = applied(document, {"lock", {{"lines", {line->id}}, {"locked", false}}});
  EXPECT_TRUE(apply(document, {"delete_lines", {{"lines", {line->id}}}}).has_value());
}

TEST(Corrections, AreListedWhenTheyNoLongerApply) {
  Document document = cube_document();
  const Line line = *document.lines.lines[0];
  document = applied(
      document, {"trim_line", {{"line", line.id}, {"vertex", line.vertices[5]}, {"side", "last"}}});
  document = applied(document, {"extend_line", {{"line", line.id}, {"angle", 40.0}}});
  // No line at all is found above 120 degrees: there is nothing to extend.
  document = applied(document, {"find_sharp_lines", {{"angle", 120.0}}});
  ASSERT_EQ(document.corrections.size(), 2u);
  EXPECT_EQ(document.corrections[1]->state, CorrectionState::failed);
  EXPECT_FALSE(document.corrections[1]->message.empty());
  // Back again, and it applies again.
  document = applied(document, {"find_sharp_lines", {{"angle", 30.0}, {"min_length", 0.0}}});
  EXPECT_NE(document.corrections[1]->state, CorrectionState::failed);
}

TEST(LiftCorrection, IsAsIfItHadNeverBeenMade) {
  const Document before = cube_document();
  Document document = applied(before, {"delete_lines", {{"lines", {before.lines.lines[4]->id}}}});
  document = applied(document, {"delete_lines", {{"lines", {before.lines.lines[5]->id}}}});
  const std::vector<EdgeId> one_gone =
      sharp_set(applied(before, {"delete_lines", {{"lines", {before.lines.lines[5]->id}}}}));
  document = applied(document, {"lift_correction", {{"correction", document.corrections[0]->id}}});
  EXPECT_EQ(document.corrections.size(), 1u);
  EXPECT_EQ(sharp_set(document), one_gone);
  document = applied(document, {"lift_correction", {{"correction", document.corrections[0]->id}}});
  EXPECT_EQ(sharp_set(document), sharp_set(before));
  expect_invariants(document);
}

}  // namespace
}  // namespace arris
