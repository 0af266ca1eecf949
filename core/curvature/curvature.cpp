#include "core/curvature/curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/base/watched_for.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

/// Twice the area over the squared longest side: under this a face has no direction of its own.
constexpr double zero_area_share = 1e-12;

/// Unit normals; a zero-area face takes the normal of the face across its longest edge, so that
/// beta is taken across it.
std::vector<Point> face_normals(const Mesh& mesh) {
  std::vector<Point> normals(mesh.face_count());
  std::vector<std::uint8_t> flat(mesh.face_count(), 0);
  parallel_for(mesh.face_count(), [&](std::size_t f) {
    const Triangle& t = mesh.triangle(static_cast<FaceId>(f));
    const Point a = mesh.point(t[1]) - mesh.point(t[0]);
    const Point b = mesh.point(t[2]) - mesh.point(t[0]);
    const Point n = a.cross(b);
    const double norm = n.norm();
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
    flat[f] = !(norm > zero_area_share * longest);
    normals[f] = flat[f] ? Point(Point::Zero()) : Point(n / norm);
  });
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!flat[f]) continue;
    FaceId across = static_cast<FaceId>(f);
    for (int steps = 0; steps < 16 && across != no_id && flat[across]; ++steps) {
      HalfEdgeId longest = mesh.face_half_edge(across);
      for (const HalfEdgeId h : mesh.sides(across))
        if (mesh.edge_length(Mesh::edge_of(h)) > mesh.edge_length(Mesh::edge_of(longest)))
          longest = h;
      across = mesh.face(Mesh::opposite(longest));
    }
    if (across != no_id && !flat[across]) normals[f] = normals[across];
  }
  return normals;
}

/// What the star of a vertex adds up to.
struct Star {
  double angles = 0.0;          // sum of alpha
  double area = 0.0;            // sum of A
  double modulus = 0.0;         // denominator of eq. 2
  double mixed_area = 0.0;      // Meyer et al. 2003
  double sector_modulus = 0.0;  // D, denominator of eq. 13
  double betas = 0.0;
  double betas_by_length = 0.0;
};

Star star_of(const Mesh& mesh, const std::vector<float>& beta, VertexId v) {
  Star star;
  const Point& p = mesh.point(v);
  mesh.for_ring(v, [&](HalfEdgeId h) {
    const Point a = mesh.point(mesh.to(h)) - p;
    const double edge_beta = beta[Mesh::edge_of(h)];
    star.betas += edge_beta;
    star.betas_by_length += edge_beta * a.norm();
    if (mesh.face(h) == no_id) return;
    const Point b = mesh.point(mesh.to(mesh.next(h))) - p;
    const Point opposite = b - a;
    const double cross = a.cross(b).norm();
    const double dot = a.dot(b);
    const double alpha = std::atan2(cross, dot);
    star.angles += alpha;
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), opposite.squaredNorm()});
    if (cross > zero_area_share * longest) {
      const double area = 0.5 * cross;
      const double cot = dot / cross;
      const double cell = 0.5 * area - 0.125 * cot * opposite.squaredNorm();
      star.area += area;
      star.modulus += cell;
      const bool obtuse_here = dot < 0.0;
      const bool obtuse_there = a.dot(opposite) > 0.0 || b.dot(opposite) < 0.0;
      star.mixed_area += obtuse_here ? 0.5 * area : obtuse_there ? 0.25 * area : cell;
    }
    // alpha^2 cot(alpha) tends to alpha at 0, where the quotient cannot be formed.
    const double sine = std::sin(alpha);
    star.sector_modulus +=
        0.25 * alpha - 0.125 * (sine > 1e-12 ? alpha * alpha * std::cos(alpha) / sine : alpha);
  });
  return star;
}

Shape shape_of(double k, double h, double tolerance) {
  if (std::isnan(k) || std::isnan(h)) return Shape::undefined;
  const double root = std::sqrt(std::max(h * h - k, 0.0));
  const auto sign = [&](double x) { return x > tolerance ? 1 : x < -tolerance ? -1 : 0; };
  const int high = sign(h + root), low = sign(h - root);
  if (high == 0 && low == 0) return Shape::flat;
  if (high > 0 && low < 0) return Shape::saddle;
  if (high > 0) return low > 0 ? Shape::elliptic_convex : Shape::ridge;
  return high < 0 ? Shape::elliptic_concave : Shape::valley;
}

}  // namespace

std::size_t Curvatures::bytes() const {
  return 10 * k.capacity() * sizeof(double) + beta.capacity() * sizeof(float) +
         shape.capacity() * sizeof(Shape) + by_decreasing_ikabs.capacity() * sizeof(VertexId);
}

