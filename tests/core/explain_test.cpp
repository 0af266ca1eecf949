#include "core/guidance/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "core/base/words.h"
#include "core/sharp_lines/automatic_treatments.h"
#include "core/sharp_lines/sharp_lines.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;

const ExplainedTest* find_test(const Explanation& explanation, const std::string& begin) {
  for (const ExplainedTest& test : explanation.tests)
    if (test.name.starts_with(begin)) return &test;
  return nullptr;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

double degrees(const Document& document, EdgeId e) {
  return std::abs(document.curvatures->beta[e]) * 180.0 / std::numbers::pi;
}

constexpr const char* methods[] = {"normal_jump", "walk"};

Document with_lines(Document document, const char* method) {
  return applied(std::move(document), {"find_sharp_lines", {{"method", method}}});
}

/// A segmented sample mould; partitions by the method that goes with that of the lines.
Document segmented_mould(const char* method) {
  const bool walk = std::string_view(method) == "walk";
  return applied(with_lines(document_of(sample_mould(1.8)), method),
                 {"find_partitions", {{"method", walk ? "fronts" : "surfaces"}}});
}

const BorderEdge* candidate(const Document& document, EdgeId e) {
  return document.evidence->known()->candidates.find(e);
}

/// What must hold of every edge and face, whatever the document.
void expect_agreement(const Document& document) {
  for (EdgeId e = 0; e < document.mesh->edge_count(); ++e) {
    const Explanation explanation = explain_edge(document, e);
    const bool sharp = document.lines.is_sharp(e);
    ASSERT_EQ(explanation.holds, sharp);
    ASSERT_EQ(explanation.headline.starts_with("On line "), sharp) << explanation.headline;
    ASSERT_EQ(explanation.headline.starts_with("Not on a line: "), !sharp) << explanation.headline;
    if (sharp) {
      const std::uint32_t id =
          static_cast<std::uint32_t>(std::stoul(explanation.headline.substr(8)));
      const Line* line = document.lines.find(id);
      ASSERT_NE(line, nullptr);
      for (const VertexId v : document.mesh->edge(e))
        ASSERT_NE(std::ranges::find(line->vertices, v), line->vertices.end());
    }
  }
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const Explanation explanation = explain_face(document, f);
    const std::uint32_t label = document.partitions.label(f);
    ASSERT_EQ(explanation.holds, label != 0);
    const std::string begin =
        label != 0 ? "In partition " + std::to_string(label) : std::string("In no partition: ");
    ASSERT_TRUE(explanation.headline.starts_with(begin)) << explanation.headline;
  }
}

TEST(ExplainEdge, EdgesOfACubePassEveryTestAndFlatOnesFailAtTheAngle) {
  for (const int divisions : {1, 4}) {
    SCOPED_TRACE(divisions);
    const Document document = with_lines(document_of(divided_cube(10.0, divisions)), "walk");
    int sharp = 0;
    for (EdgeId e = 0; e < document.mesh->edge_count(); ++e) {
      const Explanation explanation = explain_edge(document, e);
      if (degrees(document, e) > 45.0) {
        ++sharp;
        EXPECT_TRUE(explanation.holds);
        EXPECT_TRUE(contains(explanation.headline, "found; convex 90°.")) << explanation.headline;
        EXPECT_FALSE(explanation.tests.empty());
        for (const ExplainedTest& test : explanation.tests)
          EXPECT_TRUE(test.passed) << test.sentence;
        continue;
      }
      EXPECT_FALSE(explanation.holds);
      EXPECT_TRUE(contains(explanation.headline, "angle of 0°")) << explanation.headline;
      const ExplainedTest* angle = find_test(explanation, "|IHe|");
      ASSERT_NE(angle, nullptr);
      EXPECT_FALSE(angle->passed);
      EXPECT_NEAR(angle->value, 0.0, 1e-4);
      EXPECT_EQ(angle->threshold, document.step("find_sharp_lines")->parameters.at("angle"));
      EXPECT_EQ(angle->unit, "°");
    }
    EXPECT_EQ(sharp, 12 * divisions);
  }
}

