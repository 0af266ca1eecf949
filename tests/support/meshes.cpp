#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "core/base/random.h"

namespace arris::testing {

namespace {

constexpr double pi = std::numbers::pi;

int steps(double length, double h) {
  return std::max(1, static_cast<int>(std::lround(length / h)));
}

/// Lattice of columns x rows cells, or closed on itself in a direction. With position(i, j), u x v
/// is the side the faces look to. All diagonals run the same way: valence 6.
Triangles lattice(int columns, int rows, bool closed_columns, bool closed_rows,
                  const std::function<Point(int, int)>& position) {
  const int across = closed_columns ? columns : columns + 1;
  const int down = closed_rows ? rows : rows + 1;
  Triangles result;
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) result.points.push_back(position(i, j));
  const auto id = [&](int i, int j) {
    return static_cast<VertexId>((j % down) * across + i % across);
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const VertexId a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      result.triangles.push_back({a, b, c});
      result.triangles.push_back({a, c, d});
    }
  return result;
}

/// Points (s, z) of a profile, drawn along y over `length`; looks to the left of the profile.
Triangles extruded(const std::vector<std::array<double, 2>>& profile, double length, double h) {
  const int along = steps(length, h);
  return lattice(static_cast<int>(profile.size()) - 1, along, false, false, [&](int i, int j) {
    return Point(profile[i][0], length * j / along, profile[i][1]);
  });
}

/// Joins vertices at the very same place.
Triangles welded(const Triangles& soup) {
  Triangles result;
  std::map<std::array<double, 3>, VertexId> known;
  std::vector<VertexId> id;
  for (const Point& p : soup.points) {
    const auto [place, is_new] =
        known.try_emplace({p.x(), p.y(), p.z()}, static_cast<VertexId>(result.points.size()));
    if (is_new) result.points.push_back(p);
    id.push_back(place->second);
  }
  for (const Triangle& t : soup.triangles)
    result.triangles.push_back({id[t[0]], id[t[1]], id[t[2]]});
  return result;
}

void append(Triangles& to, const Triangles& part) {
  const auto offset = static_cast<VertexId>(to.points.size());
  to.points.insert(to.points.end(), part.points.begin(), part.points.end());
  for (const Triangle& t : part.triangles)
    to.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

/// Surface of revolution about z of the profile (radius, z), whose ends may lie on the axis. A
/// profile that rises at a positive radius looks away from the axis.
Triangles revolved(const std::vector<std::array<double, 2>>& profile, int around) {
  Triangles result;
  std::vector<VertexId> first;
  for (const auto& [radius, z] : profile) {
    first.push_back(static_cast<VertexId>(result.points.size()));
    const int count = radius == 0.0 ? 1 : around;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * pi * i / around;
      result.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  const auto id = [&](std::size_t j, int i) {
    return first[j] + static_cast<VertexId>(profile[j][0] == 0.0 ? 0 : i % around);
  };
  for (std::size_t j = 0; j + 1 < profile.size(); ++j)
    for (int i = 0; i < around; ++i) {
      const VertexId a = id(j, i), b = id(j, i + 1), c = id(j + 1, i + 1), d = id(j + 1, i);
      if (a != b) result.triangles.push_back({a, b, c});
      if (c != d) result.triangles.push_back({a, c, d});
    }
  return result;
}

}  // namespace

MeshPtr mesh_of(const Triangles& triangles) {
  Result<MeshPtr> mesh = Mesh::create(triangles.points, triangles.triangles);
  if (!mesh) throw std::logic_error("mesh_of: " + mesh.error().message);
  return std::move(*mesh);
}

Triangles cube(double size) { return divided_cube(size, 1); }

Triangles divided_cube(double size, int divisions) {
  Triangles sides;
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, 1})
      append(sides, lattice(divisions, divisions, false, false, [&](int i, int j) {
               Point p;
               p[axis] = size * end;
               p[(axis + 1) % 3] = size * (end ? i : j) / divisions;
               p[(axis + 2) % 3] = size * (end ? j : i) / divisions;
               return p;
             }));
  return welded(sides);
}

