#include "core/samples/mould.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace arris {
namespace {

MeshPtr mesh_of(const SampleMould& mould) {
  Result<MeshPtr> mesh = Mesh::create(mould.points, mould.triangles);
  if (!mesh) throw std::logic_error(mesh.error().message);
  return *mesh;
}

const SampleMould& sample() {
  static const SampleMould mould = make_mould();
  return mould;
}

const SampleMould& noise_free() {
  static const SampleMould mould = make_mould({.noise = 0.0});
  return mould;
}

Point normal_of(const SampleMould& mould, std::size_t f) {
  const Triangle& t = mould.triangles[f];
  const Point& a = mould.points[t[0]];
  return (mould.points[t[1]] - a).cross(mould.points[t[2]] - a);
}

std::size_t component_count(const Mesh& mesh) {
  std::vector<char> seen(mesh.face_count(), 0);
  std::size_t count = 0;
  for (FaceId start = 0; start < mesh.face_count(); ++start) {
    if (seen[start]) continue;
    ++count;
    seen[start] = 1;
    std::vector<FaceId> front{start};
    while (!front.empty()) {
      const FaceId f = front.back();
      front.pop_back();
      HalfEdgeId h = mesh.face_half_edge(f);
      for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
        const FaceId g = mesh.face(Mesh::opposite(h));
        if (g == no_id || seen[g]) continue;
        seen[g] = 1;
        front.push_back(g);
      }
    }
  }
  return count;
}

std::vector<std::vector<VertexId>> border_loops(const Mesh& mesh) {
  std::vector<std::vector<VertexId>> loops;
  std::vector<char> seen(2 * mesh.edge_count(), 0);
  for (HalfEdgeId start = 0; start < 2 * mesh.edge_count(); ++start) {
    if (mesh.face(start) != no_id || seen[start]) continue;
    loops.emplace_back();
    for (HalfEdgeId h = start; !seen[h]; h = mesh.next(h)) {
      seen[h] = 1;
      loops.back().push_back(mesh.from(h));
    }
  }
  return loops;
}

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

/// Faces by cells of their centres in the plane, for searches round a place.
class FaceCells {
 public:
  explicit FaceCells(const SampleMould& mould) : mould_(mould) {
    for (std::size_t f = 0; f < mould.triangles.size(); ++f) cells_[cell(centre(f))].push_back(f);
  }
  Point centre(std::size_t f) const {
    const Triangle& t = mould_.triangles[f];
    return (mould_.points[t[0]] + mould_.points[t[1]] + mould_.points[t[2]]) / 3.0;
  }
  template <class Visit>
  void near(const Point& p, const Visit& visit) const {
    const auto [column, row] = cell(p);
    for (int j = row - 1; j <= row + 1; ++j)
      for (int i = column - 1; i <= column + 1; ++i)
        if (const auto found = cells_.find({i, j}); found != cells_.end())
          for (const std::size_t f : found->second) visit(f);
  }

 private:
  static constexpr double size_ = 3.0;
  static std::pair<int, int> cell(const Point& p) {
    return {static_cast<int>(std::floor(p.x() / size_)),
            static_cast<int>(std::floor(p.y() / size_))};
  }
  const SampleMould& mould_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> cells_;
};

TEST(Mould, HasTheSizeOfThePapersPart) {
  const MeshPtr mesh = mesh_of(sample());
  const Point size = mesh->box_max() - mesh->box_min();
  EXPECT_NEAR(size.x(), 108.0, 0.02 * 108.0);
  EXPECT_NEAR(size.y(), 104.0, 0.02 * 104.0);
  EXPECT_NEAR(size.z(), 21.0, 0.02 * 21.0);
  EXPECT_GE(mesh->face_count(), 20'000u);
  EXPECT_LE(mesh->face_count(), 30'000u);
}

TEST(Mould, IsOneOpenSheetWhateverTheSeed) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    MouldOptions options;
    options.seed = seed;
    options.edge_length = seed == 1 ? 0.92 : 1.5;
    const MeshPtr mesh = mesh_of(make_mould(options));
    EXPECT_EQ(component_count(*mesh), 1u);
    EXPECT_EQ(border_loops(*mesh).size(), 1u);
    for (VertexId v = 0; v < mesh->vertex_count(); ++v) ASSERT_FALSE(mesh->is_isolated(v));
  }
}

TEST(Mould, BorderIsRagged) {
  const MeshPtr mesh = mesh_of(sample());
  const std::vector<VertexId> loop = border_loops(*mesh).front();
  double turning = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point a = mesh->point(loop[i]), b = mesh->point(loop[(i + 1) % loop.size()]);
    const Point c = mesh->point(loop[(i + 2) % loop.size()]);
    turning += std::abs(std::atan2((b - a).cross(c - b).norm(), (b - a).dot(c - b)));
  }
  // A smooth convex border turns 2 pi in all.
  EXPECT_GT(degrees(turning / loop.size()), 20.0);
}

