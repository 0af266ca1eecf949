// Partitions by fitted surfaces: which surface it is, how exactly, and where one area ends and the
// next begins, the same wherever and however the part lies.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "core/base/random.h"
#include "core/base/thread_limit.h"
#include "core/document/history.h"
#include "core/mesh/geometry.h"
#include "core/partitions/area_tree.h"
#include "core/partitions/continuation.h"
#include "core/partitions/partition_surfaces.h"
#include "core/partitions/surface_fit.h"
#include "core/partitions/surface_growing.h"
#include "tests/support/documents.h"
#include "tests/support/meshes.h"

namespace arris {
namespace {

using namespace arris::testing;
using Eigen::Vector3d;
constexpr double degree = std::numbers::pi / 180.0;

Document found(const Triangles& part, nlohmann::json parameters = nlohmann::json::object()) {
  return applied(applied(document_of(part), {"find_sharp_lines"}),
                 {"find_partitions", std::move(parameters)});
}

std::vector<PartitionSurface> surfaces_of(const Document& document) {
  return value_of(fit_partition_surfaces(*document.mesh, document.lines, document.partitions));
}

/// A plane along x that goes over into a cylinder of `radius` after half of `length`, without an
/// edge.
Triangles bent_strip(double radius, double length, double h) {
  return shaped_lattice(length, h, [=](double x, double y) {
    const double s = x - length / 2.0;
    if (s <= 0.0) return Point(s, y, 0.0);
    return Point(radius * std::sin(s / radius), y, radius * (std::cos(s / radius) - 1.0));
  });
}

Point centre_of(const Mesh& mesh, FaceId f) {
  const Triangle& t = mesh.triangle(f);
  return (mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0;
}

/// Share of the area of the true patch `in` that its main partition covers, and of that partition
/// what lies in the patch: the smaller of both.
double agreement(const Document& document, const std::function<bool(const Point&)>& in) {
  const Mesh& mesh = *document.mesh;
  double all = 0.0;
  std::map<std::uint32_t, double> shared, own;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const double area = face_area(mesh, f);
    own[document.partitions.labels[f]] += area;
    if (!in(centre_of(mesh, f))) continue;
    all += area;
    shared[document.partitions.labels[f]] += area;
  }
  const auto main =
      std::ranges::max_element(shared, {}, [](const auto& entry) { return entry.second; });
  return std::min(main->second / all, main->second / own[main->first]);
}

// ---- fits ----

/// Samples of a surface over a patch of it, with noise along the normal and of the normal.
std::vector<SurfaceSample> samples_of(const std::function<SurfaceSample(double, double)>& at,
                                      int steps, const SurfaceNoise& noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      SurfaceSample s = at((i + 0.5) / steps, (j + 0.5) / steps);
      s.point += noise.distance * random.gaussian() * s.normal;
      s.normal += noise.angle * Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
      s.normal.normalize();
      samples.push_back(s);
    }
  return samples;
}

TEST(SurfaceFit, TellsThePlainSurfacesApartAndMeasuresThem) {
  const SurfaceNoise noise{0.05, 2.0 * degree};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  const Vector3d shift(30.0, -20.0, 5.0);
  const auto placed = [&](SurfaceSample s, double side) {
    return SurfaceSample{turn * s.point + shift, side * (turn * s.normal), 1.0};
  };
  for (const double side : {1.0, -1.0}) {
    const auto fitted = [&](const std::function<SurfaceSample(double, double)>& at) {
      return fit_surface(
          samples_of([&](double u, double v) { return placed(at(u, v), side); }, 14, noise, 5),
          noise);
    };
    const FittedSurface plane = fitted([](double u, double v) {
      return SurfaceSample{{12.0 * u, 10.0 * v, 0.0}, Vector3d::UnitZ()};
    });
    EXPECT_EQ(plane.surface.type, SurfaceType::plane);
    EXPECT_GT(plane.surface.axis.dot(turn * Vector3d::UnitZ()) * side, std::cos(0.3 * degree));

    const auto on_sphere = [](double u, double v) {
      const double a = 0.3 + 0.8 * u, b = 1.2 * v;
      const Vector3d n(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
      return SurfaceSample{20.0 * n, n};
    };
    const FittedSurface sphere = fitted(on_sphere);
    EXPECT_EQ(sphere.surface.type, SurfaceType::sphere);
    EXPECT_NEAR(sphere.surface.radius, 20.0, 0.5);
    EXPECT_EQ(sphere.surface.side, side);
    EXPECT_LT((sphere.surface.point - shift).norm(), 0.5);

    const FittedSurface cylinder = fitted([](double u, double v) {
      const Vector3d n(std::cos(1.2 * u), std::sin(1.2 * u), 0.0);
      return SurfaceSample{8.0 * n + Vector3d(0.0, 0.0, 15.0 * v), n};
    });
    EXPECT_EQ(cylinder.surface.type, SurfaceType::cylinder);
    EXPECT_NEAR(cylinder.surface.radius, 8.0, 0.15);
    EXPECT_GT(std::abs(cylinder.surface.axis.dot(turn * Vector3d::UnitZ())), std::cos(degree));

    const FittedSurface cone = fitted([](double u, double v) {
      const double half = 15.0 * degree, b = 2.0 * u, l = 25.0 + 20.0 * v;
      const Vector3d out(std::cos(b), std::sin(b), 0.0);
      return SurfaceSample{l * (std::cos(half) * Vector3d::UnitZ() + std::sin(half) * out),
                           std::cos(half) * out - std::sin(half) * Vector3d::UnitZ()};
    });
    EXPECT_EQ(cone.surface.type, SurfaceType::cone);
    EXPECT_NEAR(cone.surface.half_angle / degree, 15.0, 0.7);
    EXPECT_LT((cone.surface.point - shift).norm(), 2.0);

    // A fillet between a cylinder and a plane, over a seventh of the way round.
    const FittedSurface torus = fitted([](double u, double v) {
      const double a = 1.5 * v, b = 0.9 * u;
      const Vector3d out(std::cos(b), std::sin(b), 0.0);
      const Vector3d n = std::cos(a) * out + std::sin(a) * Vector3d::UnitZ();
      return SurfaceSample{30.0 * out + 3.0 * n, n};
    });
    EXPECT_EQ(torus.surface.type, SurfaceType::torus);
    EXPECT_NEAR(torus.surface.tube, 3.0, 0.2);
    EXPECT_NEAR(torus.surface.radius, 30.0, 1.5);
    for (const FittedSurface& fit : {plane, sphere, cylinder, cone, torus})
      EXPECT_LT(fit.misfit, 1.4) << name_of(fit.surface.type);
  }
}

TEST(SurfaceFit, DistanceAndNormalAreThoseOfTheSurface) {
  // The normal is the gradient of the distance, and turns as bend_at() says, whatever the surface.
  const std::array types{SurfaceType::plane, SurfaceType::sphere, SurfaceType::cylinder,
                         SurfaceType::cone,  SurfaceType::torus,  SurfaceType::free};
  std::vector<Surface> surfaces(types.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    surfaces[k].type = types[k];
    surfaces[k].point = {1.0, 2.0, 3.0};
    surfaces[k].axis = Vector3d(1.0, 1.0, 2.0).normalized();
    surfaces[k].radius = 9.0;
    surfaces[k].tube = 2.5;
    surfaces[k].half_angle = 0.4;
    surfaces[k].heights << 0.3, 0.02, -0.03, 0.01, 0.004, -0.006, 1e-4, -2e-4, 0.0, 1e-4, 1e-6,
        -2e-6, 0.0, 1e-6, 2e-6;
  }
  Random random(3);
  for (const Surface& surface : surfaces)
    for (int k = 0; k < 50; ++k) {
      Vector3d p = surface.point + 8.0 * Vector3d(random.gaussian(), random.gaussian(), 0.5);
      if (surface.type == SurfaceType::cone) p -= 40.0 * surface.axis;  // clear of the apex
      for (int round = 0; round < 20; ++round) {                        // on the surface
        const Surface::At at = surface.at(p);
        p -= at.distance * at.normal;
      }
      const Surface::At at = surface.at(p);
      ASSERT_NEAR(at.distance, 0.0, 1e-4) << name_of(surface.type);
      const double step = 1e-5;
      for (int c = 0; c < 3; ++c) {
        const Vector3d offset = step * Vector3d::Unit(c);
        const double slope =
            (surface.at(p + offset).distance - surface.at(p - offset).distance) / (2.0 * step);
        EXPECT_NEAR(slope, at.normal[c], 2e-3) << name_of(surface.type);
        if (surface.type == SurfaceType::free) continue;
        const Vector3d turn =
            (surface.at(p + offset).normal - surface.at(p - offset).normal) / (2.0 * step);
        EXPECT_LT((turn - surface.bend_at(p).col(c)).norm(), 1e-5) << name_of(surface.type);
      }
    }
}

TEST(SurfaceFit, ASurfacePlacedElsewhereIsTheSameSurface) {
  const Vector3d origin(4.0, -3.0, 2.0);
  constexpr double unit = 2.5;
  Surface cylinder, torus;
  cylinder.type = SurfaceType::cylinder;
  cylinder.radius = 3.0;
  torus.type = SurfaceType::torus;
  torus.point = {1.0, 2.0, 0.5};
  torus.radius = 9.0;
  torus.tube = 3.1;
  Surface free;
  free.heights.head<6>() << 0.3, 0.02, -0.03, 0.01, 0.004, -0.006;
  Random random(8);
  for (const Surface& surface : {cylinder, torus, free, continued(cylinder, 1.0, torus, 2.0)})
    for (int k = 0; k < 20; ++k) {
      const Vector3d p = 4.0 * Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
      const Surface::At here = surface.at(p),
                        there = surface.placed(origin, unit).at(origin + unit * p);
      EXPECT_NEAR(there.distance, unit * here.distance, 1e-9) << name_of(surface.type);
      EXPECT_LT((there.normal - here.normal).norm(), 1e-9) << name_of(surface.type);
    }
}

TEST(SurfaceFit, TubesOfOneRadiusContinueOneAnother) {
  // A straight fillet and the ring that it runs into, where they touch and elsewhere.
  Surface straight, ring;
  straight.type = SurfaceType::cylinder;
  straight.axis = Vector3d::UnitX();
  straight.radius = 3.0;
  ring.type = SurfaceType::torus;
  ring.point = {0.0, 60.0, 0.0};
  ring.radius = 60.0;
  ring.tube = 3.0;
  const Vector3d meet(0.0, -3.0, 0.0);
  EXPECT_LT(tear_between(straight, ring, meet), 0.5);
  EXPECT_LT(tear_between(ring, straight, meet), 0.5);
  EXPECT_GT(tear_between(straight, ring, meet + Vector3d(40.0, 0.0, 0.0)), 1.0) << "turned away";
  Surface tight = ring;
  tight.point.y() = tight.radius = 8.0;
  EXPECT_GT(tear_between(straight, tight, meet), 1.0) << "bent at once";
  Surface hollow = straight;
  hollow.side = -1.0;
  EXPECT_GT(tear_between(hollow, ring, meet), 1.0) << "to the other side";
  Surface wide = straight;
  wide.radius = 4.5;
  wide.point.z() = -1.5;
  EXPECT_GT(tear_between(wide, ring, meet), 1.0) << "of another radius";
  Surface flat;
  flat.type = SurfaceType::plane;
  EXPECT_GT(tear_between(flat, flat, meet), 1e9) << "planes are joined as one surface or not";
}

TEST(SurfaceFit, AWidePlaneThatTheScanBendsIsRatherAPlane) {
  // Off by a noise over its width, as scans are: as a bend it is explained the best, but a radius
  // of a thousand edges says nothing of what the part is.
  const SurfaceNoise noise{0.1, 2.0 * degree};
  const std::vector<SurfaceSample> samples = samples_of(
      [](double u, double v) {
        const double x = 60.0 * (u - 0.5), y = 60.0 * (v - 0.5), bend = 1.0 / 1500.0;
        return SurfaceSample{{x, y, 0.5 * bend * (x * x + 0.6 * y * y)},
                             Vector3d(-bend * x, -0.6 * bend * y, 1.0).normalized()};
      },
      20, noise, 7);
  EXPECT_NE(fit_surface(samples, noise).surface.type, SurfaceType::plane);
  SurfaceFitOptions telling;
  telling.wide = 100.0;
  telling.blend = 15.0;
  telling.free = 2.5;
  const FittedSurface fit = fit_surface(samples, noise, telling);
  EXPECT_EQ(fit.surface.type, SurfaceType::plane);
  EXPECT_LT(fit.misfit, 2.5);
  // Where no plane is near it is as good as a free area, whatever fits it.
  std::vector<SurfaceSample> bent = samples_of(
      [](double u, double v) {
        const double a = 0.6 * (u - 0.5), b = 0.6 * (v - 0.5);
        const Vector3d n(std::sin(a), std::sin(b) * std::cos(a), std::cos(a) * std::cos(b));
        return SurfaceSample{300.0 * n, n};
      },
      20, noise, 8);
  EXPECT_LT(fit_surface(bent, noise).misfit, 1.4);
  EXPECT_EQ(fit_surface(bent, noise, telling).misfit, 2.5);
}

TEST(SurfaceFit, AFreeSurfaceIsExactUpToItsDegree) {
  const SurfaceNoise noise{0.05, 1.0 * degree};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(0.3, -1.0, 0.6).normalized()).toRotationMatrix();
  const auto samples_to_degree = [&](int most) {
    std::vector<SurfaceSample> samples;
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j) {
        const double u = (i - 9.5) / 10.0, v = (j - 9.5) / 10.0;
        double z = 0.2 * u * u - 0.1 * u * v, by_u = 0.4 * u - 0.1 * v, by_v = -0.1 * u;
        if (most >= 3) z += 0.1 * u * u * v, by_u += 0.2 * u * v, by_v += 0.1 * u * u;
        if (most >= 4) z += 0.1 * v * v * v * v, by_v += 0.4 * v * v * v;
        const Vector3d p(30.0 * u, 30.0 * v, 30.0 * z);
        samples.push_back(
            {turn * p + Vector3d(5.0, 6.0, 7.0), turn * Vector3d(-by_u, -by_v, 1.0).normalized()});
      }
    return samples;
  };
  for (const int degree_of : {2, 3, 4}) {
    const std::vector<SurfaceSample> samples = samples_to_degree(degree_of);
    for (const int fitted : {2, 3, 4}) {
      const FittedSurface fit = fit_free_surface(samples, noise, fitted);
      EXPECT_EQ(fit.surface.type, SurfaceType::free);
      if (fitted < degree_of) {
        EXPECT_GT(fit.misfit, 1.0) << degree_of << " by " << fitted;
        continue;
      }
      // Heights are over the mean plane, not over the one they were made by.
      EXPECT_LT(fit.misfit, 0.3) << degree_of << " by " << fitted;
      const Surface larger = fit.surface.placed(Vector3d(1.0, 2.0, 3.0), 0.1);
      for (const SurfaceSample& s : samples)
        EXPECT_NEAR(larger.at(0.1 * s.point + Vector3d(1.0, 2.0, 3.0)).distance,
                    0.1 * fit.surface.at(s.point).distance, 1e-9);
    }
  }
}

