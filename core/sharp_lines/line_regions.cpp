#include "core/sharp_lines/line_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/sharp_lines/region_joining.h"

namespace arris {

namespace {

/// Inner edges by increasing height, ties by number.
std::vector<EdgeId> edges_by_height(const std::vector<std::array<FaceId, 2>>& edge_faces,
                                    const std::vector<float>& height) {
  std::vector<EdgeId> order;
  order.reserve(edge_faces.size());
  for (EdgeId e = 0; e < edge_faces.size(); ++e)
    if (edge_faces[e][0] != no_id && edge_faces[e][1] != no_id) order.push_back(e);
  parallel_sort(order.begin(), order.end(), [&](EdgeId a, EdgeId b) {
    return height[a] != height[b] ? height[a] < height[b] : a < b;
  });
  return order;
}

std::vector<float> areas_of(const FaceTable& table, const FaceRegions& regions) {
  std::vector<float> areas(regions.count, 0.0F);
  for (FaceId f = 0; f < table.size(); ++f) areas[regions.of_face[f]] += table.faces[f].area;
  return areas;
}

/// What a border of these heights costs between regions, the smaller of this area.
float cost_of(const HeightHistogram& heights, float quantile, float smaller, float least_area) {
  const float cost = heights.quantile(quantile);
  return smaller < least_area ? cost * smaller / least_area : cost;
}

/// The joins of regions as a forest: at which height two of them became one.
class JoinForest {
 public:
  explicit JoinForest(std::size_t count) : parent_(count), height_(count, 0.0F), order_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  void join(std::uint32_t gone, std::uint32_t into, float height) {
    parent_[gone] = into;
    height_[gone] = height;
    order_[gone] = ++joins_;
  }
  std::uint32_t root(std::uint32_t region) const {
    while (parent_[region] != region) region = parent_[region];
    return region;
  }
  /// Of two regions with one root.
  float height_of_join(std::uint32_t a, std::uint32_t b) const {
    float height = 0.0F;
    while (a != b) {
      // Whichever joined its parent first has not met the other yet.
      const bool a_first = parent_[a] != a && (parent_[b] == b || order_[a] < order_[b]);
      std::uint32_t& next = a_first ? a : b;
      height = std::max(height, height_[next]);
      next = parent_[next];
    }
    return height;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<float> height_;         // of the join with the parent
  std::vector<std::uint32_t> order_;  // of that join among all
  std::uint32_t joins_ = 0;
};

/// Joins what no border of `options.first_cut` parts by the jump itself. Borders that went are
/// added to `low` (null: not wanted), as far as they count for something.
FaceRegions first_cut(const FaceTable& table, const std::vector<float>& jump,
                      const std::vector<float>& edge_length,
                      const std::vector<std::array<FaceId, 2>>& edge_faces, FaceRegions regions,
                      const LineRegionOptions& options, std::vector<BorderEdge>* low) {
  RegionJoining<HeightHistogram> joining(areas_of(table, regions));
  for (EdgeId e = 0; e < edge_faces.size(); ++e) {
    const auto [left, right] = edge_faces[e];
    if (left == no_id || right == no_id || regions.of_face[left] == regions.of_face[right])
      continue;
    joining.border(regions.of_face[left], regions.of_face[right]).add(jump[e], edge_length[e]);
  }
  JoinForest forest(regions.count);
  const float least_area = options.first_area * mean_face_area;
  joining.run(
      options.first_cut,
      [&](const HeightHistogram& heights, std::uint32_t a, std::uint32_t b) {
        return cost_of(heights, options.first_quantile, std::min(joining.area(a), joining.area(b)),
                       least_area);
      },
      [&](const auto& join, const HeightHistogram&) {
        forest.join(join.gone, join.into, join.height);
      });
  for (EdgeId e = 0; low && e < edge_faces.size(); ++e) {
    const auto [left, right] = edge_faces[e];
    if (left == no_id || right == no_id) continue;
    const std::uint32_t a = regions.of_face[left], b = regions.of_face[right];
    if (a == b || forest.root(a) != forest.root(b)) continue;
    const float height = forest.height_of_join(a, b);
    if (height >= options.least_height) low->push_back({e, height, {jump[e], jump[e], height}});
  }
  FaceRegions result{std::move(regions.of_face), 0};
  std::vector<std::uint32_t> number(regions.count, no_id);
  for (std::uint32_t& r : result.of_face) {
    const std::uint32_t root = forest.root(r);
    if (number[root] == no_id) number[root] = result.count++;
    r = number[root];
  }
  return result;
}

/// Makes each tube a region of its own, whatever the faces on it were of. False where there is
/// none.
bool set_apart(const std::vector<std::uint32_t>& tubes, FaceRegions& regions) {
  bool any = false;
  for (FaceId f = 0; f < tubes.size(); ++f)
    if (tubes[f] != no_id) {
      regions.of_face[f] = regions.count + tubes[f];
      any = true;
    }
  return any;
}

/// A border between two regions while they are joined by the test.
struct TestedBorder {
  std::vector<std::uint32_t> chains;  // some of them may have been joined to others
  HeightHistogram heights;
  void absorb(const TestedBorder& other) {
    chains.insert(chains.end(), other.chains.begin(), other.chains.end());
    heights.absorb(other.heights);
  }
};

/// The joining of regions by the test of their borders, which notes when each border edge goes.
class TestedJoining {
 public:
  TestedJoining(const Mesh& mesh, const FaceTable& table,
                const std::vector<Eigen::Vector3f>& normals, const FaceRegions& regions,
                const std::vector<float>& edge_length, const LineRegionOptions& options)
      : mesh_(mesh),
        table_(table),
        edge_length_(edge_length),
        options_(options),
        parent_(regions.count),
        test_(mesh, table, normals, regions.of_face, parent_, options.test),
        joining_(areas_of(table, regions)),
        perimeter_(regions.count, 0.0F),
        window_(table) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    // The constructor of the test has not looked at parent_, which is filled only now.
    PerThread<FaceWindow> windows([&] { return FaceWindow(table); });
    parallel_for(
        test_.chains().size(),
        [&](std::size_t k) { test_.measure(static_cast<std::uint32_t>(k), windows.local()); }, 4);
    chains_of_.resize(regions.count);
    for (std::uint32_t k = 0; k < test_.chains().size(); ++k) {
      const auto [a, b] = test_.sides(k);
      TestedBorder& border = joining_.border(a, b);
      border.chains.push_back(k);
      add_heights(k, border.heights);
      for (const std::uint32_t r : {a, b}) {
        chains_of_[r].push_back(k);
        for (const HalfEdgeId h : test_.chains()[k].path) perimeter_[r] += edge_length_[h >> 1];
      }
    }
    narrow_before_.resize(regions.count);
    for (std::uint32_t r = 0; r < regions.count; ++r) narrow_before_[r] = is_narrow(r);
  }

