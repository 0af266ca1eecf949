#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/base/context.h"
#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"

/// What the measures over windows of faces have in common.
namespace arris {

/// exp(-x) for x >= 0 by table, 0 from 12 on. The same on every machine, and fast.
class FallingExponential {
 public:
  FallingExponential() {
    for (std::size_t k = 0; k < table_.size(); ++k)
      table_[k] = static_cast<float>(std::exp(-(static_cast<double>(k) + 0.5) / steps));
  }
  float operator()(float x) const {
    const auto k = static_cast<std::size_t>(x * steps);
    return k < table_.size() ? table_[k] : 0.0F;
  }

 private:
  static constexpr float steps = 256.0F;
  std::array<float, 12 * 256> table_;
};

/// angle / sin(angle) for 1 - cos(angle) = z, z in [0, 0.8], to 0.1 %.
inline float angle_over_sine(float z) {
  return 1.0F +
         z * (1.0F / 3 +
              z * (2.0F / 15 +
                   z * (2.0F / 35 + z * (8.0F / 315 + z * (8.0F / 693 + z * (16.0F / 3003 +
                                                                             z * 16.0F / 6435))))));
}

/// A face of a window, copied so that they lie side by side.
struct WindowFace {
  Eigen::Vector3f from_place, normal;
  float area;
};

/// How a window lies: its mean normal, the direction in which the normals turn most, and the one
/// along which they do least. All zero where the faces turn into every direction.
struct WindowFrame {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f across = Eigen::Vector3f::Zero();
  Eigen::Vector3f along = Eigen::Vector3f::Zero();
};

/// `spread`: of the weights towards the middle, mean edges.
inline WindowFrame frame_of(const std::vector<WindowFace>& faces, float spread,
                            const FallingExponential& falling) {
  using Eigen::Vector3f;
  WindowFrame frame;
  // The mean normal, and the tensor of how normals change over the tangent plane. The tensor is
  // about the mean, so it is summed up with its moments.
  Vector3f sum = Vector3f::Zero(), moment = Vector3f::Zero();
  float weight = 0.0F;
  Eigen::Matrix3f change = Eigen::Matrix3f::Zero();
  const float spread2 = 0.5F / (spread * spread);
  for (const WindowFace& f : faces) {
    const float w = f.area * falling(spread2 * f.from_place.squaredNorm());
    const Vector3f wn = w * f.normal;
    sum += wn;
    weight += w;
    moment += w * f.from_place;
    change.noalias() += wn * f.from_place.transpose();
  }
  const float length = sum.norm();
  if (!(length > 1e-6F * weight)) return frame;
  frame.normal = sum / length;
  change.noalias() -= (sum / weight) * moment.transpose();
  const Vector3f x = (std::abs(frame.normal[0]) < 0.7F ? Vector3f::UnitX() : Vector3f::UnitY())
                         .cross(frame.normal)
                         .normalized();
  const Vector3f y = frame.normal.cross(x);
  const Vector3f change_x = change * x, change_y = change * y;
  const float angle = 0.5F * std::atan2(2.0F * change_x.dot(change_y),
                                        change_x.squaredNorm() - change_y.squaredNorm());
  frame.across = std::cos(angle) * x + std::sin(angle) * y;
  frame.along = frame.normal.cross(frame.across);
  return frame;
}

/// Grows a window of faces about each vertex that has some, on all threads: `visit(v, faces,
/// scratch)` gets those within `reach` (mean edges) and an empty vector of its thread to fill. It
/// may write only what belongs to v. Errors: cancelled.
template <class Visit>
Result<void> for_each_window(const Mesh& mesh, const FaceTable& table, float reach,
                             const Context& context, std::string_view what, const Visit& visit) {
  struct Local {
    explicit Local(const FaceTable& all) : window(all) {}
    FaceWindow window;
    std::vector<FaceId> seeds;
    std::vector<WindowFace> scratch;
  };
  PerThread<Local> locals([&] { return Local(table); });
  // Share by share, so that progress is told and a stop is seen by one thread, in between.
  constexpr std::size_t shares = 50;
  const std::size_t vertices = mesh.vertex_count();
  for (std::size_t share = 0; share < shares; ++share) {
    if (context.cancelled()) return cancelled();
    context.report(static_cast<double>(share) / shares, what);
    const std::size_t first = vertices * share / shares;
    parallel_for(
        vertices * (share + 1) / shares - first,
        [&](std::size_t i) {
          const VertexId v = static_cast<VertexId>(first + i);
          Local& local = locals.local();
          local.seeds.clear();
          mesh.for_ring(v, [&](HalfEdgeId h) {
            if (mesh.face(h) != no_id) local.seeds.push_back(mesh.face(h));
          });
          if (local.seeds.empty()) return;
          local.scratch.clear();
          visit(v, local.window.grow(local.seeds, table.points[v], reach), local.scratch);
        },
        256);
  }
  return {};
}

}  // namespace arris
