#pragma once

#include <optional>
#include <vector>

#include "ui/view/mesh_view.h"
#include "ui/view/ray_tree.h"
#include "ui/view/view_camera.h"

namespace arris::ui {

/// The pick at `position` in a view of `size` (logical pixels). `lines`: those that are shown.
std::optional<Pick> pick_at(const RayTree& tree, const ViewCamera& camera, QSizeF size,
                            QPointF position, const std::vector<ViewLine>& lines);

/// Where the ray through `position` meets the surface, on either side.
std::optional<Point> surface_at(const RayTree& tree, const ViewCamera& camera, QSizeF size,
                                QPointF position);

}  // namespace arris::ui
