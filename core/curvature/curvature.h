#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace arris {

/// Which IH and IK make up IKabs (section 3.4; E1 to E4 of table 2 in this order).
enum class InvariantPairing {
  h1_k1,  ///< 4 IH1^2 - 2 IK1, the paper's choice (eq. 14).
  h2_k1,
  h1_k2,  ///< The pairing that is exactly invariant when flat faces are split (method.md 1).
  h2_k2,
};

struct CurvatureOptions {
  InvariantPairing pairing = InvariantPairing::h1_k1;  // the paper's choice
  /// Below this share of a third of the star's area the modulus M is replaced by the mixed area.
  double least_modulus_share = 0.1;
};

/// Local form of the surface from the signs of K and H (figures 4 and 8).
enum class Shape : std::uint8_t {
  undefined,
  flat,
  elliptic_convex,
  elliptic_concave,
  ridge,   ///< Developable, convex.
  valley,  ///< Developable, concave.
  saddle,
};

/// The quantities of section 3 on one mesh. Per vertex unless said otherwise; undefined values are
/// NaN (isolated vertices everywhere; border vertices in K, H and Kabs, which have no closed star).
struct Curvatures {
  std::vector<double> k_area;  ///< Gaussian curvature by eq. 1, 1/mm^2.
  std::vector<double> k;       ///< Gaussian curvature by eq. 2 (modulus), 1/mm^2.
  std::vector<double> h_area;  ///< Mean curvature by eq. 5, 1/mm.
  std::vector<double> h;       ///< Mean curvature by eq. 6 (modulus), 1/mm; positive: convex.
  std::vector<double> kabs;    ///< Absolute curvature, eq. 8, never below 0, 1/mm^2.
  std::vector<double> ih1;     ///< Eq. 12. On the border (3/2) sum(beta) / pi.
  std::vector<double> ih2;     ///< Variant with the denominator of eq. 13. On the border as ih1.
  std::vector<double> ik1;     ///< Eq. 13. 0 on the border.
  std::vector<double> ik2;     ///< Variant with the denominator of eq. 12. 0 on the border.
  std::vector<double> ikabs;   ///< Eq. 14 by the chosen pairing, never below 0.
  std::vector<float> beta;  ///< Per edge: IHe (eq. 11), radians, convex positive; 0 on the border.
  std::vector<Shape> shape;

  /// Principal curvatures below this count as zero in `shape`, 1/mm.
  double shape_tolerance = 0.0;
  /// Vertices whose modulus was replaced by the mixed area of Meyer et al. 2003.
  std::uint64_t mixed_area_vertices = 0;
  CurvatureOptions options;

  /// Interior vertices by decreasing ikabs, ties by id: the order of the seeds of sharp lines.
  std::vector<VertexId> by_decreasing_ikabs;

  std::size_t bytes() const;
};

using CurvaturesPtr = std::shared_ptr<const Curvatures>;

/// Computes all quantities of section 3. Errors: cancelled.
Result<CurvaturesPtr> compute_curvatures(const Mesh& mesh, const CurvatureOptions& options = {},
                                         const Context& context = {});

/// 2 pi - sum of the face angles at v: the angle deviation; 0 on the border and isolated vertices.
double angle_deviation(const Mesh& mesh, VertexId v);

/// He of an edge (eq. 3), mm.
double edge_mean_curvature(const Mesh& mesh, const Curvatures& curvatures, EdgeId e);

/// Radius in mm that a value of Kabs reads as, on a cylinder (Kabs = 1/r^2). Infinite for 0.
double cylinder_radius(double kabs);

/// TV_IK from TV_IH (figure 27): the IKabs of a vertex on a straight sharp edge whose exterior
/// angle is `angle` radians, 9 angle^2 / pi^2.
double ikabs_of_straight_edge(double angle);

/// Mean of the face normals, weighted by area: the side an open scan was seen from. Its length runs
/// from 0 (a closed surface) to 1 (a plane).
Point mean_normal(const Mesh& mesh);

}  // namespace arris