TEST(SurfaceFit, ABlendAlongACurveHasOneRadius) {
  // Rolled along a curve that bends to and fro: no torus explains it.
  const SurfaceNoise noise{0.05, 2.0 * degree};
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](double u, double v) {
      const double x = 80.0 * u, y = 8.0 * std::sin(x / 12.0),
                   slope = 8.0 / 12.0 * std::cos(x / 12.0);
      const Vector3d along = Vector3d(1.0, slope, 0.0).normalized();
      const double a = 1.4 * v;
      const Vector3d n =
          std::cos(a) * Vector3d::UnitZ() + std::sin(a) * along.cross(Vector3d::UnitZ());
      return SurfaceSample{Vector3d(x, y, 0.0) + 4.0 * n, side * n};
    };
    const std::vector<SurfaceSample> samples = samples_of(at, 24, noise, 3);
    EXPECT_GT(fit_surface(samples, noise).misfit, 3.0);
    const std::optional<FittedSurface> blend = fit_blend(samples, noise, 3.0);
    ASSERT_TRUE(blend);
    EXPECT_EQ(blend->surface.type, SurfaceType::blend);
    EXPECT_EQ(blend->surface.side, side);
    EXPECT_NEAR(blend->surface.tube, 4.0, 0.15);
    EXPECT_EQ(size_text(blend->surface, LengthUnit::unknown).substr(0, 2), "r ");
  }
  // A saddle is none.
  EXPECT_FALSE(fit_blend(samples_of(
                             [](double u, double v) {
                               const double x = 30.0 * (u - 0.5), y = 30.0 * (v - 0.5);
                               return SurfaceSample{{x, y, (x * x - y * y) / 20.0},
                                                    Vector3d(-x, y, 10.0).normalized()};
                             },
                             24, noise, 4),
                         noise, 3.0));
}

