#include "core/partitions/surface_growing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/parallel_sort.h"

namespace arris {

namespace {

/// Half the squared distance and turn of a sample over the noise, without limit.
double misfit_of(const SurfaceSample& s, const Surface& surface, const SurfaceNoise& noise) {
  const Surface::At at = surface.at(s.point);
  const double d = at.distance / noise.distance;
  const double turn = std::max(0.0, 2.0 * (1.0 - at.normal.dot(s.normal)));
  return 0.5 * (d * d + turn / (2.0 * noise.angle * noise.angle));
}

class Growing {
 public:
  Growing(const Grains& grains, const SurfaceNoise& noise, const SurfaceGrowingOptions& options)
      : grains_(grains),
        noise_(noise),
        options_(options),
        surface_(grains.size(), no_id),
        seen_(grains.size(), 0),
        tried_(grains.size(), 0) {}

  std::vector<std::uint32_t> run(const Context& context) {
    context_ = context;
    // Grains of each area; the areas by their size.
    std::uint32_t areas = 0;
    for (const std::uint32_t a : grains_.area) areas = std::max(areas, a + 1);
    std::vector<std::vector<std::uint32_t>> members(areas);
    for (std::uint32_t k = 0; k < grains_.size(); ++k) members[grains_.area[k]].push_back(k);
    std::vector<std::uint32_t> order(areas);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return members[a].size() > members[b].size();
    });
    // Told by the grains that were looked at.
    std::size_t done = 0, told = 0;
    const auto goes_on = [&](std::size_t more) {
      done += more;
      if (done >= told) {
        context.report(static_cast<double>(done) / static_cast<double>(grains_.size() + 1),
                       "surfaces");
        told = done + grains_.size() / 50 + 1;
      }
      return !context.cancelled();
    };
    for (const std::uint32_t a : order) {
      if (members[a].size() < options_.least || !goes_on(0)) break;
      grow(members[a]);
      // What it did not explain, from places in it; a place where nothing grew is not tried again.
      for (const std::uint32_t k : members[a]) {
        if (!goes_on(1)) break;
        if (surface_[k] != no_id || tried_[k]) continue;
        const std::vector<std::uint32_t> seed = window(k);
        grow(seed);
        for (const std::uint32_t other : seed) tried_[other] = 1;
      }
    }
    return std::move(surface_);
  }

 private:
  /// Free grains about one, in its area.
  std::vector<std::uint32_t> window(std::uint32_t first) {
    ++stamp_;
    std::vector<std::uint32_t> found{first};
    seen_[first] = stamp_;
    for (std::size_t i = 0; i < found.size() && found.size() < options_.seed; ++i)
      for (const std::uint32_t k : grains_.around(found[i]))
        if (seen_[k] != stamp_ && surface_[k] == no_id && grains_.area[k] == grains_.area[first] &&
            found.size() < options_.seed) {
          seen_[k] = stamp_;
          found.push_back(k);
        }
    return found;
  }

  std::vector<SurfaceSample> samples_of(const std::vector<std::uint32_t>& members) const {
    std::vector<SurfaceSample> samples;
    const std::size_t step = members.size() / options_.samples + 1;
    for (std::size_t i = 0; i < members.size(); i += step)
      samples.push_back(grains_.samples[members[i]]);
    return samples;
  }

  bool grow(std::vector<std::uint32_t> members) {
    std::erase_if(members, [&](std::uint32_t k) { return surface_[k] != no_id; });
    if (members.size() < options_.least) return false;
    FittedSurface fitted = fit_surface(samples_of(members), noise_);
    if (fitted.misfit > 2.0 * options_.good) return false;
    std::size_t searched = members.size();  // when all types were tried last
    std::vector<std::uint32_t> kept;        // as far as one surface explained all of it
    for (int round = 0; round < options_.rounds && !context_.cancelled(); ++round) {
      // From the grain that fits best, so that what is reached hangs together.
      std::uint32_t first = members.front();
      double least = 1e300;
      for (const std::uint32_t k : members)
        if (const double m = misfit_of(grains_.samples[k], fitted.surface, noise_); m < least) {
          least = m;
          first = k;
        }
      if (least > options_.admits) break;
      ++stamp_;
      std::vector<std::uint32_t> reached{first};
      seen_[first] = stamp_;
      const std::size_t most = 3 * members.size() + 10;
      for (std::size_t i = 0; i < reached.size() && reached.size() < most; ++i)
        for (const std::uint32_t k : grains_.around(reached[i]))
          if (seen_[k] != stamp_ && surface_[k] == no_id) {
            seen_[k] = stamp_;
            if (misfit_of(grains_.samples[k], fitted.surface, noise_) <= options_.admits)
              reached.push_back(k);
          }
      if (reached.size() < options_.least) break;
      const bool settled = reached.size() <= members.size() + members.size() / 50 &&
                           reached.size() + members.size() / 50 >= members.size();
      members.swap(reached);
      const std::vector<SurfaceSample> samples = samples_of(members);
      fitted = refit_surface(samples, noise_, fitted.surface);
      if (fitted.misfit > options_.good || 2 * members.size() > 3 * searched) {
        fitted = fit_surface(samples, noise_);
        searched = members.size();
      }
      if (fitted.misfit <= options_.good)
        kept = members;
      else if (!kept.empty() || fitted.misfit > 2.0 * options_.good)
        break;
      if (settled) break;
    }
    if (kept.empty()) return false;
    for (const std::uint32_t k : kept) surface_[k] = count_;
    ++count_;
    return true;
  }

