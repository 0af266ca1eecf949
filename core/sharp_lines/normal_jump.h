#pragma once

#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

/// Lengths in mean edges, angles in degrees.
struct NormalJumpOptions {
  float reach = 4.0F;       // faces nearer than this to the place are looked at
  float near = 0.5F;        // across the line, the strip about it that the rounding spoils
  float far = 3.5F;         // across the line, where the sides end
  float across = 2.2F;      // spread of the weights across the line
  float along = 3.0F;       // and along it: pooling along a line is what noise cannot follow
  float ridge = 0.1F;       // holds the slope of a side down where its faces lie at one distance
  float most_turn = 75.0F;  // faces turned farther from the mean are another side of the part
  float least_slant = 0.6F;  // cosine across the line from which an edge counts as lying along it
};

/// How far the surface turns at once: the jump of the mean normal across a place, above what the
/// curvature on both sides of it accounts for.
struct NormalJump {
  std::vector<float> at_vertex;  ///< Degrees, up to 150 either way; convex positive.
  std::vector<float> turn;  ///< Per vertex, degrees, 0 or more: between the means of the sides.
  /// Degrees, 0 or more: of its ends, less where the edge runs across the line.
  std::vector<float> at_edge;
  std::vector<std::uint8_t> convex;  ///< Per edge: 1 where its ends are rather convex.
};

/// The jump at every vertex and edge.
///
/// In a window about a vertex: the mean normal, the direction across which the normals turn most
/// (eigenvector of a 2 x 2 tensor), then on each side a straight line through the normals, as
/// rotation vectors, over the distance from the vertex; what the two lines leave at distance 0,
/// along the jump of the means and not above it, is the jump. A sharp line is a jump, a fillet is
/// two slopes. Border vertices are measured like the others with what faces they have.
/// `normals`: per face, those to use (the table's own or filtered ones). Errors: cancelled.
Result<NormalJump> measure_normal_jump(const Mesh& mesh, const FaceTable& table,
                                       const std::vector<Eigen::Vector3f>& normals,
                                       const NormalJumpOptions& options, const Context& context);

}  // namespace arris
