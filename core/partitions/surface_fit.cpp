#include "core/partitions/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace arris {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::array<Vector3d, 2> tangents(const Vector3d& n) {
  const Vector3d x =
      (std::abs(n[0]) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY()).cross(n).normalized();
  return {x, n.cross(x)};
}

/// The shortest turn of one direction to another. As Eigen's FromTwoVectors, whose answer for
/// opposite ones takes a third of the time that this file takes to compile.
Eigen::Quaterniond turn_between(const Vector3d& one, const Vector3d& other) {
  const Vector3d from = one.normalized(), to = other.normalized();
  const double cosine = to.dot(from);
  if (cosine < -1.0 + 1e-12) {
    const Vector3d across = tangents(from)[0];
    return {0.0, across.x(), across.y(), across.z()};
  }
  const double length = std::sqrt((1.0 + cosine) * 2.0);
  const Vector3d axis = from.cross(to) * (1.0 / length);
  return {0.5 * length, axis.x(), axis.y(), axis.z()};
}

/// Unit eigenvector of the least eigenvalue.
Vector3d least_direction(const Matrix3d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(symmetric);
  return solver.eigenvectors().col(0);
}

/// Moments of the samples about their centre.
struct Moments {
  double weight = 0.0;
  Vector3d centre = Vector3d::Zero(), normal = Vector3d::Zero();  // means
  Matrix3d points = Matrix3d::Zero();                             // mean (p - c)(p - c)^T
  Matrix3d normals = Matrix3d::Zero();                            // mean n n^T
  double together = 0.0;                                          // mean (p - c) . (n - mean n)

  explicit Moments(std::span<const SurfaceSample> samples) {
    for (const SurfaceSample& s : samples) {
      weight += s.weight;
      centre += s.weight * s.point;
      normal += s.weight * s.normal;
    }
    centre /= weight;
    normal /= weight;
    for (const SurfaceSample& s : samples) {
      const Vector3d p = s.point - centre;
      points.noalias() += s.weight * p * p.transpose();
      normals.noalias() += s.weight * s.normal * s.normal.transpose();
      together += s.weight * p.dot(s.normal);
    }
    points /= weight;
    normals /= weight;
    together /= weight;
  }
  Matrix3d turn() const { return normals - normal * normal.transpose(); }
};

/// The terms of Surface::heights at a place, and how they change along x and y.
struct Powers {
  Surface::Heights value, by_x, by_y;

  Powers(double x, double y, int degree) {
    std::array<double, Surface::most_degree + 1> xs{1.0}, ys{1.0};
    for (std::size_t k = 1; k < xs.size(); ++k) {
      xs[k] = xs[k - 1] * x;
      ys[k] = ys[k - 1] * y;
    }
    Eigen::Index term = 0;
    for (std::size_t d = 0; d <= static_cast<std::size_t>(degree); ++d)
      for (std::size_t j = 0; j <= d; ++j, ++term) {
        const std::size_t i = d - j;
        value[term] = xs[i] * ys[j];
        by_x[term] = i > 0 ? static_cast<double>(i) * xs[i - 1] * ys[j] : 0.0;
        by_y[term] = j > 0 ? static_cast<double>(j) * xs[i] * ys[j - 1] : 0.0;
      }
  }
};

/// As lengths are multiplied by `unit`.
void scale_heights(Surface::Heights& heights, double unit) {
  double factor = unit;
  Eigen::Index term = 0;
  for (int degree = 0; degree <= Surface::most_degree; ++degree, factor /= unit)
    for (int k = 0; k <= degree; ++k) heights[term++] *= factor;
}

/// Fits one surface after the other and keeps the best.
class Fitting {
 public:
  Fitting(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
          const SurfaceFitOptions& options)
      : samples_(samples), noise_(noise), options_(options), moments_(samples) {
    best_.misfit = telling_.misfit = std::numeric_limits<double>::infinity();
  }

  FittedSurface best() {
    plane();
    if (samples_.size() < 4) return best_;
    sphere();
    cylinder();
    cone();
    torus();
    torus_by_curvature();
    if (telling_.misfit < options_.free) return telling_;
    if (!tells(best_.surface)) best_.misfit = std::max(best_.misfit, options_.free);
    return best_;
  }

