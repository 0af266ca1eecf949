#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace arris {

/// Joins regions across their borders, the cheapest border first, and again by what the joined
/// borders cost. `Border` holds what is known of the border between two regions and has
/// `absorb(const Border&)` for two borders that become one.
///
/// Ties go to the lower numbers, so that the order is the same on every run.
template <class Border>
class RegionJoining {
 public:
  explicit RegionJoining(std::vector<float> areas)
      : areas_(std::move(areas)), neighbours_(areas_.size()) {}

  /// The border between two different regions; made where there is none.
  Border& border(std::uint32_t a, std::uint32_t b) {
    const auto [it, fresh] =
        neighbours_[a].try_emplace(b, static_cast<std::uint32_t>(borders_.size()));
    if (fresh) {
      neighbours_[b].emplace(a, it->second);
      borders_.push_back({});
    }
    return borders_[it->second].data;
  }
  float area(std::uint32_t a) const { return areas_[a]; }

  /// A join: `gone` became part of `into`, at a cost that is never below those that made the two.
  struct Join {
    std::uint32_t into, gone;
    float height;
  };

  /// Joins until no border costs `most` or less. `cost(border, a, b)`; `joined(join, border)` is
  /// told of each join with the border that vanished, after the neighbours were joined, and may
  /// change borders of `join.into` and others that it then reports by touch().
  template <class Cost, class Joined>
  void run(float most, const Cost& cost, const Joined& joined) {
    for (std::uint32_t a = 0; a < neighbours_.size(); ++a)
      for (const auto& [b, k] : neighbours_[a])
        if (a < b) offer(a, b, k, cost);
    std::vector<float> height(areas_.size(), 0.0F);
    while (!queue_.empty()) {
      const Offer offered = queue_.top();
      if (offered.cost > most) break;
      queue_.pop();
      if (borders_[offered.border].version != offered.version) continue;
      const std::uint32_t a = offered.a, b = offered.b;
      const bool larger = neighbours_[b].size() > neighbours_[a].size();
      const std::uint32_t into = larger ? b : a, gone = larger ? a : b;
      const Border vanished = std::move(borders_[offered.border].data);
      ++borders_[offered.border].version;
      neighbours_[into].erase(gone);
      neighbours_[gone].erase(into);
      for (const auto& [c, k] : neighbours_[gone]) {
        neighbours_[c].erase(gone);
        const auto [it, fresh] = neighbours_[into].try_emplace(c, k);
        if (fresh) {
          neighbours_[c].emplace(into, k);
        } else {
          borders_[it->second].data.absorb(borders_[k].data);
          borders_[k].data = {};
        }
        ++borders_[k].version;
        borders_[it->second].cost = -1.0F;
      }
      neighbours_[gone].clear();
      areas_[into] += areas_[gone];
      height[into] = std::max({offered.cost, height[into], height[gone]});
      joined(Join{into, gone, height[into]}, vanished);
      for (const auto& [c, k] : neighbours_[into]) offer(into, c, k, cost);
      for (const auto& [c, d] : touched_)
        if (const auto it = neighbours_[c].find(d); it != neighbours_[c].end())
          offer(c, d, it->second, cost);
      touched_.clear();
    }
  }

  /// Says within `joined` that the border between two regions changed.
  void touch(std::uint32_t a, std::uint32_t b) { touched_.emplace_back(a, b); }

 private:
  struct Kept {
    Border data;
    std::uint32_t version = 0;
    float cost = -1.0F;  // as last offered; negative: never
  };
  struct Offer {
    float cost;
    std::uint32_t a, b, border, version;
    bool operator<(const Offer& other) const {  // the queue gives the greatest first
      if (cost != other.cost) return cost > other.cost;
      return a != other.a ? a > other.a : b > other.b;
    }
  };

  template <class Cost>
  void offer(std::uint32_t a, std::uint32_t b, std::uint32_t k, const Cost& cost) {
    if (a > b) std::swap(a, b);
    Kept& kept = borders_[k];
    const float now = cost(kept.data, a, b);
    if (now == kept.cost) return;
    kept.cost = now;
    queue_.push({now, a, b, k, ++kept.version});
  }

  std::vector<float> areas_;
  std::vector<std::map<std::uint32_t, std::uint32_t>> neighbours_;
  std::vector<Kept> borders_;
  std::priority_queue<Offer> queue_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touched_;
};

/// Length of border by height, and its quantiles. Additive.
class HeightHistogram {
 public:
  static constexpr float width = 2.5F;     // degrees a bin
  static constexpr std::size_t bins = 72;  // up to 180

  void add(float height, float length) {
    bins_[std::min(bins - 1, static_cast<std::size_t>(std::max(height, 0.0F) / width))] += length;
    length_ += length;
  }
  void absorb(const HeightHistogram& other) {
    for (std::size_t k = 0; k < bins; ++k) bins_[k] += other.bins_[k];
    length_ += other.length_;
  }
  float length() const { return length_; }
  /// The height below which `share` of the length lies, linear within a bin; 0 where empty.
  float quantile(float share) const {
    const float wanted = share * length_;
    float below = 0.0F;
    for (std::size_t k = 0; k < bins; ++k) {
      if (bins_[k] > 0.0F && below + bins_[k] >= wanted)
        return width * (static_cast<float>(k) + (wanted - below) / bins_[k]);
      below += bins_[k];
    }
    return 0.0F;
  }

 private:
  std::array<float, bins> bins_{};
  float length_ = 0.0F;
};

}  // namespace arris
