#pragma once

#include "core/mesh/mesh.h"

namespace arris {

/// Standard deviation in mm of the sensor noise along the surface normal: what is left of each
/// two-ring after a quadric is fitted to it, corrected for the freedom of the fit; the median over
/// the inner vertices, so that sharp lines and fillets do not count. 0 where no vertex has enough
/// neighbours.
double estimate_noise(const Mesh& mesh);

/// The radius of the error zones for a scan: twice its noise, rounded to two digits. By
/// measurement: a radius of the noise itself takes out two thirds of the vertices, but those that
/// stay are the outliers of their neighbourhood, and the mean error of the normals rises (sample
/// mould 4.9 to 5.8 degrees, block 9.8 to 11.6); at twice the noise it falls on every pair measured
/// (4.9 to 4.7, 9.8 to 7.0, fandisk 27.6 to 22.9), with 7 to 15 % of the vertices left.
double default_error_zone(const Mesh& mesh);

}  // namespace arris
