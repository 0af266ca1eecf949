#include "core/partitions/area_joining.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/watched_for.h"
#include "core/partitions/surface_growing.h"
#include "core/sharp_lines/region_joining.h"

namespace arris {

namespace {

using Samples = std::vector<SurfaceSample>;
constexpr float never = 1e9F;

/// A border between two areas while areas are joined.
struct AreaBorder {
  std::array<std::uint32_t, 2> areas{no_id, no_id};  // on its first and second side, as begun with
  BorderSums sums;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // sum of its places, over its length
  float line = 0.0F;                                 // length of line between the two
  float known = -1.0F;                       // the cost as last worked out; negative: not known
  std::array<std::uint32_t, 2> known_for{};  // the states of the areas then, in any order
  const std::vector<std::uint32_t>* parent = nullptr;

  std::uint32_t root(std::size_t side) const {
    std::uint32_t a = areas[side];
    while ((*parent)[a] != a) a = (*parent)[a];
    return a;
  }
  void absorb(const AreaBorder& other) {
    const bool turned = root(0) == other.root(1) || root(1) == other.root(0);
    sums.add(turned ? other.sums.turned() : other.sums);
    middle += other.middle;
    line += other.line;
    known = -1.0F;
  }
};

/// Joins areas, round after round.
class AreaJoining {
 public:
  AreaJoining(AreasToJoin given, const AreaJoiningOptions& options, const Context& context)
      : context_(context),
        mesh_(given.mesh),
        table_(given.table),
        lines_(given.lines),
        banded_(given.banded),
        options_(options),
        fitting_{.wide = static_cast<double>(options.wide),
                 .blend = static_cast<double>(options.blend),
                 .free = static_cast<double>(options.free)},
        noise_(given.noise),
        face_noise_(given.face_noise),
        grain_(given.grain),
        base_(given.areas.of_face),
        parent_(given.areas.count),
        area_(given.areas.count, 0.0F),
        voting_(given.areas.count, 0.0F),
        samples_(std::move(given.samples)),
        fits_(given.areas.count),
        state_(given.areas.count),
        next_state_(given.areas.count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::iota(state_.begin(), state_.end(), 0U);
    for (FaceId f = 0; f < table_.size(); ++f) {
      area_[base_[f]] += table_.faces[f].area / mean_face_area;
      if (!banded_[f]) voting_[base_[f]] += table_.faces[f].area / mean_face_area;
    }
    state_area_ = voting_;
  }

  /// The surface of each area, before any is joined. False where it was cancelled.
  bool fit(const Context& context) {
    return watched_for(
        fits_.size(), context, "areas",
        [&](std::size_t a) {
          samples_[a] = thinned(std::move(samples_[a]), options_.samples);
          fits_[a] = fit_of(samples_[a]);
        },
        16);
  }

  const std::vector<FittedSurface>& surfaces() const { return fits_; }

  std::vector<AreaJoin> run(const Context& context) {
    std::vector<float> heights;
    for (int k = 1; k <= options_.rounds; ++k)
      heights.push_back(static_cast<float>(k) / static_cast<float>(options_.rounds));
    for (const float height : {1.5F, 2.5F, 5.0F, 20.0F}) heights.push_back(height);
    // The first round looks at every border there is, the others at those that are left.
    constexpr double first = 0.6;
    for (std::size_t k = 0; k < heights.size() && !context_.cancelled(); ++k) {
      const auto until = [&](std::size_t round) {
        return round == 0 ? 0.0
                          : first + (1.0 - first) * static_cast<double>(round - 1) /
                                        static_cast<double>(heights.size() - 1);
      };
      join_up_to(heights[k], context.part(until(k), until(k + 1)));
    }
    return std::move(joins_);
  }

