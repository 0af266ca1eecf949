#pragma once

#include <string>

#include "core/document/document.h"

namespace arris {

/// The working mesh as Wavefront OBJ with one group a partition, "partition_7", and "unassigned":
/// neighbours share the points of their boundary, which are those of the boundaries' curves.
std::string partitions_obj(const Document& document);

/// The same as VTK PolyData: cell data `partition`, 0 where unassigned.
std::string partitions_vtp(const Document& document);

/// A row for each partition: id, faces, area, share of the whole area, sides, holes, the fitted
/// surface (type, radius, radius of the tube, half angle; empty where it has none), mean and
/// largest deviation, share of the vertices within the tolerance, 1 for an approved one. Errors:
/// those of fit_partition_surfaces().
Result<std::string> partition_table_csv(const Document& document);

}  // namespace arris