TEST(ExplainEdge, ByTheJumpEdgesOfACubeCountByTheirOwnAngle) {
  for (const int divisions : {1, 4}) {
    SCOPED_TRACE(divisions);
    const Document document = with_lines(document_of(divided_cube(10.0, divisions)), "normal_jump");
    int sharp = 0;
    for (EdgeId e = 0; e < document.mesh->edge_count(); ++e) {
      const Explanation explanation = explain_edge(document, e);
      const bool is_edge = degrees(document, e) > 45.0;
      ASSERT_EQ(explanation.holds, is_edge);
      if (is_edge) {
        ++sharp;
        EXPECT_TRUE(contains(explanation.headline, "found; convex 90°.")) << explanation.headline;
        const ExplainedTest* angle = find_test(explanation, "Exterior angle");
        ASSERT_NE(angle, nullptr);
        EXPECT_NEAR(angle->value, 90.0, 1e-3);
        EXPECT_EQ(angle->threshold, document.step("find_sharp_lines")->parameters.at("angle"));
        EXPECT_EQ(angle->unit, "°");
        EXPECT_EQ(find_test(explanation, "Jump to turn"), nullptr) << "nothing was pooled";
        for (const ExplainedTest& test : explanation.tests)
          EXPECT_TRUE(test.passed) << test.sentence;
        continue;
      }
      EXPECT_TRUE(contains(explanation.headline, "no border between regions"))
          << explanation.headline;
      EXPECT_FALSE(find_test(explanation, "Region border")->passed);
    }
    EXPECT_EQ(sharp, 12 * divisions);
  }
}

TEST(ExplainEdge, ByTheJumpABorderCountsAsAWhole) {
  const Document document = segmented_mould("normal_jump");
  const double threshold = document.step("find_sharp_lines")->parameters.at("angle");
  int borders = 0, weak = 0, fitted = 0;
  for (EdgeId e = 0; e < document.mesh->edge_count(); ++e) {
    const BorderEdge* border = candidate(document, e);
    if (!border || border->exact) continue;
    const Explanation explanation = explain_edge(document, e);
    const ExplainedTest* jump = find_test(explanation, "Normal jump");
    ASSERT_NE(jump, nullptr);
    EXPECT_EQ(jump->threshold, threshold);
    if (contains(jump->sentence, "as a whole")) {
      ++borders;
      EXPECT_FLOAT_EQ(static_cast<float>(jump->value), border->height);
      EXPECT_EQ(jump->passed, border->height > threshold);
    }
    if (!explanation.holds && border->height <= threshold) {
      ++weak;
      EXPECT_TRUE(contains(explanation.headline, "not above the threshold") ||
                  contains(explanation.headline, "parts no two regions"))
          << explanation.headline;
    }
    // One value per meaning: the chart shows what the test noted.
    if (!explanation.profile || !explanation.profile->fitted()) continue;
    ++fitted;
    EXPECT_NEAR(explanation.profile->turn(), border->place.turn, 1e-2);
    EXPECT_NEAR(std::abs(explanation.profile->jump()), std::abs(border->place.jump), 1e-2);
  }
  EXPECT_GT(borders, 300);
  EXPECT_GT(weak, 20);
  EXPECT_GT(fitted, 300);
}

/// Numbers before "°" in a text.
std::set<std::string> angles_in(const std::string& text) {
  std::set<std::string> found;
  const std::string degree = "°";
  for (std::size_t at = text.find(degree); at != std::string::npos;
       at = text.find(degree, at + degree.size())) {
    std::size_t begin = at;
    while (begin > 0 && (std::isdigit(static_cast<unsigned char>(text[begin - 1])) != 0 ||
                         text[begin - 1] == '.'))
      --begin;
    found.insert(text.substr(begin, at - begin));
  }
  return found;
}

