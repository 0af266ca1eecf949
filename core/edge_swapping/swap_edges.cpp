#include "core/edge_swapping/swap_edges.h"

#include "core/mesh/geometry.h"

namespace arris {

namespace {

/// A swap has to gain more than this, radians: far above the rounding of five angles, so that no
/// chain of swaps can come back to where it was.
constexpr double least_gain = 1e-9;

SwapEngine::Values bending(const WorkingMesh& mesh, const SwapCase& s) {
  const Point &left = mesh.normal(s.left), &right = mesh.normal(s.right);
  double before = angle_between(left, right);
  double after = angle_between(s.new_left, s.new_right);
  const auto beyond = [&](WorkingMesh::SideId side, const Point& old_normal,
                          const Point& new_normal) {
    const WorkingMesh::SideId twin = mesh.twin(side);
    if (twin == no_id) return;
    before += angle_between(old_normal, mesh.normal(twin >> 2));
    after += angle_between(new_normal, mesh.normal(twin >> 2));
  };
  beyond(s.ad, right, s.new_left);
  beyond(s.db, right, s.new_right);
  beyond(s.bc, left, s.new_right);
  beyond(s.ca, left, s.new_left);
  return {before, after, after < before - least_gain};
}

}  // namespace

Result<Prepared> swap_edges(const Mesh& mesh, const ErrorZonesPtr& zones,
                            const ChunkedArray<Origin>& sharp, const SwapOptions& options,
                            const Context& context) {
  return run_swaps(mesh, zones, sharp, bending, true, options, context, "smoothing swaps");
}

double total_bending(const Mesh& mesh) {
  double sum = 0.0;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (!mesh.is_border_edge(e))
      sum += angle_between(unit_normal(mesh, mesh.edge_faces(e)[0]),
                           unit_normal(mesh, mesh.edge_faces(e)[1]));
  return sum;
}

}  // namespace arris
