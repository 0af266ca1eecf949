#include "core/sharp_lines/crest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include "core/mesh/chains.h"

namespace arris {

namespace {

/// Thins the band {sign * jump >= least}. Marks the edges that are left.
class Thinning {
 public:
  Thinning(const Mesh& mesh, const FaceTable& table, const NormalJump& jump)
      : mesh_(mesh),
        table_(table),
        jump_(jump),
        kept_(mesh.edge_count(), 0),
        triangles_(mesh.edge_count(), 0),
        inside_(mesh.face_count(), 0) {}

  void thin(float sign, float least) {
    const auto in_band = [&](VertexId v) {
      return sign * jump_.at_vertex[v] >= least && !mesh_.is_border(v) && fits_windows(v);
    };
    for (FaceId f = 0; f < inside_.size(); ++f) {
      const Triangle& t = mesh_.triangle(f);
      if (!in_band(t[0]) || !in_band(t[1]) || !in_band(t[2])) continue;
      inside_[f] = 1;
      for (const EdgeId e : table_.sides[f]) ++triangles_[e];
    }
    using Entry = std::pair<float, EdgeId>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto weight = [&](EdgeId e) {
      const EdgeVertices& ends = mesh_.edge(e);
      return std::abs(jump_.at_vertex[ends[0]]) + std::abs(jump_.at_vertex[ends[1]]);
    };
    for (EdgeId e = 0; e < kept_.size(); ++e) {
      const EdgeVertices& ends = mesh_.edge(e);
      if (!in_band(ends[0]) || !in_band(ends[1])) continue;
      kept_[e] = 1;
      if (triangles_[e] == 1) queue.push({weight(e), e});
    }
    while (!queue.empty()) {
      const EdgeId e = queue.top().second;
      queue.pop();
      if (!kept_[e] || triangles_[e] != 1) continue;
      FaceId inside = no_id;
      for (const FaceId f : mesh_.edge_faces(e))
        if (f != no_id && inside_[f]) inside = f;
      kept_[e] = 0;
      inside_[inside] = 0;
      for (const EdgeId side : table_.sides[inside])
        if (--triangles_[side] == 1 && kept_[side]) queue.push({weight(side), side});
    }
  }

  std::vector<std::uint8_t>& kept() { return kept_; }

 private:
  /// Edges far shorter or longer than the mean are no scan's: windows say nothing there.
  bool fits_windows(VertexId v) const {
    constexpr double shortest = 0.25, longest = 4.0;
    bool fits = true;
    mesh_.for_ring(v, [&](HalfEdgeId h) {
      const double length = mesh_.edge_length(h >> 1) / table_.unit;
      fits = fits && length >= shortest && length <= longest;
    });
    return fits;
  }

  const Mesh& mesh_;
  const FaceTable& table_;
  const NormalJump& jump_;
  std::vector<std::uint8_t> kept_;       // per edge
  std::vector<std::uint8_t> triangles_;  // per edge: faces of the band beside it
  std::vector<std::uint8_t> inside_;     // per face: of the band
};

/// Branches with a free end shorter than `most` go, a few rounds.
void cut_spurs(const Mesh& mesh, double unit, float most, std::vector<EdgeId>& edges,
               std::vector<std::uint8_t>& kept) {
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Chain> chains = link_chains(
        mesh, edges, [&](EdgeId e) { return kept[e] != 0; },
        [](HalfEdgeId, HalfEdgeId) { return true; });
    const auto degree = [&](VertexId v) {
      int count = 0;
      mesh.for_ring(v, [&](HalfEdgeId h) { count += kept[h >> 1]; });
      return count;
    };
    std::vector<std::size_t> spurs;
    for (std::size_t k = 0; k < chains.size(); ++k) {
      if (chains[k].closed) continue;
      const int first = degree(mesh.from(chains[k].half_edges.front()));
      const int last = degree(mesh.to(chains[k].half_edges.back()));
      if ((first == 1) == (last == 1)) continue;
      double length = 0.0;
      for (const HalfEdgeId h : chains[k].half_edges) length += mesh.edge_length(h >> 1) / unit;
      if (length <= most) spurs.push_back(k);
    }
    if (spurs.empty()) return;
    for (const std::size_t k : spurs)
      for (const HalfEdgeId h : chains[k].half_edges) kept[h >> 1] = 0;
    std::erase_if(edges, [&](EdgeId e) { return !kept[e]; });
  }
}

}  // namespace