TEST(PartitionSurfaces, AreExactOnScansWithNoise) {
  // The promises to who rebuilds the part: sigma 0.03 mm.
  constexpr double sigma = 0.03, h = 0.25;
  const auto scanned = [&](const Triangles& clean, std::uint64_t seed) {
    return noisy(clean, sigma / mesh_of(clean)->mean_edge_length(), seed);
  };
  const auto whole = [](const Triangles& part) {  // as one partition
    return applied(document_of(part),
                   {"find_partitions", {{"intervals", {{0.0, nullptr}}}, {"fill_holes", 1000000}}});
  };
  const double radius = 10.0, arc = 90.0 * degree;
  const Document cylinder =
      whole(scanned(shaped_lattice(radius * arc, h,
                                   [&](double x, double y) {
                                     return Point(radius * std::cos(x / radius),
                                                  radius * std::sin(x / radius), y);
                                   }),
                    1));
  ASSERT_EQ(cylinder.partitions.partitions.size(), 1u);
  const PartitionSurface c = surfaces_of(cylinder).front();
  EXPECT_EQ(c.surface.type, SurfaceType::cylinder);
  EXPECT_NEAR(c.surface.radius, radius, 0.01);
  EXPECT_NEAR(c.mean_deviation, sigma * std::sqrt(2.0 / std::numbers::pi), 0.3 * sigma);
  EXPECT_GT(c.within, 0.98);

  const double half = 12.0 * degree;
  const Document cone = whole(scanned(
      shaped_lattice(30.0, h,
                     [&](double x, double y) {
                       const double l = 60.0 + x, turn = y / 20.0;
                       return Point(l * std::sin(half) * std::cos(turn),
                                    l * std::sin(half) * std::sin(turn), l * std::cos(half));
                     }),
      2));
  const PartitionSurface k = surfaces_of(cone).front();
  EXPECT_EQ(k.surface.type, SurfaceType::cone);
  EXPECT_NEAR(k.surface.half_angle / degree, 12.0, 0.1);

  const Vector3d normal = Vector3d(0.2, -0.1, 1.0).normalized();
  const Document plane = whole(
      scanned(shaped_lattice(20.0, h,
                             [&](double x, double y) {
                               return Point(x, y, -(normal.x() * x + normal.y() * y) / normal.z());
                             }),
              3));
  const PartitionSurface p = surfaces_of(plane).front();
  EXPECT_EQ(p.surface.type, SurfaceType::plane);
  EXPECT_LT(std::acos(std::min(1.0, p.surface.axis.dot(normal))) / degree, 0.01);
}

