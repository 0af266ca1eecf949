// The interactive treatments of partitions (section 7.2) as operations on documents, and the
// boundaries between them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/base/random.h"
#include "core/document/history.h"
#include "core/mesh/chains.h"
#include "tests/core/treatments_fixture.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using nlohmann::json;
using testing::applied;
using testing::cube_document;
using testing::document_of;
using testing::expect_invariants;

TEST(ConnectPartitions, TakesTheCommonLineAwayOrKeepsIt) {
  const Document document = cube_document();
  ASSERT_EQ(document.partitions.partitions.size(), 6u);
  ASSERT_EQ(document.boundaries->size(), 12u);
  const Boundary& edge = *(*document.boundaries)[0];
  const json both = {edge.left, edge.right};
  const Document kept = applied(document, {"connect_partitions", {{"partitions", both}}});
  EXPECT_EQ(kept.partitions.partitions.size(), 5u);
  EXPECT_EQ(kept.boundaries->size(), 12u);
  expect_invariants(kept);
  const Document removed =
      applied(document, {"connect_partitions", {{"partitions", both}, {"lines", "remove"}}});
  EXPECT_EQ(removed.partitions.partitions.size(), 5u);
  EXPECT_EQ(removed.lines.lines.size(), 9u);  // at both its corners two lines are one now
  expect_invariants(removed);
  // Found again, both corrections hold.
  Document again = applied(removed, {"find_sharp_lines", {{"angle", 30.0}, {"min_length", 0.0}}});
  EXPECT_EQ(again.lines.lines.size(), 9u);
  again = applied(again, {"find_partitions",
                          {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}, {"fill_holes", 200}}});
  EXPECT_EQ(again.partitions.partitions.size(), 5u);
  expect_invariants(again);
}

TEST(ConnectPartitions, RefusesThoseThatAreApart) {
  const Document document = cube_document();
  std::set<std::uint32_t> beside;
  const std::uint32_t first = document.partitions.partitions[0]->id;
  for (const BoundaryPtr& b : *document.boundaries) {
    if (b->left == first) beside.insert(b->right);
    if (b->right == first) beside.insert(b->left);
  }
  for (const PartitionPtr& partition : document.partitions.partitions)
    if (partition->id != first && !beside.contains(partition->id)) {
      const auto result =
          apply(document, {"connect_partitions", {{"partitions", {first, partition->id}}}});
      ASSERT_FALSE(result.has_value());
      EXPECT_NE(result.error().message.find("common boundary"), std::string::npos);
      return;
    }
  FAIL() << "a cube has opposite sides";
}

TEST(ExtendPartition, IsPointlessWithoutAnUndefinedBoundary) {
  const Document document = cube_document();
  const auto result = apply(
      document, {"extend_partition",
                 {{"partition", document.partitions.partitions[0]->id}, {"interval", {0.0, 9.0}}}});
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().message.find("undefined boundary"), std::string::npos);
}

TEST(ExtendPartition, GrowsIntoUnassignedFacesOnly) {
  // A bump on a plane: the plane is found, the bump is not until the partition is extended.
  const auto place = [](double x, double y) {
    const double r2 = (x - 15.0) * (x - 15.0) + (y - 15.0) * (y - 15.0);
    return Point(x, y, 3.0 * std::exp(-r2 / 20.0));
  };
  Document document = document_of(testing::shaped_lattice(30.0, 1.0, place));
  document = applied(
      document,
      {"find_partitions", {{"intervals", {{0.0, 1e-3}}}, {"min_faces", 10}, {"fill_holes", 0}}});
  ASSERT_GE(document.partitions.partitions.size(), 1u);
  const PartitionPtr plane = *std::max_element(
      document.partitions.partitions.begin(), document.partitions.partitions.end(),
      [](const auto& a, const auto& b) { return a->area < b->area; });
  std::uint32_t before = plane->faces;
  for (const double max : {5e-3, 5e-2, 1.0}) {
    const Document extended = applied(
        document, {"extend_partition", {{"partition", plane->id}, {"interval", {0.0, max}}}});
    EXPECT_GE(extended.partitions.find(plane->id)->faces, before) << max;
    before = extended.partitions.find(plane->id)->faces;
    expect_invariants(extended);
    for (FaceId f = 0; f < document.mesh->face_count(); ++f)
      if (document.partitions.labels[f] != 0) {
        ASSERT_EQ(extended.partitions.labels[f], document.partitions.labels[f]);
      }
  }
  EXPECT_GT(before, plane->faces);
}

