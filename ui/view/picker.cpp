#include "ui/view/picker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
Ray ray_at(const PickSpace& space, QPointF position) {
  const Mesh& mesh = *space.tree.mesh();
  const Point on_plane = space.camera.unproject(position, space.size);
  const Point towards = space.camera.towards_viewer();
  const Point centre = (mesh.box_min() + mesh.box_max()) / 2;
  const double reach = mesh.diagonal();
  const double ahead = (centre - on_plane).dot(towards) + reach;
  return {on_plane + towards * ahead, -towards, 2.0 * reach};
}

double beyond(const Section& section, const Point& point) {
  return section.normal.dot(point) - section.offset;
}

/// The part of a ray that the section leaves; nullopt: nothing.
std::optional<Ray> uncut(Ray ray, const std::optional<Section>& section) {
  if (!section) return ray;
  const double at_origin = beyond(*section, ray.origin);
  const double slope = section->normal.dot(ray.direction);
  const double crossing = -at_origin / slope;
  if (at_origin > 0.0) {
    if (!(slope < 0.0) || crossing > ray.length) return std::nullopt;
    ray.origin += crossing * ray.direction;
    ray.length -= crossing;
  } else if (slope > 0.0) {
    ray.length = std::min(ray.length, crossing);
  }
  return ray;
}

std::optional<RayTree::Hit> first_hit(const PickSpace& space, const Ray& ray) {
  return space.tree.first(ray.origin, ray.direction, ray.length, space.hidden);
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

/// A point of a line, as far in front of the surface as the line is drawn there, so that what is
/// seen is what is picked.
Point drawn_point(const PickSpace& space, const ViewLine& line, std::size_t segment, double share) {
  const Mesh& mesh = *space.tree.mesh();
  const VertexId from = line.vertices[segment];
  const VertexId to = line.vertices[segment + 1];
  const Point point = mesh.point(from) + share * (mesh.point(to) - mesh.point(from));
  const Point towards = space.camera.towards_viewer();
  const double half_width =
      static_cast<double>(line_strokes()[static_cast<std::size_t>(line.type)].half_width);
  const double lift =
      line_lift(mesh, from, to, towards, half_width + static_cast<double>(line_rim));
  return point + towards * (lift * space.camera.units_per_pixel(space.size));
}

struct PickedLine {
  std::uint32_t id;
  EdgeId edge;
  Point point;
};

/// The nearest line that is drawn within reach and that the surface does not hide there.
std::optional<PickedLine> line_at(const PickSpace& space, QPointF position,
                                  const std::vector<ViewLine>& lines) {
  const Mesh& mesh = *space.tree.mesh();
  const Eigen::Vector2d at(position.x(), position.y());
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<VertexId>& vertices = lines[i].vertices;
    if (lines[i].id == 0 || vertices.size() < 2) continue;
    Eigen::Vector2d a = space.camera.project(mesh.point(vertices[0]), space.size).head<2>();
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const Eigen::Vector2d b =
          space.camera.project(mesh.point(vertices[k + 1]), space.size).head<2>();
      double share = 0.0;
      const double distance = distance_to_segment(at, a, b, share);
      if (distance <= line_reach) candidates.push_back({distance, i, k, share});
      a = b;
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.line, a.segment) < std::tie(b.distance, b.line, b.segment);
  });
  for (const Candidate& candidate : candidates) {
    const ViewLine& line = lines[candidate.line];
    if (!is_seen(space, drawn_point(space, line, candidate.segment, candidate.share))) continue;
    const VertexId a = line.vertices[candidate.segment], b = line.vertices[candidate.segment + 1];
    const Point point = mesh.point(a) + candidate.share * (mesh.point(b) - mesh.point(a));
    return PickedLine{line.id, mesh.find_edge(a, b).value_or(no_id), point};
  }
  return std::nullopt;
}

}  // namespace

bool is_seen(const PickSpace& space, const Point& point) {
  if (space.section && beyond(*space.section, point) > 0.0) return false;
  const auto ray = uncut(
      {point, space.camera.towards_viewer(), 2.0 * space.tree.mesh()->diagonal()}, space.section);
  return !first_hit(space, *ray);
}

std::optional<Point> surface_at(const PickSpace& space, QPointF position) {
  const auto ray = uncut(ray_at(space, position), space.section);
  const auto hit = ray ? first_hit(space, *ray) : std::nullopt;
  if (!hit) return std::nullopt;
  return Point(ray->origin + hit->distance * ray->direction);
}

std::optional<Pick> pick_at(const PickSpace& space, QPointF position,
                            const std::vector<ViewLine>& lines) {
  const Mesh& mesh = *space.tree.mesh();
  const ViewCamera& camera = space.camera;
  const QSizeF size = space.size;
  Pick pick;
  const auto ray = uncut(ray_at(space, position), space.section);
  const auto hit = ray ? first_hit(space, *ray) : std::nullopt;
  if (hit && hit->front) {
    pick.face = hit->face;
    pick.point = ray->origin + hit->distance * ray->direction;
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
  if (const auto line = line_at(space, position, lines)) {
    pick.line = line->id;
    if (pick.face == no_id)
      pick.point = line->point;
    else if (line->edge != no_id)
      pick.edge = line->edge;
  }
  if (pick.face == no_id && pick.line == 0) return std::nullopt;
  return pick;
}

std::vector<std::uint32_t> lines_in(const PickSpace& space, QRectF area,
                                    const std::vector<ViewLine>& lines) {
  const Mesh& mesh = *space.tree.mesh();
  constexpr std::size_t samples = 48;  // of a line
  const auto contains = [&](const Point& point) {
    const Eigen::Vector3d at = space.camera.project(point, space.size);
    return area.contains(QPointF(at.x(), at.y()));
  };
  const auto middle = [&](const ViewLine& line, std::size_t k) {
    return Point((mesh.point(line.vertices[k]) + mesh.point(line.vertices[k + 1])) / 2);
  };
  // What hides a line is looked for only where a part of it lies in the area at all.
  struct Lengths {
    double inside = 0.0, seen = 0.0;
  };
  std::map<std::uint32_t, Lengths> lengths;
  for (const ViewLine& line : lines) {
    if (line.id == 0 || lengths.contains(line.id)) continue;
    for (std::size_t k = 0; k + 1 < line.vertices.size(); ++k) {
      if (!contains(middle(line, k))) continue;
      lengths.insert({line.id, {}});
      break;
    }
  }
  for (const ViewLine& line : lines) {
    const auto sum = lengths.find(line.id);
    if (sum == lengths.end()) continue;
    const std::size_t segments = line.vertices.size() - 1;
    for (std::size_t k = 0; k < segments; k += std::max<std::size_t>(segments / samples, 1)) {
      if (!is_seen(space, drawn_point(space, line, k, 0.5))) continue;
      const double length =
          (mesh.point(line.vertices[k + 1]) - mesh.point(line.vertices[k])).norm();
      sum->second.seen += length;
      if (contains(middle(line, k))) sum->second.inside += length;
    }
  }
  std::vector<std::uint32_t> result;
  for (const auto& [id, sum] : lengths) {
    if (sum.inside > 0.0 && 2.0 * sum.inside >= sum.seen) result.push_back(id);
  }
  return result;
}

}  // namespace arris::ui
