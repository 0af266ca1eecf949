#include "core/partitions/curvature_kinks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/normal_window.h"

namespace arris {

namespace {

using Eigen::Vector3f;
using Fields = Eigen::Matrix<float, 3, 2>;
constexpr std::size_t least_faces = 8;  // of a window

struct Measured {
  float kink = 0.0F, missed = 0.0F;  // in_degrees<float>
  Vector3f across = Vector3f::Zero(), normal = Vector3f::Zero();
};

/// Sums of a linear regression of the normals' two angles on (1, t, y).
struct Side {
  Eigen::Matrix3f gram = Eigen::Matrix3f::Zero();
  Fields right = Fields::Zero();

  /// How much of the sum of squares a linear field explains.
  float explained(float ridge) const {
    const float w = gram(0, 0);
    Eigen::Matrix3f held = gram;
    held(0, 0) += 1e-6F * w;
    held(1, 1) += ridge * w;
    held(2, 2) += ridge * w;
    const Fields x = held.llt().solve(right);
    return 2.0F * x.cwiseProduct(right).sum() - (x.transpose() * gram * x).trace();
  }
};

Measured measure(const std::vector<WindowFace>& faces, const CurvatureKinkOptions& options,
                 const FallingExponential& falling) {
  Measured result;
  const auto [n, across, along] = frame_of(faces, options.spread, falling);
  if (n.isZero()) return result;
  result.across = across;
  result.normal = n;

  std::array<Side, 2> sides;
  float squares = 0.0F;
  const float along2 = 1.0F / (options.along * options.along);
  for (const WindowFace& f : faces) {
    const float t = f.from_place.dot(across), height = f.from_place.dot(n);
    const float distance = std::sqrt(t * t + height * height) / options.across;
    if (distance > 1.0F) continue;
    const float cosine = f.normal.dot(n);
    if (cosine < 0.2F) continue;
    const float u = f.from_place.dot(along);
    const float w = f.area * falling(u * u * along2) * (1.0F - 0.5F * distance);
    const Eigen::Vector2f turn =
        angle_over_sine(1.0F - cosine) * Eigen::Vector2f(f.normal.dot(across), f.normal.dot(along));
    const Vector3f at(1.0F, t > 0.0F ? distance : -distance, u / options.across);
    Side& side = sides[t > 0.0F];
    side.gram.noalias() += (w * at) * at.transpose();
    side.right.noalias() += (w * at) * turn.transpose();
    squares += w * turn.squaredNorm();
  }
  const float w0 = sides[0].gram(0, 0), w1 = sides[1].gram(0, 0), w = w0 + w1;
  if (!(w0 > 0.0F) || !(w1 > 0.0F)) return result;
  const Side both{sides[0].gram + sides[1].gram, sides[0].right + sides[1].right};
  const float apart = sides[0].explained(options.ridge) + sides[1].explained(options.ridge);
  const float kink = std::max(0.0F, apart - both.explained(options.ridge)) / w;
  // With nearly all faces on one side the other explains anything.
  const float balance = 2.0F * std::sqrt(w0 * w1) / w;
  result.kink = std::sqrt(kink) * in_degrees<float> * std::min(1.0F, 1.2F * balance);
  result.missed = std::sqrt(std::max(0.0F, squares - apart) / w / 2.0F) * in_degrees<float>;
  return result;
}

}  // namespace

Result<CurvatureKinks> measure_curvature_kinks(const Mesh& mesh, const FaceTable& table,
                                               const std::vector<std::uint8_t>& skipped,
                                               const CurvatureKinkOptions& options,
                                               const Context& context) {
  std::vector<Measured> measured(mesh.vertex_count());
  const FallingExponential falling;
  const float reach = std::max(options.across, 1.2F * options.along);
  const Result<void> done = for_each_window(
      mesh, table, reach, context, "kinks of curvature",
      [&](VertexId v, const std::vector<FaceId>& faces, std::vector<WindowFace>& read) {
        // On a line the two sides do not belong to one window.
        bool on_line = false;
        mesh.for_ring(v, [&](HalfEdgeId h) {
          const FaceId f = mesh.face(h), g = mesh.face(Mesh::opposite(h));
          if (f == no_id || g == no_id) return;
          const auto& beside = table.neighbours[f];
          on_line |= std::find(beside.begin(), beside.end(), g) == beside.end();
        });
        if (on_line) return;
        for (const FaceId f : faces)
          if (!skipped[f])
            read.push_back({table.faces[f].centre - table.points[v], table.faces[f].normal,
                            table.faces[f].area});
        if (read.size() >= least_faces) measured[v] = measure(read, options, falling);
      });
  if (!done) return tl::unexpected<Error>(done.error());
  CurvatureKinks result;
  result.at_edge.assign(mesh.edge_count(), 0.0F);
  parallel_for(mesh.edge_count(), [&](std::size_t i) {
    const EdgeId e = static_cast<EdgeId>(i);
    const auto [left, right] = mesh.edge_faces(e);
    if (left == no_id || right == no_id) return;
    const Vector3f apart = table.faces[right].centre - table.faces[left].centre;
    float kink = 0.0F, ends = 0.0F;
    for (const VertexId v : mesh.edge(e)) {
      const Measured& m = measured[v];
      if (m.normal.isZero()) continue;
      const Vector3f way = apart - m.normal * apart.dot(m.normal);
      const float length = way.norm();
      const float slant = length > 0.0F ? std::abs(way.dot(m.across)) / length : 1.0F;
      kink += m.kink * std::min(1.0F, slant / options.least_slant);
      ends += 1.0F;
    }
    if (ends > 0.0F) result.at_edge[i] = kink / ends;
  });
  std::vector<float> missed;
  for (const Measured& m : measured)
    if (m.missed > 0.0F) missed.push_back(m.missed);
  if (!missed.empty()) {
    const auto middle = missed.begin() + static_cast<std::ptrdiff_t>(missed.size() / 2);
    std::nth_element(missed.begin(), middle, missed.end());
    result.noise = *middle;
  }
  return result;
}

}  // namespace arris
