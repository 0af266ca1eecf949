#include "core/guidance/worklist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "core/base/thread_limit.h"
#include "core/guidance/line_ends.h"
#include "core/mesh/geometry.h"
#include "core/partitions/boundaries.h"
#include "core/sharp_lines/sharp_lines.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;

std::vector<WorkItem> items_of(const std::vector<WorkItem>& items, WorkKind kind) {
  std::vector<WorkItem> result;
  std::ranges::copy_if(items, std::back_inserter(result),
                       [&](const WorkItem& item) { return item.kind == kind; });
  return result;
}

Document segmented(const Document& document) {
  return applied(applied(document, {"find_sharp_lines", {}}), {"find_partitions", {}});
}

/// Segmented, and then some of its sharp edges taken away.
template <class Taken>
Document without(Document document, const Taken& is_taken) {
  std::vector<Origin> edges(document.mesh->edge_count());
  for (EdgeId e = 0; e < edges.size(); ++e)
    edges[e] = is_taken(e) ? Origin::none : document.lines.edges[e];
  document.lines =
      relink_lines(*document.mesh, *document.curvatures, edges, document.lines, document.next_id);
  return document;
}

TEST(Worklist, NothingIsLeftOnASegmentedBox) {
  EXPECT_TRUE(value_of(worklist(segmented(document_of(divided_cube(10.0, 8))))).empty());
}

TEST(Worklist, AnEmptyDocumentAndStepsNotRunLeaveNothing) {
  EXPECT_TRUE(value_of(worklist({})).empty());
  EXPECT_TRUE(value_of(worklist(document_of(divided_cube(10.0, 4)))).empty());
}

