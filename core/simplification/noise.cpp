#include "core/simplification/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "core/base/number_text.h"
#include "core/base/parallel.h"

namespace arris {

namespace {

constexpr int fit_freedom = 6;    // coefficients of a quadric over the tangent plane
constexpr int least_surplus = 4;  // neighbours beyond that, or the residual says nothing
constexpr std::size_t most_neighbours = 40;
constexpr std::size_t most_samples = 100000;  // vertices looked at; enough for three digits

/// Variance of the noise about v by its two-ring; negative where there are too few neighbours.
double local_variance(const Mesh& mesh, VertexId v, std::vector<VertexId>& ring) {
  ring.assign(1, v);
  const auto add_ring_of = [&](VertexId centre) {
    mesh.for_ring(centre, [&](HalfEdgeId h) {
      const VertexId w = mesh.to(h);
      if (ring.size() < most_neighbours && std::ranges::find(ring, w) == ring.end())
        ring.push_back(w);
    });
  };
  add_ring_of(v);
  const std::size_t first_ring = ring.size();
  for (std::size_t k = 1; k < first_ring; ++k) add_ring_of(ring[k]);
  const int n = static_cast<int>(ring.size());
  if (n < fit_freedom + least_surplus) return -1.0;

  // The plane of least squares gives the frame; lengths in units of the neighbourhood's size.
  Point centre = Point::Zero();
  for (const VertexId w : ring) centre += mesh.point(w);
  centre /= n;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const VertexId w : ring) {
    const Point d = mesh.point(w) - centre;
    spread += d * d.transpose();
  }
  const double size = std::sqrt(spread.trace() / n);
  if (!(size > 0.0)) return -1.0;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> frame;
  frame.computeDirect(spread);

  Eigen::Matrix<double, fit_freedom, fit_freedom> normal_matrix;
  Eigen::Matrix<double, fit_freedom, 1> right;
  normal_matrix.setZero();
  right.setZero();
  const auto row_of = [&](VertexId w, double& height) {
    const Point d = frame.eigenvectors().transpose() * (mesh.point(w) - centre) / size;
    height = d[0];
    Eigen::Matrix<double, fit_freedom, 1> row;
    row << 1.0, d[1], d[2], d[1] * d[1], d[1] * d[2], d[2] * d[2];
    return row;
  };
  double height = 0.0;
  for (const VertexId w : ring) {
    const auto row = row_of(w, height);
    normal_matrix += row * row.transpose();
    right += height * row;
  }
  const Eigen::LDLT<Eigen::Matrix<double, fit_freedom, fit_freedom>> solver(normal_matrix);
  const Eigen::Matrix<double, fit_freedom, 1> quadric = solver.solve(right);
  double residual = 0.0;
  for (const VertexId w : ring) {
    const auto row = row_of(w, height);
    residual += (height - row.dot(quadric)) * (height - row.dot(quadric));
  }
  // The median of chi-square is about f (1 - 2 / 9f)^3 for f degrees of freedom: the median of
  // these values over the mesh is then the variance.
  const double freedom = n - fit_freedom;
  const double median = freedom * std::pow(1.0 - 2.0 / (9.0 * freedom), 3);
  return size * size * residual / median;
}

}  // namespace

double estimate_noise(const Mesh& mesh) {
  const std::size_t step = 1 + mesh.vertex_count() / most_samples;
  const std::size_t count = (mesh.vertex_count() + step - 1) / step;
  std::vector<double> variances(count, -1.0);
  parallel_for(count, [&](std::size_t k) {
    thread_local std::vector<VertexId> ring;
    const VertexId v = static_cast<VertexId>(k * step);
    if (!mesh.is_isolated(v) && !mesh.is_border(v)) variances[k] = local_variance(mesh, v, ring);
  });
  std::erase_if(variances, [](double value) { return !(value >= 0.0); });
  if (variances.empty()) return 0.0;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::ranges::nth_element(variances, middle);
  return std::sqrt(*middle);
}

double default_error_zone(const Mesh& mesh) { return rounded(3.0 * estimate_noise(mesh), 2); }

double default_max_edge_length(const Mesh& mesh) {
  return rounded(2.0 * mesh.mean_edge_length(), 2);
}

}  // namespace arris
