#include "core/partitions/continuation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace arris {

namespace {

/// The surfaces that one is made of.
std::span<const Surface> stretches(const Surface& surface) {
  return surface.parts ? std::span(*surface.parts) : std::span(&surface, 1);
}

/// Radius of the tube that a surface is a stretch of, negative where it is seen from within; 0:
/// none.
double tube_of(const Surface& surface, const ContinuationOptions& options) {
  switch (surface.type) {
    case SurfaceType::cylinder:
      return surface.side * surface.radius;
    case SurfaceType::torus:
      // To least squares a short stretch of tube may be the inner side of a wide ring.
      return surface.tube > options.widest && surface.radius > surface.tube
                 ? -surface.side * (surface.radius - surface.tube)
                 : surface.side * surface.tube;
    case SurfaceType::blend:
      return surface.side * surface.tube;
    default:
      return 0.0;
  }
}

/// Parts samples into `count` by the nearest of as many places that lie far from one another.
std::vector<std::vector<SurfaceSample>> parted(std::span<const SurfaceSample> samples,
                                               std::size_t count) {
  std::vector<std::size_t> nearest(samples.size(), 0);
  std::vector<double> distance(samples.size(), std::numeric_limits<double>::infinity());
  std::size_t place = 0;
  for (int round = 0; round < 2; ++round) {  // the first place: far from any
    for (std::size_t i = 0; i < samples.size(); ++i)
      distance[i] = (samples[i].point - samples[place].point).squaredNorm();
    place = static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin());
  }
  std::ranges::fill(distance, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (const double d = (samples[i].point - samples[place].point).squaredNorm();
          d < distance[i]) {
        distance[i] = d;
        nearest[i] = k;
      }
    place = static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin());
  }
  std::vector<std::vector<SurfaceSample>> parts(count);
  for (std::size_t i = 0; i < samples.size(); ++i) parts[nearest[i]].push_back(samples[i]);
  return parts;
}

}  // namespace

ContinuationOptions scaled(ContinuationOptions options, double scale) {
  options.flat *= scale;
  options.widest *= scale;
  return options;
}

double tear_between(const Surface& a, const Surface& b, const Eigen::Vector3d& place,
                    const ContinuationOptions& options) {
  double least = std::numeric_limits<double>::infinity();
  if (a.type == SurfaceType::free || b.type == SurfaceType::free) return least;
  // Of a chain the stretch that is met: others turn elsewhere there.
  for (const Surface& pa : stretches(a))
    for (const Surface& pb : stretches(b)) {
      const Eigen::Matrix3d bend_a = pa.bend_at(place), bend_b = pb.bend_at(place);
      const double bend = std::max(bend_a.norm(), bend_b.norm());
      if (!(bend * options.flat > 1.0)) continue;
      const double turn = (pa.at(place).normal - pb.at(place).normal).norm();
      least = std::min(least, std::max(turn / (options.shift * bend),
                                       (bend_a - bend_b).norm() / (options.bend * bend)));
    }
  return least;
}

Surface continued(const Surface& a, double weight_a, const Surface& b, double weight_b,
                  const ContinuationOptions& options) {
  std::vector<Surface> parts;
  for (const Surface* surface : {&a, &b})
    for (const Surface& stretch : stretches(*surface)) parts.push_back(stretch);
  Surface chain;
  chain.type = SurfaceType::chain;
  const double ta = tube_of(a, options), tb = tube_of(b, options);
  if (ta * tb > 0.0 && std::max(std::abs(ta), std::abs(tb)) <= options.widest) {
    chain.type = SurfaceType::blend;
    chain.side = ta > 0.0 ? 1.0 : -1.0;
    chain.tube = std::abs(weight_a * ta + weight_b * tb) / (weight_a + weight_b);
  }
  chain.parts = std::make_shared<const std::vector<Surface>>(std::move(parts));
  return chain;
}

std::optional<FittedSurface> fit_blend(std::span<const SurfaceSample> samples,
                                       const SurfaceNoise& noise, double most_misfit,
                                       const ContinuationOptions& options) {
  constexpr std::size_t least = 12;  // samples of a stretch
  for (const std::size_t count : {2U, 3U, 4U, 6U, 8U, 12U, 16U}) {
    if (samples.size() < count * least) break;
    std::optional<Surface> blend;
    double weight = 0.0;
    for (const std::vector<SurfaceSample>& part : parted(samples, count)) {
      if (part.size() < least / 2) continue;
      const Surface stretch = fit_surface(part, noise).surface;
      const double own = static_cast<double>(part.size());
      blend = blend ? continued(*blend, weight, stretch, own, options) : stretch;
      weight += own;
      if (blend->parts && blend->type != SurfaceType::blend) break;
    }
    if (!blend || blend->type != SurfaceType::blend) continue;
    const FittedSurface fit = judge_surface(samples, noise, *blend);
    const bool one_radius = std::ranges::all_of(*blend->parts, [&](const Surface& part) {
      return std::abs(tube_of(part, options) - blend->side * blend->tube) <=
             options.apart * blend->tube;
    });
    if (one_radius && fit.misfit <= most_misfit) return fit;
  }
  return std::nullopt;
}

}  // namespace arris
