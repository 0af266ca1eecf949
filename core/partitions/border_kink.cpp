#include "core/partitions/border_kink.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/base/parallel.h"
#include "core/mesh/chains.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

namespace {

using Eigen::Vector3f;
constexpr std::ptrdiff_t smoothing = 4;  // places on either side over which a chain is smoothed

float explained(const BorderSums::Side& side, float ridge) {
  const float w = side.gram(0, 0);
  Eigen::Matrix3f held = side.gram;
  held(0, 0) += 1e-6F * w;
  held(1, 1) += ridge * w;
  held(2, 2) += ridge * w;
  const Eigen::Matrix<float, 3, 2> x = held.llt().solve(side.right);
  return 2.0F * x.cwiseProduct(side.right).sum() - (x.transpose() * side.gram * x).trace();
}

/// Sums one place of a border up. `side_of(f)`: 0 or 1 for the faces of the two sides.
template <class SideOf>
void sum_place(const Mesh& mesh, const FaceTable& table, const SideOf& side_of,
               const std::vector<std::uint8_t>& skipped, const BorderKinkOptions& options,
               const Chain& chain, std::ptrdiff_t i, FaceWindow& window, BorderSums& sums) {
  const auto n = static_cast<std::ptrdiff_t>(chain.half_edges.size());
  const HalfEdgeId h = chain.half_edges[static_cast<std::size_t>(i)];
  const auto vertex = [&](std::ptrdiff_t k) -> const Vector3f& {
    k = chain.closed ? ((k % n) + n) % n : std::clamp(k, std::ptrdiff_t{0}, n);
    return table.points[k == n ? mesh.to(chain.half_edges.back())
                               : mesh.from(chain.half_edges[static_cast<std::size_t>(k)])];
  };
  sums.length = static_cast<float>(mesh.edge_length(h >> 1) / table.unit);
  FaceId first = mesh.face(h), second = mesh.face(Mesh::opposite(h));
  const bool swapped = side_of(first) == 1;
  if (swapped) std::swap(first, second);
  const std::ptrdiff_t range =
      chain.closed ? std::clamp(n / 8, std::ptrdiff_t{1}, smoothing) : smoothing;
  Vector3f middle = Vector3f::Zero();
  for (std::ptrdiff_t k = 1 - range; k <= range; ++k) middle += vertex(i + k);
  middle /= static_cast<float>(2 * range);
  Vector3f tangent = vertex(i + range + 1) - vertex(i - range);
  if (!(tangent.norm() > 1e-6F)) return;
  tangent.normalize();
  const auto& faces = window.grow(std::array{first, second}, middle, 1.05F * options.far,
                                  [&](FaceId f) { return side_of(f) <= 1; });
  std::array<Vector3f, 2> mean{Vector3f::Zero(), Vector3f::Zero()};
  for (const FaceId f : faces)
    if (!skipped[f]) {
      const float d2 = (table.faces[f].centre - middle).squaredNorm();
      mean[side_of(f) == 1] += table.faces[f].area * std::exp(-0.25F * d2) * table.faces[f].normal;
    }
  if (!(mean[0].norm() > 1e-6F) || !(mean[1].norm() > 1e-6F)) return;
  Vector3f up = mean[0].normalized() + mean[1].normalized();
  up -= tangent * up.dot(tangent);
  if (!(up.norm() > 1e-6F)) return;
  up.normalize();
  // Across: from the first side to the second. The left face of h lies on the left of the tangent.
  const Vector3f across = (swapped ? 1.0F : -1.0F) * up.cross(tangent);
  const Vector3f along = up.cross(across);
  for (const FaceId f : faces) {
    if (skipped[f]) continue;
    const Vector3f d = table.faces[f].centre - middle;
    const float y = d.dot(along);
    if (std::abs(y) > options.along) continue;
    const bool beyond = side_of(f) == 1;
    const float t = (d - y * along).norm();
    if (t < options.near || t > options.far) continue;
    Eigen::Vector2f turn(table.faces[f].normal.dot(across), table.faces[f].normal.dot(along));
    const float sine = turn.norm();
    if (sine > 1e-6F)
      turn *= std::atan2(sine, table.faces[f].normal.dot(up)) / sine * in_degrees<float>;
    const float w = table.faces[f].area;
    const Vector3f at(1.0F, beyond ? t : -t, y);
    BorderSums::Side& side = sums.sides[beyond];
    side.gram.noalias() += (w * at) * at.transpose();
    side.right.noalias() += (w * at) * turn.transpose();
  }
}

}  // namespace