TEST(ExplainEdge, OneAngleIsSaidOfAnEdgeBesideTheThreshold) {
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Document document = segmented_mould(method);
    const double threshold = document.step("find_sharp_lines")->parameters.at("angle");
    int more = 0;
    for (EdgeId e = 0; e < document.mesh->edge_count(); e += 7) {
      const Explanation explanation = explain_edge(document, e);
      std::string text = explanation.headline;
      for (const ExplainedTest& test : explanation.tests) {
        text += " " + test.sentence;
        if (test.unit == "°") text += " " + degrees_in_words(test.value) + " ";
      }
      std::set<std::string> angles = angles_in(text);
      const std::string own = degrees_in_words(threshold);
      angles.erase(own.substr(0, own.find("°")));
      more += angles.size() > 1;
      EXPECT_LE(angles.size(), 1u) << text;
      if (more > 3) return;
    }
  }
}

TEST(ExplainEdge, ByTheJumpTheLeastLengthAndCorrectionsAreNamed) {
  Document document = segmented_mould("normal_jump");
  nlohmann::json parameters = document.step("find_sharp_lines")->parameters;
  const auto is_on_line = [&](EdgeId e) { return document.lines.is_sharp(e); };
  EdgeId on_line = 0;
  while (!is_on_line(on_line)) ++on_line;
  // Longer than all lines together: all go.
  double length = 0.0;
  for (const LinePtr& line : document.lines.lines) length += line->length;
  parameters["min_length"] = 2.0 * length;
  const Document none = applied(document, {"find_sharp_lines", parameters});
  const Explanation explanation = explain_edge(none, on_line);
  EXPECT_TRUE(contains(explanation.headline, "shorter than min_length")) << explanation.headline;
  const ExplainedTest* test = find_test(explanation, "Length");
  ASSERT_NE(test, nullptr);
  EXPECT_FALSE(test->passed);
  EXPECT_LE(test->value, length * 1.0001);
  EXPECT_EQ(test->threshold, 2.0 * length);
  // And only concave ones.
  parameters = document.step("find_sharp_lines")->parameters;
  parameters["convexity"] = "concave";
  const Document concave = applied(document, {"find_sharp_lines", parameters});
  int outside = 0;
  for (EdgeId e = 0; e < document.mesh->edge_count(); ++e)
    if (is_on_line(e) && !concave.lines.is_sharp(e) && candidate(document, e)->place.turn > 0.0F)
      outside += contains(explain_edge(concave, e).headline, "outside the bounds");
  EXPECT_GT(outside, 50);

  const std::uint32_t line = document.lines.lines.front()->id;
  const Document deleted = applied(document, {"delete_lines", {{"lines", {line}}}});
  for (EdgeId e = 0; e < document.mesh->edge_count(); ++e)
    if (is_on_line(e) && !deleted.lines.is_sharp(e)) {
      ASSERT_TRUE(contains(explain_edge(deleted, e).headline, "correction took it away"))
          << explain_edge(deleted, e).headline;
    }
}

TEST(ExplainEdge, ConcaveAndConvexAreToldApart) {
  for (const char* method : methods) {
    const Document document = with_lines(document_of(stepped_plate(10.0, 20.0, 4.0, 1.0)), method);
    int sharp = 0;
    for (EdgeId e = 0; e < document.mesh->edge_count(); ++e)
      if (document.lines.is_sharp(e)) {
        ++sharp;
        EXPECT_TRUE(contains(explain_edge(document, e).headline,
                             document.curvatures->beta[e] > 0 ? "convex 90°" : "concave 90°"));
      }
    EXPECT_EQ(sharp, 40) << method;
  }
}