  std::vector<BorderEdge> run() {
    const float least_area = options_.area * mean_face_area;
    joining_.run(
        1e9F,
        [&](const TestedBorder& border, std::uint32_t a, std::uint32_t b) {
          const float cost = cost_of(border.heights, options_.quantile,
                                     std::min(joining_.area(a), joining_.area(b)), least_area);
          const float width = std::min(width_of(a), width_of(b));
          return width < options_.thin ? cost * width * width / (options_.thin * options_.thin)
                                       : cost;
        },
        [&](const auto& join, const TestedBorder& border) {
          this->join(join.into, join.gone, join.height, border);
        });
    std::sort(gone_.begin(), gone_.end(),
              [](const BorderEdge& a, const BorderEdge& b) { return a.edge < b.edge; });
    return std::move(gone_);
  }

 private:
  void add_heights(std::uint32_t chain, HeightHistogram& heights) const {
    for (const HalfEdgeId h : test_.chains()[chain].path)
      heights.add(test_.place(h >> 1).value, edge_length_[h >> 1]);
  }

  void join(std::uint32_t into, std::uint32_t gone, float height, const TestedBorder& border) {
    const std::array<std::uint8_t, 2> was_narrow{narrow_before_[into], narrow_before_[gone]};
    std::vector<VertexId> ends;
    float vanished = 0.0F;
    for (const std::uint32_t k : border.chains) {
      const BorderTest::BorderChain& chain = test_.chains()[k];
      if (!chain.alive) continue;
      for (const HalfEdgeId h : chain.path) {
        gone_.push_back({h >> 1, height, test_.place(h >> 1)});
        vanished += edge_length_[h >> 1];
      }
      if (!chain.closed) {
        ends.push_back(mesh_.from(chain.path.front()));
        ends.push_back(mesh_.to(chain.path.back()));
      }
      test_.remove(k);
    }
    parent_[gone] = into;
    perimeter_[into] += perimeter_[gone] - 2.0F * vanished;
    narrow_before_[into] = is_narrow(into);
    // Chains beside what was narrow see farther now.
    std::vector<std::uint32_t> again;
    for (std::size_t side = 0; side < 2; ++side)
      if (was_narrow[side])
        for (const std::uint32_t k : chains_of_[side == 0 ? into : gone])
          if (test_.chains()[k].alive) again.push_back(k);
    std::vector<std::uint32_t>& mine = chains_of_[into];
    std::vector<std::uint32_t>& theirs = chains_of_[gone];
    if (mine.size() < theirs.size()) mine.swap(theirs);
    mine.insert(mine.end(), theirs.begin(), theirs.end());
    theirs = {};
    std::vector<std::uint32_t> changed;
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const VertexId v : ends) test_.join_at(v);
    for (const VertexId v : ends) {
      // Round the joint, on the chain it is on now; where several still meet, at the ends of each.
      mesh_.for_ring(v, [&](HalfEdgeId out) {
        const std::uint32_t k = test_.chain_of(out >> 1);
        if (k == no_id) return;
        const auto n = static_cast<std::ptrdiff_t>(test_.chains()[k].path.size());
        const auto at = static_cast<std::ptrdiff_t>(test_.index_of(out >> 1));
        measure_about(k, at, n);
        changed.push_back(k);
      });
    }
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    for (const std::uint32_t k : again)
      if (test_.chains()[k].alive) {
        test_.measure(k, window_);
        changed.push_back(k);
      }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    // The heights of the borders these chains are part of, afresh.
    std::vector<std::array<std::uint32_t, 2>> borders;
    for (const std::uint32_t k : changed) {
      auto sides = test_.sides(k);
      if (sides[0] > sides[1]) std::swap(sides[0], sides[1]);
      borders.push_back(sides);
    }
    std::sort(borders.begin(), borders.end());
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
    for (const auto& [a, b] : borders) {
      TestedBorder& kept = joining_.border(a, b);
      std::erase_if(kept.chains, [&](std::uint32_t k) { return !test_.chains()[k].alive; });
      kept.heights = {};
      for (const std::uint32_t k : kept.chains) add_heights(k, kept.heights);
      joining_.touch(a, b);
    }
  }