TEST(Mould, EdgesAreAsLongAsAsked) {
  for (const double length : {0.92, 2.0}) {
    MouldOptions options;
    options.edge_length = length;
    options.noise = 0.0;
    const MeshPtr mesh = mesh_of(make_mould(options));
    double shortest = std::numeric_limits<double>::infinity();
    for (EdgeId e = 0; e < mesh->edge_count(); ++e)
      shortest = std::min(shortest, mesh->edge_length(e));
    EXPECT_GE(shortest, 0.86 * length);
    EXPECT_NEAR(mesh->mean_edge_length(), 1.2 * length, 0.1 * length);
  }
}

TEST(Mould, WallsAreAsDenseAsFlats) {
  const SampleMould& mould = noise_free();
  std::vector<double> area(mould.area_names.size(), 0.0);
  std::vector<std::size_t> count(mould.area_names.size(), 0);
  for (std::size_t f = 0; f < mould.triangles.size(); ++f) {
    area[mould.face_areas[f]] += normal_of(mould, f).norm() / 2.0;
    ++count[mould.face_areas[f]];
  }
  std::map<std::string, double> mean;
  for (std::size_t k = 0; k < area.size(); ++k) mean[mould.area_names[k]] = area[k] / count[k];
  EXPECT_NEAR(mean.at("boss wall") / mean.at("base"), 1.0, 0.2);
}

TEST(Mould, FacesLookUpAndNoiseFlipsNone) {
  const SampleMould& clean = noise_free();
  ASSERT_EQ(clean.triangles, sample().triangles);
  for (std::size_t f = 0; f < clean.triangles.size(); ++f) {
    const Point normal = normal_of(clean, f);
    ASSERT_GT(normal.z(), 0.0) << "face " << f;
    ASSERT_GT(normal.dot(normal_of(sample(), f)), 0.0) << "face " << f;
  }
}

TEST(Mould, NoiseIsThatOfTheSensor) {
  const SampleMould& clean = noise_free();
  const MeshPtr mesh = mesh_of(clean);
  std::vector<double> residuals;
  double along_normals = 0.0, all = 0.0;
  for (VertexId v = 0; v < mesh->vertex_count(); ++v) {
    Point normal = Point::Zero();
    mesh->for_ring(v, [&](HalfEdgeId h) {
      if (mesh->face(h) != no_id) normal += normal_of(clean, mesh->face(h));
    });
    const Point offset = sample().points[v] - clean.points[v];
    residuals.push_back(offset.dot(normal) < 0.0 ? -offset.norm() : offset.norm());
    along_normals += std::abs(offset.dot(normal.normalized()));
    all += offset.norm();
  }
  double mean = 0.0, square = 0.0, fourth = 0.0;
  for (const double r : residuals) mean += r / residuals.size();
  for (const double r : residuals) {
    square += (r - mean) * (r - mean) / residuals.size();
    fourth += std::pow(r - mean, 4) / residuals.size();
  }
  EXPECT_NEAR(mean, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(square), 0.05, 0.05 * 0.05);
  EXPECT_NEAR(fourth / (square * square), 3.0, 0.3) << "kurtosis of a Gaussian";
  EXPECT_GT(along_normals / all, 0.95);
}

TEST(Mould, SharpLinesHaveTheirClaimedAngle) {
  const SampleMould& clean = noise_free();
  const FaceCells faces(clean);
  const double edge = mesh_of(clean)->mean_edge_length();
  int sharp = 0;
  for (const TrueLine& line : clean.lines) {
    if (line.fillet) continue;
    ++sharp;
    // Away from the line, where no face reaches over it, the faces on either side show its angle.
    std::vector<double> angles;
    int convex = 0;
    for (std::size_t i = 0; i < line.points.size(); i += 4) {
      const Point& p = line.points[i];
      const Point& next = line.points[(i + 1) % line.points.size()];
      if (!line.closed && i + 1 == line.points.size()) break;
      const Point along = (next - p).normalized();
      // The side in space: across the line and within one and a half edges of it.
      std::array<Point, 2> normal{Point::Zero(), Point::Zero()};
      std::array<Point, 2> place{Point::Zero(), Point::Zero()};
      std::array<double, 2> weight{0.0, 0.0};
      const Point level(along.y(), -along.x(), 0.0);
      std::vector<std::pair<Point, Point>> found;
      faces.near(p, [&](std::size_t f) {
        const Point offset = faces.centre(f) - p;
        const double run = offset.dot(along);
        const double reach = (offset - run * along).norm();
        if (std::abs(run) > 1.5 * edge || reach < 0.6 * edge || reach > 1.5 * edge) return;
        found.emplace_back(offset - run * along, normal_of(clean, f));
      });
      if (found.size() < 2) continue;
      // Two sides: those whose direction agrees with that of the most level face, and the others.
      const auto flattest = std::ranges::max_element(
          found, {}, [](const auto& face) { return face.second.normalized().z(); });
      for (const auto& [offset, n] : found) {
        const int side = offset.normalized().dot(flattest->first.normalized()) > 0.3 ? 0 : 1;
        normal[side] += n;
        place[side] += n.norm() * offset;
        weight[side] += n.norm();
      }
      if (weight[0] == 0.0 || weight[1] == 0.0) continue;
      const double angle =
          degrees(std::atan2(normal[0].cross(normal[1]).norm(), normal[0].dot(normal[1])));
      const Point middle = place[0] / weight[0] + place[1] / weight[1];
      convex += middle.dot(normal[0].normalized() + normal[1].normalized()) < 0.0 ? 1 : -1;
      angles.push_back(angle);
    }
    ASSERT_GT(angles.size(), 20u) << line.name;
    EXPECT_GT(convex * line.angle, 0.0) << line.name;
    const std::size_t tenth = angles.size() / 10;
    if (!line.closed) {
      const double begin = std::accumulate(angles.begin(), angles.begin() + tenth, 0.0) / tenth;
      const double end = std::accumulate(angles.end() - tenth, angles.end(), 0.0) / tenth;
      EXPECT_LT(end, begin / 3.0) << line.name << " should fade";
    }
    // The claim is the largest angle of the line; a single largest measurement would be chance.
    std::ranges::sort(angles);
    EXPECT_NEAR(angles[9 * tenth], std::abs(line.angle), 8.0) << line.name;
  }
  EXPECT_EQ(sharp, 6);
}