TEST(ExplainEdge, TheBorderAndStepsThatWereNotRunAreNamed) {
  const Document plain = document_of(noisy_plane(6.0, 1.0, 0.0, 0.0, 1));
  EXPECT_TRUE(contains(explain_edge(plain, 0).headline, "not looked for yet"));
  EXPECT_TRUE(contains(explain_face(plain, 0).headline, "not looked for yet"));
  const Document found = applied(plain, {"find_sharp_lines", {}});
  for (EdgeId e = 0; e < found.mesh->edge_count(); ++e)
    EXPECT_EQ(contains(explain_edge(found, e).headline, "the scan ends"),
              found.mesh->is_border_edge(e));
  EXPECT_EQ(explain_edge(found, no_id).headline, "There is no such edge.");
  EXPECT_EQ(explain_face(found, no_id).headline, "There is no such face.");
  EXPECT_FALSE(explain_edge(Document{}, 0).holds);
  EXPECT_FALSE(explain_face(Document{}, 0).holds);
}

TEST(ExplainEdge, WhatACorrectionTookAwayIsSaidToBeSo) {
  Document document = with_lines(document_of(divided_cube(10.0, 4)), "walk");
  EdgeId taken = 0;
  while (!document.lines.is_sharp(taken)) ++taken;
  std::vector<Origin> edges(document.mesh->edge_count());
  for (EdgeId e = 0; e < edges.size(); ++e) edges[e] = document.lines.edges[e];
  edges[taken] = Origin::none;
  EdgeId drawn = 0;
  while (edges[drawn] != Origin::none || degrees(document, drawn) > 1.0) ++drawn;
  edges[drawn] = Origin::drawn;
  document.lines =
      relink_lines(*document.mesh, *document.curvatures, edges, document.lines, document.next_id);
  EXPECT_TRUE(contains(explain_edge(document, taken).headline, "correction took it away"));
  const Explanation explanation = explain_edge(document, drawn);
  EXPECT_TRUE(contains(explanation.headline, "drawn by hand"));
  EXPECT_FALSE(find_test(explanation, "|IHe|")->passed);
}

TEST(Explain, AgreesWithTheDocumentOnEveryEdgeAndFaceOfTheSampleMould) {
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Document document = segmented_mould(method);
    ASSERT_FALSE(document.lines.lines.empty());
    ASSERT_FALSE(document.partitions.partitions.empty());
    expect_agreement(document);
  }
}

TEST(Explain, AgreesAfterStepsThatChangedTheMesh) {
  for (const char* method : methods) {
    SCOPED_TRACE(method);
    const Document document = segmented_mould(method);
    expect_agreement(applied(document, {"equilateralize", {}}));
    expect_agreement(applied(document, {"simplify", {}}));
  }
}

TEST(ExplainEdge, NamesTheTreatmentThatTookAnEdge) {
  const Document document = segmented_mould("walk");
  const Mesh& mesh = *document.mesh;
  const nlohmann::json& parameters = document.step("find_sharp_lines")->parameters;
  SharpLineOptions options;
  options.angle = parameters.at("angle");
  options.candidates = parameters.at("candidates");
  const std::vector<Origin> found = identify_sharp_edges(mesh, *document.curvatures, options);
  std::vector<Origin> without_parallel = found;
  remove_parallel_lines(mesh, *document.curvatures, parameters.at("parallel_distance"),
                        without_parallel);
  int parallel = 0, short_ones = 0;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const Explanation explanation = explain_edge(document, e);
    const bool taken = found[e] != Origin::none && !explanation.holds;
    EXPECT_EQ(contains(explanation.headline, "it was found, but"), taken) << explanation.headline;
    if (!taken) continue;
    const bool was_parallel = without_parallel[e] == Origin::none;
    EXPECT_EQ(contains(explanation.headline, "doubled"), was_parallel);
    EXPECT_EQ(contains(explanation.headline, "shorter than min_length"), !was_parallel);
    ++(was_parallel ? parallel : short_ones);
  }
  EXPECT_GT(parallel, 0);
  EXPECT_GT(short_ones, 0);
}

