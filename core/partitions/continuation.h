#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "core/partitions/surface_fit.h"

namespace arris {

/// Surfaces that run on into one another, end to end, with slowly varying curvature: stretches of
/// tube of one radius along a curve, as a ball leaves them that rolls along two faces, or cylinders
/// whose radius changes little by little.

struct ContinuationOptions {
  /// By how far one of two surfaces is shifted against the other at most, for their normals to
  /// agree where they meet; in the unit of the points.
  double shift = 0.7;
  double bend = 0.2;     // by which their curvatures differ at most there, over the larger one
  double flat = 100.0;   // radius beyond which a surface continues nothing
  double widest = 15.0;  // radius of the tube up to which such surfaces are a blend
  double apart = 0.2;  // by which a stretch's radius differs from that of the blend at most, share
};

/// The same radii on a part `scale` times as many mean edges across (part_size).
ContinuationOptions scaled(ContinuationOptions options, double scale);

/// How badly two surfaces continue one another at a place where they meet: 1 where their normals
/// or curvatures differ by the most that is allowed. Infinite where both are flat or one is free.
double tear_between(const Surface& a, const Surface& b, const Eigen::Vector3d& place,
                    const ContinuationOptions& options = {});

/// Two surfaces as one chain, or as a blend where both are tubes, of the mean radius. Whether they
/// continue one another is not looked at. `weight_a`, `weight_b`: how much each says of the radius.
Surface continued(const Surface& a, double weight_a, const Surface& b, double weight_b,
                  const ContinuationOptions& options = {});

/// A blend through samples of which no single surface explains all: they are parted by where they
/// lie, into as few stretches as will do, each a tube of about the same radius. Nothing where that
/// does not come out.
std::optional<FittedSurface> fit_blend(std::span<const SurfaceSample> samples,
                                       const SurfaceNoise& noise, double most_misfit,
                                       const ContinuationOptions& options = {});

}  // namespace arris
