#include "core/sharp_lines/candidate_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>

namespace arris {

namespace {

bool may_be_line(const BorderPlace& place, const LineChoiceOptions& options) {
  return std::abs(place.value) <= options.max_angle &&
         (place.turn >= 0.0F ? options.convex : options.concave);
}

}  // namespace

CandidateGraph::CandidateGraph(const Mesh& mesh, const FaceTable& table,
                               std::vector<BorderEdge> edges)
    : edges_(std::move(edges)) {
  std::vector<VertexId> vertices;
  for (const BorderEdge& edge : edges_)
    for (const VertexId v : mesh.edge(edge.edge)) vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto number = [&](VertexId v) {
    return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                      vertices.begin());
  };
  starts_.assign(vertices.size() + 1, 0);
  for (const BorderEdge& edge : edges_) {
    const EdgeVertices& ends = mesh.edge(edge.edge);
    ends_.push_back({number(ends[0]), number(ends[1])});
    length_.push_back(static_cast<float>(mesh.edge_length(edge.edge) / table.unit));
    const Eigen::Vector3f &from = table.points[ends[0]], &to = table.points[ends[1]];
    middle_.push_back(0.5F * (from + to));
    direction_.push_back((to - from).stableNormalized());
    for (const std::uint32_t v : ends_.back()) ++starts_[v + 1];
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) starts_[v + 1] += starts_[v];
  halves_.resize(2 * edges_.size());
  std::vector<std::uint32_t> place(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    for (std::size_t k = 0; k < 2; ++k) halves_[place[ends_[e][k]]++] = {e, ends_[e][1 - k]};
}

const BorderEdge* CandidateGraph::find(EdgeId e) const {
  const auto found =
      std::lower_bound(edges_.begin(), edges_.end(), e,
                       [](const BorderEdge& edge, EdgeId x) { return edge.edge < x; });
  return found != edges_.end() && found->edge == e ? &*found : nullptr;
}

std::size_t CandidateGraph::bytes() const {
  return edges_.size() * (sizeof(BorderEdge) + sizeof(float) + sizeof ends_[0] +
                          2 * (sizeof middle_[0] + sizeof(Half))) +
         starts_.size() * sizeof starts_[0];
}

std::size_t CandidateGraph::degree(std::uint32_t v, const std::vector<std::uint8_t>& chosen) const {
  std::size_t count = 0;
  for (const Half& half : around(v)) count += chosen[half.edge];
  return count;
}

std::vector<EdgeId> CandidateGraph::choose(const LineChoiceOptions& options) const {
  if (edges_.empty()) return {};
  std::vector<std::uint8_t> chosen(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e)
    chosen[e] = edges_[e].height > options.angle && may_be_line(edges_[e].place, options);
  if (options.least_slit > 0.0F) add_slits(options, chosen);
  if (options.gap > 0.0F) close_gaps(options.gap, chosen);
  cut_spurs(options, chosen);
  drop_short(options.least_group, chosen);
  std::vector<EdgeId> result;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (chosen[e]) result.push_back(edges_[e].edge);
  return result;
}

/// Tells which candidates run beside one of the chosen ones, by a grid of their middles.
class CandidateGraph::Beside {
 public:
  /// `reach`: mean edges; 0: nothing is beside anything.
  Beside(const CandidateGraph& graph, const std::vector<std::uint8_t>& chosen, float reach)
      : graph_(graph), reach_(reach) {
    for (std::uint32_t e = 0; reach > 0.0F && e < chosen.size(); ++e)
      if (chosen[e]) cells_.emplace_back(cell(graph.middle_[e], {0, 0, 0}), e);
    std::sort(cells_.begin(), cells_.end());
  }

  bool operator()(std::uint32_t e) const {
    if (cells_.empty()) return false;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const std::uint64_t key = cell(graph_.middle_[e], {x, y, z});
          for (auto it = std::lower_bound(cells_.begin(), cells_.end(), std::pair{key, 0U});
               it != cells_.end() && it->first == key; ++it)
            if (is_beside(e, it->second)) return true;
        }
    return false;
  }

