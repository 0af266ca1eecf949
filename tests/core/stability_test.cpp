#include "core/guidance/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/thread_limit.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/lines.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;

Context stopped() {
  std::stop_source source;
  source.request_stop();
  return Context({}, source.get_token());
}

TEST(LineStability, ABoxHasTwelveLinesBelowNinetyDegreesAndNoneAbove) {
  for (const int divisions : {1, 6}) {
    SCOPED_TRACE(divisions);
    const MeshPtr mesh = mesh_of(divided_cube(10.0, divisions));
    const CurvaturesPtr curvatures = curvatures_of(*mesh);
    const StabilityCurve curve = value_of(line_stability(*mesh, *curvatures, nullptr, {}));
    ASSERT_EQ(curve.points.size(), 24u);
    double last_below = 0.0;
    for (const StabilityPoint& point : curve.points) {
      EXPECT_EQ(point.count, point.threshold < 90.0 ? 12u : 0u) << point.threshold;
      EXPECT_NEAR(point.size, point.threshold < 90.0 ? 120.0 : 0.0, 1e-9);
      if (point.threshold < 90.0) last_below = point.threshold;
    }
    EXPECT_GT(curve.points.back().threshold, 90.0);
    const std::optional<Plateau> flat = plateau(curve);
    ASSERT_TRUE(flat);
    EXPECT_EQ(flat->from, curve.points.front().threshold);
    EXPECT_EQ(flat->to, last_below);
    EXPECT_GT(flat->middle, flat->from);
    EXPECT_LT(flat->middle, flat->to);
  }
}

TEST(LineStability, EachPointIsWhatTheStepFinds) {
  const MeshPtr mesh = mesh_of(sample_mould(2.5));
  const CurvaturesPtr curvatures = curvatures_of(*mesh);
  SharpLineOptions options;
  options.min_length = default_min_length(*mesh, LineMethod::walk);
  const StabilityCurve curve =
      value_of(line_stability(*mesh, *curvatures, nullptr, options, {40.0, 15.0, 25.0}));
  ASSERT_EQ(curve.points.size(), 3u);
  EXPECT_EQ(curve.points[0].threshold, 15.0);
  EXPECT_EQ(curve.points[2].threshold, 40.0);
  for (const StabilityPoint& point : curve.points) {
    options.angle = point.threshold;
    const std::vector<Line> lines = derive_lines(
        *mesh, *curvatures, value_of(find_sharp_edges(*mesh, *curvatures, nullptr, options)));
    double length = 0.0;
    for (const Line& line : lines) length += line.length;
    EXPECT_EQ(point.count, lines.size());
    EXPECT_EQ(point.size, length);
  }
}

TEST(PartitionStability, EachPointIsWhatThePropagationFinds) {
  const Document document = applied(document_of(sample_mould(1.8)), {"find_sharp_lines", {}});
  const Mesh& mesh = *document.mesh;
  const std::vector<double>& values = document.curvatures->kabs;
  double whole = 0.0;
  for (FaceId f = 0; f < mesh.face_count(); ++f) whole += face_area(mesh, f);
  for (const auto& [least, min_faces, bare] : {std::tuple{0.0, 1u, false},
                                               {0.0, 1u, true},
                                               {0.0, 20u, true},
                                               {1e-4, 5u, false},
                                               {1e-4, 2u, true}}) {
    PartitionOptions options;
    options.min_faces = min_faces;
    options.bare_areas = bare;
    options.intervals = {{least, 1.0}};
    const StabilityCurve curve =
        value_of(partition_stability(mesh, values, document.lines, options, {}, 9));
    ASSERT_EQ(curve.points.size(), 9u);
    for (const StabilityPoint& point : curve.points) {
      options.intervals = {{least, point.threshold}};
      const FoundPartitions found =
          value_of(propagate_fronts(mesh, values, document.lines, options));
      double area = 0.0;
      for (const Partition& partition : found.partitions) area += partition.area;
      EXPECT_EQ(point.count, found.partitions.size()) << point.threshold;
      EXPECT_NEAR(point.size, area / whole, 1e-9) << point.threshold;
    }
  }
}

TEST(PartitionStability, ABoxHasItsSixSidesUnderEveryKmax) {
  const Document document = applied(document_of(divided_cube(10.0, 6)), {"find_sharp_lines", {}});
  const StabilityCurve curve =
      value_of(partition_stability(*document.mesh, document.curvatures->kabs, document.lines, {}));
  for (const StabilityPoint& point : curve.points) {
    EXPECT_EQ(point.count, 6u);
    EXPECT_NEAR(point.size, 1.0, 1e-9);
  }
  const std::optional<Plateau> flat = plateau(curve);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->from, curve.points.front().threshold);
  EXPECT_EQ(flat->to, curve.points.back().threshold);
}

