#pragma once

#include "core/mesh/mesh.h"

namespace arris {

/// Standard deviation in mm of the sensor noise along the surface normal: what is left of each
/// two-ring after a quadric is fitted to it, corrected for the freedom of the fit; the median over
/// the inner vertices, so that sharp lines and fillets do not count. 0 where no vertex has enough
/// neighbours.
double estimate_noise(const Mesh& mesh);

/// The radius of the error zones for a scan: its noise, rounded to two digits. (On a plate,
/// Gaussian noise and a radius of its standard deviation, about two thirds of the vertices go.)
double default_error_zone(const Mesh& mesh);

}  // namespace arris
