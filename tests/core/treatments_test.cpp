// The interactive treatments (sections 6.3.2 and 7.2) as operations on documents, and how they
// survive finding again.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>

#include "core/base/random.h"
#include "core/document/history.h"
#include "core/document/journal.h"
#include "core/mesh/chains.h"
#include "core/mesh/geometry.h"
#include "core/partitions/interactive_treatments.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using nlohmann::json;
using testing::applied;
using testing::cube_document;
using testing::document_of;

/// A plate with a straight step line along y at x = 0 whose angle falls off towards the ends.
Document roof_document(double angle = 0.8) {
  const Document document = document_of(testing::roof(angle, 5.0, 20.0, 1.0));
  return applied(document, {"find_sharp_lines", {{"angle", 20.0}, {"min_length", 0.0}}});
}

std::vector<EdgeId> sharp_set(const Document& document) {
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < document.lines.edges.size(); ++e)
    if (document.lines.is_sharp(e)) edges.push_back(e);
  return edges;
}

std::vector<std::vector<VertexId>> sorted_paths(const std::vector<LinePtr>& lines) {
  std::vector<std::vector<VertexId>> paths;
  for (const LinePtr& line : lines) paths.push_back(line->vertices);
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// What must hold of every document (method.md 5 and 6).
void expect_invariants(const Document& document) {
  const Mesh& mesh = *document.mesh;
  // Lines are the chains of the sharp edges, each once.
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  for (EdgeId e = 0; e < document.lines.edges.size(); ++e) edges[e] = document.lines.edges[e];
  std::vector<std::vector<VertexId>> derived;
  for (const Line& line : derive_lines(mesh, *document.curvatures, edges, document.lines.cuts))
    derived.push_back(line.vertices);
  std::sort(derived.begin(), derived.end());
  ASSERT_EQ(sorted_paths(document.lines.lines), derived);
  std::set<std::uint32_t> ids;
  for (const LinePtr& line : document.lines.lines) {
    ASSERT_TRUE(ids.insert(line->id).second);
    ASSERT_LT(line->id, document.next_id);
  }
  // Boundaries carried on by edits are those derived from scratch.
  const Boundaries fresh =
      derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions);
  ASSERT_EQ(document.boundaries->size(), fresh.size());
  for (std::size_t k = 0; k < fresh.size(); ++k)
    ASSERT_TRUE(*(*document.boundaries)[k] == *fresh[k])
        << "boundary " << k << " " << name_of(fresh[k]->type) << " line " << fresh[k]->line << " "
        << (*document.boundaries)[k]->line;
  // Partitions are edge-connected and disjoint, and know their faces, area and anchor.
  if (document.partitions.labels.empty()) return;
  std::map<std::uint32_t, std::pair<std::uint32_t, double>> counted;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (const std::uint32_t id = document.partitions.labels[f]; id != 0) {
      ++counted[id].first;
      counted[id].second += face_area(mesh, f);
    }
  ASSERT_EQ(counted.size(), document.partitions.partitions.size());
  for (const PartitionPtr& partition : document.partitions.partitions) {
    ASSERT_TRUE(ids.insert(partition->id).second);
    ASSERT_LT(partition->id, document.next_id);
    ASSERT_EQ(partition->faces, counted[partition->id].first);
    ASSERT_NEAR(partition->area, counted[partition->id].second, 1e-6 * partition->area + 1e-9);
    const auto anchor = mesh.find_face(partition->anchor);
    ASSERT_TRUE(anchor.has_value());
    ASSERT_EQ(document.partitions.labels[*anchor], partition->id);
    ASSERT_EQ(faces_of(mesh, document.partitions, *partition).size(), partition->faces);
  }
}

std::uint32_t longest_line(const Document& document) {
  const auto longest =
      std::max_element(document.lines.lines.begin(), document.lines.lines.end(),
                       [](const LinePtr& a, const LinePtr& b) { return a->length < b->length; });
  return (*longest)->id;
}

// ---- lines ----

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

