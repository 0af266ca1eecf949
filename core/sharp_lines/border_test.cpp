#include "core/sharp_lines/border_test.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

using Eigen::Vector3f;
/// Beyond this a side shows whether it is wide enough to have a slope.
constexpr float far_side = 2.0F;
/// Faces belong to a place only where their nearest border edge is on its chain, no farther along.
constexpr std::ptrdiff_t own_reach = 7;
constexpr std::ptrdiff_t smoothing = 3;  // places on either side over which a chain is smoothed

}  // namespace

BorderTest::BorderTest(const Mesh& mesh, const FaceTable& table,
                       const std::vector<Vector3f>& normals,
                       const std::vector<std::uint32_t>& labels, std::vector<std::uint32_t>& parent,
                       const BorderTestOptions& options)
    : mesh_(mesh),
      table_(table),
      normals_(normals),
      labels_(labels),
      parent_(parent),
      options_(options),
      slot_of_edge_(mesh.edge_count(), no_id),
      nearest_(mesh.face_count(), no_id) {
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    const auto [left, right] = mesh.edge_faces(e);
    if (left == no_id || right == no_id || labels[left] == labels[right]) continue;
    slot_of_edge_[e] = static_cast<std::uint32_t>(edges.size());
    edges.push_back(e);
  }
  chain_of_.assign(edges.size(), no_id);
  index_of_.assign(edges.size(), 0);
  sums_.resize(edges.size());
  place_.resize(edges.size());
  // Where the scan ends a border ends, too: three regions may meet there at two edges.
  std::vector<Chain> linked = link_chains(
      mesh, edges, [&](EdgeId e) { return slot_of_edge_[e] != no_id; },
      [&](HalfEdgeId, HalfEdgeId next) { return !mesh.is_border(mesh.from(next)); });
  for (Chain& chain : linked) {
    const auto number = static_cast<std::uint32_t>(chains_.size());
    for (std::size_t i = 0; i < chain.half_edges.size(); ++i) {
      const std::uint32_t slot = slot_of_edge_[chain.half_edges[i] >> 1];
      chain_of_[slot] = number;
      index_of_[slot] = static_cast<std::uint32_t>(i);
    }
    chains_.push_back({std::move(chain.half_edges), chain.closed, true});
  }
  // The nearest border edge of each face near one, grown from the borders inside each region.
  std::vector<Vector3f> middle(edges.size());
  std::vector<float> distance(mesh.face_count(), 1e9F);
  std::vector<FaceId> front;
  for (std::uint32_t slot = 0; slot < edges.size(); ++slot) {
    const EdgeVertices& ends = mesh.edge(edges[slot]);
    middle[slot] = (table.points[ends[0]] + table.points[ends[1]]) / 2.0F;
    for (const FaceId f : mesh.edge_faces(edges[slot])) {
      const float d = (table.faces[f].centre - middle[slot]).norm();
      if (d >= distance[f]) continue;
      if (nearest_[f] == no_id) front.push_back(f);
      distance[f] = d;
      nearest_[f] = slot;
    }
  }
  const float reach = options.far * 1.3F;
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const FaceId g : table.neighbours[front[i]]) {
      if (g == no_id || labels[g] != labels[front[i]]) continue;
      const std::uint32_t slot = nearest_[front[i]];
      const float d = (table.faces[g].centre - middle[slot]).norm();
      if (d >= distance[g] - 1e-6F || d >= reach) continue;
      distance[g] = d;
      nearest_[g] = slot;
      front.push_back(g);
    }
}

VertexId BorderTest::vertex(const BorderChain& chain, std::ptrdiff_t i) const {
  const auto n = static_cast<std::ptrdiff_t>(chain.path.size());
  if (chain.closed)
    i = ((i % n) + n) % n;
  else
    i = std::clamp(i, std::ptrdiff_t{0}, n);
  return i == n ? mesh_.to(chain.path.back()) : mesh_.from(chain.path[static_cast<std::size_t>(i)]);
}

