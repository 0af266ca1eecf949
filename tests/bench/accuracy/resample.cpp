#include "tests/bench/accuracy/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.h"

namespace arris::accuracy {

namespace {

using testing::Triangles;

constexpr double edges_per_cell = 0.885;  // mean edge over the side of a cell; measured
constexpr int smoothing_rounds = 5;

/// How the grid is turned against the solid: along no axis, no diagonal.
Eigen::Matrix3d turn() {
  return Eigen::AngleAxisd(0.67, Point(0.37, 0.61, 0.70).normalized()).toRotationMatrix();
}

Point gradient(const Solid& solid, const Point& p, double step) {
  Point result;
  for (int axis = 0; axis < 3; ++axis) {
    const Point offset = step * Point::Unit(axis);
    result[axis] = (solid(p + offset).distance - solid(p - offset).distance) / (2.0 * step);
  }
  return result;
}

/// Puts a point that is near the surface on it.
Point on_surface(const Solid& solid, Point p, double cell) {
  for (int round = 0; round < 4; ++round) {
    const double distance = solid(p).distance;
    if (std::abs(distance) < 1e-9 * cell) break;
    const Point direction = gradient(solid, p, 1e-5 * cell);
    p -= distance / std::max(direction.squaredNorm(), 0.1) * direction;
  }
  return p;
}

struct Grid {
  Point origin;
  double cell;
  std::array<int, 3> nodes;

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * nodes[1] + y) * nodes[0] + x;
  }
  Point node(int x, int y, int z) const { return origin + cell * Point(x, y, z); }
};

Grid grid_about(const Eigen::Matrix3d& turned, const Point& low, const Point& high, double cell) {
  Point least = turned * low, most = least;
  for (int corner = 1; corner < 8; ++corner) {
    const Point p(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                  corner & 4 ? high.z() : low.z());
    least = least.cwiseMin(turned * p);
    most = most.cwiseMax(turned * p);
  }
  Grid grid{least - Point(1.3, 1.6, 1.9) * cell, cell, {}};
  for (int axis = 0; axis < 3; ++axis)
    grid.nodes[axis] = static_cast<int>(std::ceil((most - grid.origin)[axis] / cell)) + 3;
  return grid;
}

/// Distances at the nodes, made so that no side of a cell, nor a cell, has only opposite corners
/// inside or only opposite corners outside: surface nets are no manifold there. The nearest node
/// comes inside, which ends, since none goes out again.
std::vector<double> distances_at_nodes(const Solid& solid, const Eigen::Matrix3d& turned,
                                       const Grid& grid) {
  const auto [columns, rows, layers] = grid.nodes;
  std::vector<double> values(static_cast<std::size_t>(columns) * rows * layers);
  const Eigen::Matrix3d back = turned.transpose();
  parallel_for(
      static_cast<std::size_t>(layers),
      [&, columns = columns, rows = rows](std::size_t layer) {
        const int z = static_cast<int>(layer);
        for (int y = 0; y < rows; ++y)
          for (int x = 0; x < columns; ++x)
            values[grid.index(x, y, z)] = solid(back * grid.node(x, y, z)).distance;
      },
      1);

  const auto inside = [&](std::size_t k) { return values[k] < 0.0; };
  bool changed = true;
  const auto take_nearest_in = [&](std::span<const std::size_t> nodes) {
    std::size_t nearest = nodes.front();
    for (const std::size_t k : nodes)
      if (inside(nearest) || (!inside(k) && values[k] < values[nearest])) nearest = k;
    values[nearest] = -1e-3 * grid.cell;
    changed = true;
  };
  while (changed) {
    changed = false;
    for (int z = 0; z + 1 < layers; ++z)
      for (int y = 0; y + 1 < rows; ++y)
        for (int x = 0; x + 1 < columns; ++x) {
          std::array<std::size_t, 8> corners;
          for (int k = 0; k < 8; ++k)
            corners[k] = grid.index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1));
          for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
              const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
              const std::array<std::size_t, 4> nodes{corners[base], corners[base + u],
                                                     corners[base + u + v], corners[base + v]};
              if (inside(nodes[0]) == inside(nodes[2]) && inside(nodes[1]) == inside(nodes[3]) &&
                  inside(nodes[0]) != inside(nodes[1]))
                take_nearest_in(nodes);
            }
          const auto count = std::ranges::count_if(corners, inside);
          const auto is_odd = [&](int k) { return inside(corners[k]) == (count == 2); };
          if (count != 2 && count != 6) continue;
          for (int k = 0; k < 4; ++k)
            if (is_odd(k) && is_odd(7 - k)) take_nearest_in(corners);
        }
  }
  return values;
}

