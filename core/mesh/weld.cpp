#include "core/mesh/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/base/disjoint_sets.h"

namespace arris {

Welder::Welder(std::vector<Point>& points, std::size_t expected) : points_(points) {
  slots_.assign(std::bit_ceil(std::max<std::size_t>(16, 2 * expected)), no_id);
}

VertexId Welder::vertex(const Point& point) {
  if (2 * (points_.size() + 1) > slots_.size()) grow();
  const Key key = key_of(point);
  std::size_t slot = hash(key) & (slots_.size() - 1);
  while (slots_[slot] != no_id) {
    if (key_of(points_[slots_[slot]]) == key) return slots_[slot];
    slot = (slot + 1) & (slots_.size() - 1);
  }
  slots_[slot] = static_cast<VertexId>(points_.size());
  points_.push_back(point);
  return slots_[slot];
}

Welder::Key Welder::key_of(const Point& point) {
  return {std::bit_cast<std::uint64_t>(point.x() + 0.0),
          std::bit_cast<std::uint64_t>(point.y() + 0.0),
          std::bit_cast<std::uint64_t>(point.z() + 0.0)};
}

std::size_t Welder::hash(const Key& key) {
  std::uint64_t h = 0;
  for (const std::uint64_t part : key) {
    h = (h ^ part) * 0x9E3779B97F4A7C15u;
    h ^= h >> 32;
  }
  return static_cast<std::size_t>(h);
}

void Welder::grow() {
  slots_.assign(2 * slots_.size(), no_id);
  for (std::size_t v = 0; v < points_.size(); ++v) {
    std::size_t slot = hash(key_of(points_[v])) & (slots_.size() - 1);
    while (slots_[slot] != no_id) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = static_cast<VertexId>(v);
  }
}

Weld weld_coincident(const std::vector<Point>& points, const std::vector<VertexId>& corners) {
  std::vector<bool> in_face(points.size(), false);
  for (const VertexId v : corners) in_face[v] = true;
  Weld weld;
  weld.target.resize(points.size());
  weld.points.reserve(points.size());
  // Points of no face may lie where they like and never stand in the way of others.
  std::vector<Point> places;
  places.reserve(points.size());
  Welder welder(places, points.size());
  std::vector<VertexId> first;  // of each place: its number after
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (in_face[v] && points[v].allFinite()) {
      const VertexId place = welder.vertex(points[v]);
      if (place < first.size()) {
        weld.target[v] = first[place];
        ++weld.joined;
        continue;
      }
      first.push_back(static_cast<VertexId>(weld.points.size()));
    }
    weld.target[v] = static_cast<VertexId>(weld.points.size());
    weld.points.push_back(points[v]);
  }
  if (weld.joined == 0) weld = {};
  return weld;
}

namespace {

using Pair = std::array<VertexId, 2>;

Pair sorted_pair(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Sorts and keeps the pairs that stand there once.
void keep_single(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size();) {
    std::size_t j = i + 1;
    while (j < pairs.size() && pairs[j] == pairs[i]) ++j;
    if (j - i == 1) pairs[kept++] = pairs[i];
    i = j;
  }
  pairs.resize(kept);
}

}  // namespace

std::uint64_t cuts_closed_by(const std::vector<VertexId>& target,
                             const std::vector<std::uint64_t>& starts,
                             const std::vector<VertexId>& corners) {
  std::vector<Pair> sides;
  sides.reserve(corners.size());
  for (std::size_t k = 0; k + 1 < starts.size(); ++k)
    for (std::uint64_t c = starts[k]; c < starts[k + 1]; ++c) {
      const VertexId a = corners[c];
      const VertexId b = corners[c + 1 < starts[k + 1] ? c + 1 : starts[k]];
      if (a != b) sides.push_back(sorted_pair(a, b));
    }
  keep_single(sides);
  for (Pair& side : sides) side = sorted_pair(target[side[0]], target[side[1]]);
  std::sort(sides.begin(), sides.end());
  std::uint64_t closed = 0;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j] == sides[i]) ++j;
    if (j - i > 1 && sides[i][0] != sides[i][1]) ++closed;
    i = j;
  }
  return closed;
}