TEST(ExplainFace, NamesTheVertexThatFailsAndByHowMuch) {
  // The caps have Kabs 0, the wall 1/100.
  Document document =
      applied(document_of(capped_cylinder(10.0, 20.0, 48, 12, 6)), {"find_sharp_lines", {}});
  document = applied(
      document,
      {"find_partitions", {{"intervals", {{0.0, 0.004}}}, {"fill_holes", 0}, {"min_faces", 1}}});
  int outside = 0;
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const Explanation explanation = explain_face(document, f);
    if (explanation.holds) {
      EXPECT_TRUE(contains(explanation.headline, "Kabs lies in the interval 0 to 0.004"))
          << explanation.headline;
      continue;
    }
    ++outside;
    const ExplainedTest* failed = nullptr;
    for (const ExplainedTest& test : explanation.tests)
      if (test.name.starts_with("Kabs") && !test.passed) failed = &test;
    ASSERT_NE(failed, nullptr) << explanation.headline;
    EXPECT_NEAR(failed->value, 0.01, 5e-4);
    EXPECT_EQ(failed->threshold, 0.004);
    EXPECT_TRUE(contains(explanation.headline, " over 0 to 0.004")) << explanation.headline;
  }
  EXPECT_EQ(outside, 48 * 12 * 2) << "the wall";
}

TEST(ExplainFace, NamesSharpLinesAsWhatStopsTheFront) {
  Document document = applied(document_of(divided_cube(10.0, 4)), {"find_sharp_lines", {}});
  document = applied(document, {"find_partitions", {}});
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const Explanation explanation = explain_face(document, f);
    int stops = 0, sharp = 0;
    HalfEdgeId h = document.mesh->face_half_edge(f);
    for (int k = 0; k < 3; ++k, h = document.mesh->next(h))
      sharp += document.lines.is_sharp(h >> 1);
    for (const ExplainedTest& test : explanation.tests)
      stops += test.name.starts_with("Side ") && contains(test.sentence, "stops every front");
    EXPECT_EQ(stops, sharp);
  }
}

TEST(ExplainFace, TooFewFacesForAPartition) {
  Document document = applied(document_of(divided_cube(10.0, 4)), {"find_sharp_lines", {}});
  document = applied(
      document,
      {"find_partitions", {{"intervals", {{0.0, 1.0}}}, {"fill_holes", 0}, {"min_faces", 33}}});
  ASSERT_TRUE(document.partitions.partitions.empty()) << "each side has 32 faces";
  int told = 0;
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const Explanation explanation = explain_face(document, f);
    EXPECT_FALSE(explanation.holds);
    if (find_test(explanation, "Regular vertices")->passed) {
      ++told;
      EXPECT_TRUE(contains(explanation.headline, "fewer than the 33")) << explanation.headline;
    }
  }
  EXPECT_GT(told, 0);
}

TEST(ExplainFace, BySurfacesItIsTheSurfaceAndWhatLiesBesideTheFace) {
  const Document document = segmented_mould("normal_jump");
  for (FaceId f = 0; f < document.mesh->face_count(); f += 7) {
    const Explanation explanation = explain_face(document, f);
    EXPECT_TRUE(explanation.holds);
    EXPECT_TRUE(contains(explanation.headline, "one surface explains")) << explanation.headline;
    EXPECT_EQ(explanation.tests.size(), 3u) << "its sides";
  }
}

TEST(ExplainFace, JoinedWithoutAVoteAndFilledHolesAreToldApart) {
  const Document document = segmented_mould("walk");
  int joined = 0, filled = 0;
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const Explanation explanation = explain_face(document, f);
    if (!explanation.holds) continue;
    const bool vote = find_test(explanation, "Regular vertices")->passed;
    const bool says_joined = contains(explanation.headline, "joined without a vote");
    const bool says_filled = contains(explanation.headline, "filled as part of a hole");
    EXPECT_FALSE(says_joined && vote);
    joined += says_joined;
    filled += says_filled;
    if (!vote || says_filled) continue;
    for (const ExplainedTest& test : explanation.tests)
      EXPECT_TRUE(test.passed || !test.name.starts_with("Kabs")) << test.sentence;
  }
  EXPECT_GT(joined, 0);
  EXPECT_GT(filled, 0);
}

}  // namespace
}  // namespace arris