/// A plane with bumps of which each is left unassigned until it is filled or extended into.
Document bumpy_document(const std::vector<Point>& bumps) {
  const auto place = [&](double x, double y) {
    double z = 0.0;
    for (const Point& bump : bumps) {
      const double r2 = (x - bump.x()) * (x - bump.x()) + (y - bump.y()) * (y - bump.y());
      z += 3.0 * std::exp(-r2 / 20.0);
    }
    return Point(x, y, z);
  };
  return applied(
      document_of(testing::shaped_lattice(40.0, 1.0, place)),
      {"find_partitions", {{"intervals", {{0.0, 1e-3}}}, {"min_faces", 10}, {"fill_holes", 0}}});
}

PartitionPtr largest_of(const Document& document) {
  return *std::max_element(document.partitions.partitions.begin(),
                           document.partitions.partitions.end(),
                           [](const auto& a, const auto& b) { return a->area < b->area; });
}

TEST(ExtendPartition, MadeForALittleIsNotDoneAgainWhereItWouldFlood) {
  const Document document = bumpy_document({Point(15.0, 15.0, 0.0)});
  const PartitionPtr plane = largest_of(document);
  Document extended = applied(
      document, {"extend_partition", {{"partition", plane->id}, {"interval", {0.0, 5e-3}}}});
  const double meant = extended.partitions.find(plane->id)->area - plane->area;
  ASSERT_GT(meant, 0.0);
  const json& stored = extended.corrections.back()->operation.parameters;
  ASSERT_TRUE(stored.at("areas").is_array());
  EXPECT_NEAR(stored.at("areas")[0].get<double>(), meant, 1e-9);
  // Found again under an interval that leaves most of the plane to it.
  const Document again = applied(
      extended,
      {"find_partitions", {{"intervals", {{0.0, 1e-9}}}, {"min_faces", 10}, {"fill_holes", 0}}});
  const Correction& correction = *again.corrections.back();
  EXPECT_NE(correction.state, CorrectionState::applied);
  EXPECT_FALSE(correction.message.empty());
  // Found as before it is what it was.
  const Document back =
      applied(again, {"find_partitions", extended.step("find_partitions")->parameters});
  EXPECT_EQ(back.corrections.back()->state, CorrectionState::applied)
      << back.corrections.back()->message;
  expect_invariants(back);
}

TEST(ExtendPartition, TakesSeveralAtOnce) {
  // Both sides of a roof, each with a bump of its own.
  Document document = document_of(testing::roof(0.8, 10.0, 30.0, 1.0));
  document = applied(document, {"find_sharp_lines", {{"angle", 20.0}, {"min_length", 0.0}}});
  document =
      applied(document, {"find_partitions", {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}}});
  ASSERT_EQ(document.partitions.partitions.size(), 2u);
  std::vector<std::uint32_t> ids;
  const std::vector<PartitionPtr> sides = document.partitions.partitions;
  for (const PartitionPtr& partition : sides) {
    ids.push_back(partition->id);
    const Mesh& mesh = *document.mesh;
    const std::vector<FaceId> faces = faces_of(mesh, document.partitions, *partition);
    const VertexId inside = mesh.triangle(faces[faces.size() / 2])[0];
    document = applied(
        document, {"paint_partition",
                   {{"partition", 0u}, {"region", {{"vertices", {inside}}, {"radius", 1.2}}}}});
  }
  ASSERT_LT(assigned_share(document), 0.999);
  const Document extended =
      applied(document, {"extend_partition", {{"partitions", ids}, {"interval", {0.0, 1.0}}}});
  EXPECT_NEAR(assigned_share(extended), 1.0, 1e-9);
  EXPECT_EQ(extended.partitions.partitions.size(), 2u);
  expect_invariants(extended);
}

