#pragma once

#include <optional>
#include <vector>

#include <QRectF>

#include "ui/view/mesh_view.h"
#include "ui/view/ray_tree.h"
#include "ui/view/view_camera.h"

namespace arris::ui {

/// What can be picked, and how it is seen. Positions are in logical pixels.
struct PickSpace {
  const RayTree& tree;
  const ViewCamera& camera;
  QSizeF size;                                ///< Of the view.
  const std::vector<bool>* hidden = nullptr;  ///< Faces that are not shown; null: none.
  std::optional<Section> section;
};

/// The pick at `position`. `lines`: those that are shown.
std::optional<Pick> pick_at(const PickSpace& space, QPointF position,
                            const std::vector<ViewLine>& lines);

/// Where the ray through `position` meets the surface, on either side.
std::optional<Point> surface_at(const PickSpace& space, QPointF position);

/// Whether nothing is drawn in front of a point, which is not cut away itself.
bool is_seen(const PickSpace& space, const Point& point);

/// Ids of the lines of whose visible length at least half lies in `area`, ascending.
std::vector<std::uint32_t> lines_in(const PickSpace& space, QRectF area,
                                    const std::vector<ViewLine>& lines);

}  // namespace arris::ui
