#include "core/sharp_lines/tight_tubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>

#include "core/base/parallel.h"
#include "core/base/watched_for.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/normal_window.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// A round wall about an axis.
struct Tube {
  Vector3f axis = Vector3f::Zero(), centre = Vector3f::Zero();
  float radius = 0.0F;  // negative: a pin
  float tilt = 0.0F;    // radians: of the normals against the radius, root of the mean square

  float along_axis(const Vector3f& normal) const { return std::abs(normal.dot(axis)); }
  Vector3f from_axis(const Vector3f& p) const {
    const Vector3f d = p - centre;
    return d - axis * d.dot(axis);
  }
};

class TubeFinder {
 public:
  TubeFinder(const FaceTable& table, const std::vector<Vector3f>& normals,
             const TightTubeOptions& options)
      : table_(table),
        normals_(normals),
        options_(options),
        most_along_(std::sin(options.most_slant * in_radians<float>)) {}

  /// The wall about a place on it.
  std::optional<Tube> fit_at(const std::vector<FaceId>& seeds, const Vector3f& place,
                             FaceWindow& window, std::vector<WindowFace>& scratch,
                             const FallingExponential& falling) const {
    constexpr float about = 4.0F;  // mean edges: as the windows of the jump
    scratch.clear();
    for (const FaceId f : window.grow(seeds, place, about))
      scratch.push_back({table_.faces[f].centre - place, normals_[f], table_.faces[f].area});
    Tube tube;
    tube.axis = frame_of(scratch, 1.0F, falling).along;
    if (tube.axis.isZero()) return {};
    const auto& faces =
        window.grow(seeds, place, 2.0F * options_.most_radius + 1.0F,
                    [&](FaceId f) { return tube.along_axis(normals_[f]) < most_along_; });
    return fit(faces);
  }

  /// Axis, centre and radius by these faces; nothing where they do not close round it.
  std::optional<Tube> fit(const std::vector<FaceId>& faces) const {
    Eigen::Matrix3f tensor = Eigen::Matrix3f::Zero();
    Vector3f middle = Vector3f::Zero();
    float area = 0.0F;
    for (const FaceId f : faces) {
      const float w = table_.faces[f].area;
      tensor.noalias() += w * normals_[f] * normals_[f].transpose();
      middle += w * table_.faces[f].centre;
      area += w;
    }
    if (!(area > options_.least_area * mean_face_area)) return {};
    middle /= area;
    Tube tube;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(tensor);
    tube.axis = solver.eigenvectors().col(0);
    const Vector3f x = solver.eigenvectors().col(1), y = solver.eigenvectors().col(2);
    // The lines through the faces along their normals meet on the axis.
    Eigen::Matrix2f lines = Eigen::Matrix2f::Zero();
    Vector2f right = Vector2f::Zero();
    const auto flat = [&](const Vector3f& v) { return Vector2f(v.dot(x), v.dot(y)); };
    for (const FaceId f : faces) {
      const Vector2f m = flat(normals_[f]).normalized();
      const Eigen::Matrix2f off =
          table_.faces[f].area * (Eigen::Matrix2f::Identity() - m * m.transpose());
      lines += off;
      right += off * flat(table_.faces[f].centre - middle);
    }
    if (!(lines.determinant() > 1e-3F * area * area)) return {};
    const Vector2f centre = lines.inverse() * right;
    tube.centre = middle + centre.x() * x + centre.y() * y;
    constexpr std::size_t sectors = 12;
    std::array<bool, sectors> seen{};
    float radius = 0.0F, tilt = 0.0F;
    for (const FaceId f : faces) {
      const Vector2f d = flat(table_.faces[f].centre - tube.centre);
      const Vector2f m = flat(normals_[f]).normalized();
      const float w = table_.faces[f].area;
      radius -= w * d.dot(m);
      const float length = d.norm();
      if (!(length > 1e-6F)) continue;
      const float sine = (d.x() * m.y() - d.y() * m.x()) / length;
      tilt += w * sine * sine;
      const auto at = static_cast<std::size_t>(
          (std::atan2(d.y(), d.x()) / (2.0F * std::numbers::pi_v<float>)+0.5F) * sectors);
      seen[std::min(at, sectors - 1)] = true;
    }
    tube.radius = radius / area;
    tube.tilt = std::sqrt(tilt / area);
    const float size = std::abs(tube.radius);
    if (size > options_.most_radius || size < options_.least_radius) return {};
    if (tube.tilt > options_.most_tilt * in_radians<float>) return {};
    // A face may span more than a sector of the narrowest.
    if (std::count(seen.begin(), seen.end(), true) + 1 < static_cast<std::ptrdiff_t>(sectors))
      return {};
    return tube;
  }