TEST(FillUnassigned, GivesEachAreaToTheNeighbourItBelongsTo) {
  Document document = cube_document();
  const Mesh& mesh = *document.mesh;
  const PartitionPtr side = document.partitions.partitions[0];
  const std::vector<FaceId> faces = faces_of(mesh, document.partitions, *side);
  const VertexId inside = mesh.triangle(faces[faces.size() / 2])[0];
  const Document holed = applied(
      document, {"paint_partition",
                 {{"partition", 0u}, {"region", {{"vertices", {inside}}, {"radius", 1.2}}}}});
  ASSERT_LT(assigned_share(holed), 1.0);
  const Document filled = applied(holed, {"fill_unassigned", json::object()});
  EXPECT_NEAR(assigned_share(filled), 1.0, 1e-12);
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    EXPECT_EQ(filled.partitions.label(f), document.partitions.label(f));
  expect_invariants(filled);
  // An area as large as a whole side stays where only smaller ones are asked for, and where lines
  // enclose it altogether.
  const Document bare = applied(document, {"remove_partitions", {{"partitions", {side->id}}}});
  EXPECT_EQ(applied(bare, {"fill_unassigned", {{"faces", 5}}}).partitions.partitions.size(), 5u);
  const Document kept = applied(bare, {"fill_unassigned", json::object()});
  EXPECT_LT(assigned_share(kept), 0.9);
  EXPECT_NE(kept.corrections.back()->message.find("sharp lines"), std::string::npos);
  EXPECT_TRUE(apply(document, {"fill_unassigned", json::object()}).error().nothing_to_do);
}

TEST(RemoveSmall, CanLeaveWhatItTakesToTheNeighbours) {
  const Document document = cube_document();
  const Mesh& mesh = *document.mesh;
  const PartitionPtr side = document.partitions.partitions[0];
  // A small piece cut off the side.
  const std::vector<FaceId> faces = faces_of(mesh, document.partitions, *side);
  const VertexId inside = mesh.triangle(faces[faces.size() / 2])[0];
  Document parted =
      applied(document,
              {"recompute_partitions",
               {{"region", {{"vertices", {inside}}, {"radius", 1.2}}}, {"interval", {0.0, 1.0}}}});
  ASSERT_GT(parted.partitions.partitions.size(), 6u);
  const json holes{{"faces", 60}}, filled{{"faces", 60}, {"fill", true}};
  EXPECT_LT(assigned_share(applied(parted, {"remove_small_partitions", holes})), 1.0);
  const Document whole = applied(parted, {"remove_small_partitions", filled});
  EXPECT_NEAR(assigned_share(whole), 1.0, 1e-12);
  EXPECT_EQ(whole.partitions.partitions.size(), 6u);
  expect_invariants(whole);
}

TEST(DrawLine, PartsThePartitionsItRunsThroughAtOnce) {
  // Two sides of a cube run into one through a gap in the line between them.
  Document document = cube_document();
  const Line& line = *document.lines.lines.front();
  const std::vector<VertexId> path = line.vertices;
  document = applied(document, {"delete_lines", {{"lines", {line.id}}}});
  document =
      applied(document,
              {"draw_line", {{"vertices", std::vector<VertexId>(path.begin(), path.begin() + 4)}}});
  document =
      applied(document, {"find_partitions", {{"intervals", {{0.0, 1e9}}}, {"min_faces", 1}}});
  ASSERT_EQ(document.partitions.partitions.size(), 5u);
  const std::vector<VertexId> rest(path.begin() + 3, path.end());
  // Not there yet: nothing is parted.
  const std::vector<VertexId> half(rest.begin(), rest.begin() + 3);
  EXPECT_EQ(applied(document, {"draw_line", {{"vertices", half}}}).partitions.partitions.size(),
            5u);
  const Document closed = applied(document, {"draw_line", {{"vertices", rest}}});
  EXPECT_EQ(closed.partitions.partitions.size(), 6u);
  EXPECT_FALSE(closed.step("find_partitions")->out_of_date);
  expect_invariants(closed);
  for (const PartitionPtr& partition : closed.partitions.partitions)
    EXPECT_NEAR(partition->area, 100.0, 1e-9);
  // Several lines are one operation, and finding again gives the same sides.
  const std::vector<VertexId> other(rest.begin() + 2, rest.end());
  const Document both = applied(document, {"draw_line", {{"paths", {half, other}}}});
  EXPECT_EQ(both.partitions.labels, closed.partitions.labels);
  EXPECT_EQ(both.corrections.size(), document.corrections.size() + 1);
  const Document again =
      applied(both, {"find_partitions", both.step("find_partitions")->parameters});
  EXPECT_EQ(again.partitions.partitions.size(), 6u);
}

