#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/context.h"
#include "core/partitions/surface_fit.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

/// A few neighbouring faces of one area, as one sample of its surface: their mean place and normal
/// carry far less of the noise than those of a face do. Linked where their faces are neighbours.
struct Grains {
  std::vector<SurfaceSample> samples;        ///< Weights in equilateral faces of the mean edge.
  std::vector<std::uint32_t> area;           ///< Of each.
  std::vector<std::uint32_t> of_face;        ///< Per face; no_id where it does not vote.
  std::vector<std::uint32_t> starts, links;  ///< Neighbours of grain k: links[starts[k]...].

  std::size_t size() const { return samples.size(); }
  std::span<const std::uint32_t> around(std::uint32_t k) const {
    return {links.data() + starts[k], links.data() + starts[k + 1]};
  }
};

/// `banded`: per face, 1 for those that do not vote. `faces`: how many make one grain.
Grains make_grains(const FaceTable& table, const FaceRegions& areas,
                   const std::vector<std::uint8_t>& banded, int faces);

struct SurfaceGrowingOptions {
  std::size_t seed = 16;      // grains that a surface is first fitted to
  std::size_t least = 6;      // grains below which a surface explains nothing
  double admits = 6.0;        // misfit up to which a grain belongs to a surface
  double good = 1.6;          // mean misfit up to which a surface is one
  int rounds = 12;            // of growing and fitting again
  std::size_t samples = 200;  // that are fitted, at most
};

/// Which surface explains each grain: numbers from 0, no_id for none. Surfaces grow from the
/// largest areas on, as far as the grains they reach agree with them, and are fitted again as they
/// grow. Cancelled, it comes back before it is done.
std::vector<std::uint32_t> grow_surfaces(const Grains& grains, const SurfaceNoise& noise,
                                         const SurfaceGrowingOptions& options,
                                         const Context& context = {});

/// The samples of windows of `size` neighbouring grains of one area, side by side.
std::vector<std::vector<SurfaceSample>> grain_windows(const Grains& grains, std::size_t size);

/// At most `most` of the samples, evenly, with the same weight in all.
std::vector<SurfaceSample> thinned(std::vector<SurfaceSample> samples, std::size_t most);

}  // namespace arris
