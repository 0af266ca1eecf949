#pragma once

#include <cstdint>
#include <vector>

#include "core/base/context.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"
#include "core/sharp_lines/normal_jump.h"

namespace arris {

/// Lengths in mean edges, angles in degrees.
struct TightTubeOptions {
  float least_turn = 40.0F;   // between the sides of a place that may lie on so tight a wall
  float most_radius = 2.5F;   // wider walls are told by the windows of the jump themselves
  float least_radius = 0.5F;  // narrower than an edge across: a scan does not hold it
  float most_slant = 37.0F;   // of the wall's normals against the plane across the axis
  float most_tilt = 20.0F;    // of the normals against the radius, on the mean: rounder than square
  float least_area = 12.0F;   // in equilateral faces of the mean edge
};

/// The walls of small round holes and pins: per face the number of its tube, no_id where it is on
/// none. Windows as wide as those of the jump reach round such a wall and read jumps along it that
/// are none, so that its rims are not seen; a fit of axis and radius that closes round the axis
/// tells it as what it is. Walls end where the surface turns to the axis, at rims and bottoms.
/// Cancelled, it comes back before it is done.
std::vector<std::uint32_t> find_tight_tubes(const Mesh& mesh, const FaceTable& table,
                                            const std::vector<Eigen::Vector3f>& normals,
                                            const NormalJump& jump, const TightTubeOptions& options,
                                            const Context& context = {});

/// Takes what windows read along the walls of tubes out of the jump: they are round.
void clear_jump_on(const Mesh& mesh, const std::vector<std::uint32_t>& tubes, NormalJump& jump);

}  // namespace arris
