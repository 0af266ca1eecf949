#include "core/partitions/partition_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "core/base/number_text.h"
#include "core/base/parallel.h"
#include "core/mesh/geometry.h"
#include "core/partitions/continuation.h"
#include "core/partitions/part_size.h"
#include "core/simplification/noise.h"

namespace arris {

namespace {

constexpr std::size_t enough = 30;         // vertices, for those at the rim to be left out
constexpr std::size_t least = 6;           // below, nothing can be said
constexpr std::size_t most_fitted = 4000;  // vertices
/// Mean misfit from which on no surface explains a partition. Scans are off their surfaces by more
/// than their noise says: by what is wrong with the calibration, and with the part.
constexpr double most_misfit = 6.0;
/// Misfit from which on a blend may be the better answer, and up to which share of it it is.
constexpr double doubtful = 2.0, better_blend = 0.7;
/// Any smooth area is a torus of some kind for a while. Blends are what is one: a tube of up to so
/// many mean edges, on a part of the usual size, about a ring that is wider.
constexpr double widest_blend = 15.0;

bool says_nothing(const Surface& surface, double scale) {
  return surface.type == SurfaceType::torus &&
         (surface.tube > scale * widest_blend || surface.tube > surface.radius);
}

struct Member {
  VertexId vertex;
  bool inner;  // no vertex round it lies on a line or another partition
};

/// Vertices whose faces all belong to one partition, by partition.
std::vector<std::vector<Member>> members_of(const Mesh& mesh, const SharpLines& lines,
                                            const Partitions& partitions) {
  std::unordered_map<std::uint32_t, std::uint32_t> place;
  for (std::uint32_t k = 0; k < partitions.partitions.size(); ++k)
    place[partitions.partitions[k]->id] = k;
  std::vector<std::uint32_t> of_vertex(mesh.vertex_count(), 0);  // 0: at a rim, or in none
  parallel_for(mesh.vertex_count(), [&](std::size_t i) {
    const VertexId v = static_cast<VertexId>(i);
    std::uint32_t label = 0;
    bool inside = !mesh.is_isolated(v) && !mesh.is_border(v);
    if (inside)
      mesh.for_ring(v, [&](HalfEdgeId h) {
        const std::uint32_t other = partitions.label(mesh.face(h));
        inside = inside && other != 0 && (label == 0 || other == label) && !lines.is_sharp(h >> 1);
        label = other;
      });
    if (inside) of_vertex[v] = label;
  });
  std::vector<std::vector<Member>> members(partitions.partitions.size());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const auto listed = place.find(of_vertex[v]);
    if (listed == place.end()) continue;
    bool inner = true;
    mesh.for_ring(v, [&](HalfEdgeId h) { inner = inner && of_vertex[mesh.to(h)] != 0; });
    members[listed->second].push_back({v, inner});
  }
  return members;
}

/// A sample about `middle` in mean edges.
SurfaceSample sample_at(const Mesh& mesh, VertexId v, const Point& middle, double unit) {
  Point normal = Point::Zero();
  mesh.for_ring(v, [&](HalfEdgeId h) { normal += area_normal(mesh, mesh.face(h)); });
  return {(mesh.point(v) - middle) / unit, normal.normalized(), 1.0};
}

}  // namespace

Result<std::vector<PartitionSurface>> fit_partition_surfaces(const Mesh& mesh,
                                                             const SharpLines& lines,
                                                             const Partitions& partitions,
                                                             const Context& context) {
  std::vector<PartitionSurface> result(partitions.partitions.size());
  if (partitions.labels.empty()) return result;
  const std::vector<std::vector<Member>> members = members_of(mesh, lines, partitions);
  if (context.cancelled()) return cancelled();
  context.report(0.3, "surfaces of partitions");
  const double unit = mesh.mean_edge_length() > 0.0 ? mesh.mean_edge_length() : 1.0;
  const double relative = std::max(estimate_noise(mesh) / unit, 0.01);
  const SurfaceNoise noise{relative, std::max(relative, 0.3 * std::numbers::pi / 180.0)};
  const double scale = part_size(mesh) / usual_part_size;
  const ContinuationOptions continuation = scaled({}, scale);
  parallel_for(
      members.size(),
      [&](std::size_t k) {
        if (context.cancelled()) return;
        PartitionSurface& fitted = result[k];
        fitted.tolerance = 3.0 * relative * unit;
        std::vector<VertexId> vertices;
        const auto inner = std::ranges::count(members[k], true, &Member::inner);
        for (const Member& member : members[k])
          if (member.inner || static_cast<std::size_t>(inner) < enough)
            vertices.push_back(member.vertex);
        if (vertices.size() < least) return;
        Point middle = Point::Zero();
        for (const VertexId v : vertices) middle += mesh.point(v);
        middle /= static_cast<double>(vertices.size());
        std::vector<SurfaceSample> samples;
        const std::size_t stride = vertices.size() / most_fitted + 1;
        for (std::size_t i = 0; i < vertices.size(); i += stride)
          samples.push_back(sample_at(mesh, vertices[i], middle, unit));
        SurfaceFitOptions options;
        options.refined = most_fitted;
        options.steps = 12;
        options.near = options.most;
        options.blend = scale * widest_blend;
        options.free = doubtful;
        FittedSurface fit = fit_surface(samples, noise, options);
        bool explained = fit.misfit <= most_misfit && !says_nothing(fit.surface, scale);
        if (!explained || fit.misfit > doubtful)
          if (const std::optional<FittedSurface> blend =
                  fit_blend(samples, noise, explained ? better_blend * fit.misfit : most_misfit,
                            continuation)) {
            fit = *blend;
            explained = true;
          }
        if (!explained) {
          fit = fit_free_surface(samples, noise, Surface::most_degree, options);
          if (!(fit.misfit <= most_misfit)) return;
        }
        fitted.fitted = true;
        double sum = 0.0;
        std::size_t within = 0;
        for (const VertexId v : vertices) {
          const double d =
              std::abs(fit.surface.at((mesh.point(v) - middle) / unit).distance) * unit;
          sum += d;
          fitted.max_deviation = std::max(fitted.max_deviation, d);
          within += d <= fitted.tolerance;
        }
        fitted.mean_deviation = sum / static_cast<double>(vertices.size());
        fitted.within = static_cast<double>(within) / static_cast<double>(vertices.size());
        fitted.surface = fit.surface.placed(middle, unit);
      },
      1);
  if (context.cancelled()) return cancelled();
  return result;
}

std::string size_text(const Surface& surface, LengthUnit unit) {
  const auto text = [](double value) { return number_text(value, 4); };
  switch (surface.type) {
    case SurfaceType::sphere:
    case SurfaceType::cylinder:
      return "R " + with_unit(text(surface.radius), unit);
    case SurfaceType::cone:
      return "half angle " + number_text(surface.half_angle * 180.0 / std::numbers::pi, 3) + "°";
    case SurfaceType::torus:
      return "R " + text(surface.radius) + ", r " + with_unit(text(surface.tube), unit);
    case SurfaceType::blend:
      return "r " + with_unit(text(surface.tube), unit);
    default:
      return "";
  }
}

}  // namespace arris
