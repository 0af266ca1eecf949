#pragma once

#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include <QColor>

#include "core/document/document.h"
#include "ui/view/mesh_view.h"

/// A document's lines, boundaries and partitions as a view shows them.
namespace arris::ui {

/// Boundaries that are no sharp lines have no id of their own: a view knows the k-th of the
/// document as first_boundary + k, and sharp lines by their ids.
inline constexpr std::uint32_t first_boundary = 0x80000000u;

/// `tangent`: places of the boundaries that are shown as tangent lines.
std::vector<ViewLine> view_lines(const Document& document,
                                 const std::unordered_set<std::size_t>& tangent = {});

/// Places of the partitions in document.partitions.partitions by id, from 1; 0: no partition.
std::vector<std::uint32_t> places_of_partitions(const Document& document);

/// One colour for each partition, in their order; adjacent ones never alike. `given`, empty or as
/// many: colours that are kept where that allows.
std::vector<QColor> colours_of_partitions(const Document& document,
                                          const std::vector<std::optional<QColor>>& given = {});

/// Colours the faces of the view by partition; the labels are places, not ids.
void show_partitions_in(MeshView& view, const Document& document,
                        const std::vector<QColor>& colours);

}  // namespace arris::ui