  const Grains& grains_;
  const SurfaceNoise& noise_;
  const SurfaceGrowingOptions& options_;
  Context context_;
  std::vector<std::uint32_t> surface_;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint8_t> tried_;
  std::uint32_t stamp_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace

Grains make_grains(const FaceTable& table, const FaceRegions& areas,
                   const std::vector<std::uint8_t>& banded, int faces) {
  Grains grains;
  grains.of_face.assign(table.size(), no_id);
  const auto most = static_cast<std::size_t>(faces);
  std::vector<FaceId> members;
  for (FaceId first = 0; first < table.size(); ++first) {
    if (banded[first] || grains.of_face[first] != no_id) continue;
    const auto number = static_cast<std::uint32_t>(grains.size());
    members.assign(1, first);
    grains.of_face[first] = number;
    for (std::size_t i = 0; i < members.size() && members.size() < most; ++i)
      for (const FaceId g : table.neighbours[members[i]])
        if (g != no_id && !banded[g] && grains.of_face[g] == no_id &&
            areas.of_face[g] == areas.of_face[first] && members.size() < most) {
          grains.of_face[g] = number;
          members.push_back(g);
        }
    SurfaceSample sample{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
    for (const FaceId f : members) {
      const double area = static_cast<double>(table.faces[f].area);
      sample.point += area * table.faces[f].centre.cast<double>();
      sample.normal += area * table.faces[f].normal.cast<double>();
      sample.weight += area;
    }
    if (sample.weight > 0.0) sample.point /= sample.weight;
    if (sample.normal.norm() > 0.0) sample.normal.normalize();
    sample.weight /= static_cast<double>(mean_face_area);
    grains.samples.push_back(sample);
    grains.area.push_back(areas.of_face[first]);
  }
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (FaceId f = 0; f < table.size(); ++f)
    for (const FaceId g : table.neighbours[f])
      if (g != no_id && grains.of_face[f] != no_id && grains.of_face[g] != no_id &&
          grains.of_face[f] != grains.of_face[g])
        pairs.push_back({grains.of_face[f], grains.of_face[g]});
  parallel_sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  grains.starts.assign(grains.size() + 1, 0);
  for (const auto& pair : pairs) ++grains.starts[pair[0] + 1];
  for (std::size_t k = 0; k < grains.size(); ++k) grains.starts[k + 1] += grains.starts[k];
  grains.links.reserve(pairs.size());
  for (const auto& pair : pairs) grains.links.push_back(pair[1]);
  return grains;
}

std::vector<std::uint32_t> grow_surfaces(const Grains& grains, const SurfaceNoise& noise,
                                         const SurfaceGrowingOptions& options,
                                         const Context& context) {
  return Growing(grains, noise, options).run(context);
}

std::vector<std::vector<SurfaceSample>> grain_windows(const Grains& grains, std::size_t size) {
  std::vector<std::vector<SurfaceSample>> windows;
  std::vector<std::uint8_t> taken(grains.size(), 0);
  std::vector<std::uint32_t> members;
  for (std::uint32_t first = 0; first < grains.size(); ++first) {
    if (taken[first]) continue;
    members.assign(1, first);
    taken[first] = 1;
    for (std::size_t i = 0; i < members.size() && members.size() < size; ++i)
      for (const std::uint32_t k : grains.around(members[i]))
        if (!taken[k] && grains.area[k] == grains.area[first] && members.size() < size) {
          taken[k] = 1;
          members.push_back(k);
        }
    windows.emplace_back();
    for (const std::uint32_t k : members) windows.back().push_back(grains.samples[k]);
  }
  return windows;
}

std::vector<SurfaceSample> thinned(std::vector<SurfaceSample> samples, std::size_t most) {
  if (samples.size() <= most) return samples;
  double sum = 0.0;
  for (const SurfaceSample& s : samples) sum += s.weight;
  // Each stands for the same share of the whole weight, however often samples are thinned.
  const double share = sum / static_cast<double>(most);
  std::vector<SurfaceSample> result;
  result.reserve(most);
  // From a place that is another one each time, or the last samples would never be among them.
  constexpr double golden = 0.6180339887498949;
  double next = share * std::fmod(golden * sum, 1.0), reached = 0.0;
  for (const SurfaceSample& s : samples) {
    reached += s.weight;
    double own = 0.0;
    for (; next <= reached && next < sum; next += share) own += share;
    if (own <= 0.0) continue;
    result.push_back(s);
    result.back().weight = own;
  }
  return result;
}

}  // namespace arris