// ---- areas ----

TEST(FindPartitions, OneSurfaceIsOnePartition) {
  const std::vector<std::pair<std::string, Triangles>> parts{
      {"sphere", icosphere(15.0, 5)},
      {"torus", torus(20.0, 8.0, 120, 60)},
      {"plane", noisy_plane(40.0, 0.8, 0.0, 0.2, 3)},
      {"cone", shaped_lattice(30.0, 0.6, [](double x, double y) {
         const double l = 30.0 + x, turn = y / 12.0;
         return Point(0.3 * l * std::cos(turn), 0.3 * l * std::sin(turn), 0.95 * l);
       })}};
  for (const auto& [name, clean] : parts)
    for (const double noise : {0.05, 0.1, 0.2}) {
      const Document document = found(noisy(clean, noise, 11));
      EXPECT_EQ(document.partitions.partitions.size(), 1u) << name << " " << noise;
      EXPECT_DOUBLE_EQ(assigned_share(document), 1.0);
    }
}

TEST(FindPartitions, APlaneEndsWhereACylinderBegins) {
  // No edge parts them, only the curvature.
  for (const double radius : {8.0, 20.0})
    for (const double noise : {0.0, 0.05, 0.1}) {
      const Document document = found(noisy(bent_strip(radius, 40.0, 0.7), noise, 2));
      EXPECT_EQ(document.lines.lines.size(), 0u);
      EXPECT_EQ(document.partitions.partitions.size(), 2u) << radius << " " << noise;
      EXPECT_GT(agreement(document, [](const Point& p) { return p.x() < 0.0; }), 0.85)
          << radius << " " << noise;
      std::multiset<SurfaceType> types;
      for (const PartitionSurface& fit : surfaces_of(document)) types.insert(fit.surface.type);
      EXPECT_EQ(types, (std::multiset{SurfaceType::plane, SurfaceType::cylinder}))
          << radius << " " << noise;
    }
}

