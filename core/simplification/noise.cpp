#include "core/simplification/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "core/base/parallel.h"
#include "core/base/random.h"

namespace arris {

namespace {

constexpr int fit_freedom = 6;    // coefficients of a quadric over the tangent plane
constexpr int least_surplus = 4;  // neighbours beyond that, or the residual says nothing
constexpr int most_neighbours = 40;
constexpr std::size_t most_samples = 20000;  // places looked at; enough for two digits

// Quantiles of |x| for a Gaussian x of deviation 1.
constexpr double gaussian_quarter = 0.31864;
constexpr double gaussian_median = 0.67449;

// Least slope of a fit, against the plane of least squares, at which it is no fit of a surface.
constexpr double steep = 1.0;
// The variance of a two-ring over that of its edges, on white noise: the quantile that is looked
// at, and its value there.
constexpr double clean_share = 0.2;
constexpr double white_ratio = 0.7;
// Noise whose neighbours err alike makes that larger everywhere; 2.3 times on iron_realscan, the
// most of the scans measured. Above this it is sharp lines that do.
constexpr double most_correlated = 5.0;
// A two-ring whose ratio is so many times that of the part lies at a sharp line. On white noise one
// in twenty is above.
constexpr double at_sharp_line = 2.0;
// No scan measured has a noise above 2.6 times what its edges tell.
constexpr double most_over_edges = 3.0;
// Third-order terms of a surface whose curvature changes by itself over a third of a radius; those
// of a sphere and of an ellipsoid of 3 : 2 : 1 are below.
constexpr double model_share = 0.1;

/// Place k of those looked at, one of `step` at random: a regular step would fall in with the rows
/// of a lattice.
std::uint32_t sample(std::size_t k, std::size_t step) {
  return static_cast<std::uint32_t>(step == 1 ? k : k * step + Random(k).bits() % step);
}

/// Reorders the values. 0 for none.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::ranges::nth_element(values, place);
  return *place;
}

/// The volume between the four vertices of the two faces of e over the deviation that noise of one
/// unit along their normal gives it: for white noise on a plane Gaussian, of the noise's deviation.
/// On any other surface it is on average farther from 0. Negative on the border and for faces
/// without area.
double deviation_across(const Mesh& mesh, EdgeId e) {
  if (mesh.is_border_edge(e)) return -1.0;
  const HalfEdgeId h = 2 * e;
  const Point& a = mesh.point(mesh.from(h));
  const Point b = mesh.point(mesh.to(h)) - a;
  const Point c = mesh.point(mesh.to(mesh.next(h))) - a;
  const Point d = mesh.point(mesh.to(mesh.next(Mesh::opposite(h)))) - a;
  const Point left = b.cross(c), right = d.cross(b);
  const Point normal = (left + right).normalized();
  // What the volume grows by where a vertex rises: twice the area of the other three, from above.
  const double by_d = normal.dot(left), by_c = normal.dot(right), by_b = normal.dot(c.cross(d));
  const double by_a = by_b + by_c - by_d;
  const double deviation = std::sqrt(by_a * by_a + by_b * by_b + by_c * by_c + by_d * by_d);
  return deviation > 0.0 ? std::abs(d.dot(left)) / deviation : -1.0;
}

struct TwoRing {
  double variance = -1.0;      // of the noise; negative: cannot be told
  double edge_variance = 0.0;  // the same by the edges
  double model_error = 0.0;    // deviation that the bending of the surface may have caused
};

TwoRing fit_two_ring(const Mesh& mesh, VertexId v) {
  std::array<VertexId, most_neighbours> ring;
  int n = 0;
  ring[n++] = v;
  thread_local std::vector<double> deviations;
  deviations.clear();
  const auto add_ring_of = [&](VertexId centre) {
    mesh.for_ring(centre, [&](HalfEdgeId h) {
      if (const double d = deviation_across(mesh, h >> 1); d >= 0.0) deviations.push_back(d);
      const VertexId w = mesh.to(h);
      if (n < most_neighbours && std::find(ring.begin(), ring.begin() + n, w) == ring.begin() + n)
        ring[n++] = w;
    });
  };
  add_ring_of(v);
  const int first_ring = n;
  for (int k = 1; k < first_ring; ++k) add_ring_of(ring[k]);
  if (n < fit_freedom + least_surplus) return {};

  // The plane of least squares gives the frame; lengths in units of the neighbourhood's size.
  Point centre = Point::Zero();
  for (int k = 0; k < n; ++k) centre += mesh.point(ring[k]);
  centre /= n;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int k = 0; k < n; ++k) {
    const Point d = mesh.point(ring[k]) - centre;
    spread += d * d.transpose();
  }
  const double size = std::sqrt(spread.trace() / n);
  if (!(size > 0.0)) return {};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> frame;
  frame.computeDirect(spread / (size * size));

