// Clean tessellations: see shapes.h.

#include <array>
#include <cmath>
#include <map>

#include "tests/bench/accuracy/curves.h"
#include "tests/bench/accuracy/shapes.h"

namespace arris::accuracy {

namespace {

/// Surface of a block whose sides are divided so often along x, y and z: few divisions along one
/// axis and many along another make slivers, one along each two large triangles a side.
testing::Triangles divided_block(const Point& size, const std::array<int, 3>& divisions) {
  testing::Triangles mesh;
  std::map<std::array<int, 3>, VertexId> known;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, fresh] = known.try_emplace(at, static_cast<VertexId>(mesh.points.size()));
    if (fresh)
      mesh.points.emplace_back(size.x() * at[0] / divisions[0], size.y() * at[1] / divisions[1],
                               size.z() * at[2] / divisions[2]);
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int j = 0; j < divisions[v]; ++j)
        for (int i = 0; i < divisions[u]; ++i) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> at{};
            at[axis] = high ? divisions[axis] : 0;
            at[u] = i + a;
            at[v] = j + b;
            return vertex(at);
          };
          const VertexId a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (high) {
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
          } else {
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({a, d, c});
          }
        }
    }
  return mesh;
}

/// Patches by `patch_of(centre, normal)`.
template <class PatchOf>
CleanPart with_patches(testing::Triangles mesh, std::vector<TrueCurve> curves,
                       const PatchOf& patch_of) {
  CleanPart part{std::move(mesh), {std::move(curves), {}, {}}};
  for (const Triangle& t : part.mesh.triangles) {
    const Point &a = part.mesh.points[t[0]], &b = part.mesh.points[t[1]],
                &c = part.mesh.points[t[2]];
    part.truth.patches.push_back(
        patch_of(Point((a + b + c) / 3.0), Point((b - a).cross(c - a).normalized())));
  }
  return part;
}

CleanPart block_part(const Point& size, const std::array<int, 3>& divisions) {
  return with_patches(divided_block(size, divisions), block_edges(Point::Zero(), size),
                      [](const Point&, const Point& normal) {
                        Eigen::Index axis = 0;
                        normal.cwiseAbs().maxCoeff(&axis);
                        return static_cast<std::uint32_t>(1 + 2 * axis + (normal[axis] > 0.0));
                      });
}

/// The circle a tessellation has: straight between its corners.
TrueCurve polygon(double radius, double z, int sectors, double angle) {
  TrueCurve curve{{}, Demand::must, angle};
  for (int k = 0; k <= sectors; ++k) {
    const double t = 2.0 * std::numbers::pi * (k % sectors) / sectors;
    curve.points.emplace_back(radius * std::cos(t), radius * std::sin(t), z);
  }
  return curve;
}

std::uint32_t patch_by_slope(const Point&, const Point& normal) {
  return normal.z() > 0.9 ? 3 : normal.z() < -0.9 ? 2 : 1;
}

/// With few sectors the edges between the facets of the wall may be lines or not.
void add_facet_edges(double radius, double height, double top_radius, int sectors,
                     std::vector<TrueCurve>& curves) {
  const double turn = 360.0 / sectors;
  if (turn < may_angle) return;
  for (int k = 0; k < sectors; ++k) {
    const double t = 2.0 * std::numbers::pi * k / sectors;
    const Point direction(std::cos(t), std::sin(t), 0.0);
    curves.push_back(segment(radius * direction, top_radius * direction + height * Point::UnitZ(),
                             turn, Demand::may));
  }
}

CleanPart cylinder_part(int sectors, int along, int rings) {
  const double radius = 15.0, height = 30.0;
  std::vector<TrueCurve> curves{polygon(radius, 0.0, sectors, 90.0),
                                polygon(radius, height, sectors, 90.0)};
  add_facet_edges(radius, height, radius, sectors, curves);
  return with_patches(testing::capped_cylinder(radius, height, sectors, along, rings),
                      std::move(curves), patch_by_slope);
}

CleanPart cone_part(int sectors, int along) {
  const double radius = 20.0, height = 34.0;
  const double angle = 180.0 - std::atan2(height, radius) * 180.0 / std::numbers::pi;
  return with_patches(testing::cone(radius, height, sectors, along),
                      {polygon(radius, 0.0, sectors, angle)}, patch_by_slope);
}

CleanPart smooth_part(testing::Triangles mesh) {
  return with_patches(std::move(mesh), {}, [](const Point&, const Point&) { return 1u; });
}

}  // namespace

std::vector<CadMesh> cad_meshes() {
  return {
      {"cad_cube_12",
       [] {
         return block_part(Point::Constant(40.0), {1, 1, 1});
       }},
      {"cad_cube_divided",
       [] {
         return block_part(Point::Constant(40.0), {20, 20, 20});
       }},
      {"cad_box_slivers",
       [] {
         return block_part({40.0, 32.0, 24.0}, {60, 1, 1});
       }},
      {"cad_box_uneven",
       [] {
         return block_part({40.0, 32.0, 24.0}, {80, 6, 1});
       }},
      {"cad_cylinder_12", [] { return cylinder_part(12, 1, 1); }},
      {"cad_cylinder_96", [] { return cylinder_part(96, 1, 1); }},
      {"cad_cylinder_96_even", [] { return cylinder_part(96, 30, 15); }},
      {"cad_cone_64", [] { return cone_part(64, 1); }},
      {"cad_sphere", [] { return smooth_part(testing::icosphere(18.0, 4)); }},
      {"cad_torus", [] { return smooth_part(testing::torus(20.0, 8.0, 96, 40)); }},
  };
}

}  // namespace arris::accuracy
