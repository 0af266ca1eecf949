#include "core/guidance/leaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/thread_limit.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/sharp_lines.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A box of side 10 in steps of 1, with the edges from x = begin to x = end taken out of its sharp
/// edge along x at y = z = 0, and partitions that know no limit but the lines.
struct LeakingBox {
  explicit LeakingBox(const std::vector<std::pair<double, double>>& gaps) {
    document = applied(document_of(divided_cube(10.0, 10)), {"find_sharp_lines", {}});
    const Mesh& mesh = *document.mesh;
    std::vector<Origin> edges(mesh.edge_count());
    for (EdgeId e = 0; e < edges.size(); ++e) {
      edges[e] = document.lines.edges[e];
      const Point middle = (mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0;
      for (const auto& [begin, end] : gaps)
        if (middle.y() == 0.0 && middle.z() == 0.0 && middle.x() > begin && middle.x() < end)
          edges[e] = Origin::none;
    }
    document.lines =
        relink_lines(mesh, *document.curvatures, edges, document.lines, document.next_id);
    PartitionOptions options;
    options.intervals = {{0.0, infinite}};
    document.partitions = number_partitions(
        mesh, value_of(propagate_fronts(mesh, document.curvatures->kabs, document.lines, options)),
        {}, document.next_id);
  }
  std::vector<Leak> leaks(const LeakOptions& options = {}) const {
    return value_of(find_leaks(*document.mesh, document.lines, document.partitions, options));
  }
  /// From the lower x to the higher.
  std::vector<Point> points(const std::vector<VertexId>& vertices) const {
    std::vector<Point> path;
    for (const VertexId v : vertices) path.push_back(document.mesh->point(v));
    if (path.back().x() < path.front().x()) std::ranges::reverse(path);
    return path;
  }
  Document document;
};

TEST(Leaks, ABoxWithTwoEdgesMissingLeaksThereFirst) {
  const LeakingBox box({{4.0, 6.0}});
  ASSERT_EQ(box.document.partitions.partitions.size(), 5u) << "two sides are one";
  const std::vector<Leak> leaks = box.leaks();
  ASSERT_FALSE(leaks.empty());
  const Leak& leak = leaks.front();
  EXPECT_EQ(box.points(leak.path), (std::vector<Point>{{4, 0, 0}, {5, 0, 0}, {6, 0, 0}}));
  EXPECT_NEAR(leak.gap, 2.0, 1e-12);
  EXPECT_NEAR(leak.area, 100.0, 1e-9);
  EXPECT_TRUE(leak.others.empty());
  const Partition* partition = box.document.partitions.find(leak.partition);
  ASSERT_NE(partition, nullptr);
  EXPECT_NEAR(partition->area, 200.0, 1e-9);
  for (std::size_t k = 1; k < leaks.size(); ++k) EXPECT_LT(leaks[k].score, leak.score);
}

TEST(Leaks, TwoGapsBetweenTheSamePartsAreClosedTogether) {
  const LeakingBox box({{2.0, 4.0}, {6.0, 8.0}});
  ASSERT_EQ(box.document.partitions.partitions.size(), 5u);
  const std::vector<Leak> leaks = box.leaks();
  ASSERT_FALSE(leaks.empty());
  ASSERT_EQ(leaks[0].others.size(), 1u);
  EXPECT_NEAR(leaks[0].gap, 4.0, 1e-12);
  EXPECT_NEAR(leaks[0].area, 100.0, 1e-9);
  std::vector<std::vector<Point>> gaps{box.points(leaks[0].path), box.points(leaks[0].others[0])};
  if (gaps[1].front().x() < gaps[0].front().x()) std::swap(gaps[0], gaps[1]);
  EXPECT_EQ(gaps[0], (std::vector<Point>{{2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  EXPECT_EQ(gaps[1], (std::vector<Point>{{6, 0, 0}, {7, 0, 0}, {8, 0, 0}}));
}

TEST(Leaks, AClosedBoxHasNone) { EXPECT_TRUE(LeakingBox({}).leaks().empty()); }

TEST(Leaks, GapsBeyondTheReachAreNotLookedFor) {
  LeakOptions options;
  options.reach = 1.0;  // mean edge lengths; the gap is two edges
  EXPECT_TRUE(LeakingBox({{4.0, 6.0}}).leaks(options).empty());
}

TEST(Leaks, ALineThatEndsInTheMiddleOfNowhereIsNone) {
  // A line half across a plate: the way to the border parts as much as the gap is long, squared.
  Document document = document_of(noisy_plane(40.0, 1.0, 0.0, 0.0, 1));
  std::vector<Origin> edges(document.mesh->edge_count(), Origin::none);
  for (EdgeId e = 0; e < edges.size(); ++e) {
    const Point a = document.mesh->point(document.mesh->edge(e)[0]);
    const Point b = document.mesh->point(document.mesh->edge(e)[1]);
    if (a.y() == 20.0 && b.y() == 20.0 && std::max(a.x(), b.x()) <= 20.0) edges[e] = Origin::drawn;
  }
  document.lines = relink_lines(*document.mesh, *document.curvatures, edges, {}, document.next_id);
  ASSERT_EQ(document.lines.lines.size(), 1u);
  document = applied(document, {"find_partitions", {}});
  EXPECT_TRUE(value_of(find_leaks(*document.mesh, document.lines, document.partitions)).empty());
}

TEST(Leaks, NothingToLookAtGivesNone) {
  const Document document = document_of(divided_cube(10.0, 4));
  EXPECT_TRUE(value_of(find_leaks(*document.mesh, {}, {})).empty());
}

TEST(Leaks, PartitionsAreReallyPartedWhereTheLeaksAreClosed) {
  Document document = applied(applied(document_of(sample_mould(1.2)), {"find_sharp_lines", {}}),
                              {"find_partitions", {}});
  const Mesh& mesh = *document.mesh;
  for (const Leak& leak : value_of(find_leaks(mesh, document.lines, document.partitions))) {
    std::vector<bool> closed(mesh.edge_count(), false);
    std::vector<std::vector<VertexId>> paths = leak.others;
    paths.push_back(leak.path);
    for (const std::vector<VertexId>& path : paths)
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        closed[mesh.find_edge(path[i], path[i + 1]).value()] = true;
    // Flood the partition from one of its faces.
    std::vector<bool> seen(mesh.face_count(), false);
    std::vector<double> pieces;
    for (FaceId start = 0; start < mesh.face_count(); ++start) {
      if (seen[start] || document.partitions.label(start) != leak.partition) continue;
      std::vector<FaceId> front{start};
      seen[start] = true;
      double area = 0.0;
      for (std::size_t next = 0; next < front.size(); ++next) {
        area += face_area(mesh, front[next]);
        HalfEdgeId h = mesh.face_half_edge(front[next]);
        for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
          const FaceId f = mesh.face(Mesh::opposite(h));
          if (f == no_id || seen[f] || closed[h >> 1] || document.lines.is_sharp(h >> 1) ||
              document.partitions.label(f) != leak.partition)
            continue;
          seen[f] = true;
          front.push_back(f);
        }
      }
      pieces.push_back(area);
    }
    ASSERT_GE(pieces.size(), 2u);
    std::ranges::sort(pieces);
    if (pieces.size() == 2) {
      EXPECT_NEAR(pieces[0], leak.area, 1e-6);
    }
  }
}

TEST(Leaks, AreTheSameOnOneThreadAndOnTwo) {
  const Document document = applied(
      applied(document_of(sample_mould(1.2)), {"find_sharp_lines", {}}), {"find_partitions", {}});
  const auto run = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    return value_of(find_leaks(*document.mesh, document.lines, document.partitions));
  };
  const std::vector<Leak> one = run(1), two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].path, two[k].path);
    EXPECT_EQ(one[k].score, two[k].score);
    EXPECT_EQ(one[k].area, two[k].area);
    EXPECT_LE(one[k].score, one[k > 0 ? k - 1 : 0].score);
  }
}

TEST(Leaks, CanBeCancelled) {
  const LeakingBox box({{4.0, 6.0}});
  std::stop_source source;
  source.request_stop();
  const auto leaks = find_leaks(*box.document.mesh, box.document.lines, box.document.partitions, {},
                                Context({}, source.get_token()));
  ASSERT_FALSE(leaks);
  EXPECT_TRUE(leaks.error().cancelled);
}

}  // namespace
}  // namespace arris