/// Off by up to `height` along z in waves that are `length` long.
Triangles wavy(Triangles mesh, double height, double length) {
  for (Point& p : mesh.points)
    p.z() += height * std::sin(2.0 * std::numbers::pi * p.x() / length) *
             std::sin(2.0 * std::numbers::pi * (p.y() + 0.3 * p.x()) / length);
  return mesh;
}

TEST(FindPartitions, AreThoseOfThePartHoweverFinelyItIsScanned) {
  // What a scanner is off by over long ways is more edges the finer the scan; a radius is, too.
  constexpr double length = 40.0;
  for (const double h : {0.7, 0.1}) {
    const Triangles scan = wavy(noisy(bent_strip(10.0, length, h), 0.05, 4), 0.005, 5.0);
    const Document document = found(scan);
    EXPECT_EQ(document.partitions.partitions.size(), 2u) << h;
    EXPECT_GT(agreement(document, [](const Point& p) { return p.x() < 0.0; }), 0.9) << h;
    std::multiset<SurfaceType> types;
    for (const PartitionSurface& fit : surfaces_of(document)) types.insert(fit.surface.type);
    EXPECT_EQ(types, (std::multiset{SurfaceType::plane, SurfaceType::cylinder})) << h;
  }
}

TEST(AreaTree, SamplesThatAreThinnedStandForAllThatWere) {
  // A large area takes up small ones a thousand times over: what each sample stands for stays true,
  // so that neither the old nor the new ones count for nothing.
  Random random(3);
  std::vector<SurfaceSample> samples;
  double old = 0.0, added = 0.0;
  for (int k = 0; k < 128; ++k, old += 50.0)
    samples.push_back({Vector3d::Zero(), Vector3d::UnitZ(), 50.0});
  for (int round = 0; round < 2000; ++round) {
    const double weight = 1.0 + 4.0 * random.uniform();
    samples.push_back({Vector3d::UnitX(), Vector3d::UnitZ(), weight});
    added += weight;
    samples = thinned(std::move(samples), 128);
    ASSERT_LE(samples.size(), 128u);
  }
  double kept_old = 0.0, kept_added = 0.0, most = 0.0;
  for (const SurfaceSample& s : samples) {
    (s.point.x() > 0.5 ? kept_added : kept_old) += s.weight;
    most = std::max(most, s.weight);
  }
  EXPECT_NEAR(kept_old + kept_added, old + added, 1e-6 * (old + added));
  EXPECT_NEAR(kept_added, added, 0.1 * (old + added));
  EXPECT_LT(most, 3.0 * (old + added) / 128.0);
}

