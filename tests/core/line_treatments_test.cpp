// The interactive treatments of lines (section 6.3.2) as operations on documents.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/treatments_fixture.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using nlohmann::json;
using testing::applied;
using testing::document_of;
using testing::expect_invariants;
using testing::sharp_set;

/// A plate with a straight step line along y at x = 0 whose angle falls off towards the ends.
Document roof_document(double angle = 0.8) {
  const Document document = document_of(testing::roof(angle, 5.0, 20.0, 1.0));
  return applied(document, {"find_sharp_lines", {{"angle", 20.0}, {"min_length", 0.0}}});
}

std::uint32_t longest_line(const Document& document) {
  const auto longest =
      std::max_element(document.lines.lines.begin(), document.lines.lines.end(),
                       [](const LinePtr& a, const LinePtr& b) { return a->length < b->length; });
  return (*longest)->id;
}

TEST(DeleteLines, TakesThemAwayAndKeepsThemAwayUnderOtherThresholds) {
  Document document = roof_document();
  ASSERT_EQ(document.lines.lines.size(), 1u);
  const std::uint32_t id = document.lines.lines[0]->id;
  document = applied(document, {"delete_lines", {{"lines", {id}}}});
  EXPECT_TRUE(document.lines.lines.empty());
  for (const double angle : {20.0, 10.0, 30.0}) {
    document = applied(document, {"find_sharp_lines", {{"angle", angle}, {"min_length", 0.0}}});
    EXPECT_TRUE(document.lines.lines.empty()) << angle;
    ASSERT_EQ(document.corrections.size(), 1u);
    EXPECT_EQ(document.corrections[0]->state, CorrectionState::applied);
  }
}

TEST(DeleteLines, TheSwitchTurnsCorrectionsOff) {
  Document document = roof_document();
  document = applied(document, {"delete_lines", {{"lines", {document.lines.lines[0]->id}}}});
  document = applied(document, {"find_sharp_lines",
                                {{"angle", 20.0}, {"min_length", 0.0}, {"corrections", false}}});
  EXPECT_EQ(document.lines.lines.size(), 1u);
  EXPECT_EQ(document.corrections[0]->state, CorrectionState::off);
}

TEST(DeleteLines, SparesALineCloseByThatWasNotDeleted) {
  // Two step edges a mean edge apart: deleting one leaves the other when lines are found again.
  Document document = document_of(testing::stepped_plate(6.0, 20.0, 1.0, 1.0));
  const Operation find{"find_sharp_lines",
                       {{"angle", 30.0}, {"min_length", 0.0}, {"parallel_distance", 0}}};
  document = applied(document, find);
  ASSERT_EQ(document.lines.lines.size(), 2u);
  document = applied(document, {"delete_lines", {{"lines", {document.lines.lines[0]->id}}}});
  const std::vector<EdgeId> left = sharp_set(document);
  document = applied(document, find);
  EXPECT_EQ(sharp_set(document), left);
}

TEST(DrawLine, LiftsADeletionWhereItRuns) {
  Document document = roof_document();
  const Line line = *document.lines.lines[0];
  document = applied(document, {"delete_lines", {{"lines", {line.id}}}});
  document = applied(document,
                     {"draw_line", {{"vertices", {line.vertices.front(), line.vertices.back()}}}});
  ASSERT_EQ(document.lines.lines.size(), 1u);
  EXPECT_EQ(document.lines.lines[0]->vertices, line.vertices);  // it snaps to the ridge
  EXPECT_EQ(document.lines.lines[0]->origin, Origin::drawn);
  const std::vector<EdgeId> drawn = sharp_set(document);
  document = applied(document, {"find_sharp_lines", {{"angle", 25.0}}});
  EXPECT_EQ(sharp_set(document), drawn);
}

