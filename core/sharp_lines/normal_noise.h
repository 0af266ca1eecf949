#pragma once

#include <vector>

#include "core/base/context.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

/// How much noise turns the faces of a scan, in degrees: the median angle between a face's normal
/// and the mean of the normals about its corners. 0 where most faces are flat with their
/// neighbours, about 5 on scans, 12 and more where the noise is as large as a third of an edge.
float normal_noise(const Mesh& mesh, const FaceTable& table);

struct NormalFilterOptions {
  int rounds = 10;
  float likeness = 0.5F;  // spread over the difference of two unit normals that still mix
};

/// Normals without most of their noise, whose jumps stay: each becomes the mean of those of the
/// faces that share a corner with it, by area, nearness and likeness (bilateral filter on a field
/// of normals, Zheng, Fu, Au and Tai 2011, local scheme). Only for harsh noise: on ordinary scans
/// it costs more of the weak lines than it mends.
std::vector<Eigen::Vector3f> filter_normals(const Mesh& mesh, const FaceTable& table,
                                            const NormalFilterOptions& options,
                                            const Context& context);

}  // namespace arris