  float width_of(std::uint32_t r) const {
    return perimeter_[r] > 0.0F ? 2.0F * joining_.area(r) / perimeter_[r] : options_.narrow;
  }
  /// A strip too thin for the windows of its borders.
  bool is_narrow(std::uint32_t r) const { return width_of(r) < options_.narrow; }

  /// Measures again what the place `at` of a chain has part in.
  void measure_about(std::uint32_t chain, std::ptrdiff_t at, std::ptrdiff_t n) {
    constexpr std::ptrdiff_t summed = 8;
    const std::ptrdiff_t pooled = summed + options_.test.pooled;
    const auto each = [&](std::ptrdiff_t reach, const auto& visit) {
      if (test_.chains()[chain].closed && 2 * reach + 1 >= n) {
        visit(std::ptrdiff_t{0}, n);
      } else if (test_.chains()[chain].closed) {
        const std::ptrdiff_t from = at - reach, to = at + reach + 1;
        visit(std::max(from, std::ptrdiff_t{0}), std::min(to, n));
        if (from < 0) visit(n + from, n);
        if (to > n) visit(std::ptrdiff_t{0}, to - n);
      } else {
        visit(std::max(at - reach, std::ptrdiff_t{0}), std::min(at + reach + 1, n));
      }
    };
    each(summed, [&](std::ptrdiff_t from, std::ptrdiff_t to) {
      test_.sum_sides(chain, static_cast<std::size_t>(from), static_cast<std::size_t>(to), window_);
    });
    each(pooled, [&](std::ptrdiff_t from, std::ptrdiff_t to) {
      test_.pool(chain, static_cast<std::size_t>(from), static_cast<std::size_t>(to));
    });
  }

  const Mesh& mesh_;
  const FaceTable& table_;
  const std::vector<float>& edge_length_;
  const LineRegionOptions options_;
  std::vector<std::uint32_t> parent_;
  BorderTest test_;
  RegionJoining<TestedBorder> joining_;
  std::vector<float> perimeter_;
  std::vector<std::uint8_t> narrow_before_;  // per region, as of its last join
  std::vector<std::vector<std::uint32_t>> chains_of_;
  FaceWindow window_;
  std::vector<BorderEdge> gone_;
};

}  // namespace