TEST(Stability, IsTheSameOnOneThreadAndOnTwo) {
  const Document document = applied(document_of(sample_mould(2.5)), {"find_sharp_lines", {}});
  const auto run = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    return std::pair{value_of(line_stability(*document.mesh, *document.curvatures, nullptr, {})),
                     value_of(partition_stability(*document.mesh, document.curvatures->kabs,
                                                  document.lines, {}))};
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(Stability, CanBeCancelled) {
  const Document document = applied(document_of(sample_mould(2.5)), {"find_sharp_lines", {}});
  const auto lines =
      line_stability(*document.mesh, *document.curvatures, nullptr, {}, {}, 24, stopped());
  ASSERT_FALSE(lines);
  EXPECT_TRUE(lines.error().cancelled);
  const auto partitions = partition_stability(*document.mesh, document.curvatures->kabs,
                                              document.lines, {}, {}, 24, stopped());
  ASSERT_FALSE(partitions);
  EXPECT_TRUE(partitions.error().cancelled);
}

StabilityCurve curve_of(const std::vector<std::size_t>& counts, bool logarithmic = false) {
  StabilityCurve curve;
  curve.logarithmic = logarithmic;
  for (std::size_t k = 0; k < counts.size(); ++k)
    curve.points.push_back(
        {logarithmic ? std::pow(10.0, static_cast<double>(k)) : 5.0 * static_cast<double>(k),
         counts[k], static_cast<double>(counts[k])});
  return curve;
}

TEST(PlateauOfACurve, LiesBetweenTheNoiseAndTheEnd) {
  const auto flat = plateau(curve_of({9000, 8900, 8800, 400, 31, 30, 30, 30, 29, 12, 3, 0, 0, 0}));
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->from, 20.0);
  EXPECT_EQ(flat->to, 40.0);
  EXPECT_EQ(flat->middle, 30.0);
}

TEST(PlateauOfACurve, IsMeasuredInTheLogarithmWhereTheCurveIs) {
  const auto flat = plateau(curve_of({2, 500, 40, 8, 8, 8, 2, 1}, true));
  ASSERT_TRUE(flat);
  EXPECT_DOUBLE_EQ(flat->from, 1e3);
  EXPECT_DOUBLE_EQ(flat->to, 1e5);
  EXPECT_NEAR(flat->middle, 1e4, 1e-6);
}

TEST(PlateauOfACurve, IsNotFoundWhereTheCountKeepsFalling) {
  EXPECT_FALSE(plateau(curve_of({4000, 2000, 1000, 500, 250, 120, 60, 30, 15, 7, 3, 1, 0, 0, 0})));
  EXPECT_FALSE(plateau(curve_of({})));
  EXPECT_FALSE(plateau(curve_of({0, 0, 0, 0})));
  EXPECT_FALSE(plateau(curve_of({12, 12})));
}

TEST(PlateauOfACurve, IsOneThatAPersonWouldChoose) {
  // Many lines at 25 degrees; at 75 and beyond a few are left, which stay for longer.
  StabilityCurve curve;
  for (int k = 0; k < 24; ++k) {
    const double angle = 4.0 * k + 2.0;
    const std::size_t count = angle < 18.0   ? static_cast<std::size_t>(2000.0 / (k + 1))
                              : angle < 34.0 ? 60
                              : angle < 66.0 ? static_cast<std::size_t>(60 - 2 * (k - 8))
                                             : 20;
    curve.points.push_back({angle, count, 10.0 * static_cast<double>(count)});
  }
  const auto flat = plateau(curve);
  ASSERT_TRUE(flat);
  EXPECT_LE(flat->from, 25.0);
  EXPECT_GE(flat->to, 25.0);
  // Where the part itself says 25, nothing is offered far from it.
  for (StabilityPoint& point : curve.points)
    if (point.threshold < 66.0) point.count = static_cast<std::size_t>(4000.0 / point.threshold);
  curve.usual = 25.0;
  const auto near = plateau(curve);
  if (near) {
    EXPECT_LE(near->from, 50.0);
    EXPECT_GE(near->to, 12.5);
  }
  curve.usual = 0.0;
  ASSERT_TRUE(plateau(curve));
  EXPECT_GT(plateau(curve)->from, 60.0) << "so that the test can fail";
}

TEST(PlateauOfACurve, LeavesOutNextToNothing) {
  StabilityCurve curve = curve_of({800, 400, 200, 90, 40, 2, 2, 2, 2, 2});
  EXPECT_TRUE(plateau(curve));
  curve.trivial = 5.0;
  EXPECT_FALSE(plateau(curve));
  curve.trivial = 0.0;
  curve.trivial_count = 2;
  EXPECT_FALSE(plateau(curve));
}

}  // namespace
}  // namespace arris