 private:
  /// What goes on where a line ends is not beside it.
  bool is_beside(std::uint32_t e, std::uint32_t line) const {
    constexpr float along = 0.75F;
    const Eigen::Vector3f offset = graph_.middle_[e] - graph_.middle_[line];
    return offset.squaredNorm() < reach_ * reach_ &&
           std::abs(offset.dot(graph_.direction_[line])) <=
               along * std::max(1.0F, graph_.length_[line]);
  }
  std::uint64_t cell(const Eigen::Vector3f& place, const std::array<int, 3>& step) const {
    constexpr float most = 1 << 20;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) {
      const float at = std::clamp(std::floor(place[k] / reach_), 1.0F - most, most - 2.0F);
      key = key << 21 | static_cast<std::uint64_t>(static_cast<std::int64_t>(at + most) +
                                                   step[static_cast<std::size_t>(k)]);
    }
    return key;
  }

  const CandidateGraph& graph_;
  float reach_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_;  // and the chosen candidate there
};

void CandidateGraph::add_slits(const LineChoiceOptions& options,
                               std::vector<std::uint8_t>& chosen) const {
  constexpr float clear_ratio = 0.65F;  // of the jump to the turn: nothing like a fillet
  const Beside beside(*this, chosen, options.beside);
  // Connected stretches of what is as sharp as a line without parting two regions.
  std::vector<std::uint8_t> seen(edges_.size(), 0);
  std::vector<std::uint32_t> group;
  for (std::uint32_t start = 0; start < edges_.size(); ++start) {
    const auto is_slit = [&](std::uint32_t e) {
      const BorderPlace& place = edges_[e].place;
      return !chosen[e] && !seen[e] && place.value >= options.angle &&
             may_be_line(place, options) &&
             std::abs(place.jump) >= clear_ratio * std::abs(place.turn);
    };
    if (!is_slit(start)) continue;
    group.assign(1, start);
    seen[start] = 1;
    float length = 0.0F, sharpest = 0.0F;  // degrees
    for (std::size_t k = 0; k < group.size(); ++k) {
      const float strength = edges_[group[k]].place.value / options.angle;
      if (!beside(group[k])) length += length_[group[k]] * strength * strength;
      sharpest = std::max(sharpest, edges_[group[k]].place.value);
      for (const std::uint32_t v : ends_[group[k]])
        for (const Half& half : around(v))
          if (is_slit(half.edge)) {
            seen[half.edge] = 1;
            group.push_back(half.edge);
          }
    }
    if (length >= options.least_slit && sharpest >= options.clear_slit)
      for (const std::uint32_t e : group) seen[e] = 2;
  }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (seen[e] == 2) chosen[e] = 1;
}

