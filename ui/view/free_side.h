#pragma once

#include <optional>
#include <vector>

#include "ui/view/picker.h"

namespace arris::ui {

/// From where a place on the part is seen.
struct FreeSide {
  Point towards_viewer = Point::UnitZ();  ///< Unit vector.
  bool turned = false;                    ///< It is not the direction of the camera.
  std::optional<Section> cut;             ///< What to cut away so that the place is seen at all.
};

/// The direction of the camera where the place is seen well from there; else the one from which
/// most of it is seen, as nearly face on as can be. Does not depend on what the camera is zoomed
/// to.
FreeSide free_side(const PickSpace& space, const std::vector<VertexId>& place);

/// Whether any of these vertices lies inside the view and is not hidden.
bool sees_any(const PickSpace& space, const std::vector<VertexId>& place);

}  // namespace arris::ui