TEST(Mould, HoldsEveryFormPromised) {
  std::set<std::string> names;
  int fillets = 0, convex = 0, concave = 0;
  for (const TrueLine& line : sample().lines) {
    EXPECT_TRUE(names.insert(line.name).second) << line.name;
    EXPECT_GT(line.points.size(), 50u);
    if (line.fillet) ++fillets;
    if (!line.fillet) ++(line.angle > 0.0 ? convex : concave);
  }
  EXPECT_GE(fillets, 4);
  EXPECT_GE(convex, 2);
  EXPECT_GE(concave, 3);
  EXPECT_TRUE(names.contains("oval line"));
}

TEST(Mould, EveryFaceHasAnArea) {
  const SampleMould& mould = sample();
  ASSERT_EQ(mould.face_areas.size(), mould.triangles.size());
  std::vector<std::size_t> count(mould.area_names.size(), 0);
  for (const std::uint32_t area : mould.face_areas) {
    ASSERT_LT(area, mould.area_names.size());
    ++count[area];
  }
  for (std::size_t k = 0; k < count.size(); ++k) EXPECT_GT(count[k], 20u) << mould.area_names[k];
  EXPECT_EQ(std::set<std::string>(mould.area_names.begin(), mould.area_names.end()).size(),
            mould.area_names.size());
}

TEST(Mould, VerticesKnowTheirSharpLine) {
  const SampleMould& clean = noise_free();
  ASSERT_EQ(clean.vertex_lines.size(), clean.points.size());
  std::vector<std::size_t> count(clean.lines.size(), 0);
  for (std::size_t v = 0; v < clean.points.size(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const TrueLine& line : clean.lines) {
      if (line.fillet) continue;
      for (const Point& p : line.points) nearest = std::min(nearest, (clean.points[v] - p).norm());
    }
    const std::int32_t own = clean.vertex_lines[v];
    if (own < 0) {
      EXPECT_GT(nearest, 0.92 / 2.0 - 1e-9);
      continue;
    }
    ASSERT_LT(own, static_cast<std::int32_t>(clean.lines.size()));
    EXPECT_FALSE(clean.lines[own].fillet);
    EXPECT_LT(nearest, 0.92 / 2.0 + 0.1);  // the points of a line lie up to 1.7 mm / 4 apart
    ++count[own];
  }
  for (std::size_t l = 0; l < count.size(); ++l)
    EXPECT_EQ(count[l] > 0, !clean.lines[l].fillet) << clean.lines[l].name;
}

TEST(Mould, SameOptionsGiveTheSameBytes) {
  const SampleMould again = make_mould();
  ASSERT_EQ(again.points.size(), sample().points.size());
  EXPECT_EQ(
      std::memcmp(again.points.data(), sample().points.data(), again.points.size() * sizeof(Point)),
      0);
  EXPECT_EQ(again.triangles, sample().triangles);
  EXPECT_EQ(again.face_areas, sample().face_areas);
  EXPECT_EQ(again.vertex_lines, sample().vertex_lines);
}

TEST(Mould, SeedsDiffer) {
  MouldOptions options;
  options.seed = 2;
  EXPECT_NE(make_mould(options).points, sample().points);
}

TEST(Mould, OddOptionsNeitherHangNorCrash) {
  for (const double length : {1e9, 5.0, std::numeric_limits<double>::infinity()}) {
    MouldOptions options;
    options.edge_length = length;
    options.noise = std::numeric_limits<double>::quiet_NaN();
    EXPECT_GT(mesh_of(make_mould(options))->face_count(), 300u);
  }
}

}  // namespace
}  // namespace arris
