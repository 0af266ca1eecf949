#include "ui/view/free_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/mesh/measurement.h"

namespace arris::ui {

namespace {

constexpr std::size_t most_samples = 32;
/// How far samples are raised off the surface, in mean edges: what they lie on must not hide them.
constexpr double raised = 0.3;
/// Cosine below which a place is seen too much from the side.
constexpr double least_facing = 0.4;
/// The camera stays where it sees this share of what can be seen at best.
constexpr double well_seen = 0.8;
/// Where no direction sees a larger share, what hides the place is cut away.
constexpr double unseen = 0.1;

struct Sample {
  Point point, normal;
};

std::vector<Sample> samples_of(const Mesh& mesh, const std::vector<VertexId>& place) {
  std::vector<Sample> samples;
  const std::size_t step = std::max<std::size_t>(1, place.size() / most_samples);
  for (std::size_t k = 0; k < place.size(); k += step) {
    if (place[k] >= mesh.vertex_count()) continue;
    const Point normal = mean_normal_at(mesh, {place[k]});
    samples.push_back({mesh.point(place[k]) + raised * mesh.mean_edge_length() * normal, normal});
  }
  return samples;
}

PickSpace seen_against(const PickSpace& space, const ViewCamera& camera) {
  return {space.tree, camera, space.size, space.hidden, space.section};
}

/// Of the samples, those seen against a direction: their share, and how much they face it.
struct Sight {
  double share = 0.0, facing = 0.0;
  double worth() const { return share * (0.6 + 0.4 * facing); }
};

Sight sight_of(const PickSpace& space, const std::vector<Sample>& samples, const Point& direction) {
  ViewCamera camera = space.camera;
  camera.look(direction, direction.unitOrthogonal());
  const PickSpace from = seen_against(space, camera);
  Sight sight;
  for (const Sample& sample : samples) {
    if (!is_seen(from, sample.point)) continue;
    sight.share += 1.0;
    sight.facing += std::max(0.0, sample.normal.dot(direction));
  }
  if (sight.share > 0.0) sight.facing /= sight.share;
  sight.share /= static_cast<double>(samples.size());
  return sight;
}

/// Straight on, then tilted further and further; then from all about.
std::vector<Point> directions_about(const Point& normal) {
  std::vector<Point> directions;
  if (normal.norm() > 0.0) {
    directions.push_back(normal);
    const Point right = normal.unitOrthogonal(), up = normal.cross(right);
    for (const double tilt : {25.0, 45.0, 65.0})
      for (int k = 0; k < 8; ++k) {
        const double round = std::numbers::pi * k / 4.0, off = tilt * std::numbers::pi / 180.0;
        directions.push_back(std::cos(off) * normal +
                             std::sin(off) * (std::cos(round) * right + std::sin(round) * up));
      }
  }
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) directions.push_back(Point(x, y, z).normalized());
  return directions;
}

}  // namespace

FreeSide free_side(const PickSpace& space, const std::vector<VertexId>& place) {
  const Mesh& mesh = *space.tree.mesh();
  FreeSide result;
  result.towards_viewer = space.camera.towards_viewer();
  const std::vector<Sample> samples = samples_of(mesh, place);
  if (samples.empty()) return result;
  const Sight now = sight_of(space, samples, result.towards_viewer);
  Sight best = now;
  Point towards = result.towards_viewer;
  for (const Point& direction : directions_about(mean_normal_at(mesh, place))) {
    const Sight sight = sight_of(space, samples, direction);
    if (sight.worth() <= best.worth() + 1e-6) continue;
    best = sight;
    towards = direction;
  }
  const bool stays = now.share >= well_seen * best.share && now.facing >= least_facing;
  if (!stays) {
    result.turned = towards != result.towards_viewer;
    result.towards_viewer = towards;
  }
  if (std::max(best.share, now.share) > unseen) return result;
  // Inside: face on, through what lies before it.
  const Point normal = mean_normal_at(mesh, place);
  if (normal.norm() > 0.0) {
    result.turned = true;
    result.towards_viewer = normal;
  }
  Section cut;
  cut.normal = result.towards_viewer;
  cut.offset = -HUGE_VAL;
  for (const Sample& sample : samples)
    cut.offset = std::max(cut.offset, cut.normal.dot(sample.point));
  cut.offset += raised * mesh.mean_edge_length();
  result.cut = cut;
  return result;
}

bool sees_any(const PickSpace& space, const std::vector<VertexId>& place) {
  const QRectF view(QPointF(0.0, 0.0), space.size);
  return std::ranges::any_of(samples_of(*space.tree.mesh(), place), [&](const Sample& sample) {
    const Eigen::Vector3d at = space.camera.project(sample.point, space.size);
    return view.contains(QPointF(at.x(), at.y())) && is_seen(space, sample.point);
  });
}

}  // namespace arris::ui