TEST(Worklist, TheBestWayOnAcrossAGapIsTheGap) {
  Document document = segmented(document_of(divided_cube(10.0, 10)));
  const Mesh& mesh = *document.mesh;
  document = without(document, [&](EdgeId e) {
    const Point middle = (mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0;
    return middle.y() == 0.0 && middle.z() == 0.0 && middle.x() > 3.0 && middle.x() < 6.0;
  });
  const auto ends = items_of(value_of(worklist(document)), WorkKind::loose_end);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_NEAR(ends[0].size, 4.0, 1e-12);
  EXPECT_NEAR(ends[1].size, 3.0, 1e-12);
  for (const WorkItem& end : ends) {
    ASSERT_FALSE(end.continuations.empty());
    const Continuation& best = end.continuations.front();
    EXPECT_EQ(best.vertices.front(), end.vertices.front());
    ASSERT_EQ(best.vertices.size(), 4u);
    for (const VertexId v : best.vertices) {
      EXPECT_EQ(mesh.point(v).y(), 0.0);
      EXPECT_EQ(mesh.point(v).z(), 0.0);
    }
    EXPECT_NEAR(best.length, 3.0, 1e-12);
    EXPECT_TRUE(best.arrives);
    EXPECT_EQ(end.lines.size(), 2u) << "its own line and the one on the other side";
    for (const Continuation& way : end.continuations) {
      EXPECT_LE(way.score, best.score);
      EXPECT_GE(way.score, 0.0);
      EXPECT_LE(way.score, 1.0);
    }
  }
}

TEST(Worklist, ALineThatFadesOutGoesOnUnderALowerAngle) {
  // A ridge along y whose exterior angle falls from 60 to 0 degrees: found above 40 only.
  Document document = document_of(shaped_lattice(40.0, 1.0, [](double x, double y) {
    const double turn = (60.0 - 1.5 * y) * std::numbers::pi / 180.0;
    return Point(x, y, -std::abs(x - 20.0) * std::tan(turn / 2.0));
  }));
  document = applied(document, {"find_sharp_lines", {{"angle", 40.0}}});
  ASSERT_EQ(document.lines.lines.size(), 1u);
  const auto ends = items_of(value_of(worklist(document)), WorkKind::loose_end);
  ASSERT_EQ(ends.size(), 1u);
  ASSERT_FALSE(ends[0].continuations.empty());
  const Continuation& best = ends[0].continuations.front();
  EXPECT_GE(best.vertices.size(), 5u);
  for (const VertexId v : best.vertices) EXPECT_EQ(document.mesh->point(v).x(), 20.0);
}

TEST(Worklist, UnassignedAreasCoverAllThatIsInNoPartition) {
  // Flat only: the wall of the cylinder is left.
  Document document =
      applied(document_of(capped_cylinder(10.0, 20.0, 48, 12, 6)), {"find_sharp_lines", {}});
  document = applied(document, {"find_partitions", {{"intervals", {{0.0, 0.004}}}}});
  const auto areas = items_of(value_of(worklist(document)), WorkKind::unassigned_area);
  ASSERT_EQ(areas.size(), 1u);
  double wall = 0.0;
  for (FaceId f = 0; f < document.mesh->face_count(); ++f)
    if (document.partitions.label(f) == 0) wall += face_area(*document.mesh, f);
  EXPECT_GT(wall, 1000.0);
  EXPECT_NEAR(areas[0].size, wall, 1e-9);
  ASSERT_LT(areas[0].face, document.mesh->face_count());
  EXPECT_EQ(document.partitions.label(areas[0].face), 0u);
}

TEST(Worklist, UndefinedBoundariesAreTheDerivedOnes) {
  const Document document = segmented(document_of(sample_mould(1.5)));
  std::vector<double> lengths;
  for (const BoundaryPtr& boundary : *document.boundaries)
    if (boundary->type == BoundaryType::undefined) lengths.push_back(boundary->length);
  std::ranges::sort(lengths, std::greater<>());
  WorklistOptions options;
  options.most_per_kind = 1000;
  const auto items = items_of(value_of(worklist(document, options)), WorkKind::undefined_boundary);
  ASSERT_EQ(items.size(), lengths.size());
  for (std::size_t k = 0; k < items.size(); ++k) EXPECT_EQ(items[k].size, lengths[k]);
}

TEST(Worklist, ANarrowStripIsASliverUnlessOneSurfaceExplainsIt) {
  Document document = segmented(document_of(stepped_plate(10.0, 40.0, 2.0, 1.0)));
  const Mesh& mesh = *document.mesh;
  ASSERT_EQ(document.partitions.partitions.size(), 3u);
  EXPECT_TRUE(items_of(value_of(worklist(document)), WorkKind::sliver).empty())
      << "the wall is a plane between two lines";

  // The wall and the row of faces above it, as where the line between them was missed.
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  double top = 0.0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) top = std::max(top, mesh.point(v).z());
  for (EdgeId e = 0; e < edges.size(); ++e)
    if (mesh.point(mesh.edge(e)[0]).z() != top || mesh.point(mesh.edge(e)[1]).z() != top)
      edges[e] = document.lines.edges[e];
  document.lines =
      relink_lines(mesh, *document.curvatures, edges, document.lines, document.next_id);
  FoundPartitions found;
  found.labels.assign(mesh.face_count(), 0);
  found.partitions.resize(3);
  double wall = 0.0;
  for (const PartitionPtr& partition : document.partitions.partitions)
    if (wall == 0.0 || partition->area < wall) wall = partition->area;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    const bool on_wall = document.partitions.find(document.partitions.label(f))->area == wall;
    bool beside_wall = false;
    for (const VertexId v : t)
      mesh.for_ring(v, [&](HalfEdgeId h) {
        const FaceId g = mesh.face(h);
        beside_wall =
            beside_wall || (g != no_id && mesh.point(t[0]).z() == top &&
                            mesh.point(t[1]).z() == top && mesh.point(t[2]).z() == top &&
                            document.partitions.find(document.partitions.label(g))->area == wall);
      });
    const std::uint32_t label = on_wall || beside_wall ? 1 : mesh.point(t[0]).z() == top ? 2 : 3;
    found.labels[f] = label;
    found.partitions[label - 1].area += face_area(mesh, f);
    ++found.partitions[label - 1].faces;
  }
  document.partitions = number_partitions(mesh, found, {}, document.next_id);
  document.boundaries = std::make_shared<const Boundaries>(
      derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions));
  const auto slivers = items_of(value_of(worklist(document)), WorkKind::sliver);
  ASSERT_EQ(slivers.size(), 1u);
  EXPECT_NEAR(document.partitions.find(slivers[0].partitions.at(0))->area, 120.0, 1e-9);
  EXPECT_NEAR(slivers[0].size, 13.0, 3.0) << "40 by 3";
}

TEST(Worklist, PartitionsWithTooManyBorderlinesAreListed) {
  const Document document = segmented(document_of(divided_cube(10.0, 6)));
  WorklistOptions options;
  options.most_borderlines = 3;
  const auto items = value_of(worklist(document, options));
  ASSERT_EQ(items.size(), 6u) << "each side of a box has four";
  for (const WorkItem& item : items) {
    EXPECT_EQ(item.kind, WorkKind::many_borders);
    EXPECT_EQ(item.size, 4.0);
  }
}