Triangles box_corner(int sectors_a, int sectors_b, int sectors_c) {
  const std::array<int, 3> sectors{sectors_a, sectors_b, sectors_c};
  Triangles soup;
  for (int side = 0; side < 3; ++side) {
    const Point u = Point::Unit(side), v = Point::Unit((side + 1) % 3);
    // From u (i = 0) to v; the ends are exact so that the sides meet.
    const auto ray = [&](int i) -> Point {
      if (i == 0) return u;
      if (i == sectors[side]) return v;
      if (2 * i == sectors[side]) return u + v;
      const double angle = pi / 2.0 * i / sectors[side];
      const Point direction = std::cos(angle) * u + std::sin(angle) * v;
      return direction / direction.maxCoeff();
    };
    for (int i = 0; i < sectors[side]; ++i) {
      Triangles part{{Point::Zero(), ray(i + 1), ray(i)}, {{0, 1, 2}}};
      if (2 * i + 1 == sectors[side]) {  // the sector over the far corner of the square
        part.points.push_back(u + v);
        part.triangles.push_back({1, 3, 2});
      }
      append(soup, part);
    }
  }
  return welded(soup);
}

Triangles icosphere(double radius, int subdivisions) {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  Triangles mesh{
      {{-1, t, 0},
       {1, t, 0},
       {-1, -t, 0},
       {1, -t, 0},
       {0, -1, t},
       {0, 1, t},
       {0, -1, -t},
       {0, 1, -t},
       {t, 0, -1},
       {t, 0, 1},
       {-t, 0, -1},
       {-t, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Point& p : mesh.points) p.normalize();
  for (int level = 0; level < subdivisions; ++level) {
    std::map<EdgeVertices, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
      const auto [place, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                       static_cast<VertexId>(mesh.points.size()));
      if (is_new) mesh.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& f : mesh.triangles) {
      const VertexId a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.push_back({f[0], a, c});
      finer.push_back({f[1], b, a});
      finer.push_back({f[2], c, b});
      finer.push_back({a, b, c});
    }
    mesh.triangles = std::move(finer);
  }
  for (Point& p : mesh.points) p *= radius;
  return mesh;
}

Triangles irregular_sphere(double radius, int vertices, std::uint64_t seed) {
  Triangles hull;
  // An octahedron to start from, so that the hull holds the centre from the first point on.
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) hull.points.push_back(sign * Point::Unit(axis));
  for (VertexId x : {0, 1})
    for (VertexId y : {2, 3})
      for (VertexId z : {4, 5})
        hull.triangles.push_back((x + y + z) % 2 ? Triangle{x, z, y} : Triangle{x, y, z});
  Random random(seed);
  std::set<EdgeVertices> rim;
  while (hull.points.size() < static_cast<std::size_t>(vertices)) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 2.0 * pi);
    const double r = std::sqrt(1.0 - z * z);
    const Point p(r * std::cos(angle), r * std::sin(angle), z);
    const auto id = static_cast<VertexId>(hull.points.size());
    rim.clear();
    std::erase_if(hull.triangles, [&](const Triangle& t) {
      const Point& a = hull.points[t[0]];
      const Point normal = (hull.points[t[1]] - a).cross(hull.points[t[2]] - a);
      if (normal.dot(p - a) <= 0.0) return false;
      for (int k = 0; k < 3; ++k)
        if (!rim.erase({t[(k + 1) % 3], t[k]})) rim.insert({t[k], t[(k + 1) % 3]});
      return true;
    });
    hull.points.push_back(p);
    for (const auto& [from, to] : rim) hull.triangles.push_back({from, to, id});
  }
  for (Point& p : hull.points) p *= radius;
  return hull;
}

Triangles torus(double major_radius, double minor_radius, int major_steps, int minor_steps) {
  return lattice(major_steps, minor_steps, true, true, [&](int i, int j) {
    const double around = 2.0 * pi * i / major_steps, tube = 2.0 * pi * j / minor_steps;
    const double r = major_radius + minor_radius * std::cos(tube);
    return Point(r * std::cos(around), r * std::sin(around), minor_radius * std::sin(tube));
  });
}

Triangles block_with_holes(int genus) {
  const auto full = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z != 0 || x > 2 * genus || y > 2) return false;
    return !(x % 2 == 1 && y == 1);
  };
  Triangles soup;
  for (int x = 0; x <= 2 * genus; ++x)
    for (int y = 0; y <= 2; ++y) {
      if (!full(x, y, 0)) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, 1}) {
          std::array<int, 3> beyond{x, y, 0};
          beyond[axis] += end ? 1 : -1;
          if (full(beyond[0], beyond[1], beyond[2])) continue;
          append(soup, lattice(1, 1, false, false, [&](int i, int j) {
                   Point p(x, y, 0);
                   p[axis] += end;
                   p[(axis + 1) % 3] += end ? i : j;
                   p[(axis + 2) % 3] += end ? j : i;
                   return p;
                 }));
        }
    }
  return welded(soup);
}

