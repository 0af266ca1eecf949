#include "core/sharp_lines/normal_jump.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/normal_window.h"

namespace arris {

namespace {

using Eigen::Vector3f;

struct Measured {
  float jump = 0.0F;  // in_degrees<float>, convex positive
  float turn = 0.0F;  // in_degrees<float>, between the means
  Vector3f along = Vector3f::Zero(), normal = Vector3f::Zero();
};

Measured measure(const std::vector<WindowFace>& samples, const NormalJumpOptions& options,
                 const FallingExponential& falling) {
  Measured result;
  const auto [n, across, along] = frame_of(samples, 1.0F, falling);
  if (n.isZero()) return result;
  result.along = along;
  result.normal = n;

  const float least_cosine = std::cos(options.most_turn / in_degrees<float>);
  const float near2 = options.near * options.near, far2 = options.far * options.far;
  const float across2 = 1.0F / (options.across * options.across);
  const float along2 = 1.0F / (options.along * options.along);
  // Sums for each side: weight, distance, its square, and the rotation, plain and by distance.
  std::array<float, 2> w0{}, w1{}, w2{};
  std::array<Eigen::Vector2f, 2> a0, a1;
  a0.fill(Eigen::Vector2f::Zero());
  a1.fill(Eigen::Vector2f::Zero());
  for (const WindowFace& s : samples) {
    const float cosine = s.normal.dot(n);
    if (cosine < least_cosine) continue;
    const float t = s.from_place.dot(across), height = s.from_place.dot(n);
    const float t2 = t * t + height * height;
    if (t2 < near2 || t2 > far2) continue;
    const float u = s.from_place.dot(along);
    const float w = s.area * falling(t2 * across2 + u * u * along2);
    const float distance = std::sqrt(t2);
    const Eigen::Vector2f rotation =
        angle_over_sine(1.0F - cosine) * Eigen::Vector2f(s.normal.dot(across), s.normal.dot(along));
    const std::size_t side = t > 0.0F;
    w0[side] += w;
    w1[side] += w * distance;
    w2[side] += w * t2;
    a0[side] += w * rotation;
    a1[side] += w * distance * rotation;
  }
  if (!(w0[0] > 0.0F) || !(w0[1] > 0.0F)) return result;
  std::array<Eigen::Vector2f, 2> mean, at_line;
  for (std::size_t k = 0; k < 2; ++k) {
    mean[k] = a0[k] / w0[k];
    const float distance = w1[k] / w0[k];
    const float spread = w2[k] - w0[k] * distance * distance + options.ridge * w0[k];
    at_line[k] = mean[k] - (a1[k] - distance * a0[k]) / spread * distance;
  }
  const Eigen::Vector2f plain = mean[1] - mean[0];
  const float most = plain.norm();
  if (!(most > 0.0F)) return result;
  result.jump =
      std::clamp((at_line[1] - at_line[0]).dot(plain) / most, 0.0F, most) * in_degrees<float>;
  result.turn = most * in_degrees<float>;
  if (plain[0] < 0.0F) result.jump = -result.jump;  // the sides lean towards each other
  return result;
}

}  // namespace

Result<NormalJump> measure_normal_jump(const Mesh& mesh, const FaceTable& table,
                                       const std::vector<Vector3f>& normals,
                                       const NormalJumpOptions& options, const Context& context) {
  NormalJump result;
  const std::size_t vertices = mesh.vertex_count();
  result.at_vertex.assign(vertices, 0.0F);
  result.turn.assign(vertices, 0.0F);
  std::vector<Vector3f> direction(vertices, Vector3f::Zero()), normal(vertices, Vector3f::Zero());
  result.convex.assign(mesh.edge_count(), 0);
  result.at_edge.assign(mesh.edge_count(), 0.0F);
  const FallingExponential falling;
  const Result<void> done = for_each_window(
      mesh, table, options.reach, context, "normal jump",
      [&](VertexId v, const std::vector<FaceId>& faces, std::vector<WindowFace>& samples) {
        for (const FaceId f : faces)
          samples.push_back(
              {table.faces[f].centre - table.points[v], normals[f], table.faces[f].area});
        const Measured measured = measure(samples, options, falling);
        result.at_vertex[v] = measured.jump;
        result.turn[v] = measured.turn;
        direction[v] = measured.along;
        normal[v] = measured.normal;
      });
  if (!done) return tl::unexpected<Error>(done.error());
  parallel_for(mesh.edge_count(), [&](std::size_t i) {
    const EdgeId e = static_cast<EdgeId>(i);
    const auto [left, right] = mesh.edge_faces(e);
    if (left == no_id || right == no_id) return;
    float strength = 0.0F, lean = 0.0F;
    const Vector3f apart = table.faces[right].centre - table.faces[left].centre;
    for (const VertexId v : mesh.edge(e)) {
      // The way between the two faces, in the tangent plane: across the line for an edge along it.
      const Vector3f& n = normal[v];
      const Vector3f way = apart - n * apart.dot(n);
      const float length = way.norm();
      const float slant = length > 0.0F ? std::abs(way.dot(n.cross(direction[v]))) / length : 1.0F;
      strength +=
          0.5F * std::abs(result.at_vertex[v]) * std::min(1.0F, slant / options.least_slant);
      lean += result.at_vertex[v];
    }
    result.at_edge[i] = strength;
    result.convex[i] = lean > 0.0F;
  });
  return result;
}

}  // namespace arris