TEST(Words, OfTheHistoryTellWhatAndHowMany) {
  const auto said = [](const char* name, const json& parameters) {
    return describe({name, parameters});
  };
  std::vector<std::uint32_t> many(24);
  std::iota(many.begin(), many.end(), 1u);
  EXPECT_EQ(said("delete_lines", {{"lines", {3u}}}), "Delete line 3");
  EXPECT_EQ(said("delete_lines", {{"lines", {3u, 4u}}}), "Delete lines 3 and 4");
  EXPECT_EQ(said("delete_lines", {{"lines", many}}), "Delete 24 lines");
  EXPECT_EQ(said("extend_partition", {{"partition", 7u}, {"interval", {0.0, 0.23651}}}),
            "Extend partition 7, 0 to 0.237");
  EXPECT_EQ(said("find_partitions",
                 {{"criterion", "kabs"}, {"intervals", {{0.0, 0.236}, {0.236, nullptr}}}}),
            "Find partitions, Kabs 0 to 0.236, above 0.236");
  EXPECT_EQ(said("draw_line", {{"paths", {{1, 2}, {3, 4}}}}), "Draw 2 lines");
  EXPECT_EQ(said("remove_partitions", {{"partitions", many}}), "Remove 24 partitions");
  EXPECT_EQ(said("lock", {{"lines", {5u}}, {"locked", false}}), "Unlock line 5");
  EXPECT_EQ(said("remove_small_partitions", {{"faces", 20}, {"fill", true}}),
            "Give partitions under 20 faces to their neighbours");
  for (const OperationKind& kind : operation_table()) {
    const std::string text = said(std::string(kind.name).c_str(), json::object());
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find('_'), std::string::npos) << text;
  }
}

TEST(SplitPartition, SaysInPlainWordsWhichPointIsElsewhere) {
  const Document document = cube_document();
  const Mesh& mesh = *document.mesh;
  const auto inside = [&](std::size_t side) {
    const std::vector<FaceId> faces =
        faces_of(mesh, document.partitions, *document.partitions.partitions[side]);
    return mesh.triangle(faces[faces.size() / 2])[0];
  };
  const auto refused = apply(document, {"split_partition",
                                        {{"partition", document.partitions.partitions[0]->id},
                                         {"vertices", {inside(0), inside(1)}}}});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("The second point is on another partition"),
            std::string::npos)
      << refused.error().message;
}

TEST(SplitAndPaint, PartAPartitionAndTakeItsFaces) {
  const Document document = cube_document();
  const Mesh& mesh = *document.mesh;
  const PartitionPtr side = document.partitions.partitions[0];
  // A path across the middle of that side: between two points of opposite borders.
  std::vector<VertexId> corners;
  for (const FaceId f : faces_of(mesh, document.partitions, *side))
    for (const VertexId v : mesh.triangle(f)) corners.push_back(v);
  Eigen::AlignedBox3d box;
  for (const VertexId v : corners) box.extend(mesh.point(v));
  int flat = 0;
  box.sizes().minCoeff(&flat);
  const int a = (flat + 1) % 3, b = (flat + 2) % 3;
  Point from = box.center(), to = box.center();
  from[a] = box.min()[a];
  to[a] = box.max()[a];
  const auto nearest = [&](const Point& p) {
    return *std::min_element(corners.begin(), corners.end(), [&](VertexId x, VertexId y) {
      return (mesh.point(x) - p).norm() < (mesh.point(y) - p).norm();
    });
  };
  const Document split = applied(
      document,
      {"split_partition", {{"partition", side->id}, {"vertices", {nearest(from), nearest(to)}}}});
  EXPECT_EQ(split.partitions.partitions.size(), 7u);
  expect_invariants(split);
  const double whole = side->area;
  EXPECT_NEAR(split.partitions.find(side->id)->area, 0.5 * whole, 0.1 * whole);

  // Painted over, the other half loses what the brush covers; it stops at the sharp lines.
  Point centre = box.center();
  centre[b] = 0.75 * box.min()[b] + 0.25 * box.max()[b];
  const Document painted = applied(
      split, {"paint_partition",
              {{"partition", 0}, {"region", {{"vertices", {nearest(centre)}}, {"radius", 2.2}}}}});
  expect_invariants(painted);
  EXPECT_LT(assigned_share(painted), assigned_share(split));
  const Document wide = applied(
      split,
      {"paint_partition",
       {{"partition", 0}, {"region", {{"vertices", {nearest(box.center())}}, {"radius", 100.0}}}}});
  EXPECT_NEAR(assigned_share(wide), 5.0 / 6.0, 0.02);
}