  FittedSurface from(const Surface& start) {
    if (start.type == SurfaceType::plane)
      plane();
    else if (start.type < SurfaceType::blend)
      try_out(start);
    return best_;
  }

  FittedSurface as_it_is(const Surface& surface) {
    judge(surface);
    return best_;
  }

  FittedSurface free(int degree) {
    Surface surface;
    free_parameters_ = (degree + 1) * (degree + 2) / 2;
    if (height_field(surface, degree)) judge(surface);
    return best_;
  }

 private:
  double judge(const Surface& surface) {
    double sum = 0.0;
    for (const SurfaceSample& s : samples_) {
      const Surface::At at = surface.at(s.point);
      const double d = at.distance / noise_.distance;
      // 2 (1 - cos) is the squared angle as far as it counts.
      const double turn = std::max(0.0, 2.0 * (1.0 - at.normal.dot(s.normal)));
      const double a = turn / (2.0 * noise_.angle * noise_.angle);
      sum += s.weight * 0.5 * (std::min(d * d, options_.most) + std::min(a, options_.most));
    }
    const std::array<double, 8> parameters{3, 4, 5, 6,
                                           7, 8, 8, static_cast<double>(free_parameters_)};
    // Each parameter has to be worth it (Bayesian information criterion), over the noise there is.
    const double n = static_cast<double>(samples_.size());
    const double misfit =
        sum / moments_.weight *
        (1.0 + options_.price * parameters[static_cast<std::size_t>(surface.type)] * 0.5 *
                   std::log(3.0 * n) / n);
    if (misfit < best_.misfit) best_ = {surface, misfit};
    if (misfit < telling_.misfit && tells(surface)) telling_ = {surface, misfit};
    return misfit;
  }

  /// Any smooth surface is a torus for a while, and one that bends little a sphere or cylinder:
  /// they say something where the torus is a blend and the others bend noticeably.
  bool tells(const Surface& surface) const {
    switch (surface.type) {
      case SurfaceType::torus:
        return std::min(surface.tube, std::abs(surface.radius - surface.tube)) <= options_.blend;
      case SurfaceType::sphere:
      case SurfaceType::cylinder:
        return surface.radius <= options_.wide;
      default:
        return true;
    }
  }

  /// Judges a first estimate, and what least squares make of it where it is near.
  void try_out(Surface surface) {
    const double first = judge(surface);
    if (first > options_.near) return;
    const std::size_t stride = std::max<std::size_t>(1, samples_.size() / options_.refined);
    double before = 1e300;
    for (int step = 0; step < options_.steps; ++step) {
      double misfit = 0.0;
      if (!improve(surface, stride, misfit)) return;
      if (std::abs(misfit - before) <= 2e-3 * before) break;
      before = misfit;
    }
    judge(surface);
  }

  /// How the signed distance at p and the normal there change with the place of the surface along
  /// x, y and its axis, its tilt about the middle of the samples, radius, tube and half angle.
  struct Changes {
    std::array<double, 8> distance;
    std::array<Vector3d, 8> normal;
  };
  void changes_at(const Surface& surface, const std::array<Vector3d, 3>& frame, const Vector3d& p,
                  const Surface::At& at, Changes& by) const {
    const Matrix3d bend = surface.bend_at(p);
    // A surface that is moved is the surface as p moves the other way.
    for (std::size_t k = 0; k < 3; ++k) {
      by.distance[k] = -at.normal.dot(frame[k]);
      by.normal[k] = -bend * frame[k];
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3d turn = surface.axis.cross(frame[k]);
      const Vector3d way = turn.cross(p - moments_.centre);
      by.distance[3 + k] = -at.normal.dot(way);
      by.normal[3 + k] = turn.cross(at.normal) - bend * way;
    }
    for (std::size_t k = 5; k < 8; ++k) {
      by.distance[k] = -surface.side;
      by.normal[k].setZero();
    }
    const Vector3d d = p - surface.point;
    Vector3d out = d - d.dot(surface.axis) * surface.axis;
    if (const double length = out.norm(); length > 0.0) out /= length;
    if (surface.type == SurfaceType::torus) {
      const Vector3d from_tube = surface.side * at.normal;
      const double reach = surface.side * at.distance + surface.tube;
      by.distance[5] = -surface.side * from_tube.dot(out);
      if (reach > 0.0)
        by.normal[5] = -surface.side / reach * (out - from_tube.dot(out) * from_tube);
    }
    if (surface.type == SurfaceType::cone) {
      by.normal[7] = std::cos(surface.half_angle) * surface.axis -
                     surface.side * std::sin(surface.half_angle) * out;
      by.distance[7] = d.dot(by.normal[7]);
    }
  }