TEST(ExtendLine, GrowsUnderItsOwnAngleAndShrinksWithIt) {
  // A roof whose ridge is sharp in the middle and fades out: the angle falls along y.
  const auto place = [](double x, double y) {
    const double slope = 0.5 * std::exp(-std::pow((y - 20.0) / 12.0, 2));
    return Point(x, y, -slope * std::abs(x - 20.0));
  };
  const Document opened = document_of(testing::shaped_lattice(40.0, 1.0, place));
  for (const auto& [method, found_at] : {std::pair{"walk", 40.0}, std::pair{"normal_jump", 32.0}}) {
    const Document document = applied(
        opened,
        {"find_sharp_lines", {{"method", method}, {"angle", found_at}, {"min_length", 0.0}}});
    ASSERT_GE(document.lines.lines.size(), 1u);
    const std::uint32_t id = longest_line(document);
    double before = document.lines.find(id)->length;
    for (const double angle : {30.0, 20.0, 12.0}) {
      const Document longer = applied(document, {"extend_line", {{"line", id}, {"angle", angle}}});
      ASSERT_NE(longer.lines.find(id), nullptr);
      EXPECT_GT(longer.lines.find(id)->length, before) << angle;
      before = longer.lines.find(id)->length;
      expect_invariants(longer);
    }
    const Document same = applied(document, {"extend_line", {{"line", id}, {"angle", 60.0}}});
    EXPECT_EQ(sharp_set(same), sharp_set(document));
    // One end only.
    const double both =
        applied(document, {"extend_line", {{"line", id}, {"angle", 20.0}}}).lines.find(id)->length;
    const double first =
        applied(document, {"extend_line", {{"line", id}, {"angle", 20.0}, {"ends", "first"}}})
            .lines.find(id)
            ->length;
    EXPECT_LT(first, both);
    EXPECT_GT(first, document.lines.find(id)->length);
  }
}

TEST(TrimAndMerge, UndoEachOther) {
  const Document document = roof_document();
  const Line line = *document.lines.lines[0];
  ASSERT_GE(line.vertices.size(), 12u);
  // Cut the middle out: split twice, delete the middle piece, merge the rest again.
  Document cut =
      applied(document, {"split_line", {{"line", line.id}, {"vertex", line.vertices[5]}}});
  ASSERT_EQ(cut.lines.lines.size(), 2u);
  const std::uint32_t longer = longest_line(cut);
  cut = applied(cut, {"split_line", {{"line", longer}, {"vertex", line.vertices[8]}}});
  ASSERT_EQ(cut.lines.lines.size(), 3u);
  expect_invariants(cut);
  std::uint32_t middle = 0;
  for (const LinePtr& l : cut.lines.lines)
    if (l->vertices.size() == 4) middle = l->id;
  ASSERT_NE(middle, 0u);
  cut = applied(cut, {"delete_lines", {{"lines", {middle}}}});
  ASSERT_EQ(cut.lines.lines.size(), 2u);
  const Document merged =
      applied(cut, {"merge_lines", {{"a", cut.lines.lines[0]->id}, {"b", cut.lines.lines[1]->id}}});
  ASSERT_EQ(merged.lines.lines.size(), 1u);
  EXPECT_EQ(merged.lines.lines[0]->vertices, line.vertices);
  EXPECT_EQ(merged.lines.lines[0]->origin, Origin::merged);
  expect_invariants(merged);

  const Document trimmed = applied(
      document, {"trim_line", {{"line", line.id}, {"vertex", line.vertices[5]}, {"side", "last"}}});
  ASSERT_EQ(trimmed.lines.lines.size(), 1u);
  EXPECT_EQ(trimmed.lines.lines[0]->vertices.size(), 6u);
  EXPECT_EQ(trimmed.lines.lines[0]->id, line.id);
}

