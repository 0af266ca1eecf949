#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace arris {

/// Distribution of a field over the part, weighted by area. NaN does not count.
class Distribution {
 public:
  Distribution() = default;
  /// `values` and `weights` (>= 0) of one length. Where the weights are too large to be added, all
  /// values count alike.
  Distribution(const std::vector<double>& values, const std::vector<double>& weights);

  bool empty() const { return values_.empty(); }
  double min() const { return values_.empty() ? 0.0 : values_.front(); }
  double max() const { return values_.empty() ? 0.0 : values_.back(); }
  /// The value under which a share `q` (0 to 1) of the area lies.
  double quantile(double q) const;
  /// The share of the area whose value is at most `value`, 0 to 1.
  double share_up_to(double value) const;

  struct Bins {
    std::vector<double> edges;   ///< count + 1, increasing.
    std::vector<double> shares;  ///< Share of the area in each bin.
  };
  /// `count` bins over [low, high]; evenly spaced, or evenly in the logarithm (low > 0 then). What
  /// lies outside is not counted.
  Bins bins(double low, double high, std::size_t count, bool logarithmic) const;

 private:
  std::vector<double> values_;      // sorted
  std::vector<double> cumulative_;  // share of the area up to and with each value
};

}  // namespace arris