  /// The step that the normal equations of the active parameters ask for, a little damped; 0 for
  /// the others.
  static Eigen::Matrix<double, 8, 1> solved(const std::array<std::array<double, 8>, 8>& upper,
                                            const std::array<double, 8>& falls,
                                            const std::array<std::size_t, 8>& active,
                                            std::size_t count) {
    using Row = Eigen::Matrix<double, 8, 1>;
    Eigen::Matrix<double, 8, 8> gram = Eigen::Matrix<double, 8, 8>::Identity();
    Row right = Row::Zero();
    for (std::size_t a = 0; a < count; ++a) {
      const auto j = static_cast<Eigen::Index>(active[a]);
      right[j] = falls[a];
      for (std::size_t b = a; b < count; ++b) {
        const auto k = static_cast<Eigen::Index>(active[b]);
        gram(j, k) = gram(k, j) = upper[a][b];
      }
    }
    for (int k = 0; k < 8; ++k) {
      gram(k, k) *= 1.0 + 1e-6;
      gram(k, k) += 1e-12 * gram.trace();
    }
    return gram.ldlt().solve(right);
  }

  /// Changes the parameters that it `has`, no farther at once than the linear picture holds.
  void move(Surface& surface, Eigen::Matrix<double, 8, 1> step,
            const std::array<Vector3d, 3>& frame, const std::array<bool, 8>& has) const {
    const auto& [x, y, axis] = frame;
    double share = std::min(1.0, 0.3 / std::max(std::hypot(step[3], step[4]), 1e-12));
    const auto keeps = [&](double value, double change) {
      if (change < 0.0) share = std::min(share, -0.5 * value / change);
    };
    if (has[5]) keeps(surface.radius, step[5]);
    if (has[6]) keeps(surface.tube, step[6]);
    if (has[7]) share = std::min(share, 0.3 / std::max(std::abs(step[7]), 1e-12));
    step *= share;
    surface.point += step[0] * x + step[1] * y + step[2] * axis;
    surface.axis = turned(surface, step[3] * x + step[4] * y, surface.point);
    surface.radius += step[5];
    surface.tube += step[6];
    surface.half_angle += step[7];
  }

  /// A step of Gauss and Newton on distances and normals, far samples counting less.
  /// `mean`: the misfit that it started from. False where it leads to no such surface.
  bool improve(Surface& surface, std::size_t stride, double& mean) {
    using Row = Eigen::Matrix<double, 8, 1>;
    const double by_distance = 1.0 / noise_.distance, by_angle = 1.0 / noise_.angle;
    const auto [x, y] = tangents(surface.axis);
    const std::array<Vector3d, 3> frame{x, y, surface.axis};
    std::array<bool, 8> has{true, true, true, true, true, true, false, false};
    has[3] = has[4] = surface.type != SurfaceType::sphere;
    has[5] = surface.type != SurfaceType::cone;
    has[6] = surface.type == SurfaceType::torus;
    has[7] = surface.type == SurfaceType::cone;
    std::array<std::size_t, 8> active{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 8; ++k)
      if (has[k]) active[count++] = k;
    const auto misfit = [&](const Surface::At& at, const Vector3d& off) {
      return at.distance * at.distance * by_distance * by_distance +
             0.5 * off.squaredNorm() * by_angle * by_angle;
    };
    // Far is what is far beside the others, so that a bad start does not count as all outliers.
    places_.clear();
    double far = 0.0;
    for (std::size_t i = 0; i < samples_.size(); i += stride) {
      places_.push_back(surface.at(samples_[i].point));
      far += misfit(places_.back(), places_.back().normal - samples_[i].normal);
    }
    mean = far / static_cast<double>(places_.size());
    far = options_.most * std::max(1.0, mean);
    std::array<std::array<double, 8>, 8> upper{};
    std::array<double, 8> falls{};
    Changes by;
    for (std::size_t i = 0, place = 0; i < samples_.size(); i += stride, ++place) {
      const SurfaceSample& s = samples_[i];
      const Surface::At& at = places_[place];
      const Vector3d off = at.normal - s.normal;
      const double chi = misfit(at, off);
      const double w = s.weight * (chi > far ? far / chi : 1.0);
      const double wd = w * by_distance * by_distance, wn = w * by_angle * by_angle;
      changes_at(surface, frame, s.point, at, by);
      for (std::size_t a = 0; a < count; ++a) {
        const std::size_t j = active[a];
        const double dj = wd * by.distance[j];
        const Vector3d nj = wn * by.normal[j];
        falls[a] -= dj * at.distance + nj.dot(off);
        for (std::size_t b = a; b < count; ++b)
          upper[a][b] += dj * by.distance[active[b]] + nj.dot(by.normal[active[b]]);
      }
    }
    const Row step = solved(upper, falls, active, count);
    if (!step.allFinite()) return false;
    move(surface, step, frame, has);
    if (has[7]) return surface.half_angle > 0.02 && surface.half_angle < 1.55;
    return surface.radius < options_.largest_radius && surface.tube < options_.largest_radius &&
           (!has[6] || surface.tube >= options_.least_tube);
  }