  /// Whether a face belongs to the wall: across the axis, about as far from it, and facing as the
  /// rest of the wall does.
  bool is_on(const Tube& tube, FaceId f) const {
    constexpr float loose = 0.35F, slack = 0.3F;  // share of the radius, and mean edges
    constexpr float least_facing = 0.5F;          // cosine against the radius
    if (tube.along_axis(normals_[f]) >= most_along_) return false;
    const Vector3f d = tube.from_axis(table_.faces[f].centre);
    const float length = d.norm(), size = std::abs(tube.radius);
    if (std::abs(length - size) > loose * size + slack) return false;
    const float outwards = d.dot(normals_[f]) / std::max(length, 1e-6F);
    return (tube.radius > 0.0F ? -outwards : outwards) > least_facing;
  }

 private:
  const FaceTable& table_;
  const std::vector<Vector3f>& normals_;
  const TightTubeOptions options_;
  const float most_along_;
};

}  // namespace

std::vector<std::uint32_t> find_tight_tubes(const Mesh& mesh, const FaceTable& table,
                                            const std::vector<Vector3f>& normals,
                                            const NormalJump& jump, const TightTubeOptions& options,
                                            const Context& context) {
  std::vector<std::uint32_t> of_face(table.size(), no_id);
  std::vector<VertexId> places;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (jump.turn[v] >= options.least_turn) places.push_back(v);
  const TubeFinder finder(table, normals, options);
  struct Local {
    explicit Local(const FaceTable& all) : window(all) {}
    FaceWindow window;
    std::vector<FaceId> seeds;
    std::vector<WindowFace> scratch;
  };
  const auto faces_at = [&](VertexId v, std::vector<FaceId>& faces) {
    faces.clear();
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (mesh.face(h) != no_id) faces.push_back(mesh.face(h));
    });
  };
  const FallingExponential falling;
  PerThread<Local> locals([&] { return Local(table); });
  std::vector<std::optional<Tube>> tubes(places.size());
  const auto fit = [&](std::size_t i) {
    Local& local = locals.local();
    faces_at(places[i], local.seeds);
    tubes[i] =
        finder.fit_at(local.seeds, table.points[places[i]], local.window, local.scratch, falling);
  };
  if (!watched_for(places.size(), context, "walls of holes", fit, 64)) return of_face;
  // The best fits grow first.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (tubes[i]) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tubes[a]->tilt != tubes[b]->tilt ? tubes[a]->tilt < tubes[b]->tilt : a < b;
  });
  std::uint32_t count = 0;
  std::vector<FaceId> wall, seeds;
  std::vector<std::uint32_t> seen(table.size(), no_id);
  std::uint32_t stamp = 0;
  for (const std::size_t i : order) {
    if (context.cancelled()) return of_face;
    faces_at(places[i], seeds);
    if (std::any_of(seeds.begin(), seeds.end(), [&](FaceId f) { return of_face[f] != no_id; }))
      continue;
    std::optional<Tube> tube = tubes[i];
    constexpr int rounds = 2;  // again by all that the first fit reaches
    for (int round = 0; tube && round < rounds; ++round) {
      ++stamp;
      wall.clear();
      for (const FaceId f : seeds)
        if (finder.is_on(*tube, f)) {
          seen[f] = stamp;
          wall.push_back(f);
        }
      for (std::size_t k = 0; k < wall.size(); ++k)
        for (const FaceId g : table.neighbours[wall[k]])
          if (g != no_id && seen[g] != stamp && of_face[g] == no_id && finder.is_on(*tube, g)) {
            seen[g] = stamp;
            wall.push_back(g);
          }
      tube = finder.fit(wall);
    }
    if (!tube) continue;
    for (const FaceId f : wall) of_face[f] = count;
    ++count;
  }
  return of_face;
}

void clear_jump_on(const Mesh& mesh, const std::vector<std::uint32_t>& tubes, NormalJump& jump) {
  parallel_for(mesh.edge_count(), [&](std::size_t e) {
    const auto [left, right] = mesh.edge_faces(static_cast<EdgeId>(e));
    if (left != no_id && right != no_id && tubes[left] != no_id && tubes[left] == tubes[right])
      jump.at_edge[e] = 0.0F;
  });
  parallel_for(mesh.vertex_count(), [&](std::size_t v) {
    bool on = !mesh.is_isolated(static_cast<VertexId>(v));
    mesh.for_ring(static_cast<VertexId>(v), [&](HalfEdgeId h) {
      on = on && mesh.face(h) != no_id && tubes[mesh.face(h)] != no_id;
    });
    if (on) jump.at_vertex[v] = 0.0F;
  });
}

}  // namespace arris