void CandidateGraph::close_gaps(float most, std::vector<std::uint8_t>& chosen) const {
  struct Reached {
    float length;
    std::uint32_t vertex;
    bool operator<(const Reached& other) const {
      return length != other.length ? length > other.length : vertex > other.vertex;
    }
  };
  std::unordered_map<std::uint32_t, float> own;  // vertices near along the line itself
  std::unordered_map<std::uint32_t, std::pair<float, Half>> reached;
  std::priority_queue<Reached> queue;
  for (std::uint32_t end = 0; end + 1 < starts_.size(); ++end) {
    if (degree(end, chosen) != 1) continue;
    // How convex the line is before it ends, and another one where it would be met.
    float turn = 0.0F;
    const auto turn_at = [&](std::uint32_t v) {
      float sum = 0.0F;
      for (const Half& half : around(v))
        if (chosen[half.edge]) sum += edges_[half.edge].place.turn;
      return sum;
    };
    own.clear();
    queue.push({0.0F, end});
    while (!queue.empty()) {
      const auto [length, v] = queue.top();
      queue.pop();
      if (!own.emplace(v, length).second || length > 2.0F * most) continue;
      turn += turn_at(v);
      for (const Half& half : around(v))
        if (chosen[half.edge]) queue.push({length + length_[half.edge], half.to});
    }
    reached.clear();
    reached[end] = {0.0F, {}};
    queue.push({0.0F, end});
    std::uint32_t hit = no_id;
    while (!queue.empty()) {
      const auto [length, v] = queue.top();
      queue.pop();
      if (hit != no_id || length > reached[v].first) continue;
      if (v != end && degree(v, chosen) > 0) {
        // Not from a convex line to a concave one: both stop where a step fades out.
        if (!own.contains(v) && turn * turn_at(v) >= 0.0F) hit = v;
        continue;
      }
      for (const Half& half : around(v)) {
        const float further = length + length_[half.edge];
        if (chosen[half.edge] || further > most) continue;
        const auto [it, fresh] = reached.try_emplace(half.to, further, Half{half.edge, v});
        if (!fresh) {
          if (further >= it->second.first) continue;
          it->second = {further, Half{half.edge, v}};
        }
        queue.push({further, half.to});
      }
    }
    for (std::uint32_t v = hit; v != no_id && v != end; v = reached[v].second.to)
      chosen[reached[v].second.edge] = 1;
  }
}

void CandidateGraph::cut_spurs(const LineChoiceOptions& options,
                               std::vector<std::uint8_t>& chosen) const {
  constexpr int rounds = 3;  // a spur may have spurs
  std::vector<std::uint32_t> branch;
  for (int round = 0; round < rounds; ++round) {
    bool any = false;
    for (std::uint32_t start = 0; start + 1 < starts_.size(); ++start) {
      const std::size_t met = degree(start, chosen);
      if (met == 0 || met == 2) continue;
      for (const Half& first : around(start)) {
        if (!chosen[first.edge]) continue;
        branch.assign(1, first.edge);
        float length = length_[first.edge];
        std::uint32_t v = first.to;
        while (length <= options.spur && degree(v, chosen) == 2)
          for (const Half& half : around(v))
            if (chosen[half.edge] && half.edge != branch.back()) {
              branch.push_back(half.edge);
              length += length_[half.edge];
              v = half.to;
              break;
            }
        const std::size_t ahead = degree(v, chosen);
        if (length > options.spur || v == start || ahead == 2 || (met == 1 && ahead < 3)) continue;
        // Between two lines only what parts two regions is more than a rung of a ladder.
        const bool parts = std::any_of(branch.begin(), branch.end(), [&](std::uint32_t e) {
          return edges_[e].height > options.angle;
        });
        if (met != 1 && (ahead == 1 || parts)) continue;
        for (const std::uint32_t e : branch) chosen[e] = 0;
        any = true;
        break;
      }
    }
    if (!any) break;
  }
}

void CandidateGraph::drop_short(float least, std::vector<std::uint8_t>& chosen) const {
  std::vector<std::uint8_t> seen(edges_.size(), 0);
  std::vector<std::uint32_t> group;
  for (std::uint32_t start = 0; start < edges_.size(); ++start) {
    if (!chosen[start] || seen[start]) continue;
    group.assign(1, start);
    seen[start] = 1;
    float length = 0.0F;
    bool exact = false;  // no noise makes these, however short they are
    for (std::size_t k = 0; k < group.size(); ++k) {
      length += length_[group[k]];
      exact = exact || edges_[group[k]].exact;
      for (const std::uint32_t v : ends_[group[k]])
        for (const Half& half : around(v))
          if (chosen[half.edge] && !seen[half.edge]) {
            seen[half.edge] = 1;
            group.push_back(half.edge);
          }
    }
    if (length < least && !exact)
      for (const std::uint32_t e : group) chosen[e] = 0;
  }
}

}  // namespace arris