/// A floor and a wall that runs along a curve, bent to and fro by up to `bend`, with a fillet of
/// `radius` between them: the curve is where the fillet begins.
Triangles filleted_wall(double radius, double bend, double length, double h) {
  struct Place {
    Point at;
    double heading;
  };
  constexpr int steps = 4000;
  std::vector<Place> curve{{Point::Zero(), 0.0}};
  for (int k = 0; k < steps; ++k) {
    const double s = (k + 0.5) / steps, step = length / steps;
    Place next = curve.back();
    next.heading += step * bend * std::sin(2.0 * std::numbers::pi * s);
    next.at += step * Point(std::cos(next.heading), std::sin(next.heading), 0.0);
    curve.push_back(next);
  }
  return shaped_lattice(length, h, [=](double x, double y) {
    const auto [at, heading] =
        curve[static_cast<std::size_t>(std::lround(std::clamp(x / length, 0.0, 1.0) * steps))];
    const Point inward(-std::sin(heading), std::cos(heading), 0.0);
    const double way = y - 0.25 * length, arc = radius * std::numbers::pi / 2.0;
    const double turn = std::clamp(way / radius, 0.0, std::numbers::pi / 2.0);
    const double in = std::min(way, 0.0) + radius * std::sin(turn),
                 up = radius * (1.0 - std::cos(turn)) + std::clamp(way - arc, 0.0, 0.25 * length);
    return Point(at + in * inward + up * Point::UnitZ());
  });
}

TEST(FindPartitions, AFilletAlongACurveIsOneBlend) {
  constexpr double h = 0.7, radius = 4.0 * h;
  const auto in_fillet = [](const Point& p) {
    return p.z() > 0.05 * radius && p.z() < 0.95 * radius;
  };
  const Triangles clean = filleted_wall(radius, 0.025 / h, 80.0 * h, h);
  for (const double noise : {0.0, 0.05, 0.1}) {
    // The noise may part a fillet now and then: that is not the rule.
    int whole = 0, blends = 0;
    constexpr int scans = 7;
    for (int scan = 0; scan < scans; ++scan) {
      const Document document = found(noisy(clean, noise, 5 + static_cast<std::uint64_t>(scan)));
      const Mesh& mesh = *document.mesh;
      whole += agreement(document, in_fillet) > 0.7;
      // Its partition, and what the table says of it.
      std::map<std::uint32_t, double> areas;
      for (FaceId f = 0; f < mesh.face_count(); ++f)
        if (in_fillet(centre_of(mesh, f)))
          areas[document.partitions.labels[f]] += face_area(mesh, f);
      const std::uint32_t fillet = std::ranges::max_element(areas, {}, [](const auto& entry) {
                                     return entry.second;
                                   })->first;
      const std::vector<PartitionSurface> surfaces = surfaces_of(document);
      for (std::size_t k = 0; k < surfaces.size(); ++k)
        blends += document.partitions.partitions[k]->id == fillet &&
                  surfaces[k].surface.type == SurfaceType::blend &&
                  std::abs(surfaces[k].surface.tube - radius) <= 0.06 * radius;
    }
    EXPECT_GE(whole, 5) << noise;
    EXPECT_GE(blends, 5) << noise;
  }
}

/// A wall of a tube and its rim, `width` wide, both edges of it rounded as a scan rounds them.
Triangles rim_of_tube(double around, double width, double rounding, double wall, double h) {
  const double arc = rounding * std::numbers::pi / 2.0, flat = width - 2.0 * rounding;
  return shaped_lattice(around, h, [=](double x, double y) {
    // Along the profile: up the outer wall, over the rim, down the inner one.
    double way = y * (2.0 * wall + 2.0 * arc + flat) / around, out = rounding, up = 0.0;
    const auto spent = [&](double length) {
      const double part = std::clamp(way, 0.0, length);
      way -= part;
      return part;
    };
    up += spent(wall);
    double turn = spent(arc) / rounding;
    out -= rounding * (1.0 - std::cos(turn));
    up += rounding * std::sin(turn);
    out -= spent(flat);
    turn = spent(arc) / rounding;
    out -= rounding * std::sin(turn);
    up -= rounding * (1.0 - std::cos(turn));
    up -= std::max(way, 0.0);
    const double radius = around / 5.0, angle = x / radius;
    return Point((radius + out) * std::cos(angle), (radius + out) * std::sin(angle), up);
  });
}

