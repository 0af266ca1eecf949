#pragma once

#include <string>

#include "core/document/document.h"

namespace arris {

/// The working mesh as Wavefront OBJ with one group a partition, "partition_7", and "unassigned":
/// neighbours share the points of their boundary, which are those of the boundaries' curves.
std::string partitions_obj(const Document& document);

/// The same as VTK PolyData: cell data `partition`, 0 where unassigned.
std::string partitions_vtp(const Document& document);

}  // namespace arris