Triangles cylinder_wall(double radius, double height, int around, int along) {
  return lattice(around, along, true, false, [&](int i, int j) {
    const double angle = 2.0 * pi * i / around;
    return Point(radius * std::cos(angle), radius * std::sin(angle), height * j / along);
  });
}

Triangles capped_cylinder(double radius, double height, int around, int along, int rings) {
  std::vector<std::array<double, 2>> profile;
  for (int k = 0; k < rings; ++k) profile.push_back({radius * k / rings, 0.0});
  for (int k = 0; k <= along; ++k) profile.push_back({radius, height * k / along});
  for (int k = rings - 1; k >= 0; --k) profile.push_back({radius * k / rings, height});
  return revolved(profile, around);
}

Triangles cone(double radius, double height, int around, int along) {
  std::vector<std::array<double, 2>> profile;
  for (int k = 0; k < along; ++k) profile.push_back({radius * k / along, 0.0});
  for (int k = along; k >= 0; --k)
    profile.push_back({radius * k / along, height * (along - k) / along});
  return revolved(profile, around);
}

Triangles stepped_plate(double half_width, double length, double step, double h) {
  const int across = steps(half_width, h), up = steps(std::abs(step), h);
  std::vector<std::array<double, 2>> profile;
  for (int i = -across; i < 0; ++i) profile.push_back({half_width * i / across, 0.0});
  for (int i = 0; i < up; ++i) profile.push_back({0.0, step * i / up});
  for (int i = 0; i <= across; ++i) profile.push_back({half_width * i / across, step});
  return extruded(profile, length, h);
}

Triangles roof(double angle, double half_width, double length, double h) {
  const int across = steps(half_width, h);
  std::vector<std::array<double, 2>> profile;
  for (int i = -across; i <= across; ++i) {
    const double s = half_width * i / across;
    profile.push_back({s * std::cos(angle / 2.0), -std::abs(s) * std::sin(angle / 2.0)});
  }
  return extruded(profile, length, h);
}

Triangles noisy_plane(double size, double h, double sigma, double jitter, std::uint64_t seed) {
  Random random(seed);
  const int n = steps(size, h);
  const double spacing = size / n;
  return lattice(n, n, false, false, [&](int i, int j) {
    const double x = spacing * (i + random.uniform(-jitter, jitter));
    const double y = spacing * (j + random.uniform(-jitter, jitter));
    return Point(x, y, sigma * random.gaussian());
  });
}

Triangles ellipsoid(double a, double b, double c, int subdivisions) {
  Triangles mesh = icosphere(1.0, subdivisions);
  for (Point& p : mesh.points) p = p.cwiseProduct(Point(a, b, c));
  return mesh;
}

Triangles random_terrain(int n, std::uint64_t seed) {
  Random random(seed);
  const double kx = random.uniform(0.2, 1.5), ky = random.uniform(0.2, 1.5);
  Triangles mesh = lattice(n, n, false, false, [&](int i, int j) {
    const double x = i + random.uniform(-0.2, 0.2), y = j + random.uniform(-0.2, 0.2);
    return Point(x, y, std::sin(kx * x) * std::cos(ky * y) + random.uniform(-0.2, 0.2));
  });
  for (std::size_t f = 0; f + 1 < mesh.triangles.size(); f += 2) {
    Triangle& first = mesh.triangles[f];
    Triangle& second = mesh.triangles[f + 1];
    if (random.uniform() < 0.5) {
      const VertexId a = first[0], b = first[1], c = first[2], d = second[2];
      first = {a, b, d};
      second = {b, c, d};
    }
  }
  return mesh;
}

Triangles noisy(const Triangles& mesh, double share, std::uint64_t seed) {
  Random random(seed);
  Triangles result = mesh;
  const MeshPtr clean = mesh_of(mesh);
  std::vector<Point> normals(mesh.points.size(), Point::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Point& a = mesh.points[t[0]];
    const Point normal = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
    for (const VertexId v : t) normals[v] += normal;
  }
  for (VertexId v = 0; v < normals.size(); ++v)
    result.points[v] +=
        share * clean->mean_edge_length() * random.gaussian() * normals[v].normalized();
  return result;
}

Triangles moved(const Triangles& mesh, double scale, const Eigen::Matrix3d& turn,
                const Point& shift) {
  Triangles result = mesh;
  for (Point& p : result.points) p = scale * (turn * p) + shift;
  return result;
}

}  // namespace arris::testing