TEST(Worklist, ComesByKindAndSizeAndIsBounded) {
  const Document document = segmented(document_of(sample_mould(1.0)));
  WorklistOptions options;
  options.most_per_kind = 5;
  const auto all = value_of(worklist(document));
  const auto few = value_of(worklist(document, options));
  ASSERT_FALSE(few.empty());
  // What is small comes after all that is not, what is no fault last.
  const auto place = [](const WorkItem& item) {
    return std::tuple(!is_left(item), item.small, item.kind, -item.extent);
  };
  for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(place(all[k - 1]), place(all[k]));
  for (const WorkItem& item : all) {
    EXPECT_FALSE(item.vertices.empty());
    EXPECT_TRUE(item.sentence.ends_with(".")) << item.sentence;
    for (const std::uint32_t id : item.lines) EXPECT_NE(document.lines.find(id), nullptr);
    for (const std::uint32_t id : item.partitions) EXPECT_NE(document.partitions.find(id), nullptr);
  }
  EXPECT_TRUE(std::ranges::any_of(all, [](const WorkItem& item) { return !item.small; }));
  for (int kind = 0; kind < 6; ++kind) {
    const auto some = items_of(few, static_cast<WorkKind>(kind));
    const auto whole = items_of(all, static_cast<WorkKind>(kind));
    ASSERT_EQ(some.size(), std::min<std::size_t>(5, whole.size()));
    for (std::size_t k = 0; k < some.size(); ++k) EXPECT_EQ(some[k].sentence, whole[k].sentence);
  }
}

TEST(Worklist, CountsAreTrueAndNoiseComesAtTheEnd) {
  // Noise over a threshold that is far too low: hundreds of scraps of line, and the box's own.
  Document document = document_of(noisy(divided_cube(10.0, 24), 0.12, 7));
  document = applied(
      document, {"find_sharp_lines", {{"method", "walk"}, {"angle", 12.0}, {"min_length", 0.0}}});
  const LineEnds ends(*document.mesh, document.lines);
  ASSERT_GT(ends.loose().size(), 250u);
  const auto items = value_of(worklist(document));
  EXPECT_EQ(items_of(items, WorkKind::loose_end).size(), ends.loose().size());
  EXPECT_TRUE(items.back().small);
  double before = std::numeric_limits<double>::infinity();
  for (const WorkItem& item : items) {
    EXPECT_LE(item.extent, before);
    before = item.extent;
  }
}

TEST(Worklist, GoodContinuationsOfTheSampleRunAlongItsTrueLines) {
  MouldOptions mould_options;
  mould_options.edge_length = 1.0;
  const SampleMould mould = make_mould(mould_options);
  const Document document = segmented(document_of({mould.points, mould.triangles}));
  const Mesh& mesh = *document.mesh;
  const double near = 1.5 * mesh.mean_edge_length();
  int good = 0, on_line = 0;
  for (const WorkItem& item : value_of(worklist(document))) {
    if (item.kind != WorkKind::loose_end || item.continuations.empty()) continue;
    const Continuation& best = item.continuations.front();
    if (best.score < 0.5) continue;
    for (std::size_t i = 0; i + 1 < best.vertices.size(); ++i) {
      const Point middle = (mesh.point(best.vertices[i]) + mesh.point(best.vertices[i + 1])) / 2.0;
      ++good;
      on_line += std::ranges::any_of(mould.lines, [&](const TrueLine& line) {
        return std::ranges::any_of(line.points,
                                   [&](const Point& p) { return (p - middle).norm() < near; });
      });
    }
  }
  EXPECT_GE(on_line, 0.8 * good);
  RecordProperty("good", good);
  RecordProperty("on_line", on_line);
}

TEST(Worklist, IsTheSameOnOneThreadAndOnTwo) {
  const Document document = segmented(document_of(sample_mould(1.2)));
  const auto run = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    return value_of(worklist(document));
  };
  const auto one = run(1), two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].sentence, two[k].sentence);
    EXPECT_EQ(one[k].vertices, two[k].vertices);
    EXPECT_EQ(one[k].size, two[k].size);
    ASSERT_EQ(one[k].continuations.size(), two[k].continuations.size());
    for (std::size_t c = 0; c < one[k].continuations.size(); ++c)
      EXPECT_EQ(one[k].continuations[c].vertices, two[k].continuations[c].vertices);
  }
}

TEST(Worklist, CanBeCancelled) {
  std::stop_source source;
  source.request_stop();
  const auto items =
      worklist(segmented(document_of(divided_cube(10.0, 4))), {}, Context({}, source.get_token()));
  ASSERT_FALSE(items);
  EXPECT_TRUE(items.error().cancelled);
}

}  // namespace
}  // namespace arris
