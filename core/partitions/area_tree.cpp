#include "core/partitions/area_tree.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>

#include <tbb/parallel_sort.h>

#include "core/base/parallel.h"
#include "core/partitions/surface_growing.h"
#include "core/sharp_lines/region_joining.h"

namespace arris {

namespace {

constexpr float radians = static_cast<float>(std::numbers::pi / 180.0);
constexpr float never = 1e9F;
/// HeightHistogram has bins of 2.5 degrees: kinks are a tenth of that.
constexpr float finer = 10.0F;

/// No neighbours over sharp edges.
FaceTable table_between_lines(const Mesh& mesh, const SharpLines& lines) {
  FaceTable table(mesh);
  parallel_for(table.size(), [&](std::size_t f) {
    for (std::size_t k = 0; k < 3; ++k)
      if (lines.is_sharp(table.sides[f][k])) table.neighbours[f][k] = no_id;
  });
  return table;
}

/// 1 for faces whose centre lies within `options.band` of a line, on their side of it. Where strips
/// are so narrow that nothing else is left, only for those within `options.narrow_band`.
std::vector<std::uint8_t> faces_beside_lines(const Mesh& mesh, const SharpLines& lines,
                                             const FaceTable& table,
                                             const AreaTreeOptions& options) {
  std::vector<float> distance(table.size(), never);
  std::vector<EdgeId> nearest(table.size(), no_id);
  std::vector<FaceId> front;
  const auto distance_to = [&](FaceId f, EdgeId e) {
    const EdgeVertices& ends = mesh.edge(e);
    return (table.faces[f].centre - (table.points[ends[0]] + table.points[ends[1]]) / 2.0F).norm();
  };
  const auto reach = [&](FaceId f, EdgeId e, bool always) {
    const float d = distance_to(f, e);
    if (d >= distance[f] || (!always && d >= options.band)) return;
    distance[f] = d;
    nearest[f] = e;
    front.push_back(f);
  };
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (lines.is_sharp(e))
      for (const FaceId f : mesh.edge_faces(e))
        if (f != no_id) reach(f, e, true);
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const FaceId g : table.neighbours[front[i]])
      if (g != no_id) reach(g, nearest[front[i]], false);
  std::vector<std::uint8_t> beside(table.size());
  for (FaceId f = 0; f < table.size(); ++f) beside[f] = nearest[f] != no_id;
  // Rings about the faces that vote: what they do not reach is narrow.
  std::vector<std::uint8_t> rings(table.size(), 0);
  front.clear();
  for (FaceId f = 0; f < table.size(); ++f)
    if (!beside[f]) {
      rings[f] = 1;
      front.push_back(f);
    }
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (rings[front[i]] > options.narrow_rings) break;
    for (const FaceId g : table.neighbours[front[i]])
      if (g != no_id && rings[g] == 0) {
        rings[g] = static_cast<std::uint8_t>(rings[front[i]] + 1);
        front.push_back(g);
      }
  }
  for (FaceId f = 0; f < table.size(); ++f)
    if (rings[f] == 0 && distance[f] > options.narrow_band) beside[f] = 0;
  return beside;
}

/// Regions renumbered from 0 by their lowest face.
FaceRegions renumbered(std::vector<std::uint32_t> labels, std::size_t most) {
  FaceRegions result{std::move(labels), 0};
  std::vector<std::uint32_t> number(most, no_id);
  for (std::uint32_t& label : result.of_face) {
    if (number[label] == no_id) number[label] = result.count++;
    label = number[label];
  }
  return result;
}

