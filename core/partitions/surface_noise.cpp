#include "core/partitions/surface_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/parallel.h"
#include "core/partitions/surface_growing.h"

namespace arris {

SurfaceNoise noise_of(const std::vector<std::vector<SurfaceSample>>& samples,
                      const SurfaceNoise& least) {
  struct Scatter {
    double distance, angle, weight;
  };
  constexpr std::size_t enough = 10;
  std::vector<Scatter> scatters(samples.size(), {0.0, 0.0, 0.0});
  parallel_for(
      samples.size(),
      [&](std::size_t a) {
        const std::vector<SurfaceSample> own = thinned(samples[a], 128);
        if (own.size() < enough) return;
        for (const FittedSurface& fit : {fit_surface(own, least), fit_free_surface(own, least)}) {
          if (!std::isfinite(fit.misfit)) continue;
          std::vector<double> distances, turns;
          for (const SurfaceSample& s : own) {
            const Surface::At at = fit.surface.at(s.point);
            distances.push_back(std::abs(at.distance));
            turns.push_back(std::sqrt(std::max(0.0, 2.0 * (1.0 - at.normal.dot(s.normal)))));
          }
          const auto median = [](std::vector<double>& values) {
            const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
            std::nth_element(values.begin(), middle, values.end());
            return *middle;
          };
          // Of a Gaussian distance, and of the length of a Gaussian turn in two directions.
          const double distance = median(distances) / 0.6745, angle = median(turns) / 1.1774;
          Scatter& best = scatters[a];
          if (best.weight > 0.0 && angle >= best.angle) continue;
          best = {distance, angle, static_cast<double>(samples[a].size())};
        }
      },
      4);
  std::erase_if(scatters, [](const Scatter& s) { return !(s.weight > 0.0); });
  const auto middle_of = [&](double Scatter::*value) {
    std::ranges::sort(scatters, {}, value);
    double half = 0.0, sum = 0.0;
    for (const Scatter& s : scatters) half += s.weight / 2.0;
    for (const Scatter& s : scatters)
      if ((sum += s.weight) >= half) return s.*value;
    return 0.0;
  };
  return {std::max(least.distance, middle_of(&Scatter::distance)),
          std::max(least.angle, middle_of(&Scatter::angle))};
}

}  // namespace arris
