#pragma once

#include <vector>

#include "core/mesh/mesh.h"
#include "ui/view/mesh_view.h"

namespace arris::ui {

/// Zooms to these vertices, and turns the part where the surface there faces away, or something
/// else lies before it.
void show_place(MeshView& view, const Mesh& mesh, const std::vector<VertexId>& vertices);

}  // namespace arris::ui
