#include "core/sharp_lines/face_table.h"

#include <limits>

#include "core/base/parallel.h"

namespace arris {

FaceTable::FaceTable(const Mesh& mesh)
    : faces(mesh.face_count()),
      neighbours(mesh.face_count()),
      sides(mesh.face_count()),
      points(mesh.vertex_count()),
      unit(mesh.mean_edge_length() > 0.0 ? mesh.mean_edge_length() : 1.0) {
  const Point middle = (mesh.box_min() + mesh.box_max()) / 2.0;
  parallel_for(points.size(), [&](std::size_t v) {
    points[v] = ((mesh.point(static_cast<VertexId>(v)) - middle) / unit).cast<float>();
  });
  parallel_for(faces.size(), [&](std::size_t i) {
    const FaceId f = static_cast<FaceId>(i);
    const Triangle& t = mesh.triangle(f);
    const Point a = (mesh.point(t[0]) - middle) / unit, b = (mesh.point(t[1]) - middle) / unit,
                c = (mesh.point(t[2]) - middle) / unit;
    const Point normal = (b - a).cross(c - a);
    const double twice = normal.norm();
    faces[i].centre = ((a + b + c) / 3.0).cast<float>();
    faces[i].normal = (twice > 0.0 ? Point(normal / twice) : Point::Zero()).cast<float>();
    faces[i].area = static_cast<float>(twice / 2.0);
    HalfEdgeId h = mesh.face_half_edge(f);
    for (std::size_t k = 0; k < 3; ++k, h = mesh.next(h)) {
      neighbours[i][k] = mesh.face(Mesh::opposite(h));
      sides[i][k] = h >> 1;
    }
  });
}

std::vector<float> distances_from(const Mesh& mesh, const FaceTable& table,
                                  const std::vector<EdgeId>& edges, float reach) {
  std::vector<float> distance(table.size(), std::numeric_limits<float>::infinity());
  std::vector<EdgeId> nearest(table.size(), no_id);
  std::vector<FaceId> front;
  const auto visit = [&](FaceId f, EdgeId e, bool always) {
    const EdgeVertices& ends = mesh.edge(e);
    const float d =
        (table.faces[f].centre - (table.points[ends[0]] + table.points[ends[1]]) / 2.0F).norm();
    if (d >= distance[f] || (!always && d >= reach)) return;
    distance[f] = d;
    nearest[f] = e;
    front.push_back(f);
  };
  for (const EdgeId e : edges)
    for (const FaceId f : mesh.edge_faces(e))
      if (f != no_id) visit(f, e, true);
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const FaceId g : table.neighbours[front[i]])
      if (g != no_id) visit(g, nearest[front[i]], false);
  return distance;
}

}  // namespace arris