void BorderTest::sum_sides(std::uint32_t number, std::size_t from, std::size_t to,
                           FaceWindow& window) {
  const BorderChain& chain = chains_[number];
  const auto n = static_cast<std::ptrdiff_t>(chain.path.size());
  const std::ptrdiff_t range =
      chain.closed ? std::clamp(n / 8, std::ptrdiff_t{1}, smoothing) : smoothing;
  // Not the far side of a small ring.
  const std::ptrdiff_t reach = chain.closed ? std::min(n / 4, own_reach) : own_reach;
  for (std::size_t place = from; place < to; ++place) {
    const auto i = static_cast<std::ptrdiff_t>(place);
    const HalfEdgeId h = chain.path[place];
    Sums& sums = sums_[slot_of_edge_[h >> 1]];
    sums = {};
    Vector3f middle = Vector3f::Zero();
    for (std::ptrdiff_t k = 1 - range; k <= range; ++k)
      middle += table_.points[vertex(chain, i + k)];
    middle /= static_cast<float>(2 * range);
    const auto between = [&](std::ptrdiff_t a, std::ptrdiff_t b) -> Vector3f {
      return table_.points[vertex(chain, b)] - table_.points[vertex(chain, a)];
    };
    Vector3f tangent = between(i - range, i + range + 1);
    if (!(tangent.norm() > 1e-6F)) continue;
    tangent.normalize();
    // A border that bends is pooled over less of its length.
    const Vector3f before = between(i - range - 1, i + 1), after = between(i, i + range + 2);
    const float lengths = before.norm() * after.norm();
    const float bend = lengths > 0.0F
                           ? std::acos(std::clamp(before.dot(after) / lengths, -1.0F, 1.0F)) /
                                 std::max(0.5F * (before.norm() + after.norm()), 1e-6F)
                           : 0.0F;
    const float along = std::max(std::min(options_.along, 0.6F / std::max(bend, 1e-6F)), 0.35F);
    const FaceId left = mesh_.face(h), right = mesh_.face(Mesh::opposite(h));
    const std::array<std::uint32_t, 2> regions{region(left), region(right)};
    const auto& faces = window.grow(std::array{left, right}, middle, options_.far + 0.5F);
    std::array<Vector3f, 2> mean{Vector3f::Zero(), Vector3f::Zero()};
    const auto side_of = [&](FaceId f) {
      const std::uint32_t r = region(f);
      return r == regions[0] ? 0 : r == regions[1] ? 1 : -1;
    };
    for (const FaceId f : faces)
      if (const int side = side_of(f); side >= 0)
        mean[static_cast<std::size_t>(side)] += table_.faces[f].area * normals_[f];
    if (!(mean[0].norm() > 0.0F) || !(mean[1].norm() > 0.0F)) continue;
    Vector3f up = mean[0].normalized() + mean[1].normalized();
    up -= tangent * up.dot(tangent);
    if (!(up.norm() > 1e-6F)) continue;
    up.normalize();
    const Vector3f leftwards = up.cross(tangent);
    for (const FaceId f : faces) {
      const int k = side_of(f);
      if (k < 0) continue;
      const auto side = static_cast<std::size_t>(k);
      const Vector3f d = table_.faces[f].centre - middle;
      const float y = d.dot(tangent);
      if (std::abs(y) > 2.0F * along) continue;
      const float t = (d - y * tangent).norm();
      if (t < options_.near || t > options_.far) continue;
      const float w = table_.faces[f].area * std::exp(-y * y / (along * along));
      const std::uint32_t nearest = nearest_[f];
      bool own = nearest == no_id || chain_of_[nearest] == no_id;
      if (!own && chain_of_[nearest] == number) {
        auto apart = std::abs(static_cast<std::ptrdiff_t>(index_of_[nearest]) - i);
        if (chain.closed) apart = std::min(apart, n - apart);
        own = apart <= reach;
      }
      if (t > far_side) {
        sums.all_far[side] += w;
        if (own) sums.own_far[side] += w;
      }
      if (!own) continue;
      const float turn =
          std::atan2(normals_[f].dot(leftwards), normals_[f].dot(up)) * in_degrees<float>;
      std::array<float, 5>& s = sums.side[side];
      s[0] += w;
      s[1] += w * t;
      s[2] += w * t * t;
      s[3] += w * turn;
      s[4] += w * t * turn;
    }
  }
}

