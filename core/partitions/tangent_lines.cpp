#include "core/partitions/tangent_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

namespace {

/// Where a boundary runs at each of its edges, without the zigzag of the mesh; unit, zero where it
/// has no length.
std::vector<Eigen::Vector3f> directions_of(const FaceTable& table, const Boundary& boundary) {
  constexpr std::ptrdiff_t reach = 4;  // edges to each side
  const auto edges = static_cast<std::ptrdiff_t>(boundary.vertices.size()) - 1;
  const auto at = [&](std::ptrdiff_t i) {
    if (boundary.closed) i = (i % edges + edges) % edges;
    i = std::clamp<std::ptrdiff_t>(i, 0, edges);
    return table.points[boundary.vertices[static_cast<std::size_t>(i)]];
  };
  std::vector<Eigen::Vector3f> directions;
  for (std::ptrdiff_t i = 0; i < edges; ++i)
    directions.push_back((at(i + 1 + reach) - at(i - reach)).stableNormalized());
  return directions;
}

/// A straight line through (x, y) by least squares.
struct StraightLine {
  double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  void add(double at, double value, double w) {
    weight += w;
    x += w * at;
    y += w * value;
    xx += w * at * at;
    xy += w * at * value;
  }
  double spread() const { return weight * xx - x * x; }
  double slope() const { return (weight * xy - x * y) / spread(); }
  double at_zero() const { return (y - slope() * x) / weight; }
};

/// The turn of the normals, radians, over the distance across the boundary, mean edges: on its left
/// and on its right.
using Profile = std::array<StraightLine, 2>;

Profile profile_of(const Mesh& mesh, const FaceTable& table, const Partitions& partitions,
                   const Boundary& boundary, const TangentLineOptions& options,
                   FaceWindow& window) {
  constexpr double wide = 0.4;  // share of what was read that lies beyond the rim
  const auto reach = static_cast<float>(options.reach);
  Profile beyond;
  Profile profile;
  const std::vector<Eigen::Vector3f> directions = directions_of(table, boundary);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const VertexId from = boundary.vertices[i], to = boundary.vertices[i + 1];
    const EdgeId e = *mesh.find_edge(from, to);
    const Eigen::Vector3f middle = 0.5F * (table.points[from] + table.points[to]);
    const std::vector<FaceId>& faces =
        window.grow(mesh.edge_faces(e), middle, reach, [&](FaceId f) {
          const std::uint32_t label = partitions.label(f);
          return label == boundary.left || label == boundary.right;
        });
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    for (const FaceId f : faces) normal += table.faces[f].area * table.faces[f].normal;
    normal -= normal.dot(directions[i]) * directions[i];
    normal.stableNormalize();
    const Eigen::Vector3f across = directions[i].cross(normal);  // to the left
    const float length = (table.points[to] - table.points[from]).norm();
    for (const FaceId f : faces) {
      const FaceTable::Face& face = table.faces[f];
      const float turn = std::atan2(face.normal.dot(across), face.normal.dot(normal));
      // On a bent side the way over the surface is longer than its shadow.
      Eigen::Vector3f offset = face.centre - middle;
      offset -= offset.dot(directions[i]) * directions[i];
      const float at = std::copysign(offset.norm(), offset.dot(across));
      const std::size_t side = partitions.label(f) == boundary.left ? 0 : 1;
      profile[side].add(at, turn, face.area * length);
      if (std::abs(at) >= options.rim) beyond[side].add(at, turn, face.area * length);
    }
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (beyond[side].weight > wide * profile[side].weight) profile[side] = beyond[side];
  return profile;
}

}  // namespace

Result<std::vector<TangentLine>> find_tangent_lines(const Mesh& mesh, const Partitions& partitions,
                                                    const Boundaries& boundaries,
                                                    const std::vector<PartitionSurface>& surfaces,
                                                    const TangentLineOptions& options,
                                                    const Context& context) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < boundaries.size(); ++k)
    if (boundaries[k]->type == BoundaryType::gn) places.push_back(k);
  std::vector<TangentLine> result;
  if (places.empty()) return result;
  constexpr double agreeing = 0.3;
  std::unordered_map<std::uint32_t, double> radii;  // the tighter one of each fitted surface
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const Surface& surface = surfaces[k].surface;
    const double radius = surface.tube > 0.0 ? surface.tube : surface.radius;
    if (radius > 0.0) radii[partitions.partitions[k]->id] = radius;
  }
  const FaceTable table(mesh);
  std::vector<Profile> profiles(places.size());
  PerThread<FaceWindow> windows([&] { return FaceWindow(table); });
  parallel_for(
      places.size(),
      [&](std::size_t i) {
        if (context.cancelled()) return;
        profiles[i] =
            profile_of(mesh, table, partitions, *boundaries[places[i]], options, windows.local());
      },
      1);
  if (context.cancelled()) return cancelled();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [left, right] = profiles[i];
    if (!(left.spread() > 0.0) || !(right.spread() > 0.0)) continue;
    const double l = std::abs(left.slope()), r = std::abs(right.slope());
    const double tight = std::max(l, r),
                 kink = std::abs(left.at_zero() - right.at_zero()) * in_degrees<double>;
    const double stray =
        std::abs(left.slope() - right.slope()) * options.astray * in_degrees<double>;
    const Boundary& boundary = *boundaries[places[i]];
    if (kink > std::min(options.kink + stray, options.most_kink) ||
        tight < options.least_ratio * std::min(l, r) ||
        tight * options.reach * in_degrees<double> < options.least_turn)
      continue;
    const std::uint32_t fillet = l > r ? boundary.left : boundary.right;
    double radius = table.unit / tight;
    if (const auto fitted = radii.find(fillet);
        fitted != radii.end() && std::abs(fitted->second / radius - 1.0) < agreeing)
      radius = fitted->second;
    result.push_back({places[i], fillet, radius, kink});
  }
  return result;
}

}  // namespace arris
