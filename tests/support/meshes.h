#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"

/// Meshes with known geometry, made by code. All closed ones have outward normals.
namespace arris::testing {

struct Triangles {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

/// Builds or fails the test at once.
MeshPtr mesh_of(const Triangles& triangles);

Triangles cube(double size = 1.0);                   ///< 8 vertices, 12 faces.
Triangles divided_cube(double size, int divisions);  ///< Each side a divisions^2 grid.
/// Corner (vertex 0) of a box with its three square sides open at the far ends; `sectors` holds,
/// for each of the three right angles, into how many equal angles it is split.
Triangles box_corner(int sectors_a, int sectors_b, int sectors_c);
Triangles icosphere(double radius, int subdivisions);
Triangles irregular_sphere(double radius, int vertices, std::uint64_t seed);  ///< Convex hull.
/// Valence-6 torus lattice about the z axis.
Triangles torus(double major_radius, double minor_radius, int major_steps, int minor_steps);
/// Closed surface of genus 0 to 3 (blocks with square holes).
Triangles block_with_holes(int genus);
/// Open valence-6 lattice on a cylinder about z: no caps.
Triangles cylinder_wall(double radius, double height, int around, int along);
Triangles capped_cylinder(double radius, double height, int around, int along, int rings);
Triangles cone(double radius, double height, int around, int along);  ///< With a flat base.
/// Two planes at different heights joined by a vertical wall: two straight sharp lines of opposite
/// sign along y. Grid spacing `h`, extent 2*half_width by length.
Triangles stepped_plate(double half_width, double length, double step, double h);
/// Roof of two planes whose exterior angle along the ridge (the y axis) is `angle` radians; convex.
Triangles roof(double angle, double half_width, double length, double h);
/// Square plane grid of side `size`, spacing `h`, Gaussian noise `sigma` along z (and in the plane
/// a jitter of `jitter`*h).
Triangles noisy_plane(double size, double h, double sigma, double jitter, std::uint64_t seed);
/// Ellipsoid with semi-axes a, b, c from a subdivided icosahedron.
Triangles ellipsoid(double a, double b, double c, int subdivisions);
/// A random bumpy terrain, open, for property tests.
Triangles random_terrain(int n, std::uint64_t seed);

/// Every vertex moved by `share` mean edges times a Gaussian number along its normal.
Triangles noisy(const Triangles& mesh, double share, std::uint64_t seed);
/// Every point p at scale * turn * p + shift; the faces stay as they are.
Triangles moved(const Triangles& mesh, double scale, const Eigen::Matrix3d& turn,
                const Point& shift);

}  // namespace arris::testing