/// Naive surface nets: a vertex for each cell that the surface passes through, at the mean of where
/// it crosses the cell's sides; a quad, cut along its shorter diagonal, for each side it crosses.
Triangles surface_nets(const Solid& solid, const Eigen::Matrix3d& turned, const Grid& grid) {
  const auto [columns, rows, layers] = grid.nodes;
  const std::vector<double> values = distances_at_nodes(solid, turned, grid);
  const Eigen::Matrix3d back = turned.transpose();

  Triangles mesh;
  std::vector<VertexId> vertex_of(values.size(), no_id);  // by the lowest node of a cell
  for (int z = 0; z + 1 < layers; ++z)
    for (int y = 0; y + 1 < rows; ++y)
      for (int x = 0; x + 1 < columns; ++x) {
        Point sum = Point::Zero();
        int crossings = 0;
        for (int corner = 0; corner < 8; ++corner)
          for (int axis = 0; axis < 3; ++axis) {
            if (corner >> axis & 1) continue;
            const std::array<int, 3> a{x + (corner & 1), y + (corner >> 1 & 1),
                                       z + (corner >> 2 & 1)};
            std::array<int, 3> b = a;
            ++b[axis];
            const double from = values[grid.index(a[0], a[1], a[2])];
            const double to = values[grid.index(b[0], b[1], b[2])];
            if ((from < 0.0) == (to < 0.0)) continue;
            const Point start = grid.node(a[0], a[1], a[2]), end = grid.node(b[0], b[1], b[2]);
            sum += start + from / (from - to) * (end - start);
            ++crossings;
          }
        if (crossings == 0) continue;
        vertex_of[grid.index(x, y, z)] = static_cast<VertexId>(mesh.points.size());
        mesh.points.push_back(back * (sum / crossings));
      }

  for (int z = 1; z + 1 < layers; ++z)
    for (int y = 1; y + 1 < rows; ++y)
      for (int x = 1; x + 1 < columns; ++x)
        for (int axis = 0; axis < 3; ++axis) {
          std::array<int, 3> far{x, y, z};
          ++far[axis];
          const bool from_inside = values[grid.index(x, y, z)] < 0.0;
          if (from_inside == (values[grid.index(far[0], far[1], far[2])] < 0.0)) continue;
          // The four cells round this side of the grid, counter-clockwise seen from its far end.
          const int u = (axis + 1) % 3, v = (axis + 2) % 3;
          std::array<VertexId, 4> quad;
          constexpr std::array<std::array<int, 2>, 4> round{{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
          for (std::size_t k = 0; k < 4; ++k) {
            std::array<int, 3> cell{x, y, z};
            cell[u] -= round[k][0];
            cell[v] -= round[k][1];
            quad[k] = vertex_of[grid.index(cell[0], cell[1], cell[2])];
          }
          if (!from_inside) std::swap(quad[1], quad[3]);
          const auto length = [&](int a, int b) {
            return (mesh.points[quad[a]] - mesh.points[quad[b]]).squaredNorm();
          };
          const int k = length(0, 2) <= length(1, 3) ? 0 : 1;
          mesh.triangles.push_back({quad[k], quad[k + 1], quad[k + 2]});
          mesh.triangles.push_back({quad[k], quad[k + 2], quad[(k + 3) % 4]});
        }
  return mesh;
}

/// Moves vertices towards the middle of their neighbours, along the surface, where that leaves no
/// face worse than fair.
class Evener {
 public:
  Evener(const Solid& solid, double cell, Triangles& mesh)
      : solid_(solid), cell_(cell), mesh_(mesh), faces_(mesh.points.size()) {
    for (FaceId f = 0; f < mesh.triangles.size(); ++f)
      for (const VertexId v : mesh.triangles[f]) faces_[v].push_back(f);
    outward_.resize(mesh.points.size());
    parallel_for(mesh.points.size(), [&](std::size_t v) {
      mesh_.points[v] = on_surface(solid_, mesh_.points[v], cell_);
      outward_[v] = outward(mesh_.points[v]);
    });
  }

  void round() {
    for (VertexId v = 0; v < mesh_.points.size(); ++v) {
      if (faces_[v].empty()) continue;
      Point sum = Point::Zero();
      for (const FaceId f : faces_[v])
        for (const VertexId w : mesh_.triangles[f]) sum += mesh_.points[w] - mesh_.points[v];
      const Point before = mesh_.points[v], outward_before = outward_[v];
      const double fair = std::min(least_fair, worst_about(v));
      const double count = 2.0 * static_cast<double>(faces_[v].size());
      for (const double share : {0.5, 0.2}) {
        mesh_.points[v] = on_surface(solid_, before + share / count * sum, cell_);
        outward_[v] = outward(mesh_.points[v]);
        if (worst_about(v) >= fair) break;
        mesh_.points[v] = before;
        outward_[v] = outward_before;
      }
    }
  }

 private:
  static constexpr double least_fair = 0.4;

  Point outward(const Point& p) const { return gradient(solid_, p, 1e-5 * cell_).normalized(); }

  /// How good the worst face round v is: 1 where it is equilateral and looks the way the surface
  /// does at its corners, below 0 where it is folded over.
  double worst_about(VertexId v) const {
    double worst = 1.0;
    for (const FaceId f : faces_[v]) {
      const Triangle& t = mesh_.triangles[f];
      const Point &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
      const Point normal = (b - a).cross(c - a);
      const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
      const Point mean = (outward_[t[0]] + outward_[t[1]] + outward_[t[2]]).normalized();
      worst = std::min(worst, 2.0 * std::numbers::sqrt3 * normal.dot(mean) / sides);
    }
    return worst;
  }

  const Solid& solid_;
  double cell_;
  Triangles& mesh_;
  std::vector<std::vector<FaceId>> faces_;
  std::vector<Point> outward_;  // normals of the surface at the vertices
};

}  // namespace

Triangles resample(const Solid& solid, const Point& low, const Point& high, double edge) {
  const double cell = edge / edges_per_cell;
  const Eigen::Matrix3d turned = turn();
  Triangles mesh = surface_nets(solid, turned, grid_about(turned, low, high, cell));
  Evener evener(solid, cell, mesh);
  for (int round = 0; round < smoothing_rounds; ++round) evener.round();
  return mesh;
}

}  // namespace arris::accuracy