  /// The axis tilted about the middle of the samples; `point` is shifted with it.
  Vector3d turned(const Surface& surface, const Vector3d& tilt, Vector3d& point) const {
    const Vector3d axis = (surface.axis + tilt).normalized();
    if (surface.type == SurfaceType::sphere) return axis;
    const Eigen::Quaterniond turn = turn_between(surface.axis, axis);
    point = moments_.centre + turn * (point - moments_.centre);
    return axis;
  }

  /// Least squares of heights over the mean plane; false where the samples turn too far for that.
  bool height_field(Surface& surface, int degree) const {
    using Row = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Surface::Heights::RowsAtCompileTime, 1>;
    using Gram =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
                      Surface::Heights::RowsAtCompileTime, Surface::Heights::RowsAtCompileTime>;
    surface.type = SurfaceType::free;
    surface.point = moments_.centre;
    if (!(moments_.normal.norm() > 1e-9)) return false;
    surface.axis = moments_.normal.normalized();
    const auto [x, y] = tangents(surface.axis);
    double extent = 0.0;
    for (const SurfaceSample& s : samples_) {
      if (s.normal.dot(surface.axis) < 0.3) return false;
      extent = std::max(extent, (s.point - surface.point).cwiseAbs().maxCoeff());
    }
    if (!(extent > 0.0)) return false;
    const Eigen::Index count = (degree + 1) * (degree + 2) / 2;
    Gram gram = Gram::Zero(count, count);
    Row right = Row::Zero(count), row(count);
    const double wd = 1.0 / (noise_.distance * noise_.distance),
                 wn = 1.0 / (noise_.angle * noise_.angle);
    const auto add = [&](const Surface::Heights& all, double value, double w) {
      row = all.head(count);
      gram.noalias() += w * row * row.transpose();
      right += w * value * row;
    };
    for (const SurfaceSample& s : samples_) {
      const double up = s.normal.dot(surface.axis);
      const Vector3d d = (s.point - surface.point) / extent;
      const Powers at(d.dot(x), d.dot(y), degree);
      // A distance counts along the normal, an angle across it.
      add(at.value, d.dot(surface.axis), s.weight * wd * up * up * extent * extent);
      const double slope = s.weight * wn * up * up;
      add(at.by_x, -s.normal.dot(x) / up, slope);
      add(at.by_y, -s.normal.dot(y) / up, slope);
    }
    gram.diagonal().array() += 1e-9 * gram.trace();
    surface.heights.setZero();
    surface.heights.head(count) = gram.ldlt().solve(right);
    scale_heights(surface.heights, extent);
    return true;
  }

  void plane() {
    Surface surface;
    surface.type = SurfaceType::plane;
    surface.point = moments_.centre;
    surface.axis =
        least_direction(moments_.points / (noise_.distance * noise_.distance) +
                        (Matrix3d::Identity() - moments_.normals) / (noise_.angle * noise_.angle));
    if (surface.axis.dot(moments_.normal) < 0.0) surface.axis = -surface.axis;
    judge(surface);
  }