TEST(RerouteLine, RunsThroughThePoint) {
  const Document document = roof_document();
  const Line line = *document.lines.lines[0];
  const Mesh& mesh = *document.mesh;
  VertexId via = no_id;
  mesh.for_ring(line.vertices[10], [&](HalfEdgeId h) {
    if (!document.lines.is_sharp(h >> 1)) via = mesh.to(h);
  });
  const Document moved = applied(
      document,
      {"reroute_line",
       {{"line", line.id}, {"from", line.vertices[8]}, {"to", line.vertices[12]}, {"via", via}}});
  ASSERT_EQ(moved.lines.lines.size(), 1u);
  const std::vector<VertexId>& path = moved.lines.lines[0]->vertices;
  EXPECT_NE(std::find(path.begin(), path.end(), via), path.end());
  EXPECT_EQ(path.front(), line.vertices.front());
  EXPECT_EQ(path.back(), line.vertices.back());
}

TEST(RecomputeLines, InARegionOnlyThereUnderItsOwnAngle) {
  const Document none = applied(document_of(testing::roof(0.6, 5.0, 20.0, 1.0)),
                                {"find_sharp_lines", {{"angle", 60.0}}});
  ASSERT_TRUE(none.lines.lines.empty());
  // The ridge lies at x = 0; brush its middle.
  VertexId middle = 0;
  for (VertexId v = 0; v < none.mesh->vertex_count(); ++v)
    if ((none.mesh->point(v) - Point(0.0, 10.0, 0.0)).norm() <
        (none.mesh->point(middle) - Point(0.0, 10.0, 0.0)).norm())
      middle = v;
  const Document found =
      applied(none, {"recompute_lines",
                     {{"region", {{"vertices", {middle}}, {"radius", 4.5}}}, {"angle", 20.0}}});
  ASSERT_EQ(found.lines.lines.size(), 1u);
  for (const VertexId v : found.lines.lines[0]->vertices)
    EXPECT_LE((found.mesh->point(v) - found.mesh->point(middle)).norm(), 4.5);
  EXPECT_GT(found.lines.lines[0]->length, 6.0);
}

TEST(FindSharpLines, TakesOnlyTheSignAndAnglesAskedFor) {
  // A step has a convex edge above and a concave one below, both of 90 degrees.
  const Document step = document_of(testing::stepped_plate(6.0, 20.0, 3.0, 1.0));
  const auto angles = [&](const json& parameters) {
    json complete{{"angle", 30.0}, {"min_length", 0.0}};
    complete.update(parameters);
    std::vector<int> signs;
    for (const LinePtr& line : applied(step, {"find_sharp_lines", complete}).lines.lines)
      signs.push_back(line->convex() ? 1 : -1);
    std::sort(signs.begin(), signs.end());
    return signs;
  };
  EXPECT_EQ(angles(json::object()), (std::vector<int>{-1, 1}));
  EXPECT_EQ(angles({{"convexity", "convex"}}), (std::vector<int>{1}));
  EXPECT_EQ(angles({{"convexity", "concave"}}), (std::vector<int>{-1}));
  EXPECT_EQ(angles({{"max_angle", 60.0}}), (std::vector<int>{}));
  EXPECT_EQ(angles({{"max_angle", 100.0}}), (std::vector<int>{-1, 1}));
}

TEST(LineTreatments, ComplainOfWhatIsNotThere) {
  const Document document = roof_document();
  for (const Operation& operation :
       {Operation{"delete_lines", {{"lines", {999}}}},
        Operation{"delete_lines", {{"lines", json::array()}}},
        Operation{"extend_line", {{"line", 999}}}, Operation{"extend_line", json::object()},
        Operation{"draw_line", {{"vertices", {0}}}},
        Operation{"draw_line", {{"vertices", {0, 999999}}}},
        Operation{"merge_lines", {{"a", 1}, {"b", 1}}},
        Operation{"split_line", {{"line", 1}, {"vertex", 0}}},
        Operation{"recompute_lines", {{"angle", 20}}},
        Operation{"lift_correction", {{"correction", 7}}},
        Operation{"connect_partitions", {{"partitions", {1, 2}}}},
        Operation{"lock", json::object()}}) {
    const Result<Document> result = apply(document, operation);
    ASSERT_FALSE(result.has_value()) << operation.text();
    EXPECT_FALSE(result.error().message.empty());
  }
}

}  // namespace
}  // namespace arris
