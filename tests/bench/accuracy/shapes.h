#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/accuracy/part.h"
#include "tests/support/meshes.h"

namespace arris::accuracy {

/// A mesh without noise and what is true of it. Curves are where the part has them, not where the
/// mesh has edges. `truth.patches` are per triangle, `truth.surfaces` are left empty: what is
/// narrow here is meant to be found.
struct CleanPart {
  testing::Triangles mesh;
  Truth truth;
};

struct Shape {
  std::string name;
  /// The part, sampled with edges of about `edge` mm. Features that are named by a number of edges
  /// scale with it; the part as a whole, about 40 mm, does not.
  std::function<CleanPart(double edge)> make;
};

/// Shapes as a scanner would see them: no vertex on an edge.
std::vector<Shape> scanned_shapes();

/// One of 60 mm with 16 faces: planes, cylinder, cone and sphere.
Shape machined_part();

/// Clean tessellations as a CAD system would write them, every true edge an edge of the mesh.
struct CadMesh {
  std::string name;
  std::function<CleanPart()> make;
};
std::vector<CadMesh> cad_meshes();

}  // namespace arris::accuracy
