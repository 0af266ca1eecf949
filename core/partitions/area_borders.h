#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/partitions/surface_fit.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

struct AreaBorderOptions {
  int rounds = 12;      // over the faces beside borders
  double most = 6.0;    // misfit of a face to a surface, limited to this
  double free = 1.4;    // misfit of any face to an area without a surface
  double length = 1.2;  // misfit that a mean edge of border is worth
  // Then borders are made straight, lengths in mean edges:
  int straightenings = 4;  // times, all faces at once
  float reach = 1.5F;      // faces farther than this from where a border ran stay
  float spread = 1.25F;    // of the Gaussian by which the faces round one count for it
  double straight = 12.0;  // misfit that they are worth, all together
  int teeth = 4;           // rounds that take off the teeth which that leaves
};

/// Areas side by side, and what their faces are measured by.
struct AreaGround {
  const Mesh& mesh;
  const FaceTable& table;  ///< Without neighbours over what no border crosses, such as lines.
  const std::vector<float>& edge_length;       ///< Mean edges.
  const std::vector<FittedSurface>& surfaces;  ///< Of each area; type free: none explains it.
  const SurfaceNoise& noise;                   ///< Of a face.
  const std::vector<std::uint8_t>& banded;     ///< Per face, 1: its shape says nothing.
};

/// Moves the borders between areas that are no lines to where the two surfaces meet, and makes them
/// short: face after face goes over to the area beside it that it agrees with better, a mean edge
/// of border counting as much as some misfit.
void settle_borders(const AreaGround& ground, const AreaBorderOptions& options,
                    std::vector<std::uint32_t>& labels);

/// Takes the zigzag out of such borders: each face near one goes, all at once, to the area that
/// most of the faces round it are of, unless it disagrees with its surface.
void straighten_borders(const AreaGround& ground, const AreaBorderOptions& options,
                        std::vector<std::uint32_t>& labels);

/// Of each label the largest piece stays, the others go to the neighbour over the longest border.
void keep_largest_pieces(const FaceTable& table, const std::vector<float>& edge_length,
                         std::vector<std::uint32_t>& labels);

}  // namespace arris