Result<CurvaturesPtr> compute_curvatures(const Mesh& mesh, const CurvatureOptions& options,
                                         const Context& context) {
  auto result = std::make_shared<Curvatures>();
  Curvatures& c = *result;
  c.options = options;
  context.report(0.0, "curvatures");

  c.beta.assign(mesh.edge_count(), 0.0f);
  {
    const std::vector<Point> normals = face_normals(mesh);
    const Context part = context.part(0.0, 0.3);
    const auto measure = [&](std::size_t i) {
      const EdgeId e = static_cast<EdgeId>(i);
      const auto [left, right] = mesh.edge_faces(e);
      if (left == no_id || right == no_id) return;
      const Point direction = mesh.point(mesh.edge(e)[1]) - mesh.point(mesh.edge(e)[0]);
      const Point cross = normals[left].cross(normals[right]);
      const double angle = std::atan2(cross.norm(), normals[left].dot(normals[right]));
      c.beta[i] = static_cast<float>(cross.dot(direction) < 0.0 ? -angle : angle);
    };
    if (!watched_for(mesh.edge_count(), part, "curvatures", measure)) return cancelled();
  }
  context.report(0.3, "curvatures");

  const std::size_t n = mesh.vertex_count();
  for (std::vector<double>* values :
       {&c.k_area, &c.k, &c.h_area, &c.h, &c.kabs, &c.ih1, &c.ih2, &c.ik1, &c.ik2, &c.ikabs})
    values->assign(n, undefined);
  std::vector<std::uint8_t> mixed(n, 0);
  const auto measure = [&](std::size_t i) {
    const VertexId v = static_cast<VertexId>(i);
    if (mesh.is_isolated(v)) return;
    const Star star = star_of(mesh, c.beta, v);
    if (mesh.is_border(v)) {
      c.ih1[i] = c.ih2[i] = 1.5 * star.betas / pi;
      c.ik1[i] = c.ik2[i] = 0.0;
    } else {
      const double deviation = 2.0 * pi - star.angles;
      const double third = star.area / 3.0;
      double modulus = star.modulus;
      if (modulus < options.least_modulus_share * third) {
        modulus = star.mixed_area;
        mixed[i] = 1;
      }
      if (third > 0.0) {
        c.k_area[i] = deviation / third;
        c.h_area[i] = 0.25 * star.betas_by_length / third;
      }
      if (modulus > 0.0) {
        c.k[i] = deviation / modulus;
        c.h[i] = 0.25 * star.betas_by_length / modulus;
        c.kabs[i] = std::max(0.0, 4.0 * c.h[i] * c.h[i] - 2.0 * c.k[i]);
      }
      c.ih1[i] = 1.5 * star.betas / star.angles;
      c.ih2[i] = 0.25 * star.betas / star.sector_modulus;
      c.ik1[i] = deviation / star.sector_modulus;
      c.ik2[i] = 6.0 * deviation / star.angles;
    }
    const bool h2 =
        options.pairing == InvariantPairing::h2_k1 || options.pairing == InvariantPairing::h2_k2;
    const bool k2 =
        options.pairing == InvariantPairing::h1_k2 || options.pairing == InvariantPairing::h2_k2;
    const double ih = h2 ? c.ih2[i] : c.ih1[i];
    c.ikabs[i] = std::max(0.0, 4.0 * ih * ih - 2.0 * (k2 ? c.ik2[i] : c.ik1[i]));
  };
  if (!watched_for(n, context.part(0.3, 0.7), "curvatures", measure)) return cancelled();
  c.mixed_area_vertices = static_cast<std::uint64_t>(std::count(mixed.begin(), mixed.end(), 1));
  context.report(0.7, "curvatures");

  // A principal curvature counts as zero where its radius exceeds the part, or where noise alone
  // could give it: on a smooth surface H hardly differs between neighbours, noise differs wholly.
  std::vector<double> differences;
  differences.reserve(mesh.edge_count());
  for (const EdgeVertices& edge : mesh.edges()) {
    const double difference = std::abs(c.h[edge[0]] - c.h[edge[1]]);
    if (!std::isnan(difference)) differences.push_back(difference);
  }
  if (mesh.diagonal() > 0.0) c.shape_tolerance = 1.0 / mesh.diagonal();
  if (!differences.empty()) {
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    const double h_noise = 1.4826 * *middle / std::numbers::sqrt2;   // standard deviation of H
    c.shape_tolerance = std::max(c.shape_tolerance, 4.0 * h_noise);  // k is H and a root of H^2 - K
  }
  if (context.cancelled()) return cancelled();
  context.report(0.8, "curvatures");
  c.shape.assign(n, Shape::undefined);
  parallel_for(n, [&](std::size_t i) { c.shape[i] = shape_of(c.k[i], c.h[i], c.shape_tolerance); });

  if (context.cancelled()) return cancelled();
  context.report(0.85, "curvatures");
  for (VertexId v = 0; v < n; ++v)
    if (!mesh.is_isolated(v) && !mesh.is_border(v)) c.by_decreasing_ikabs.push_back(v);
  parallel_sort(c.by_decreasing_ikabs.begin(), c.by_decreasing_ikabs.end(),
                [&](VertexId a, VertexId b) {
                  return c.ikabs[a] != c.ikabs[b] ? c.ikabs[a] > c.ikabs[b] : a < b;
                });
  context.report(1.0, "curvatures");
  return CurvaturesPtr(std::move(result));
}

double angle_deviation(const Mesh& mesh, VertexId v) {
  if (mesh.is_isolated(v) || mesh.is_border(v)) return 0.0;
  double angles = 0.0;
  mesh.for_ring(v, [&](HalfEdgeId h) {
    angles +=
        corner_angle(mesh.point(v), mesh.point(mesh.to(h)), mesh.point(mesh.to(mesh.next(h))));
  });
  return 2.0 * pi - angles;
}

double edge_mean_curvature(const Mesh& mesh, const Curvatures& curvatures, EdgeId e) {
  return 0.5 * curvatures.beta[e] * mesh.edge_length(e);
}

double cylinder_radius(double kabs) { return 1.0 / std::sqrt(kabs); }

double ikabs_of_straight_edge(double angle) { return 9.0 * angle * angle / (pi * pi); }

Point mean_normal(const Mesh& mesh) {
  Point sum = Point::Zero();
  double area = 0.0;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Point n = area_normal(mesh, f);
    sum += n;
    area += n.norm();
  }
  return area > 0.0 ? Point(sum / area) : sum;
}

}  // namespace arris
