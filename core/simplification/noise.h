#pragma once

#include "core/mesh/mesh.h"

namespace arris {

/// Standard deviation of the sensor noise along the surface normal, in the unit of the mesh. It
/// follows the part: the same share of the mean edge in any unit, place and direction.
///
/// Two measures that err in different ways are put together (both over at most 20,000 places):
/// - Two-rings: what is left of each after a quadric is fitted, corrected for the freedom of the
///   fit. Right for noise of any kind on smooth surfaces; far too large beside a sharp line.
/// - Edges: how far the four vertices of its two faces are from one plane, over what noise of one
///   unit makes of that. Hardly touched by sharp lines, which few edges cross, and exactly 0 inside
///   flat areas and on the quadrangles that CAD systems cut cylinders, cones and tori into; too
///   large where the surface bends, too small where neighbours err alike.
/// A two-ring counts where it varies no more than its own edges say, so that those at sharp lines
/// do not; the median of these is the noise. By measurement it is within 15 % for white noise of
/// 0.02 to 0.3 mean edges on planes, cylinders and spheres, and where half of the vertices lie
/// within two edges of a sharp line (0.3 mean edges there: 15 % on the mean of several parts).
///
/// 0 for parts without noise: where a quarter of the edges lie in planes, whatever the fineness,
/// and where the residual is no more than a coarse mesh of a bent surface may give by itself. That
/// is taken as 0.1 times the size of a two-ring and the square of the slope of the fit at its rim:
/// on a cylinder of 30, 60 and 120 sectors noise below 0.03, 0.008 and 0.002 mean edges is not
/// told from none. 0, too, where no vertex has enough neighbours.
double estimate_noise(const Mesh& mesh);

/// The radius of the error zones for a scan: three times its noise. By measurement: a radius of the
/// noise itself takes out two thirds of the vertices, but those that stay are the outliers of their
/// neighbourhood, and the mean error of the normals rises (sample mould 4.9 to 5.8 degrees, block
/// 9.8 to 11.6); at three times the noise it falls on every pair. Not rounded: the result must not
/// depend on the unit.
double default_error_zone(const Mesh& mesh);

/// The longest new edge for a scan: twice its mean edge, so that about half of the vertices stay
/// (4.1: planes and cylinders stay populated). By measurement on the five scans with known lines,
/// all else at its default: without a limit F1 is 0.64, with 4, 3, 2 and 1.5 times the mean edge
/// 0.73, 0.76, 0.78 and 0.78; on the scan itself 0.74. Mean IoU of the partitions is 0.47, 0.56,
/// 0.56, 0.51 and 0.48; on the scan itself 0.49.
double default_max_edge_length(const Mesh& mesh);

}  // namespace arris