  using Coefficients = Eigen::Matrix<double, fit_freedom, 1>;
  using NormalMatrix = Eigen::Matrix<double, fit_freedom, fit_freedom>;
  std::array<double, most_neighbours> heights;
  std::array<Coefficients, most_neighbours> rows;
  NormalMatrix normal_matrix = NormalMatrix::Zero();
  Coefficients right = Coefficients::Zero();
  for (int k = 0; k < n; ++k) {
    const Point d = frame.eigenvectors().transpose() * (mesh.point(ring[k]) - centre) / size;
    heights[k] = d[0];
    rows[k] << 1.0, d[1], d[2], d[1] * d[1], d[1] * d[2], d[2] * d[2];
    normal_matrix += rows[k] * rows[k].transpose();
    right += heights[k] * rows[k];
  }
  const Coefficients quadric = Eigen::LDLT<NormalMatrix>(normal_matrix).solve(right);
  double residual = 0.0, squared_slope = 0.0;
  for (int k = 0; k < n; ++k) {
    const double error = heights[k] - rows[k].dot(quadric), x = rows[k][1], y = rows[k][2];
    residual += error * error;
    const double along_x = quadric[1] + 2.0 * quadric[3] * x + quadric[4] * y;
    const double along_y = quadric[2] + quadric[4] * x + 2.0 * quadric[5] * y;
    squared_slope = std::max(squared_slope, along_x * along_x + along_y * along_y);
  }
  if (!(squared_slope < steep * steep)) return {};
  // The median of chi-square is about f (1 - 2 / 9f)^3 for f degrees of freedom: the median of
  // these values over the mesh is then the variance.
  const double freedom = n - fit_freedom;
  const double median = freedom * std::pow(1.0 - 2.0 / (9.0 * freedom), 3);
  const double by_edges = quantile(deviations, 0.5) / gaussian_median;
  return {size * size * residual / median, by_edges * by_edges, model_share * squared_slope * size};
}

/// The noise by the edges of the whole mesh: for white noise no less than it on any part.
double noise_by_edges(const Mesh& mesh) {
  const std::size_t step = 1 + mesh.edge_count() / most_samples;
  std::vector<double> deviations(mesh.edge_count() / step);
  parallel_for(deviations.size(),
               [&](std::size_t k) { deviations[k] = deviation_across(mesh, sample(k, step)); });
  std::erase_if(deviations, [](double value) { return !(value >= 0.0); });
  return quantile(deviations, 0.25) / gaussian_quarter;
}

}  // namespace

double estimate_noise(const Mesh& mesh) {
  const double by_edges = noise_by_edges(mesh);
  if (!(by_edges > 0.0)) return 0.0;

  const std::size_t step = 1 + mesh.vertex_count() / most_samples;
  std::vector<TwoRing> rings(mesh.vertex_count() / step);
  constexpr std::size_t grain = 64;
  parallel_for(
      rings.size(),
      [&](std::size_t k) {
        const VertexId v = sample(k, step);
        if (!mesh.is_isolated(v) && !mesh.is_border(v)) rings[k] = fit_two_ring(mesh, v);
      },
      grain);
  std::erase_if(rings, [](const TwoRing& ring) { return !(ring.variance >= 0.0); });
  if (rings.empty()) return 0.0;

  std::vector<double> ratios;
  for (const TwoRing& ring : rings)
    ratios.push_back(ring.variance > 0.0 ? ring.variance / ring.edge_variance : 0.0);
  const double correlated = quantile(ratios, clean_share) / white_ratio;
  if (correlated > most_correlated) return by_edges;  // next to all lie at sharp lines

  // Where the surface bends, edges vary more than two-rings: the least is what white noise has.
  const double most_ratio = at_sharp_line * std::max(correlated, 1.0);
  std::vector<double> variances, model_errors;
  for (const TwoRing& ring : rings) {
    if (ring.variance > most_ratio * ring.edge_variance) continue;
    variances.push_back(ring.variance);
    model_errors.push_back(ring.model_error);
  }
  const double noise = std::sqrt(quantile(variances, 0.5));
  if (noise < quantile(model_errors, 0.5)) return 0.0;
  return std::min(noise, most_over_edges * by_edges);
}

double default_error_zone(const Mesh& mesh) { return 3.0 * estimate_noise(mesh); }

double default_max_edge_length(const Mesh& mesh) { return 2.0 * mesh.mean_edge_length(); }

}  // namespace arris