TEST(FindPartitions, ANarrowRimIsOnePartition) {
  // Two and a half edges between two lines: hardly a face of it is not rounded, so that no surface
  // explains its pieces, and none parts them either.
  constexpr double h = 0.7, wall = 20.0 * h;
  for (const double noise : {0.0, 0.05, 0.1}) {
    int pieces = 0;
    constexpr int scans = 5;
    for (int scan = 0; scan < scans; ++scan) {
      const Document document = found(noisy(rim_of_tube(60.0 * h, 2.5 * h, 0.8 * h, wall, h), noise,
                                            7 + static_cast<std::uint64_t>(scan)));
      EXPECT_EQ(document.lines.lines.size(), 2u);
      std::set<std::uint32_t> on_rim;
      for (FaceId f = 0; f < document.mesh->face_count(); ++f)
        if (centre_of(*document.mesh, f).z() > wall + 0.7 * h)
          on_rim.insert(document.partitions.labels[f]);
      pieces += static_cast<int>(on_rim.size());
    }
    EXPECT_LE(pieces, scans + 1) << noise;
  }
}

TEST(FindPartitions, SidesBetweenLinesAreOneEach) {
  for (const double noise : {0.0, 0.05, 0.15}) {
    EXPECT_EQ(found(noisy(divided_cube(20.0, 24), noise, 4)).partitions.partitions.size(), 6u)
        << noise;
    EXPECT_EQ(found(noisy(capped_cylinder(12.0, 20.0, 90, 24, 14), noise, 4))
                  .partitions.partitions.size(),
              3u)
        << noise;
  }
  EXPECT_EQ(found(cube(12.0)).partitions.partitions.size(), 6u);
}

TEST(FindPartitions, CoverEveryFaceAndNeverReachOverALine) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Document document = found(random_terrain(40, seed));
    EXPECT_DOUBLE_EQ(assigned_share(document), 1.0);
    // Connected without crossing lines, and no smaller than asked for unless enclosed.
    const std::uint32_t least = document.step("find_partitions")->parameters.at("min_faces");
    for (const PartitionPtr& partition : document.partitions.partitions) {
      std::set<FaceId> reached;
      std::vector<FaceId> front;
      bool enclosed = true;
      for (FaceId f = 0; f < document.mesh->face_count() && front.empty(); ++f)
        if (document.partitions.labels[f] == partition->id) front.push_back(f);
      reached.insert(front.front());
      for (std::size_t i = 0; i < front.size(); ++i) {
        HalfEdgeId h = document.mesh->face_half_edge(front[i]);
        for (int k = 0; k < 3; ++k, h = document.mesh->next(h)) {
          const FaceId g = document.mesh->face(Mesh::opposite(h));
          if (g == no_id || document.lines.is_sharp(h >> 1)) continue;
          if (document.partitions.labels[g] != partition->id)
            enclosed = false;
          else if (reached.insert(g).second)
            front.push_back(g);
        }
      }
      EXPECT_EQ(reached.size(), partition->faces) << "seed " << seed;
      EXPECT_TRUE(enclosed || partition->faces >= least) << "seed " << seed;
    }
  }
}

TEST(FindPartitions, DetailGoesFromFewToMany) {
  const Document lined =
      applied(document_of(noisy(torus(20.0, 6.0, 120, 40), 0.1, 9)), {"find_sharp_lines"});
  std::size_t before = 0;
  for (const double detail : {0.05, 0.2, 1.0, 3.0, 20.0}) {
    const Document document = applied(lined, {"find_partitions", {{"detail", detail}}});
    EXPECT_GE(document.partitions.partitions.size(), before) << detail;
    before = document.partitions.partitions.size();
  }
  EXPECT_GT(before, 5u);
  const Result<Document> refused = apply(lined, {"find_partitions", {{"detail", 0.0}}});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("detail"), std::string::npos);
}

