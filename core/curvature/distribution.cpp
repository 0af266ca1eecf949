#include "core/curvature/distribution.h"
#include "core/base/parallel_sort.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arris {

Distribution::Distribution(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<std::pair<double, double>> pairs;
  pairs.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) pairs.emplace_back(values[i], weights[i]);
  parallel_sort(pairs.begin(), pairs.end());
  values_.reserve(pairs.size());
  cumulative_.reserve(pairs.size());
  double sum = 0.0;
  for (const auto& [value, weight] : pairs) {
    sum += weight;
    values_.push_back(value);
    cumulative_.push_back(sum);
  }
  if (!std::isfinite(sum)) {  // areas of a part too large for them: all count alike
    sum = static_cast<double>(cumulative_.size());
    for (std::size_t k = 0; k < cumulative_.size(); ++k)
      cumulative_[k] = static_cast<double>(k + 1);
  }
  if (sum > 0.0)
    for (double& share : cumulative_) share /= sum;
}

double Distribution::quantile(double q) const {
  if (values_.empty()) return 0.0;
  const auto found = std::lower_bound(cumulative_.begin(), cumulative_.end(), q);
  const auto place =
      std::min(found - cumulative_.begin(), static_cast<std::ptrdiff_t>(values_.size()) - 1);
  return values_[static_cast<std::size_t>(place)];
}

double Distribution::share_up_to(double value) const {
  const auto found = std::upper_bound(values_.begin(), values_.end(), value);
  if (found == values_.begin()) return 0.0;
  return cumulative_[static_cast<std::size_t>(found - values_.begin()) - 1];
}

Distribution::Bins Distribution::bins(double low, double high, std::size_t count,
                                      bool logarithmic) const {
  Bins result;
  if (count == 0 || !(high > low) || (logarithmic && !(low > 0.0))) return result;
  result.edges.resize(count + 1);
  for (std::size_t k = 0; k <= count; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(count);
    result.edges[k] = logarithmic ? low * std::pow(high / low, t) : low + (high - low) * t;
  }
  result.edges.back() = high;
  result.shares.resize(count);
  // Values equal to `low` belong to the first bin.
  const auto first = std::lower_bound(values_.begin(), values_.end(), low);
  double before = first == values_.begin()
                      ? 0.0
                      : cumulative_[static_cast<std::size_t>(first - values_.begin()) - 1];
  for (std::size_t k = 0; k < count; ++k) {
    const double up_to = share_up_to(result.edges[k + 1]);
    result.shares[k] = std::max(0.0, up_to - before);
    before = std::max(before, up_to);
  }
  return result;
}

}  // namespace arris