/// The areas that a watershed of the kinks leaves, weak ones joined. Faces beside lines do not
/// vote: they go to what is nearest; where there is nothing else they are an area by themselves.
FaceRegions smallest_areas(const Mesh& mesh, const FaceTable& table,
                           const std::vector<std::uint8_t>& banded, const CurvatureKinks& kinks,
                           const std::vector<float>& edge_length, const AreaTreeOptions& options) {
  std::vector<std::array<FaceId, 2>> edge_faces(mesh.edge_count(), {no_id, no_id});
  std::vector<EdgeId> order;
  for (FaceId f = 0; f < table.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const FaceId g = table.neighbours[f][k];
      if (g == no_id || g < f || banded[f] || banded[g]) continue;
      edge_faces[table.sides[f][k]] = {f, g};
      order.push_back(table.sides[f][k]);
    }
  tbb::parallel_sort(order.begin(), order.end(), [&](EdgeId a, EdgeId b) {
    return kinks.at_edge[a] != kinks.at_edge[b] ? kinks.at_edge[a] < kinks.at_edge[b] : a < b;
  });
  FaceRegions regions = watershed(table, kinks.at_edge, order, edge_faces, options.watershed);
  std::vector<float> areas(regions.count, 0.0F);
  for (FaceId f = 0; f < table.size(); ++f) areas[regions.of_face[f]] += table.faces[f].area;
  RegionJoining<HeightHistogram> joining(std::move(areas));
  for (const EdgeId e : order) {
    const std::uint32_t a = regions.of_face[edge_faces[e][0]],
                        b = regions.of_face[edge_faces[e][1]];
    if (a != b) joining.border(a, b).add(finer * kinks.at_edge[e], edge_length[e]);
  }
  std::vector<std::uint32_t> parent(regions.count);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t r) {
    while (parent[r] != r) r = parent[r] = parent[parent[r]];
    return r;
  };
  const float least_area = options.first_area * mean_face_area;
  joining.run(
      finer * options.first_cut,
      [&](const HeightHistogram& heights, std::uint32_t a, std::uint32_t b) {
        const float cost = heights.quantile(options.first_quantile);
        const float smaller = std::min(joining.area(a), joining.area(b));
        return smaller < least_area ? cost * smaller / least_area : cost;
      },
      [&](const auto& join, const HeightHistogram&) { parent[join.gone] = join.into; });
  for (std::uint32_t& r : regions.of_face) r = root(r);

  // What lies beside lines, ring by ring.
  std::vector<FaceId> front;
  std::vector<std::uint8_t> open(banded);
  for (FaceId f = 0; f < table.size(); ++f)
    if (!open[f] &&
        std::ranges::any_of(table.neighbours[f], [&](FaceId g) { return g != no_id && open[g]; }))
      front.push_back(f);
  const auto flood = [&] {
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : table.neighbours[front[i]])
        if (g != no_id && open[g]) {
          open[g] = 0;
          regions.of_face[g] = regions.of_face[front[i]];
          front.push_back(g);
        }
    front.clear();
  };
  flood();
  for (FaceId f = 0; f < table.size(); ++f)
    if (open[f]) {
      open[f] = 0;
      front.push_back(f);
      flood();
    }
  return renumbered(std::move(regions.of_face), table.size());
}

using Samples = std::vector<SurfaceSample>;

std::vector<Samples> samples_by_area(const Grains& grains, std::uint32_t count) {
  std::vector<Samples> result(count);
  for (std::uint32_t k = 0; k < grains.size(); ++k)
    result[grains.area[k]].push_back(grains.samples[k]);
  return result;
}

/// Areas by the surfaces of their grains; where a grain has none, by the old areas.
FaceRegions areas_by_surface(const FaceTable& table, const FaceRegions& areas, const Grains& grains,
                             const std::vector<std::uint32_t>& surface) {
  std::uint32_t surfaces = 0;
  for (const std::uint32_t s : surface)
    if (s != no_id) surfaces = std::max(surfaces, s + 1);
  std::vector<std::uint32_t> label(table.size(), no_id);
  for (FaceId f = 0; f < table.size(); ++f)
    if (const std::uint32_t k = grains.of_face[f]; k != no_id)
      label[f] = surface[k] != no_id ? surface[k] : surfaces + areas.of_face[f];
  return connected_regions(table, label);
}