TEST(FindPartitions, DoNotDependOnUnitOrPlace) {
  const Triangles part = noisy(bent_strip(10.0, 36.0, 0.8), 0.08, 6);
  const Document here = found(part);
  // Powers of two change no digit of any float: the very same labels.
  for (const double scale : {0x1p-10, 0x1p10}) {
    const Document there = found(moved(part, scale, Eigen::Matrix3d::Identity(), Point::Zero()));
    EXPECT_EQ(here.partitions.labels, there.partitions.labels) << scale;
  }
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Point(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const Document there = found(moved(part, 25.4, turn, Point(3.0, 2.0, 1.0) * 100.0));
  ASSERT_EQ(there.partitions.partitions.size(), here.partitions.partitions.size());
  double same = 0.0;
  for (FaceId f = 0; f < here.mesh->face_count(); ++f)
    same += here.partitions.labels[f] == there.partitions.labels[f];
  EXPECT_GT(same / static_cast<double>(here.mesh->face_count()), 0.97);
}

TEST(FindPartitions, AreTheSameWhateverTheNumberOfThreads) {
  const Triangles part = noisy(capped_cylinder(14.0, 18.0, 100, 26, 16), 0.2, 8);
  std::string first;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const ThreadLimit limit(threads);
    const std::string hash = hash_of(found(part));
    if (first.empty()) first = hash;
    EXPECT_EQ(hash, first) << threads;
  }
}

TEST(FindPartitions, LockedOnesStayAndTheRestGoesRoundThem) {
  Document document = found(noisy(bent_strip(10.0, 36.0, 0.8), 0.05, 6));
  const PartitionPtr kept = document.partitions.partitions.front();
  document = applied(document, {"lock", {{"partitions", {kept->id}}}});
  const Document again = applied(document, {"find_partitions", {{"detail", 20.0}}});
  const Partition* still = again.partitions.find(kept->id);
  ASSERT_NE(still, nullptr);
  EXPECT_EQ(still->faces, kept->faces);
  EXPECT_TRUE(still->locked);
  EXPECT_DOUBLE_EQ(assigned_share(again), 1.0);
}

TEST(FindPartitions, CorrectionsAreDoneAgain) {
  Document document = found(noisy(bent_strip(10.0, 36.0, 0.8), 0.05, 6));
  ASSERT_EQ(document.partitions.partitions.size(), 2u);
  document =
      applied(document,
              {"connect_partitions",
               {{"partitions",
                 {document.partitions.partitions[0]->id, document.partitions.partitions[1]->id}}}});
  ASSERT_EQ(document.partitions.partitions.size(), 1u);
  const Document again = applied(document, {"find_partitions", {{"detail", 1.1}}});
  EXPECT_EQ(again.partitions.partitions.size(), 1u);
}

TEST(FindPartitions, ARowOfTheFirstVersionIsFronts) {
  const Document lined = applied(document_of(divided_cube(10.0, 10)), {"find_sharp_lines"});
  const Operation old = value_of(
      Operation::parse(R"({"operation": "find_partitions", "version": 1, "criterion": "kabs",
                           "intervals": [[0.0, 1.0]], "min_faces": 1, "fill_holes": 0,
                           "corrections": true})"));
  const Document replayed = applied(lined, old);
  EXPECT_EQ(replayed.partition_method(), PartitionMethod::fronts);
  EXPECT_EQ(replayed.partitions.partitions.size(), 6u);
  // Who names intervals means fronts; otherwise it is surfaces.
  EXPECT_EQ(applied(lined, {"find_partitions", {{"intervals", {{0.0, 1.0}}}}}).partition_method(),
            PartitionMethod::fronts);
  EXPECT_EQ(applied(lined, {"find_partitions"}).partition_method(), PartitionMethod::surfaces);
}

TEST(AreaTree, IsGrownOnceForTheSameLines) {
  const Document lined =
      applied(document_of(noisy(divided_cube(20.0, 16), 0.1, 1)), {"find_sharp_lines"});
  const SharedAreaTree shared(lined.mesh);
  const AreaTreePtr tree = value_of(shared.get(lined.lines));
  EXPECT_EQ(value_of(shared.get(lined.lines)), tree);
  SharpLines none;
  const AreaTreePtr other = value_of(shared.get(none));
  EXPECT_NE(other, tree);
  for (std::size_t k = 1; k < other->joins.size(); ++k)
    EXPECT_LE(other->joins[k - 1].height, other->joins[k].height);
}

TEST(AreaTree, CancelledLeavesTheDocumentAsItWas) {
  const Document lined =
      applied(document_of(noisy(divided_cube(20.0, 16), 0.1, 1)), {"find_sharp_lines"});
  std::stop_source stop;
  stop.request_stop();
  const Result<Document> stopped =
      apply(lined, {"find_partitions"}, Context(nullptr, stop.get_token()));
  ASSERT_FALSE(stopped);
  EXPECT_TRUE(stopped.error().cancelled);
}

}  // namespace
}  // namespace arris