TEST(RemoveAndRestart, FreeAnAreaAndFindItAgain) {
  const Document document = cube_document();
  const std::uint32_t id = document.partitions.partitions[2]->id;
  Document removed = applied(document, {"remove_partitions", {{"partitions", {id}}}});
  EXPECT_EQ(removed.partitions.partitions.size(), 5u);
  expect_invariants(removed);
  removed = applied(removed, {"find_partitions",
                              {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}, {"fill_holes", 0}}});
  EXPECT_EQ(removed.partitions.partitions.size(), 5u);  // it stays removed
  const Document restarted =
      applied(document, {"restart_partitions", {{"partitions", {id}}, {"interval", {0.0, 0.5}}}});
  EXPECT_EQ(restarted.partitions.partitions.size(), 6u);
  expect_invariants(restarted);
  const auto none = apply(document, {"remove_small_partitions", {{"faces", 2}}});
  EXPECT_FALSE(none.has_value());
}

TEST(Boundaries, OfFigure30) {
  // A plate divided by a line that fades out: C0 where it is sharp, Gn where two partitions meet
  // without one, undefined where unassigned faces lie beyond, border where the scan ends.
  const auto place = [](double x, double y) {
    return Point(x, y, y < 15.0 ? -0.6 * std::abs(x - 15.0) : -0.6 * std::abs(x - 15.0));
  };
  Document document = document_of(testing::shaped_lattice(30.0, 1.0, place));
  document = applied(document, {"find_sharp_lines", {{"angle", 20.0}, {"min_length", 0.0}}});
  ASSERT_EQ(document.lines.lines.size(), 1u);
  document = applied(
      document,
      {"find_partitions", {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}, {"fill_holes", 0}}});
  ASSERT_EQ(document.partitions.partitions.size(), 2u);
  // Trim the line to its half: beyond it the two partitions meet at a Gn boundary.
  const Line line = *document.lines.lines[0];
  document = applied(
      document,
      {"trim_line",
       {{"line", line.id}, {"vertex", line.vertices[line.vertices.size() / 2]}, {"side", "last"}}});
  std::map<BoundaryType, int> types;
  for (const BoundaryPtr& b : *document.boundaries) ++types[b->type];
  EXPECT_EQ(types[BoundaryType::c0], 1);
  EXPECT_EQ(types[BoundaryType::gn], 1);  // the C0 that fades out and goes on as Gn is two
  EXPECT_EQ(types[BoundaryType::border], 2);
  EXPECT_EQ(types[BoundaryType::undefined], 0);
  // Take one away: what was Gn is undefined now, what was C0 stays C0.
  const Document open = applied(
      document, {"remove_partitions", {{"partitions", {document.partitions.partitions[1]->id}}}});
  types.clear();
  for (const BoundaryPtr& b : *open.boundaries) ++types[b->type];
  EXPECT_EQ(types[BoundaryType::c0], 1);
  EXPECT_EQ(types[BoundaryType::gn], 0);
  EXPECT_EQ(types[BoundaryType::undefined], 1);
  EXPECT_EQ(types[BoundaryType::border], 1);
  expect_invariants(open);
}

TEST(SmoothBoundaries, MakesThemShorterAndThenStops) {
  Document document = document_of(
      testing::shaped_lattice(30.0, 1.0, [](double x, double y) { return Point(x, y, 0.0); }));
  document = applied(
      document,
      {"find_partitions", {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}, {"fill_holes", 0}}});
  ASSERT_EQ(document.partitions.partitions.size(), 1u);
  const std::uint32_t plane = document.partitions.partitions[0]->id;
  // A ragged area in it: painted out, found again as a partition of its own.
  json stroke = json::array();
  Random random(5);
  for (int k = 0; k < 12; ++k)
    stroke.push_back(static_cast<VertexId>(random.uniform(300.0, 620.0)));
  document = applied(
      document, {"recompute_partitions",
                 {{"region", {{"vertices", stroke}, {"radius", 2.5}}}, {"interval", {0.0, 1.0}}}});
  ASSERT_GE(document.partitions.partitions.size(), 2u);
  expect_invariants(document);
  const auto gn_length = [](const Document& d) {
    double length = 0.0;
    for (const BoundaryPtr& b : *d.boundaries)
      if (b->type == BoundaryType::gn) length += b->length;
    return length;
  };
  const Document smooth = applied(document, {"smooth_boundaries", {{"rounds", 100}}});
  expect_invariants(smooth);
  EXPECT_LT(gn_length(smooth), gn_length(document));
  const Document again = applied(smooth, {"smooth_boundaries", {{"rounds", 100}}});
  EXPECT_EQ(again.partitions.labels, smooth.partitions.labels);
  EXPECT_NE(smooth.partitions.find(plane), nullptr);
}

}  // namespace
}  // namespace arris