  void sphere() {
    const double turn = moments_.turn().trace();
    if (!(turn > 1e-12)) return;
    Surface surface;
    surface.type = SurfaceType::sphere;
    // p = centre + radius n, by least squares.
    double radius = moments_.together / turn;
    if (!(std::abs(radius) < options_.largest_radius)) return;
    Vector3d centre = moments_.centre - radius * moments_.normal;
    surface.side = radius > 0.0 ? 1.0 : -1.0;
    radius = std::abs(radius);
    surface.point = centre;
    surface.radius = radius;
    try_out(surface);
  }

  void cylinder() {
    Surface surface;
    surface.type = SurfaceType::cylinder;
    surface.axis = least_direction(moments_.normals);
    // In the plane across the axis: p = centre + radius n.
    const auto [x, y] = tangents(surface.axis);
    const double tx = x.dot(moments_.normal), ty = y.dot(moments_.normal);
    double turn = 0.0, together = 0.0;
    for (const SurfaceSample& s : samples_) {
      const Vector3d d = s.point - moments_.centre;
      const double nx = x.dot(s.normal) - tx, ny = y.dot(s.normal) - ty;
      turn += s.weight * (nx * nx + ny * ny);
      together += s.weight * (x.dot(d) * nx + y.dot(d) * ny);
    }
    if (!(turn > 1e-12)) return;
    const double radius = together / turn;
    if (!(std::abs(radius) < options_.largest_radius)) return;
    surface.side = radius > 0.0 ? 1.0 : -1.0;
    surface.radius = std::abs(radius);
    surface.point = moments_.centre - radius * (tx * x + ty * y);
    try_out(surface);
  }

  void cone() {
    Surface surface;
    surface.type = SurfaceType::cone;
    surface.axis = least_direction(moments_.turn());
    double sine = surface.axis.dot(moments_.normal);
    if (sine < 0.0) {
      surface.axis = -surface.axis;
      sine = -sine;
    }
    if (sine < 0.05 || sine > 0.98) return;
    // Every tangent plane goes through the apex.
    Vector3d right = Vector3d::Zero();
    for (const SurfaceSample& s : samples_)
      right += s.weight * s.normal.dot(s.point - moments_.centre) * s.normal;
    Matrix3d gram = moments_.normals;
    gram.diagonal().array() += 1e-9;
    surface.point = moments_.centre + gram.ldlt().solve(right / moments_.weight);
    surface.half_angle = std::asin(sine);
    double side = 0.0;
    for (const SurfaceSample& s : samples_) {
      Vector3d d = s.point - surface.point;
      d -= d.dot(surface.axis) * surface.axis;
      side += s.weight * d.dot(s.normal);
    }
    surface.side = side > 0.0 ? 1.0 : -1.0;
    try_out(surface);
  }