std::vector<BorderEdge> find_crests(const Mesh& mesh, const FaceTable& table,
                                    const NormalJump& jump, const std::vector<BorderEdge>& borders,
                                    float height, const CrestOptions& options) {
  Thinning thinning(mesh, table, jump);
  thinning.thin(1.0F, options.least);
  thinning.thin(-1.0F, options.least);
  std::vector<std::uint8_t>& kept = thinning.kept();
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < kept.size(); ++e)
    if (kept[e]) edges.push_back(e);
  cut_spurs(mesh, table.unit, options.spur, edges, kept);

  constexpr int rings = 2;
  constexpr std::ptrdiff_t way_on = 4;  // edges that lead from a crest to the border it runs into
  const std::vector<std::uint8_t> beside = vertices_near(mesh, borders, height, rings);
  for (const BorderEdge& border : borders)
    if (border.height > height) kept[border.edge] = 0;
  std::erase_if(edges, [&](EdgeId e) { return !kept[e]; });
  const std::vector<Chain> chains = link_chains(
      mesh, edges, [&](EdgeId e) { return kept[e] != 0; },
      [](HalfEdgeId, HalfEdgeId) { return true; });
  std::vector<BorderEdge> result;
  for (const Chain& chain : chains) {
    const auto n = static_cast<std::ptrdiff_t>(chain.half_edges.size());
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      float sum = 0.0F, turn = 0.0F, weights = 0.0F;
      for (std::ptrdiff_t k = -options.pooled; k <= options.pooled; ++k) {
        std::ptrdiff_t j = i + k;
        if (chain.closed)
          j = ((j % n) + n) % n;
        else if (j < 0 || j >= n)
          continue;
        const float w = static_cast<float>(options.pooled + 1 - std::abs(k));
        for (const VertexId v : mesh.edge(chain.half_edges[static_cast<std::size_t>(j)] >> 1)) {
          sum += w * jump.at_vertex[v];
          turn += w * jump.turn[v];
          weights += w;
        }
      }
      const EdgeId e = chain.half_edges[static_cast<std::size_t>(i)] >> 1;
      BorderEdge crest{e, 0.0F, {sum / weights, turn / weights, std::abs(sum) / weights}, false};
      if (crest.place.jump < 0.0F) crest.place.turn = -crest.place.turn;
      result.push_back(crest);
    }
    // Beside a border a crest only leads the way from one that is not.
    const auto is_beside = [&](std::ptrdiff_t i) {
      const EdgeVertices& ends = mesh.edge(chain.half_edges[static_cast<std::size_t>(i)] >> 1);
      return beside[ends[0]] && beside[ends[1]];
    };
    std::vector<BorderEdge> kept_places;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      BorderEdge crest = result[result.size() - static_cast<std::size_t>(n - i)];
      if (is_beside(i)) {
        bool leads = false;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - way_on);
             k <= std::min(n - 1, i + way_on); ++k)
          leads = leads || !is_beside(k);
        if (!leads) continue;
        crest.place.value = 0.0F;
      }
      kept_places.push_back(crest);
    }
    result.resize(result.size() - static_cast<std::size_t>(n));
    result.insert(result.end(), kept_places.begin(), kept_places.end());
  }
  std::sort(result.begin(), result.end(),
            [](const BorderEdge& a, const BorderEdge& b) { return a.edge < b.edge; });
  return result;
}

}  // namespace arris