/// The pieces that old areas cut new ones into.
FaceRegions pieces_of(const FaceTable& table, const FaceRegions& areas, const FaceRegions& old) {
  std::vector<std::uint64_t> pairs(table.size());
  for (FaceId f = 0; f < table.size(); ++f)
    pairs[f] = static_cast<std::uint64_t>(areas.of_face[f]) << 32 | old.of_face[f];
  std::vector<std::uint64_t> known(pairs);
  tbb::parallel_sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<std::uint32_t> label(table.size());
  parallel_for(label.size(), [&](std::size_t f) {
    label[f] = static_cast<std::uint32_t>(std::lower_bound(known.begin(), known.end(), pairs[f]) -
                                          known.begin());
  });
  return connected_regions(table, label);
}

/// Joins the pieces of each area again, those with the least kink between them first, up to the
/// height `most`.
std::vector<AreaTree::Join> join_pieces(const FaceTable& table, const FaceRegions& pieces,
                                        const FaceRegions& areas, const CurvatureKinks& kinks,
                                        const std::vector<float>& edge_length,
                                        const std::vector<FittedSurface>& surfaces, float most) {
  std::vector<float> area(pieces.count, 0.0F);
  std::vector<std::uint32_t> of_piece(pieces.count);
  for (FaceId f = 0; f < table.size(); ++f) {
    area[pieces.of_face[f]] += table.faces[f].area;
    of_piece[pieces.of_face[f]] = areas.of_face[f];
  }
  RegionJoining<HeightHistogram> joining(std::move(area));
  for (FaceId f = 0; f < table.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (const FaceId g = table.neighbours[f][k]; g != no_id && f < g &&
                                                   pieces.of_face[f] != pieces.of_face[g] &&
                                                   areas.of_face[f] == areas.of_face[g])
        joining.border(pieces.of_face[f], pieces.of_face[g])
            .add(finer * kinks.at_edge[table.sides[f][k]], edge_length[table.sides[f][k]]);
  std::vector<AreaTree::Join> joins;
  joining.run(
      never,
      [](const HeightHistogram& heights, std::uint32_t, std::uint32_t) {
        return heights.quantile(0.5F) / finer;
      },
      [&](const auto& join, const HeightHistogram&) {
        joins.push_back({join.into, join.gone, join.height, surfaces[of_piece[join.into]]});
      });
  std::stable_sort(joins.begin(), joins.end(),
                   [](const auto& a, const auto& b) { return a.height < b.height; });
  // From degrees to heights below those of joins between areas.
  for (AreaTree::Join& join : joins) join.height = most * join.height / (1.0F + join.height);
  return joins;
}

/// How samples scatter about the surfaces of the areas they are of, from those that have enough:
/// medians, so that areas which are several surfaces do not count.
SurfaceNoise noise_of(const std::vector<Samples>& samples, const SurfaceNoise& least) {
  struct Scatter {
    double distance, angle, weight;
  };
  constexpr std::size_t enough = 10;
  std::vector<Scatter> scatters(samples.size(), {0.0, 0.0, 0.0});
  parallel_for(
      samples.size(),
      [&](std::size_t a) {
        const Samples own = thinned(samples[a], 128);
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

/// A border between two areas while areas are joined.
struct AreaBorder {
  std::array<std::uint32_t, 2> areas{no_id, no_id};  // on its first and second side, as begun with
  BorderSums sums;
  float line = 0.0F;                         // length of line between the two
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
    line += other.line;
    known = -1.0F;
  }
};

/// Joins areas, round after round.
class AreaJoining {
 public:
  AreaJoining(const Mesh& mesh, const FaceTable& table, const SharpLines& lines,
              const FaceRegions& areas, const std::vector<std::uint8_t>& banded,
              const AreaTreeOptions& options, const SurfaceNoise& noise, float face_noise,
              std::vector<Samples> samples)
      : mesh_(mesh),
        table_(table),
        lines_(lines),
        banded_(banded),
        options_(options),
        noise_(noise),
        face_noise_(face_noise),
        base_(areas.of_face),
        parent_(areas.count),
        area_(areas.count, 0.0F),
        voting_(areas.count, 0.0F),
        samples_(std::move(samples)),
        fits_(areas.count),
        state_(areas.count),
        next_state_(areas.count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::iota(state_.begin(), state_.end(), 0U);
    for (FaceId f = 0; f < table.size(); ++f) {
      area_[base_[f]] += table.faces[f].area / mean_face_area;
      if (!banded[f]) voting_[base_[f]] += table.faces[f].area / mean_face_area;
    }
    state_area_ = voting_;
    parallel_for(
        areas.count,
        [&](std::size_t a) {
          samples_[a] = thinned(std::move(samples_[a]), options.samples);
          fits_[a] = fit_of(samples_[a]);
        },
        16);
  }

  const std::vector<FittedSurface>& surfaces() const { return fits_; }

  std::vector<AreaTree::Join> run(const Context& context) {
    std::vector<float> heights;
    for (int k = 1; k <= options_.rounds; ++k)
      heights.push_back(static_cast<float>(k) / static_cast<float>(options_.rounds));
    for (const float height : {1.5F, 2.5F, 5.0F, 20.0F}) heights.push_back(height);
    for (std::size_t k = 0; k < heights.size() && !context.cancelled(); ++k) {
      context.report(static_cast<double>(k) / static_cast<double>(heights.size()), "areas");
      join_up_to(heights[k]);
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
    FittedSurface fit = fit_surface(samples, noise_);
    // Any smooth surface is a torus for a while, and one that bends little a sphere or cylinder:
    // they say something where the torus is a blend and the others bend noticeably.
    const Surface& surface = fit.surface;
    const double torus = std::min(surface.tube, std::abs(surface.radius - surface.tube));
    if ((surface.type == SurfaceType::torus && torus > static_cast<double>(options_.blend)) ||
        ((surface.type == SurfaceType::sphere || surface.type == SurfaceType::cylinder) &&
         surface.radius > static_cast<double>(options_.wide)))
      fit.misfit = std::max(fit.misfit, static_cast<double>(options_.free));
    return fit;
  }
  /// What an area costs, in misfits of a sample: by its surface, or as a free one.
  double price_of(double misfit, double samples) const {
    return samples * std::min(misfit, static_cast<double>(options_.free));
  }
  float cost_of(const AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    if (border.line > options_.line_share * (border.sums.length + border.line)) return never;
    if (voting_[a] <= 0.0F || voting_[b] <= 0.0F) return 0.0F;
    Samples both = samples_[a];
    both.insert(both.end(), samples_[b].begin(), samples_[b].end());
    const double misfit = fit_of(both).misfit;
    const double na = static_cast<double>(voting_[a]) / options_.grain,
                 nb = static_cast<double>(voting_[b]) / options_.grain;
    const auto rise = static_cast<float>(price_of(misfit, na + nb) - price_of(fits_[a].misfit, na) -
                                         price_of(fits_[b].misfit, nb));
    const auto smaller =
        static_cast<float>(std::min({na, nb, static_cast<double>(options_.rise_area)}));
    const float by_surface =
        misfit < static_cast<double>(options_.free) && options_.surfaces
            ? std::max(0.0F, rise) / (options_.rise + options_.rise_each * smaller +
                                      options_.rise_border * border.sums.length)
            : never;
    const float by_kink = std::max(
        cost_by_kink(border, a, b),
        std::max(0.0F, rise) / (options_.free_rise + options_.free_border * border.sums.length));
    return std::min(by_surface, by_kink);
  }
  /// By the kink between them.
  float cost_by_kink(const AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    const float kink = border.sums.kink();
    float faces = border.sums.length * 1.5F * options_.border.far / mean_face_area / 1.3F;
    faces = std::min(std::max(faces, 4.0F), 2.0F * std::min(voting_[a], voting_[b]) + 4.0F);
    float cost = std::sqrt(std::max(0.0F, kink * kink - 6.0F * face_noise_ * face_noise_ / faces));
    const float smaller = std::min(area_[a], area_[b]);
    if (smaller < options_.small) cost *= smaller / options_.small;
    return cost / options_.kink;
  }

  void join_up_to(float height) {
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
      border_of(labels[f], labels[g]).sums.add(places.places[k]);
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
    parallel_for(
        pairs.size(), [&](std::size_t k) { known_cost(*borders[k], pairs[k][0], pairs[k][1]); },
        16);
    joining.run(
        height,
        [&](AreaBorder& border, std::uint32_t a, std::uint32_t b) {
          return known_cost(border, a, b);
        },
        [&](const auto& join, const AreaBorder&) {
          this->join(join.into, join.gone, join.height);
        });
  }

  /// A cost stays as long as neither of the two areas has become another.
  float known_cost(AreaBorder& border, std::uint32_t a, std::uint32_t b) const {
    std::array<std::uint32_t, 2> states{state_[a], state_[b]};
    if (states[0] > states[1]) std::swap(states[0], states[1]);
    if (border.known < 0.0F || border.known_for != states) {
      border.known = cost_of(border, a, b);
      border.known_for = states;
    }
    return border.known;
  }

  void join(std::uint32_t into, std::uint32_t gone, float height) {
    height_ = std::max(height_, height);
    parent_[gone] = into;
    // What the larger of the two is stays as good as it was while little comes to it.
    const std::uint32_t larger = voting_[into] >= voting_[gone] ? into : gone;
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
    joins_.push_back({into, gone, height_, fits_[into]});
  }

  const Mesh& mesh_;
  const FaceTable& table_;
  const SharpLines& lines_;
  const std::vector<std::uint8_t>& banded_;
  const AreaTreeOptions& options_;
  const SurfaceNoise noise_;
  const float face_noise_;
  const std::vector<std::uint32_t>& base_;
  std::vector<std::uint32_t> parent_;
  std::vector<float> area_, voting_;  // in faces
  std::vector<Samples> samples_;
  std::vector<FittedSurface> fits_;
  std::vector<AreaTree::Join> joins_;
  float height_ = 0.0F;
  std::vector<std::uint32_t> state_;  // of each area, a number that changes when it does
  std::vector<float> state_area_;     // its voting faces when it did
  std::uint32_t next_state_;
};

}  // namespace

Areas AreaTree::cut(float height, std::uint32_t least) const {
  std::vector<std::uint32_t> parent(surfaces.size());
  std::iota(parent.begin(), parent.end(), 0U);
  std::vector<const FittedSurface*> surface(surfaces.size());
  for (std::size_t a = 0; a < surfaces.size(); ++a) surface[a] = &surfaces[a];
  for (const Join& join : joins) {
    if (join.height > height) break;
    parent[join.gone] = join.into;
    surface[join.into] = &join.surface;
  }
  for (std::uint32_t a = 0; a < parent.size(); ++a) {
    std::uint32_t root = a;
    while (parent[root] != root) root = parent[root] = parent[parent[root]];
    parent[a] = root;
  }
  Areas areas;
  std::vector<std::uint32_t> number(parent.size(), no_id);
  areas.of_face.resize(smallest.size());
  for (std::size_t f = 0; f < smallest.size(); ++f) {
    const std::uint32_t root = parent[smallest[f]];
    if (number[root] == no_id) {
      number[root] = static_cast<std::uint32_t>(areas.surfaces.size());
      areas.surfaces.push_back(*surface[root]);
      if (areas.surfaces.back().misfit >= static_cast<double>(options.free))
        areas.surfaces.back().surface.type = SurfaceType::free;
    }
    areas.of_face[f] = number[root];
  }
  settle_borders(table, edge_length, areas.surfaces, face_noise, banded, options.settling,
                 areas.of_face);
  std::vector<std::uint32_t> before = areas.of_face;
  join_specks(table, edge_length, least, areas.of_face);
  // Each is of the surface of what it was part of; a speck does not decide over that.
  std::vector<FittedSurface> kept;
  for (std::size_t f = 0; f < before.size(); ++f)
    if (areas.of_face[f] == kept.size()) kept.push_back(areas.surfaces[before[f]]);
  areas.surfaces = std::move(kept);
  return areas;
}

Result<AreaTree> grow_area_tree(const Mesh& mesh, const SharpLines& lines,
                                const AreaTreeOptions& options, const Context& context) {
  AreaTree tree{table_between_lines(mesh, lines), {}, {}, {}, {}, {}, {}, {}, options};
  const FaceTable& table = tree.table;
  tree.banded = faces_beside_lines(mesh, lines, table, options);
  std::vector<float>& edge_length = tree.edge_length;
  edge_length.resize(mesh.edge_count());
  parallel_for(mesh.edge_count(), [&](std::size_t e) {
    edge_length[e] = static_cast<float>(mesh.edge_length(static_cast<EdgeId>(e)) / table.unit);
  });
  Result<CurvatureKinks> kinks =
      measure_curvature_kinks(mesh, table, tree.banded, options.kinks, context.part(0.0, 0.4));
  if (!kinks) return tl::unexpected<Error>(kinks.error());
  FaceRegions areas = smallest_areas(mesh, table, tree.banded, *kinks, edge_length, options);
  if (context.cancelled()) return cancelled();
  Grains grains = make_grains(table, areas, tree.banded, options.grain);
  const SurfaceNoise least_noise{static_cast<double>(options.distance),
                                 static_cast<double>(options.angle * radians)};
  tree.noise = noise_of(grain_windows(grains, options.growing.seed), least_noise);
  const SurfaceNoise near_noise = tree.noise;
  const FaceRegions old = areas;
  for (int round = 1;; ++round) {
    const std::vector<std::uint32_t> grown = grow_surfaces(grains, tree.noise, options.growing);
    if (context.cancelled()) return cancelled();
    // Over whole surfaces a scan is farther off than over a few edges: with the noise that they
    // show they grow again, until it stays.
    std::vector<Samples> by_surface;
    for (std::uint32_t k = 0; k < grains.size(); ++k)
      if (grown[k] != no_id) {
        if (grown[k] >= by_surface.size()) by_surface.resize(grown[k] + 1);
        by_surface[grown[k]].push_back(grains.samples[k]);
      }
    SurfaceNoise now = noise_of(by_surface, least_noise);
    now.distance = std::min(now.distance, options.most_drift * near_noise.distance);
    now.angle = std::min(now.angle, options.most_spread * near_noise.angle);
    const auto stays = [&](double before, double after) {
      return std::abs(after - before) <= options.settled * before;
    };
    if (round < options.growths &&
        !(stays(tree.noise.distance, now.distance) && stays(tree.noise.angle, now.angle))) {
      tree.noise = now;
      continue;
    }
    areas = areas_by_surface(table, old, grains, grown);
    break;
  }
  for (FaceId f = 0; f < table.size(); ++f)
    if (grains.of_face[f] != no_id) grains.area[grains.of_face[f]] = areas.of_face[f];
  const FaceRegions pieces = pieces_of(table, areas, old);
  AreaJoining joining(mesh, table, lines, areas, tree.banded, options, tree.noise, kinks->noise,
                      samples_by_area(grains, areas.count));
  const std::vector<FittedSurface> surfaces = joining.surfaces();
  tree.joins = join_pieces(table, pieces, areas, *kinks, edge_length, surfaces, options.inner);
  // From here on an area goes by the piece that its pieces were joined to.
  std::vector<std::uint32_t> gone_to(pieces.count), piece_of(areas.count, no_id);
  std::iota(gone_to.begin(), gone_to.end(), 0U);
  for (const AreaTree::Join& join : tree.joins) gone_to[join.gone] = join.into;
  tree.surfaces.resize(pieces.count);
  for (FaceId f = 0; f < table.size(); ++f) {
    const std::uint32_t piece = pieces.of_face[f];
    tree.surfaces[piece] = surfaces[areas.of_face[f]];
    if (gone_to[piece] == piece) piece_of[areas.of_face[f]] = piece;
  }
  for (AreaTree::Join join : joining.run(context.part(0.5, 1.0))) {
    join.into = piece_of[join.into];
    join.gone = piece_of[join.gone];
    join.height = std::max(join.height, options.inner);
    tree.joins.push_back(join);
  }
  tree.face_noise = {tree.noise.distance * options.face_noise,
                     std::max(static_cast<double>(kinks->noise * radians), tree.noise.angle)};
  if (context.cancelled()) return cancelled();
  tree.smallest = pieces.of_face;
  tree.table.points = {};  // windows are over
  return tree;
}

std::size_t AreaTree::bytes() const {
  return sizeof *this + table.faces.size() * sizeof(FaceTable::Face) +
         table.neighbours.size() * sizeof(table.neighbours[0]) +
         table.sides.size() * sizeof(table.sides[0]) +
         table.points.size() * sizeof(table.points[0]) + edge_length.size() * sizeof(float) +
         banded.size() + smallest.size() * sizeof(std::uint32_t) +
         surfaces.size() * sizeof(FittedSurface) + joins.size() * sizeof(Join);
}

FoundPartitions partitions_of(const Mesh& mesh, const AreaTree& tree, float height,
                              std::uint32_t least, Criterion criterion,
                              const std::vector<double>& values, const std::vector<bool>& taken) {
  Areas areas = tree.cut(height, least);
  FoundPartitions found;
  found.labels.assign(mesh.face_count(), 0);
  // What others took may part an area: each piece of it is one.
  struct Range {
    double sum = 0.0, least = 0.0, most = 0.0;
    std::size_t count = 0;
  };
  std::vector<FaceId> front;
  for (FaceId first = 0; first < mesh.face_count(); ++first) {
    if (found.labels[first] != 0 || (!taken.empty() && taken[first])) continue;
    Partition partition;
    partition.anchor = mesh.triangle(first);
    partition.criterion = criterion;
    found.partitions.push_back(partition);
    const auto label = static_cast<std::uint32_t>(found.partitions.size());
    found.labels[first] = label;
    front.assign(1, first);
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : tree.table.neighbours[front[i]])
        if (g != no_id && found.labels[g] == 0 && areas.of_face[g] == areas.of_face[first] &&
            (taken.empty() || !taken[g])) {
          found.labels[g] = label;
          front.push_back(g);
        }
    Partition& made = found.partitions.back();
    made.faces = static_cast<std::uint32_t>(front.size());
    Range range;
    for (const FaceId f : front) {
      made.area += face_area(mesh, f);
      if (tree.banded[f]) continue;
      for (const VertexId v : mesh.triangle(f)) {
        if (mesh.is_border(v) || std::isnan(values[v])) continue;
        range.least = range.count == 0 ? values[v] : std::min(range.least, values[v]);
        range.most = range.count == 0 ? values[v] : std::max(range.most, values[v]);
        range.sum += values[v];
        ++range.count;
      }
    }
    if (range.count > 0) made.mean_value = range.sum / static_cast<double>(range.count);
    made.interval = {range.least, range.most};
  }
  return found;
}

}  // namespace arris
