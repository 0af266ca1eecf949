#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/partitions/curvature_kinks.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/lines.h"
#include "core/sharp_lines/watershed.h"

namespace arris {

/// Lengths in mean edges, angles in degrees, areas in equilateral faces of the mean edge.
struct SmallestAreaOptions {
  float band = 1.5F;         // faces nearer than this to a line are rounded by it: they do not vote
  float narrow_band = 0.8F;  // and nearer than this in strips too narrow for that,
  int narrow_rings = 3;      // told by steps over sides from faces that vote
  WatershedOptions watershed{0.5F, 6.0F};  // of the kinks
  float first_cut = 1.8F;                  // borders weaker than this by their kinks go unfitted
  float first_quantile = 0.4F;             // of a border's kinks along it: what it counts for
  float first_area = 40.0F;                // below it an area joins the more easily
};

/// No neighbours over sharp edges.
FaceTable table_between_lines(const Mesh& mesh, const SharpLines& lines);

/// 1 for faces whose centre lies within `options.band` of a line, on their side of it. Where strips
/// are so narrow that nothing else is left, only for those within `options.narrow_band`.
std::vector<std::uint8_t> faces_beside_lines(const Mesh& mesh, const SharpLines& lines,
                                             const FaceTable& table,
                                             const SmallestAreaOptions& options);

/// The areas that a watershed of the kinks leaves, weak ones joined. Faces beside lines (`banded`)
/// do not vote: they go to what is nearest; where there is nothing else they are an area by
/// themselves.
FaceRegions smallest_areas(const Mesh& mesh, const FaceTable& table,
                           const std::vector<std::uint8_t>& banded, const CurvatureKinks& kinks,
                           const std::vector<float>& edge_length,
                           const SmallestAreaOptions& options);

/// Regions renumbered from 0 by their lowest face. `most`: over every label.
FaceRegions renumbered(std::vector<std::uint32_t> labels, std::size_t most);

}  // namespace arris