void BorderTest::pool(std::uint32_t number, std::size_t from, std::size_t to) {
  const BorderChain& chain = chains_[number];
  const auto n = static_cast<std::ptrdiff_t>(chain.path.size());
  for (std::size_t place = from; place < to; ++place) {
    Sums sums;
    std::ptrdiff_t first = -options_.pooled, last = options_.pooled;
    if (chain.closed && last - first + 1 > n) {  // each place once
      first = -(n - 1) / 2;
      last = first + n - 1;
    }
    for (std::ptrdiff_t k = first; k <= last; ++k) {
      std::ptrdiff_t j = static_cast<std::ptrdiff_t>(place) + k;
      if (chain.closed)
        j = ((j % n) + n) % n;
      else if (j < 0 || j >= n)
        continue;
      const float w =
          1.0F - static_cast<float>(std::abs(k)) / static_cast<float>(options_.pooled + 1);
      const Sums& other = sums_[slot_of_edge_[chain.path[static_cast<std::size_t>(j)] >> 1]];
      for (std::size_t s = 0; s < 2; ++s) {
        for (std::size_t z = 0; z < 5; ++z) sums.side[s][z] += w * other.side[s][z];
        sums.own_far[s] += w * other.own_far[s];
        sums.all_far[s] += w * other.all_far[s];
      }
    }
    BorderPlace& result = place_[slot_of_edge_[chain.path[place] >> 1]];
    result = {};
    std::array<float, 2> mean{}, at_border{};
    bool known = true;
    for (std::size_t s = 0; s < 2; ++s) {
      const std::array<float, 5>& q = sums.side[s];
      if (!(q[0] > 0.0F)) {
        known = false;
        break;
      }
      const float distance = q[1] / q[0];
      mean[s] = q[3] / q[0];
      const float spread = q[2] / q[0] - distance * distance;
      float slope = (q[4] / q[0] - distance * mean[s]) / (spread + 0.03F);
      if (spread < 0.05F) slope = 0.0F;
      // Too narrow for a slope: another border is near, and beyond it another surface.
      if (sums.own_far[s] < 0.35F * sums.all_far[s] + 1e-12F) {
        slope = 0.0F;
        mean[s] *= options_.narrow;
      }
      at_border[s] = mean[s] - slope * distance;
    }
    if (!known) continue;
    // The left side leans to the left where the border is convex.
    result.turn = mean[0] - mean[1];
    const float jump =
        std::max(0.0F, (at_border[0] - at_border[1]) * (result.turn > 0.0F ? 1.0F : -1.0F));
    result.jump = result.turn > 0.0F ? jump : -jump;
    result.value = jump < options_.least_ratio * std::abs(result.turn)
                       ? std::min(jump, options_.most_of_fillet)
                       : jump;
    result.value = std::min(result.value, 180.0F);
  }
}

void BorderTest::measure(std::uint32_t chain, FaceWindow& window) {
  const std::size_t n = chains_[chain].path.size();
  sum_sides(chain, 0, n, window);
  pool(chain, 0, n);
}

void BorderTest::remove(std::uint32_t chain) {
  chains_[chain].alive = false;
  for (const HalfEdgeId h : chains_[chain].path) chain_of_[slot_of_edge_[h >> 1]] = no_id;
}

void BorderTest::join_at(VertexId v) {
  if (mesh_.is_border(v)) return;
  std::array<std::uint32_t, 2> met{no_id, no_id};
  int count = 0;
  mesh_.for_ring(v, [&](HalfEdgeId h) {
    const std::uint32_t chain = chain_of(h >> 1);
    if (chain == no_id) return;
    if (count < 2) met[static_cast<std::size_t>(count)] = chain;
    ++count;
  });
  if (count != 2) return;
  if (met[0] == met[1]) {
    BorderChain& chain = chains_[met[0]];
    if (chain.closed || mesh_.from(chain.path.front()) != v || mesh_.to(chain.path.back()) != v)
      return;
    chain.closed = true;
    return;
  }
  // The longer one takes the other on: what follows v comes after what leads to it.
  if (chains_[met[1]].path.size() > chains_[met[0]].path.size() ||
      (chains_[met[1]].path.size() == chains_[met[0]].path.size() && met[1] < met[0]))
    std::swap(met[0], met[1]);
  BorderChain& longer = chains_[met[0]];
  std::vector<HalfEdgeId> other = std::move(chains_[met[1]].path);
  chains_[met[1]] = {{}, false, false};
  const auto reverse = [&](std::vector<HalfEdgeId>& path) {
    std::reverse(path.begin(), path.end());
    for (HalfEdgeId& h : path) {
      h = Mesh::opposite(h);
      // Left is right now, and leans the other way.
      Sums& sums = sums_[slot_of_edge_[h >> 1]];
      std::swap(sums.side[0], sums.side[1]);
      std::swap(sums.own_far[0], sums.own_far[1]);
      std::swap(sums.all_far[0], sums.all_far[1]);
      for (std::array<float, 5>& side : sums.side) {
        side[3] = -side[3];
        side[4] = -side[4];
      }
    }
  };
  if (mesh_.to(longer.path.back()) == v) {
    if (mesh_.from(other.front()) != v) reverse(other);
    longer.path.insert(longer.path.end(), other.begin(), other.end());
  } else {
    if (mesh_.to(other.back()) != v) reverse(other);
    longer.path.insert(longer.path.begin(), other.begin(), other.end());
  }
  for (std::size_t i = 0; i < longer.path.size(); ++i) {
    const std::uint32_t slot = slot_of_edge_[longer.path[i] >> 1];
    chain_of_[slot] = met[0];
    index_of_[slot] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace arris
