#include "ui/view/picker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

#include "ui/view/scene.h"

namespace arris::ui {
namespace {

constexpr double line_reach = 6.0;  // pixels

struct Ray {
  Point origin, direction;
  double length;
};

/// From in front of the part to behind it.
Ray ray_at(const Mesh& mesh, const ViewCamera& camera, QSizeF size, QPointF position) {
  const Point on_plane = camera.unproject(position, size);
  const Point towards = camera.towards_viewer();
  const Point centre = (mesh.box_min() + mesh.box_max()) / 2;
  const double reach = mesh.diagonal();
  const double ahead = (centre - on_plane).dot(towards) + reach;
  return {on_plane + towards * ahead, -towards, 2.0 * reach};
}

double distance_to_segment(const Eigen::Vector2d& at, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b, double& share) {
  const Eigen::Vector2d ab = b - a;
  const double squared = ab.squaredNorm();
  share = squared > 0.0 ? std::clamp((at - a).dot(ab) / squared, 0.0, 1.0) : 0.0;
  return (at - a - share * ab).norm();
}

struct Candidate {
  double distance;
  std::size_t line, segment;
  double share;
};

/// The nearest line that is drawn within reach and that the surface does not hide there.
std::optional<std::pair<std::uint32_t, Point>> line_at(const RayTree& tree,
                                                       const ViewCamera& camera, QSizeF size,
                                                       QPointF position,
                                                       const std::vector<ViewLine>& lines) {
  const Mesh& mesh = *tree.mesh();
  const Eigen::Vector2d at(position.x(), position.y());
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<VertexId>& vertices = lines[i].vertices;
    if (lines[i].id == 0 || vertices.size() < 2) continue;
    Eigen::Vector2d a = camera.project(mesh.point(vertices[0]), size).head<2>();
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const Eigen::Vector2d b = camera.project(mesh.point(vertices[k + 1]), size).head<2>();
      double share = 0.0;
      const double distance = distance_to_segment(at, a, b, share);
      if (distance <= line_reach) candidates.push_back({distance, i, k, share});
      a = b;
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.line, a.segment) < std::tie(b.distance, b.line, b.segment);
  });
  const Point towards = camera.towards_viewer();
  const double unit = camera.units_per_pixel(size);
  for (const Candidate& candidate : candidates) {
    const ViewLine& line = lines[candidate.line];
    const VertexId from = line.vertices[candidate.segment];
    const VertexId to = line.vertices[candidate.segment + 1];
    const Point point = mesh.point(from) + candidate.share * (mesh.point(to) - mesh.point(from));
    // The same lift as where it is drawn, so that what is seen is what is picked.
    const double half_width =
        static_cast<double>(line_strokes()[static_cast<std::size_t>(line.type)].half_width);
    const double lift =
        line_lift(mesh, from, to, towards, half_width + static_cast<double>(line_rim));
    const double reach = 2.0 * mesh.diagonal();
    if (!tree.first(point + towards * (lift * unit), towards, reach)) {
      return std::pair{line.id, point};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Point> surface_at(const RayTree& tree, const ViewCamera& camera, QSizeF size,
                                QPointF position) {
  const Ray ray = ray_at(*tree.mesh(), camera, size, position);
  const auto hit = tree.first(ray.origin, ray.direction, ray.length);
  if (!hit) return std::nullopt;
  return Point(ray.origin + hit->distance * ray.direction);
}

std::optional<Pick> pick_at(const RayTree& tree, const ViewCamera& camera, QSizeF size,
                            QPointF position, const std::vector<ViewLine>& lines) {
  const Mesh& mesh = *tree.mesh();
  Pick pick;
  const Ray ray = ray_at(mesh, camera, size, position);
  const auto hit = tree.first(ray.origin, ray.direction, ray.length);
  if (hit && hit->front) {
    pick.face = hit->face;
    pick.point = ray.origin + hit->distance * ray.direction;
    const Eigen::Vector2d at(position.x(), position.y());
    const HalfEdgeId first = mesh.face_half_edge(hit->face);
    double nearest_vertex = HUGE_VAL;
    double nearest_edge = HUGE_VAL;
    HalfEdgeId h = first;
    do {
      const Eigen::Vector2d a = camera.project(mesh.point(mesh.from(h)), size).head<2>();
      const Eigen::Vector2d b = camera.project(mesh.point(mesh.to(h)), size).head<2>();
      if ((a - at).norm() < nearest_vertex) {
        nearest_vertex = (a - at).norm();
        pick.vertex = mesh.from(h);
      }
      double share = 0.0;
      const double distance = distance_to_segment(at, a, b, share);
      if (distance < nearest_edge) {
        nearest_edge = distance;
        pick.edge = h >> 1;
      }
      h = mesh.next(h);
    } while (h != first);
  }
  if (const auto line = line_at(tree, camera, size, position, lines)) {
    pick.line = line->first;
    if (pick.face == no_id) pick.point = line->second;
  }
  if (pick.face == no_id && pick.line == 0) return std::nullopt;
  return pick;
}

}  // namespace arris::ui