void BorderSums::add(const BorderSums& other) {
  for (std::size_t k = 0; k < 2; ++k) {
    sides[k].gram += other.sides[k].gram;
    sides[k].right += other.sides[k].right;
  }
  length += other.length;
}

BorderSums BorderSums::turned() const {
  BorderSums result;
  const Vector3f turn(1.0F, -1.0F, -1.0F);
  for (std::size_t k = 0; k < 2; ++k) {
    result.sides[k].gram = turn.asDiagonal() * sides[1 - k].gram * turn.asDiagonal();
    result.sides[k].right = -(turn.asDiagonal() * sides[1 - k].right);
  }
  result.length = length;
  return result;
}

float BorderSums::kink() const {
  const float w0 = sides[0].gram(0, 0), w1 = sides[1].gram(0, 0), w = w0 + w1;
  if (!(w0 > 0.0F) || !(w1 > 0.0F)) return 0.0F;
  constexpr float ridge = 0.05F;
  const Side both{sides[0].gram + sides[1].gram, sides[0].right + sides[1].right};
  const float apart = explained(sides[0], ridge) + explained(sides[1], ridge);
  float kink = std::sqrt(std::max(0.0F, apart - explained(both, ridge)) / w);
  // A narrow side shows less than is there.
  const float balance = 4.0F * w0 * w1 / (w * w);
  if (balance < 0.75F) kink /= std::sqrt(std::max(balance, 0.15F) / 0.75F);
  return kink;
}

BorderPlaces measure_borders(const Mesh& mesh, const FaceTable& table,
                             const std::vector<std::uint32_t>& labels,
                             const std::vector<std::uint8_t>& skipped,
                             const BorderKinkOptions& options) {
  BorderPlaces result;
  std::vector<std::uint32_t> slot(mesh.edge_count(), no_id);
  for (FaceId f = 0; f < table.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const FaceId g = table.neighbours[f][k];
      if (g != no_id && f < g && labels[f] != labels[g]) result.edges.push_back(table.sides[f][k]);
    }
  std::sort(result.edges.begin(), result.edges.end());
  for (std::uint32_t k = 0; k < result.edges.size(); ++k) slot[result.edges[k]] = k;
  result.places.resize(result.edges.size());
  const std::vector<Chain> chains = link_chains(
      mesh, result.edges, [&](EdgeId e) { return slot[e] != no_id; },
      [&](HalfEdgeId h, HalfEdgeId next) {
        return labels[mesh.face(h)] == labels[mesh.face(next)] &&
               labels[mesh.face(Mesh::opposite(h))] == labels[mesh.face(Mesh::opposite(next))];
      });
  PerThread<FaceWindow> windows([&] { return FaceWindow(table); });
  parallel_for(
      chains.size(),
      [&](std::size_t c) {
        FaceWindow& window = windows.local();
        for (std::size_t i = 0; i < chains[c].half_edges.size(); ++i) {
          const HalfEdgeId h = chains[c].half_edges[i];
          const std::uint32_t a = labels[mesh.face(h)], b = labels[mesh.face(Mesh::opposite(h))];
          const auto side_of = [&](FaceId f) {
            return labels[f] == std::min(a, b) ? 0 : labels[f] == std::max(a, b) ? 1 : 2;
          };
          sum_place(mesh, table, side_of, skipped, options, chains[c],
                    static_cast<std::ptrdiff_t>(i), window, result.places[slot[h >> 1]]);
        }
      },
      4);
  return result;
}

BorderSums measure_path(const Mesh& mesh, const FaceTable& table,
                        const std::vector<HalfEdgeId>& path,
                        const std::function<int(FaceId)>& side_of,
                        const std::vector<std::uint8_t>& skipped, const BorderKinkOptions& options,
                        FaceWindow& window) {
  const Chain chain{path, false};
  BorderSums all;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const FaceId left = mesh.face(path[i]), right = mesh.face(Mesh::opposite(path[i]));
    if (left == no_id || right == no_id || side_of(left) + side_of(right) != 1) continue;
    BorderSums sums;
    sum_place(mesh, table, side_of, skipped, options, chain, static_cast<std::ptrdiff_t>(i), window,
              sums);
    all.add(sums);
  }
  return all;
}

float clear_kink(const BorderSums& sums, const BorderKinkOptions& options, float noise,
                 float most_faces) {
  const float kink = sums.kink();
  const float faces = std::min(
      std::max(sums.length * 1.5F * options.far / mean_face_area / 1.3F, 4.0F), most_faces);
  return std::sqrt(std::max(0.0F, kink * kink - 6.0F * noise * noise / faces));
}

}  // namespace arris