 private:
  std::uint32_t root(std::uint32_t a) const {
    while (parent_[a] != a) a = parent_[a];
    return a;
  }
  FittedSurface fit_of(const Samples& samples) const {
    if (samples.empty()) return {};
    return fit_surface(samples, noise_, fitting_);
  }
  /// What an area costs, in misfits of a sample: by its surface, or as a free one.
  double price_of(double misfit, double samples) const {
    return samples * std::min(misfit, static_cast<double>(options_.free));
  }
  /// Length of a border against its samples: where those are of more faces, it has fewer along it.
  float border_of_samples(const AreaBorder& border) const {
    constexpr float usual_grain = 8.0F;
    return border.sums.length * std::sqrt(usual_grain / static_cast<float>(grain_));
  }
  float cost_of(const AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    if (border.line > options_.line_share * (border.sums.length + border.line)) return never;
    if (voting_[a] <= 0.0F || voting_[b] <= 0.0F) return 0.0F;
    Samples both = samples_[a];
    both.insert(both.end(), samples_[b].begin(), samples_[b].end());
    const double misfit = fit_of(both).misfit;
    const double na = static_cast<double>(voting_[a]) / grain_,
                 nb = static_cast<double>(voting_[b]) / grain_;
    const double apart = price_of(fits_[a].misfit, na) + price_of(fits_[b].misfit, nb);
    const auto rise = static_cast<float>(price_of(misfit, na + nb) - apart);
    const auto smaller =
        static_cast<float>(std::min({na, nb, static_cast<double>(options_.rise_area)}));
    const float length = border_of_samples(border);
    const float allowed_rise =
        options_.rise + options_.rise_each * smaller + options_.rise_border * length;
    const auto in_strip = [&](std::uint32_t k) {
      return voting_[k] < options_.strip_votes * area_[k];
    };
    const bool strip = smaller < options_.strip_samples && in_strip(a) && in_strip(b);
    const float by_surface =
        options_.surfaces && (strip || misfit < static_cast<double>(options_.free))
            ? std::max(0.0F, rise) / allowed_rise
            : never;
    float by_kink = cost_by_kink(border, a, b);
    const auto as_free = [&](double lost) {
      return static_cast<float>(std::max(0.0, lost)) /
             (options_.free_rise + options_.free_border * length);
    };
    float lost = as_free(rise);
    // Not a surface of CAD, but maybe a smooth one all the same.
    if (options_.free_forms && lost > 1.0F && by_kink < options_.free_kink &&
        smaller >= options_.free_samples) {
      const FittedSurface smooth = fit_free_surface(both, noise_, options_.free_degree);
      lost = std::min(lost, as_free(price_of(smooth.misfit, na + nb) - apart));
    }
    by_kink = std::max(by_kink, lost);
    float by_continuation = never;
    if (const double tear = tear_at(border, a, b); tear < 1e9) {
      const double as_chain = price_of(judge_surface(both, noise_, chain_of(a, b)).misfit, na + nb);
      by_continuation =
          std::max(static_cast<float>(tear),
                   static_cast<float>(std::max(0.0, as_chain - apart)) / allowed_rise);
    }
    return std::min({by_surface, by_kink, by_continuation});
  }
  /// How badly the surfaces of two areas continue one another over their border.
  double tear_at(const AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    const auto free = static_cast<double>(options_.free);
    if (!options_.continuations || fits_[a].misfit >= free || fits_[b].misfit >= free)
      return std::numeric_limits<double>::infinity();
    return tear_between(fits_[a].surface, fits_[b].surface,
                        border.middle / static_cast<double>(border.sums.length),
                        options_.continuation);
  }
  Surface chain_of(std::uint32_t a, std::uint32_t b) const {
    return continued(fits_[a].surface, static_cast<double>(voting_[a]), fits_[b].surface,
                     static_cast<double>(voting_[b]), options_.continuation);
  }
  /// By the kink between them.
  float cost_by_kink(const AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    float cost = clear_kink(border.sums, options_.border, face_noise_,
                            2.0F * std::min(voting_[a], voting_[b]) + 4.0F);
    const float smaller = std::min(area_[a], area_[b]);
    if (smaller < options_.small) cost *= smaller / options_.small;
    return cost / options_.kink;
  }