// ---- partitions ----

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
  const Document back = applied(again, {"find_partitions", extended.find_partitions->parameters});
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
  for (const PartitionPtr& partition : document.partitions.partitions) {
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
  EXPECT_FALSE(closed.find_partitions->out_of_date);
  expect_invariants(closed);
  for (const PartitionPtr& partition : closed.partitions.partitions)
    EXPECT_NEAR(partition->area, 100.0, 1e-9);
  // Several lines are one operation, and finding again gives the same sides.
  const std::vector<VertexId> other(rest.begin() + 2, rest.end());
  const Document both = applied(document, {"draw_line", {{"paths", {half, other}}}});
  EXPECT_EQ(both.partitions.labels, closed.partitions.labels);
  EXPECT_EQ(both.corrections.size(), document.corrections.size() + 1);
  const Document again = applied(both, {"find_partitions", both.find_partitions->parameters});
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

// ---- locks and corrections ----

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

// ---- random edits ----

/// A random operation on what the document holds; it may be refused.
class RandomEdits {
 public:
  explicit RandomEdits(std::uint64_t seed) : random_(seed) {}

  Operation next(const Document& document) {
    const Mesh& mesh = *document.mesh;
    const auto line = [&]() -> const Line& { return *pick(document.lines.lines); };
    const auto partition = [&]() -> const Partition& {
      return *pick(document.partitions.partitions);
    };
    const double edge = mesh.mean_edge_length();
    const auto region = [&] {
      json stroke = json::array();
      VertexId v = vertex(mesh);
      for (int k = 0; k < 4; ++k) {
        stroke.push_back(v);
        v = step_from(mesh, v, 2);
      }
      return json{{"vertices", stroke}, {"radius", edge * random_.uniform(1.0, 6.0)}};
    };
    const double highest =
        document.find_partitions ? random_.uniform(0.0, 2.0) * middle_value(document) : 1.0;
    const bool has_lines = !document.lines.lines.empty();
    const bool has_partitions = !document.partitions.partitions.empty();
    for (;;) {
      const std::uint64_t kind = random_.bits() % 27;
      if (kind < 8 && kind != 4 && kind != 5 && !has_lines) continue;
      if (kind >= 10 && kind < 20 && !has_partitions) continue;
      switch (kind) {
        case 0:
          return {"delete_lines", {{"lines", {line().id}}}};
        case 1:
          return {"extend_line", {{"line", line().id}, {"angle", random_.uniform(5.0, 60.0)}}};
        case 2: {
          const Line& l = line();
          return {"trim_line",
                  {{"line", l.id},
                   {"vertex", l.vertices[random_.bits() % l.vertices.size()]},
                   {"side", random_.bits() % 2 ? "first" : "last"}}};
        }
        case 3: {
          const Line& l = line();
          return {"split_line",
                  {{"line", l.id}, {"vertex", l.vertices[random_.bits() % l.vertices.size()]}}};
        }
        case 4: {
          const VertexId from = vertex(mesh);
          return {"draw_line", {{"vertices", {from, step_from(mesh, from, 12)}}}};
        }
        case 5:
          return {"recompute_lines", {{"region", region()}, {"angle", random_.uniform(5.0, 60.0)}}};
        case 6:
          return {"merge_lines", {{"a", line().id}, {"b", line().id}}};
        case 7: {
          const Line& l = line();
          const std::size_t n = l.vertices.size();
          const std::size_t a = random_.bits() % n, b = random_.bits() % n;
          return {"reroute_line",
                  {{"line", l.id},
                   {"from", l.vertices[std::min(a, b)]},
                   {"to", l.vertices[std::max(a, b)]},
                   {"via", step_from(mesh, l.vertices[a], 3)}}};
        }
        case 8:
          return {"find_sharp_lines", {{"angle", random_.uniform(15.0, 60.0)}}};
        case 9:
          return {"find_partitions", json::object()};
        case 10:
        case 11: {
          const Boundary& b = *pick(*document.boundaries);
          return {"connect_partitions",
                  {{"partitions", {b.left, b.right}},
                   {"lines", random_.bits() % 2 ? "keep" : "remove"}}};
        }
        case 12:
          return {"extend_partition",
                  {{"partition", partition().id}, {"interval", {0.0, highest + 1e-12}}}};
        case 13:
          return {"remove_partitions", {{"partitions", {partition().id}}}};
        case 14:
          return {"remove_small_partitions", {{"faces", 2 + random_.bits() % 20}}};
        case 15:
          return {"restart_partitions",
                  {{"partitions", {partition().id}}, {"interval", {0.0, highest + 1e-12}}}};
        case 16:
          return {"recompute_partitions",
                  {{"region", region()}, {"interval", {0.0, highest + 1e-12}}}};
        case 17:
        case 18:
          return {
              "paint_partition",
              {{"partition", random_.bits() % 3 == 0 ? 0u : partition().id}, {"region", region()}}};
        case 19: {
          const VertexId from = vertex(mesh);
          return {"split_partition",
                  {{"partition", partition().id}, {"vertices", {from, step_from(mesh, from, 20)}}}};
        }
        case 20:
          if (!has_partitions) continue;
          return {"smooth_boundaries", {{"rounds", 3}}};
        case 21:
          if (!has_lines) continue;
          return {"lock", {{"lines", {line().id}}, {"locked", random_.bits() % 4 == 0}}};
        case 22:
          if (!has_partitions) continue;
          return {"lock", {{"partitions", {partition().id}}, {"locked", random_.bits() % 4 == 0}}};
        case 23:
          if (document.corrections.empty()) continue;
          return {"lift_correction", {{"correction", pick(document.corrections)->id}}};
        case 24:
          if (!has_partitions) continue;
          return {"split_to_four_sides",
                  random_.bits() % 8 ? json{{"partitions", {partition().id}}} : json::object()};
        default:
          return {random_.bits() % 3 == 0 ? "undo" : "redo", json::object()};
      }
    }
  }

 private:
  template <class T>
  const T& pick(const std::vector<T>& from) {
    return from[random_.bits() % from.size()];
  }
  VertexId vertex(const Mesh& mesh) {
    for (;;) {
      const auto v = static_cast<VertexId>(random_.bits() % mesh.vertex_count());
      if (!mesh.is_isolated(v)) return v;
    }
  }
  VertexId step_from(const Mesh& mesh, VertexId v, int steps) {
    for (int k = 0; k < steps; ++k) {
      std::vector<VertexId> ring;
      mesh.for_ring(v, [&](HalfEdgeId h) { ring.push_back(mesh.to(h)); });
      v = pick(ring);
    }
    return v;
  }
  static double middle_value(const Document& document) {
    const Partition& p = *document.partitions.partitions.front();
    return std::isfinite(p.interval.max) ? p.interval.max : p.interval.min + 1.0;
  }

  Random random_;
};

void expect_replays(const History& history, const std::string& file) {
  const testing::TempFolder folder;
  const auto replayed = replay(folder.write("operations.jsonl", journal_text(history)), {file});
  ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
  ASSERT_EQ(hash_of(replayed->history.current()), hash_of(history.current()));
  ASSERT_TRUE(replayed->warnings.empty());
}

/// `count` random edits with undo and redo in between. After each: the invariants hold, a second
/// document fed the same operation through JSON is equal; at one random point and at the end a full
/// replay is.
void run_random_edits(const std::string& file, int count, std::uint64_t seed) {
  RandomEdits edits(seed);
  History history;
  if (const auto done = history.run({"open", {{"file", file}}}); !done)
    FAIL() << done.error().message;
  ASSERT_TRUE(history.run({"find_sharp_lines", {{"angle", 30.0}}}).has_value());
  ASSERT_TRUE(history.run({"find_partitions", json::object()}).has_value());
  int performed = 0, refused = 0;
  const auto replayed_at =
      static_cast<int>(Random(seed).bits() % static_cast<std::uint64_t>(count));
  for (int k = 0; k < count; ++k) {
    if (k == replayed_at) {
      expect_replays(history, file);
      if (::testing::Test::HasFatalFailure()) return;
    }
    const Operation operation = edits.next(history.current());
    if (operation.name == "undo" || operation.name == "redo") {
      if (operation.name == "undo" && history.head() > 3) {
        const std::uint32_t parent = history.entries()[history.head() - 1].parent;
        ASSERT_TRUE(history.undo().has_value());
        ASSERT_EQ(hash_of(history.current()), history.entries()[parent - 1].hash);
      } else if (operation.name == "redo" && history.can_redo()) {
        ASSERT_TRUE(history.redo().has_value());
        ASSERT_EQ(hash_of(history.current()), history.entries()[history.head() - 1].hash);
      }
      continue;
    }
    const Document before = history.current();
    const std::string hash = hash_of(before);
    const auto done = history.run(operation);
    if (!done) {
      ++refused;
      ASSERT_FALSE(done.error().message.empty());
      ASSERT_EQ(hash_of(history.current()), hash) << operation.text();
      continue;
    }
    ++performed;
    // The same through JSON, on the document before.
    const auto parsed = Operation::parse(history.entries().back().operation.text());
    ASSERT_TRUE(parsed.has_value());
    const Result<Document> second = apply(before, *parsed);
    ASSERT_TRUE(second.has_value()) << second.error().message << " " << operation.text();
    ASSERT_EQ(hash_of(*second), history.entries().back().hash) << operation.text();
    expect_invariants(history.current());
    if (::testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << "edit " << k << ": " << operation.text();
      return;
    }
  }
  expect_replays(history, file);
  EXPECT_GT(performed, refused);
}

TEST(RandomTreatments, KeepTheInvariantsOnTheSampleMould) {
  const testing::TempFolder folder;
  const std::string file = testing::write_mesh(folder, "mould.ply", testing::sample_mould(4.0));
  run_random_edits(file, 400, 1);
}

/// Sessions as long as a user's, one after the other: 20 of 500 edits.
class RandomTreatmentsOnARealMesh : public ::testing::TestWithParam<int> {};

TEST_P(RandomTreatmentsOnARealMesh, KeepTheInvariants) {
  const std::filesystem::path file =
      std::filesystem::path(ARRIS_SOURCE_DIR) / "../shared/data/pairs/block_n1.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no ../shared/data";
  run_random_edits(file.string(), 500, static_cast<std::uint64_t>(100 + GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Sessions, RandomTreatmentsOnARealMesh, ::testing::Range(0, 20));

TEST(ThousandEdits, OfAMillionFacesCostLessThan200Megabytes) {
  const testing::TempFolder folder;
  const std::string file =
      testing::write_mesh(folder, "cube.ply", testing::divided_cube(100.0, 290));
  History history;
  const auto run = [&](const Operation& operation) { return history.run(operation).has_value(); };
  ASSERT_TRUE(run({"open", {{"file", file}}}));
  ASSERT_TRUE(run({"find_sharp_lines", {{"angle", 30.0}}}));
  ASSERT_TRUE(run({"find_partitions", {{"intervals", {{0.0, 1.0}}}}}));
  ASSERT_GT(history.current().mesh->face_count(), 1000000u);
  const std::size_t before = history.bytes();
  RandomEdits edits(9);
  int performed = 0;
  for (int k = 0; k < 10000 && performed < 1000; ++k) {
    const Operation operation = edits.next(history.current());
    // The edits of a hand; what is found again is paid for by the finding.
    if (operation.name.starts_with("find_") || operation.name == "undo" ||
        operation.name == "redo" || operation.name == "lift_correction" ||
        operation.name == "connect_partitions" || operation.name == "restart_partitions" ||
        operation.name == "remove_partitions")
      continue;
    performed += run(operation);
  }
  ASSERT_EQ(performed, 1000);
  EXPECT_LT(history.bytes() - before, 200u << 20);
  expect_invariants(history.current());
  const std::string hash = hash_of(history.current());
  for (int k = 0; k < performed; ++k) ASSERT_TRUE(history.undo().has_value());
  for (int k = 0; k < performed; ++k) ASSERT_TRUE(history.redo().has_value());
  EXPECT_EQ(hash_of(history.current()), hash);
}

}  // namespace
}  // namespace arris
