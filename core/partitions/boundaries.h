#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/mesh.h"
#include "core/partitions/partitions.h"
#include "core/sharp_lines/lines.h"

namespace arris {

/// Type of a boundary (section 5 and figure 30, with `border` added).
enum class BoundaryType : std::uint8_t {
  c0,         ///< A sharp line; stays what it is even inside one partition.
  gn,         ///< Between two different partitions.
  undefined,  ///< One partition, unassigned faces beyond.
  border,     ///< One partition, and the scan ends.
};

std::string_view name_of(BoundaryType type);  ///< "C0", "Gn", "undefined", "border".

/// A borderline: a chain of boundary edges of one type with the same two sides all along. It meets
/// other boundaries only at its ends.
struct Boundary {
  BoundaryType type = BoundaryType::undefined;
  std::vector<VertexId> vertices;  ///< A closed one repeats its first vertex at the end.
  bool closed = false;
  std::uint32_t left = 0, right = 0;  ///< Partition ids seen along the path; 0: none.
  std::uint32_t line = 0;             ///< C0: id of the sharp line it lies on.
  double length = 0.0;                ///< mm
  double mean_angle = 0.0;            ///< Degrees, signed mean of IHe weighted by length.
  EdgeId lowest_edge = no_id;         ///< Of the mesh; the order of boundaries.
  bool operator==(const Boundary&) const = default;
};

using BoundaryPtr = std::shared_ptr<const Boundary>;
using Boundaries = std::vector<BoundaryPtr>;

/// All boundaries of the lines and partitions, in the order of their lowest edge. A border edge of
/// the scan is a boundary where its face belongs to a partition.
Boundaries derive_boundaries(const Mesh& mesh, const Curvatures& curvatures,
                             const SharpLines& lines, const Partitions& partitions);

/// Lines and partitions on one mesh.
struct Division {
  const SharpLines& lines;
  const Partitions& partitions;
};

/// The same as derive_boundaries() for `after`, from the boundaries of `before`, at a cost that
/// follows the edit: only boundaries through `touched` (edges that became sharp or ceased to be, or
/// with a face whose label changed) and those of lines that changed are made anew.
Boundaries update_boundaries(const Mesh& mesh, const Curvatures& curvatures,
                             const Boundaries& boundaries, const Division& before,
                             const Division& after, const std::vector<EdgeId>& touched);

}  // namespace arris