  void join_up_to(float height, const Context& context) {
    context.report(0.0, "areas");
    std::vector<std::uint32_t> labels(base_.size());
    parallel_for(labels.size(), [&](std::size_t f) { labels[f] = root(base_[f]); });
    const BorderPlaces places = measure_borders(mesh_, table_, labels, banded_, options_.border);
    RegionJoining<AreaBorder> joining(area_);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    const auto border_of = [&](std::uint32_t a, std::uint32_t b) -> AreaBorder& {
      AreaBorder& border = joining.border(a, b);
      if (!border.parent) {
        border.areas = {std::min(a, b), std::max(a, b)};
        border.parent = &parent_;
        pairs.push_back(border.areas);
      }
      return border;
    };
    for (std::size_t k = 0; k < places.edges.size(); ++k) {
      const auto [f, g] = mesh_.edge_faces(places.edges[k]);
      AreaBorder& border = border_of(labels[f], labels[g]);
      border.sums.add(places.places[k]);
      const auto [from, to] = mesh_.edge(places.edges[k]);
      border.middle += 0.5 * static_cast<double>(places.places[k].length) *
                       (table_.points[from] + table_.points[to]).cast<double>();
    }
    if (!lines_.edges.empty())
      for (EdgeId e = 0; e < mesh_.edge_count(); ++e) {
        if (!lines_.is_sharp(e)) continue;
        const auto [f, g] = mesh_.edge_faces(e);
        if (f == no_id || g == no_id || labels[f] == labels[g]) continue;
        border_of(labels[f], labels[g]).line +=
            static_cast<float>(mesh_.edge_length(e) / table_.unit);
      }
    std::vector<AreaBorder*> borders;
    for (const auto& [a, b] : pairs) borders.push_back(&joining.border(a, b));
    const auto measure = [&](std::size_t k) { known_cost(*borders[k], pairs[k][0], pairs[k][1]); };
    if (!watched_for(pairs.size(), context.part(0.1, 0.9), "areas", measure, 16)) return;
    std::size_t joined = 0, asked = 0;  // joins: at most all but one
    joining.run(
        height,
        [&](AreaBorder& border, std::uint32_t a, std::uint32_t b) {
          constexpr std::size_t pause = 32;
          if (++asked % pause == 0)
            context.report(
                0.9 + 0.1 * static_cast<double>(joined) / static_cast<double>(parent_.size()),
                "areas");
          return known_cost(border, a, b);
        },
        [&](const auto& join, const AreaBorder& border) {
          ++joined;
          this->join(join.into, join.gone, join.height, border);
        });
  }

  /// A cost stays as long as neither of the two areas has become another.
  float known_cost(AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    if (context_.cancelled()) return never;  // what comes of it is thrown away
    std::array<std::uint32_t, 2> states{state_[a], state_[b]};
    if (states[0] > states[1]) std::swap(states[0], states[1]);
    if (border.known < 0.0F || border.known_for != states) {
      border.known = cost_of(border, a, b);
      border.known_for = states;
    }
    return border.known;
  }

  void join(std::uint32_t into, std::uint32_t gone, float height, const AreaBorder& border) {
    height_ = std::max(height_, height);
    parent_[gone] = into;
    // What the larger of the two is stays as good as it was while little comes to it.
    const std::uint32_t larger = voting_[into] >= voting_[gone] ? into : gone;
    std::optional<Surface> chain;
    if (tear_at(border, into, gone) <= static_cast<double>(std::max(height, 1.0F)))
      chain = chain_of(into, gone);
    else if (fits_[larger].surface.parts)
      chain = fits_[larger].surface;
    state_[into] = state_[larger];
    state_area_[into] = state_area_[larger];
    area_[into] += area_[gone];
    voting_[into] += voting_[gone];
    if (voting_[into] > options_.same * state_area_[into]) {
      state_[into] = next_state_++;
      state_area_[into] = voting_[into];
    }
    Samples& mine = samples_[into];
    mine.insert(mine.end(), samples_[gone].begin(), samples_[gone].end());
    samples_[gone] = {};
    mine = thinned(std::move(mine), options_.samples);
    fits_[into] = fit_of(mine);
    if (chain)
      if (const FittedSurface as_chain = judge_surface(mine, noise_, *chain);
          as_chain.misfit < fits_[into].misfit)
        fits_[into] = as_chain;
    joins_.push_back({into, gone, height_, fits_[into]});
  }

  const Context& context_;
  const Mesh& mesh_;
  const FaceTable& table_;
  const SharpLines& lines_;
  const std::vector<std::uint8_t>& banded_;
  const AreaJoiningOptions& options_;
  const SurfaceFitOptions fitting_;
  const SurfaceNoise noise_;
  const float face_noise_;
  const int grain_;
  const std::vector<std::uint32_t>& base_;
  std::vector<std::uint32_t> parent_;
  std::vector<float> area_, voting_;  // in faces
  std::vector<Samples> samples_;
  std::vector<FittedSurface> fits_;
  std::vector<AreaJoin> joins_;
  float height_ = 0.0F;
  std::vector<std::uint32_t> state_;  // of each area, a number that changes when it does
  std::vector<float> state_area_;     // its voting faces when it did
  std::uint32_t next_state_;
};
}  // namespace

JoinedAreas join_areas(AreasToJoin areas, const AreaJoiningOptions& options,
                       const Context& context) {
  AreaJoining joining(std::move(areas), options, context);
  JoinedAreas result;
  if (!joining.fit(context.part(0.0, 0.3))) return result;
  result.surfaces = joining.surfaces();
  result.joins = joining.run(context.part(0.3, 1.0));
  return result;
}

}  // namespace arris