std::vector<std::uint8_t> vertices_near(const Mesh& mesh, const std::vector<BorderEdge>& borders,
                                        float height, int rings) {
  std::vector<std::uint8_t> near(mesh.vertex_count(), 0);
  std::vector<VertexId> front;
  const auto reach = [&](VertexId v) {
    if (near[v]) return;
    near[v] = 1;
    front.push_back(v);
  };
  for (const BorderEdge& border : borders)
    if (border.height > height)
      for (const VertexId v : mesh.edge(border.edge)) reach(v);
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = front.size();
    for (; begin < end; ++begin)
      mesh.for_ring(front[begin], [&](HalfEdgeId h) { reach(mesh.to(h)); });
  }
  return near;
}

Result<std::vector<BorderEdge>> find_line_regions(const Mesh& mesh, const FaceTable& table,
                                                  const std::vector<Eigen::Vector3f>& normals,
                                                  const NormalJump& jump,
                                                  const std::vector<std::uint32_t>& tubes,
                                                  const LineRegionOptions& options,
                                                  const Context& context) {
  std::vector<std::array<FaceId, 2>> edge_faces(mesh.edge_count());
  std::vector<float> edge_length(mesh.edge_count());
  parallel_for(mesh.edge_count(), [&](std::size_t e) {
    edge_faces[e] = mesh.edge_faces(static_cast<EdgeId>(e));
    edge_length[e] = static_cast<float>(mesh.edge_length(static_cast<EdgeId>(e)) / table.unit);
  });
  context.report(0.0, "regions");
  const std::vector<EdgeId> order = edges_by_height(edge_faces, jump.at_edge);
  if (context.cancelled()) return cancelled();
  context.report(0.3, "regions");
  FaceRegions regions = watershed(table, jump.at_edge, order, edge_faces, options.watershed);
  if (context.cancelled()) return cancelled();
  context.report(0.5, "regions");
  // Weak borders are shown as they went, so their teeth go first; but the teeth of strong ones only
  // once the weak ones are gone, since at harsh noise that moves them.
  std::vector<BorderEdge> low;
  FaceRegions smooth = regions;
  smooth_borders(table, edge_length, options.smoothing, smooth.of_face);
  if (context.cancelled()) return cancelled();
  context.report(0.55, "regions");
  first_cut(table, jump.at_edge, edge_length, edge_faces, std::move(smooth), options, &low);
  if (context.cancelled()) return cancelled();
  context.report(0.6, "regions");
  regions =
      first_cut(table, jump.at_edge, edge_length, edge_faces, std::move(regions), options, nullptr);
  if (context.cancelled()) return cancelled();
  context.report(0.65, "regions");
  smooth_borders(table, edge_length, options.smoothing, regions.of_face);
  if (set_apart(tubes, regions)) {
    regions = connected_regions(table, regions.of_face);
    smooth_borders(table, edge_length, options.smoothing, regions.of_face);
  }
  if (context.cancelled()) return cancelled();
  context.report(0.7, "borders");
  TestedJoining joining(mesh, table, normals, regions, edge_length, options);
  if (context.cancelled()) return cancelled();
  context.report(0.8, "borders");
  std::vector<BorderEdge> borders = joining.run();
  if (context.cancelled()) return cancelled();
  context.report(0.95, "borders");
  // The same border may be among both, an edge apart.
  const std::vector<std::uint8_t> near = vertices_near(mesh, borders, -1.0F, 1);
  const auto by_edge = [](const BorderEdge& a, const BorderEdge& b) { return a.edge < b.edge; };
  std::erase_if(low, [&](BorderEdge& border) {
    if (!jump.convex[border.edge]) {
      border.place.jump = -border.place.jump;
      border.place.turn = -border.place.turn;
    }
    const EdgeVertices& ends = mesh.edge(border.edge);
    return near[ends[0]] && near[ends[1]];
  });
  const auto middle = static_cast<std::ptrdiff_t>(borders.size());
  borders.insert(borders.end(), low.begin(), low.end());
  std::inplace_merge(borders.begin(), borders.begin() + middle, borders.end(), by_edge);
  return borders;
}

}  // namespace arris