  void torus() {
    // A surface of revolution: all normals meet the axis, a . (p x n) + b . n = 0 (Pottmann and
    // Wallner, Computational Line Geometry).
    Matrix3d nn = Matrix3d::Zero(), nm = Matrix3d::Zero(), mm = Matrix3d::Zero();
    for (const SurfaceSample& s : samples_) {
      const Vector3d m = (s.point - moments_.centre).cross(s.normal);
      nn.noalias() += s.weight * s.normal * s.normal.transpose();
      nm.noalias() += s.weight * s.normal * m.transpose();
      mm.noalias() += s.weight * m * m.transpose();
    }
    nn.diagonal().array() += 1e-9 * moments_.weight;
    const Matrix3d back = nn.ldlt().solve(nm);
    const Vector3d a = least_direction(mm - nm.transpose() * back);
    Vector3d b = -back * a;
    b -= a * a.dot(b);
    Surface surface;
    surface.type = SurfaceType::torus;
    surface.axis = a;
    const Vector3d on_axis = moments_.centre + a.cross(b);
    // In the half plane of the profile: (r, z) = middle + tube n.
    double w = 0.0, r = 0.0, z = 0.0, nr = 0.0, nz = 0.0, rr = 0.0, together = 0.0;
    for (const SurfaceSample& s : samples_) {
      const Vector3d d = s.point - on_axis;
      const double height = d.dot(a);
      const Vector3d out = d - height * a;
      const double length = out.norm();
      if (!(length > 1e-12)) continue;
      const double or_ = s.normal.dot(out) / length, oz = s.normal.dot(a);
      w += s.weight;
      r += s.weight * length;
      z += s.weight * height;
      nr += s.weight * or_;
      nz += s.weight * oz;
      rr += s.weight * (or_ * or_ + oz * oz);
      together += s.weight * (length * or_ + height * oz);
    }
    if (!(w > 0.0)) return;
    r /= w;
    z /= w;
    nr /= w;
    nz /= w;
    const double turn = rr / w - nr * nr - nz * nz;
    if (!(turn > 1e-9)) return;
    const double tube = (together / w - r * nr - z * nz) / turn;
    const double middle = r - tube * nr;
    if (std::abs(tube) < options_.least_tube || std::abs(tube) > options_.largest_radius ||
        !(middle > 0.0) || middle > options_.largest_radius)
      return;
    surface.point = on_axis + (z - tube * nz) * a;
    surface.radius = middle;
    surface.tube = std::abs(tube);
    surface.side = tube > 0.0 ? 1.0 : -1.0;
    try_out(surface);
  }

  /// A torus from the curvatures in the middle: a short piece of one does not tell its axis.
  void torus_by_curvature() {
    Surface field;
    if (!height_field(field, 2)) return;
    const Surface::At middle = field.at(field.point);
    const Vector3d& n = middle.normal;
    const Vector3d p = field.point - middle.distance * n;
    const auto [x, y] = tangents(field.axis);
    const double fu = field.heights[1], fv = field.heights[2];
    const double root = std::sqrt(1.0 + fu * fu + fv * fv);
    Eigen::Matrix2d first, second;
    first << 1.0 + fu * fu, fu * fv, fu * fv, 1.0 + fv * fv;
    second << -2.0 * field.heights[3], -field.heights[4], -field.heights[4],
        -2.0 * field.heights[5];
    second /= root;
    Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(second, first);
    const double k0 = solver.eigenvalues()[0], k1 = solver.eigenvalues()[1];
    const int strong = std::abs(k0) > std::abs(k1) ? 0 : 1;
    const double strongest = strong == 0 ? k0 : k1, weakest = strong == 0 ? k1 : k0;
    if (!(std::abs(weakest) * options_.largest_radius > 1.0)) return;
    const Eigen::Vector2d direction = solver.eigenvectors().col(strong);
    Surface surface;
    surface.type = SurfaceType::torus;
    surface.axis =
        ((x + fu * field.axis) * direction[0] + (y + fv * field.axis) * direction[1]).normalized();
    surface.point = p - n / weakest;
    surface.radius = std::abs(1.0 / strongest - 1.0 / weakest);
    surface.tube = 1.0 / std::abs(strongest);
    surface.side = strongest > 0.0 ? 1.0 : -1.0;
    if (surface.tube < options_.least_tube || !(surface.radius > 0.0)) return;
    try_out(surface);
  }

  std::span<const SurfaceSample> samples_;
  const SurfaceNoise& noise_;
  const SurfaceFitOptions& options_;
  Moments moments_;
  FittedSurface best_, telling_;
  int free_parameters_ = 6;
  std::vector<Surface::At> places_;  // of the samples that are read, kept for its memory
};

const Surface& nearest_part(const std::vector<Surface>& parts, const Vector3d& p) {
  return *std::ranges::min_element(
      parts, {}, [&](const Surface& part) { return std::abs(part.at(p).distance); });
}

}  // namespace

std::string_view name_of(SurfaceType type) {
  static constexpr std::array<std::string_view, 8> names{"plane", "sphere", "cylinder", "cone",
                                                         "torus", "blend",  "chain",    "free"};
  return names[static_cast<std::size_t>(type)];
}

