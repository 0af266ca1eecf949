#pragma once

#include <vector>

#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/line_regions.h"
#include "core/sharp_lines/normal_jump.h"

namespace arris {

struct CrestOptions {
  float least = 12.0F;  // degrees: a band of vertices that jump by this or more is thinned
  float spur = 3.0F;    // mean edges: branches of the thinned band shorter than this go
  int pooled = 5;       // places on either side along a crest that count in
};

/// The crests of the jump, as chains of edges: lines that part no regions, such as a step that
/// fades out inside an area. The band of vertices that jump is thinned from its rims inwards,
/// weakest edge first, so that what is left runs along the crest and keeps the band's topology;
/// convex and concave bands for themselves. Each place reads the mean of its neighbours along the
/// crest. Within two edges of `borders` that stand above `height` (degrees), crests are kept as ways
/// on only (value 0). By increasing edge; without edges of such `borders`. `borders`: by increasing edge.
std::vector<BorderEdge> find_crests(const Mesh& mesh, const FaceTable& table,
                                    const NormalJump& jump, const std::vector<BorderEdge>& borders,
                                    float height, const CrestOptions& options);

}  // namespace arris