BorderWeld weld_border(const Mesh& mesh, const std::vector<Point>& points,
                       const std::vector<VertexId>& copies,
                       const std::vector<EdgeVertices>& excluded, double tolerance) {
  BorderWeld result;
  const auto original = [&](VertexId v) {
    return v < points.size() ? v : copies[v - points.size()];
  };
  std::vector<Pair> border;
  for (EdgeId e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_border_edge(e)) continue;
    const Pair pair = sorted_pair(original(mesh.edge(e)[0]), original(mesh.edge(e)[1]));
    if (!std::binary_search(excluded.begin(), excluded.end(), pair)) border.push_back(pair);
  }
  keep_single(border);
  if (border.empty() || !(tolerance > 0.0)) return result;

  // Numbered among themselves: the border is small beside the mesh.
  std::vector<VertexId> vertices;
  for (const Pair& pair : border) vertices.insert(vertices.end(), pair.begin(), pair.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto number = [&](VertexId v) {
    return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                      vertices.begin());
  };

  // Sorted along x, those within reach of each other are few and close by; a wide row of them
  // (a border in a plane of one x) is cut short by y and z in turn through the cells.
  struct Cell {
    std::array<std::int64_t, 3> at;
    std::uint32_t vertex;
    bool operator<(const Cell& other) const {
      return at != other.at ? at < other.at : vertex < other.vertex;
    }
  };
  const auto cell_of = [&](const Point& p) {
    std::array<std::int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] =
          static_cast<std::int64_t>(std::clamp(std::floor(p[axis] / tolerance), -4e18, 4e18));
    return cell;
  };
  std::vector<Cell> cells;
  for (std::uint32_t k = 0; k < vertices.size(); ++k)
    cells.push_back({cell_of(points[vertices[k]]), k});
  std::sort(cells.begin(), cells.end());
  DisjointSets groups(vertices.size());
  // Cells that hold very many are no noise of the last digit; their vertices are left alone.
  constexpr std::size_t most_in_cell = 64;
  for (const Cell& cell : cells)
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        // Three cells in a row along z lie side by side in the order.
        const Cell low{{cell.at[0] + dx, cell.at[1] + dy, cell.at[2] - 1}, 0};
        std::size_t seen = 0;
        for (auto other = std::lower_bound(cells.begin(), cells.end(), low);
             other != cells.end() && other->at[0] == low.at[0] && other->at[1] == low.at[1] &&
             other->at[2] <= cell.at[2] + 1 && ++seen <= 3 * most_in_cell;
             ++other)
          if (other->vertex < cell.vertex &&
              (points[vertices[other->vertex]] - points[vertices[cell.vertex]]).norm() <= tolerance)
            groups.join(other->vertex, cell.vertex);
      }

  // A chain of neighbours may be wider than the tolerance, and a face must keep its corners.
  std::vector<std::uint32_t> group(vertices.size());
  std::vector<bool> usable(vertices.size(), true);
  for (std::uint32_t k = 0; k < vertices.size(); ++k) {
    group[k] = groups.find(k);
    if ((points[vertices[k]] - points[vertices[group[k]]]).norm() > tolerance)
      usable[group[k]] = false;
  }
  std::vector<bool> on_border(points.size(), false);
  for (const VertexId v : vertices) on_border[v] = true;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    std::array<VertexId, 3> t;
    int count = 0;
    for (const VertexId v : mesh.triangle(f)) {
      t[count] = original(v);
      count += on_border[t[count]];
    }
    for (int i = 1; i < count; ++i)
      for (int j = 0; j < i; ++j) {
        const std::uint32_t a = group[number(t[i])], b = group[number(t[j])];
        if (a == b) usable[a] = false;
      }
  }

  // Edges of the border that fall together; those with vertices apart tell the groups worth it.
  struct Side {
    Pair groups, edge;
    bool operator<(const Side& other) const {
      return groups != other.groups ? groups < other.groups : edge < other.edge;
    }
  };
  std::vector<Side> sides;
  for (const Pair& pair : border) {
    const std::uint32_t a = number(pair[0]), b = number(pair[1]);
    sides.push_back(
        {sorted_pair(usable[group[a]] ? group[a] : a, usable[group[b]] ? group[b] : b), {a, b}});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<bool> worth(vertices.size(), false);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].groups == sides[i].groups) ++j;
    // An odd number of them would leave an edge that cannot be held.
    if ((j - i) % 2 == 0) {
      result.closed_edges += j - i;
      for (const std::uint32_t g : sides[i].groups) worth[g] = true;
    }
    i = j;
  }
  if (result.closed_edges == 0) return result;

  std::vector<VertexId> first(points.size());
  std::iota(first.begin(), first.end(), 0u);
  for (std::uint32_t k = 0; k < vertices.size(); ++k) {
    if (group[k] == k || !usable[group[k]] || !worth[group[k]]) continue;
    first[vertices[k]] = vertices[group[k]];
    ++result.weld.joined;
  }
  result.weld.target.resize(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (first[v] == v) {
      result.weld.target[v] = static_cast<VertexId>(result.weld.points.size());
      result.weld.points.push_back(points[v]);
    } else {
      result.weld.target[v] = result.weld.target[first[v]];  // which is smaller
    }
  }
  return result;
}

}  // namespace arris