Surface::At Surface::at(const Vector3d& p) const {
  const Vector3d d = p - point;
  switch (type) {
    case SurfaceType::plane:
      return {d.dot(axis), axis};
    case SurfaceType::sphere: {
      const double length = d.norm();
      const Vector3d out = length > 0.0 ? Vector3d(d / length) : axis;
      return {side * (length - radius), side * out};
    }
    case SurfaceType::cylinder: {
      const Vector3d across = d - d.dot(axis) * axis;
      const double length = across.norm();
      const Vector3d out = length > 0.0 ? Vector3d(across / length) : tangents(axis)[0];
      return {side * (length - radius), side * out};
    }
    case SurfaceType::cone: {
      const Vector3d across = d - d.dot(axis) * axis;
      const double length = across.norm();
      const Vector3d out = length > 0.0 ? Vector3d(across / length) : tangents(axis)[0];
      const Vector3d normal = std::sin(half_angle) * axis + side * std::cos(half_angle) * out;
      return {d.dot(normal), normal};
    }
    case SurfaceType::torus: {
      const double height = d.dot(axis);
      const Vector3d across = d - height * axis;
      const double length = across.norm();
      const Vector3d out = length > 0.0 ? Vector3d(across / length) : tangents(axis)[0];
      const Vector3d from_tube = (length - radius) * out + height * axis;
      const double reach = from_tube.norm();
      const Vector3d normal = reach > 0.0 ? Vector3d(from_tube / reach) : out;
      return {side * (reach - tube), side * normal};
    }
    case SurfaceType::blend:
    case SurfaceType::chain:
      return nearest_part(*parts, p).at(p);
    case SurfaceType::free:
      break;
  }
  const auto [x, y] = tangents(axis);
  const Powers powers(d.dot(x), d.dot(y), most_degree);
  const Vector3d normal =
      (axis - heights.dot(powers.by_x) * x - heights.dot(powers.by_y) * y).normalized();
  return {(d.dot(axis) - heights.dot(powers.value)) * normal.dot(axis), normal};
}

Matrix3d Surface::bend_at(const Vector3d& p) const {
  if (parts) return nearest_part(*parts, p).bend_at(p);
  const Vector3d d = p - point;
  const double height = d.dot(axis);
  const Vector3d across = d - height * axis;
  const double length = across.norm();
  switch (type) {
    case SurfaceType::sphere: {
      const double reach = d.norm();
      if (!(reach > 0.0)) break;
      return side / reach * (Matrix3d::Identity() - d * d.transpose() / (reach * reach));
    }
    case SurfaceType::cylinder:
    case SurfaceType::cone: {
      if (!(length > 0.0)) break;
      const Vector3d round = axis.cross(across / length);
      const double slant = type == SurfaceType::cone ? std::cos(half_angle) : 1.0;
      return side * slant / length * round * round.transpose();
    }
    case SurfaceType::torus: {
      if (!(length > 0.0)) break;
      const Vector3d out = across / length, round = axis.cross(out);
      const Vector3d from_tube = (length - radius) * out + height * axis;
      const double reach = from_tube.norm();
      if (!(reach > 0.0)) break;
      const Vector3d along = round.cross(from_tube / reach);
      return side * (along * along.transpose() / reach +
                     (length - radius) / reach / length * round * round.transpose());
    }
    default:
      break;
  }
  return Matrix3d::Zero();
}

Surface Surface::placed(const Vector3d& origin, double unit) const {
  Surface result = *this;
  result.point = origin + unit * point;
  result.radius *= unit;
  result.tube *= unit;
  scale_heights(result.heights, unit);
  if (parts) {
    std::vector<Surface> moved;
    for (const Surface& part : *parts) moved.push_back(part.placed(origin, unit));
    result.parts = std::make_shared<const std::vector<Surface>>(std::move(moved));
  }
  return result;
}

FittedSurface fit_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                          const SurfaceFitOptions& options) {
  return Fitting(samples, noise, options).best();
}

FittedSurface refit_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                            const Surface& start, const SurfaceFitOptions& options) {
  return Fitting(samples, noise, options).from(start);
}

FittedSurface judge_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                            const Surface& surface, const SurfaceFitOptions& options) {
  return Fitting(samples, noise, options).as_it_is(surface);
}

FittedSurface fit_free_surface(std::span<const SurfaceSample> samples, const SurfaceNoise& noise,
                               int degree, const SurfaceFitOptions& options) {
  return Fitting(samples, noise, options).free(degree);
}

}  // namespace arris
