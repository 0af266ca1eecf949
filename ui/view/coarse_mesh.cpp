#include "ui/view/coarse_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <Eigen/Geometry>

namespace arris::ui {

CoarseMesh make_coarse(const Mesh& mesh, std::size_t faces) {
  CoarseMesh result;
  double area = 0.0;
  for (const Triangle& t : mesh.triangles()) {
    const Point& a = mesh.point(t[0]);
    area += (mesh.point(t[1]) - a).cross(mesh.point(t[2]) - a).norm() / 2;
  }
  // A surface passes through about 1.5 cells for each area of a cell's side, and has two triangles
  // for each vertex.
  result.cell = std::sqrt(3.0 * area / static_cast<double>(std::max<std::size_t>(faces, 1)));
  if (!(result.cell > mesh.diagonal() * 1e-6)) result.cell = mesh.diagonal() * 1e-6;
  if (!(result.cell > 0.0)) return result;

  struct Cell {
    VertexId vertex;
    double distance;  // squared, of the vertex from the middle of the cell
  };
  std::unordered_map<std::uint64_t, Cell> cells;
  std::vector<std::uint64_t> keys(mesh.vertex_count());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(v)) continue;
    const Point local = (mesh.point(v) - mesh.box_min()) / result.cell;
    const Point index(std::floor(local.x()), std::floor(local.y()), std::floor(local.z()));
    const double distance = (local - index - Point::Constant(0.5)).squaredNorm();
    for (int k = 0; k < 3; ++k) {
      keys[v] = keys[v] << 21 | (static_cast<std::uint64_t>(index[k]) & 0x1FFFFFu);
    }
    const auto [cell, added] = cells.try_emplace(keys[v], Cell{v, distance});
    if (!added && distance < cell->second.distance) cell->second = {v, distance};
  }
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    if (keys[t[0]] == keys[t[1]] || keys[t[1]] == keys[t[2]] || keys[t[2]] == keys[t[0]]) continue;
    result.triangles.push_back(
        {cells.at(keys[t[0]]).vertex, cells.at(keys[t[1]]).vertex, cells.at(keys[t[2]]).vertex});
    result.source_faces.push_back(f);
  }
  return result;
}

}  // namespace arris::ui
