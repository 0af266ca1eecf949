#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace arris {

/// What an area may be: the surfaces of CAD, the simplest first; several of them that continue one
/// another, as a blend of one radius along any curve or as some other chain; or none of them.
enum class SurfaceType : std::uint8_t { plane, sphere, cylinder, cone, torus, blend, chain, free };

std::string_view name_of(SurfaceType type);  ///< "plane", ..., "free".

/// A place of a surface as it was measured.
struct SurfaceSample {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< Unit.
  double weight = 1.0;
};

/// How far samples scatter about the surface that they are of.
struct SurfaceNoise {
  double distance = 1.0;  ///< In the unit of the points.
  double angle = 0.01;    ///< Radians, of one of the two angles of a normal.
};

/// A surface. Angles in radians, lengths in the unit of the points it was fitted to.
struct Surface {
  SurfaceType type = SurfaceType::free;
  /// plane: on it; sphere, torus: centre; cylinder: on the axis; cone: apex; free: origin of the
  /// height field.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// Unit. plane: normal; cylinder, cone, torus: axis, of a cone on the side that its normals lean
  /// to (normal . axis = sin(half_angle)); free: direction of heights.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 0.0;      ///< Of sphere and cylinder; of a torus, of its middle circle.
  double tube = 0.0;        ///< Of a torus or blend: radius of the tube.
  double half_angle = 0.0;  ///< Of a cone: between axis and surface, 0 to pi / 2.
  double side = 1.0;        ///< 1 where normals point away from axis or centre, -1: towards it.
  /// Of a free surface: height over the tangent directions x and y, as a polynomial: factors of 1,
  /// x, y, x^2, xy, y^2, ..., by degree.
  static constexpr int most_degree = 4;
  using Heights = Eigen::Matrix<double, (most_degree + 1) * (most_degree + 2) / 2, 1>;
  Heights heights = Heights::Zero();
  /// Of a blend or chain: the surfaces that it is made of, end to end.
  std::shared_ptr<const std::vector<Surface>> parts;

  /// Signed distance of a point along the surface's normal there, and that normal.
  struct At {
    double distance;
    Eigen::Vector3d normal;
  };
  At at(const Eigen::Vector3d& p) const;
  /// How that normal turns as p moves, d normal = bend d p: symmetric, its eigenvalues across the
  /// normal are the curvatures of the parallel surface through p. Of planes and free ones zero.
  Eigen::Matrix3d bend_at(const Eigen::Vector3d& p) const;
  /// The same surface where points p are at origin + unit * p.
  Surface placed(const Eigen::Vector3d& origin, double unit) const;
};

struct FittedSurface {
  Surface surface;
  /// Mean over the samples of half the squared distance and half the squared turn of the normal,
  /// both over the noise and limited; 1 where the noise is all.
  double misfit = 0.0;
};

struct SurfaceFitOptions {
  double most = 9.0;            // squares over the noise are limited to this
  double price = 1.0;           // of a parameter of the surface, in what it has to explain
  int steps = 8;                // of least squares after the first estimate
  std::size_t refined = 32;     // samples that they read
  double near = 8.9;            // misfit of that from which on they are not worth it
  double least_tube = 0.3;      // of a torus, in the unit of the points
  double largest_radius = 1e4;  // beyond it is a plane, in the unit of the points
  // Of a sphere or cylinder, and of a torus the lesser, from which on it says little of what an
  // area is: one that does so is rather chosen where it misses less than `free`; else misfits are
  // at least that.
  double wide = std::numeric_limits<double>::infinity();
  double blend = std::numeric_limits<double>::infinity();
  double free = 0.0;
};

/// The best of plane, sphere, cylinder, cone and torus.
FittedSurface fit_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                          const SurfaceFitOptions& options = {});

/// The surface of the same type as `start`, which is near already; misfit infinite for free ones.
FittedSurface refit_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                            const Surface& start, const SurfaceFitOptions& options = {});

/// How well a surface explains samples, as it is.
FittedSurface judge_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                            const Surface& surface, const SurfaceFitOptions& options = {});

/// A height field over the mean plane, of degree 2 to Surface::most_degree; misfit infinite where
/// the samples turn too far for one.
FittedSurface fit_free_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                               int degree = 2, const SurfaceFitOptions& options = {});

}  // namespace arris
