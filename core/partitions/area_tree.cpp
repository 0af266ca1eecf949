#include "core/partitions/area_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/mesh/geometry.h"
#include "core/partitions/part_size.h"
#include "core/partitions/surface_noise.h"
#include "core/sharp_lines/region_joining.h"

namespace arris {

namespace {

constexpr float every = 1e9F;  // kinks at which areas are still joined
/// HeightHistogram has bins of 2.5 degrees: kinks are a tenth of that.
constexpr float finer = 10.0F;

using Samples = std::vector<SurfaceSample>;

std::vector<Samples> samples_by_area(const Grains& grains, std::uint32_t count) {
  std::vector<Samples> result(count);
  for (std::uint32_t k = 0; k < grains.size(); ++k)
    result[grains.area[k]].push_back(grains.samples[k]);
  return result;
}

/// Areas by the surfaces of their grains; where a grain has none, by the old areas.
FaceRegions areas_by_surface(const FaceTable& table, const FaceRegions& areas, const Grains& grains,
                             const std::vector<std::uint32_t>& surface) {
  std::uint32_t surfaces = 0;
  for (const std::uint32_t s : surface)
    if (s != no_id) surfaces = std::max(surfaces, s + 1);
  std::vector<std::uint32_t> label(table.size(), no_id);
  for (FaceId f = 0; f < table.size(); ++f)
    if (const std::uint32_t k = grains.of_face[f]; k != no_id)
      label[f] = surface[k] != no_id ? surface[k] : surfaces + areas.of_face[f];
  return connected_regions(table, label);
}

/// The pieces that old areas cut new ones into.
FaceRegions pieces_of(const FaceTable& table, const FaceRegions& areas, const FaceRegions& old) {
  std::vector<std::uint64_t> pairs(table.size());
  for (FaceId f = 0; f < table.size(); ++f)
    pairs[f] = static_cast<std::uint64_t>(areas.of_face[f]) << 32 | old.of_face[f];
  std::vector<std::uint64_t> known(pairs);
  parallel_sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<std::uint32_t> label(table.size());
  parallel_for(label.size(), [&](std::size_t f) {
    label[f] = static_cast<std::uint32_t>(std::lower_bound(known.begin(), known.end(), pairs[f]) -
                                          known.begin());
  });
  return connected_regions(table, label);
}

/// Joins the pieces of each area again, those with the least kink between them first, up to the
/// height `most`.
std::vector<AreaJoin> join_pieces(const FaceTable& table, const FaceRegions& pieces,
                                  const FaceRegions& areas, const CurvatureKinks& kinks,
                                  const std::vector<float>& edge_length,
                                  const std::vector<FittedSurface>& surfaces, float most) {
  std::vector<float> area(pieces.count, 0.0F);
  std::vector<std::uint32_t> of_piece(pieces.count);
  for (FaceId f = 0; f < table.size(); ++f) {
    area[pieces.of_face[f]] += table.faces[f].area;
    of_piece[pieces.of_face[f]] = areas.of_face[f];
  }
  RegionJoining<HeightHistogram> joining(std::move(area));
  for (FaceId f = 0; f < table.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (const FaceId g = table.neighbours[f][k]; g != no_id && f < g &&
                                                   pieces.of_face[f] != pieces.of_face[g] &&
                                                   areas.of_face[f] == areas.of_face[g])
        joining.border(pieces.of_face[f], pieces.of_face[g])
            .add(finer * kinks.at_edge[table.sides[f][k]], edge_length[table.sides[f][k]]);
  std::vector<AreaJoin> joins;
  joining.run(
      every,
      [](const HeightHistogram& heights, std::uint32_t, std::uint32_t) {
        return heights.quantile(0.5F) / finer;
      },
      [&](const auto& join, const HeightHistogram&) {
        joins.push_back({join.into, join.gone, join.height, surfaces[of_piece[join.into]]});
      });
  std::stable_sort(joins.begin(), joins.end(),
                   [](const auto& a, const auto& b) { return a.height < b.height; });
  // From degrees to heights below those of joins between areas.
  for (AreaJoin& join : joins) join.height = most * join.height / (1.0F + join.height);
  return joins;
}

/// Of each piece the one that it is joined to where areas are joined up to `height`, and the
/// surface of that.
struct Roots {
  std::vector<std::uint32_t> of_piece;
  std::vector<FittedSurface> surfaces;  // of each piece, right for roots

  Roots(std::vector<FittedSurface> of_pieces, const std::vector<AreaJoin>& joins, float height)
      : of_piece(of_pieces.size()), surfaces(std::move(of_pieces)) {
    std::iota(of_piece.begin(), of_piece.end(), 0U);
    for (const AreaJoin& join : joins) {
      if (join.height > height) break;
      of_piece[join.gone] = join.into;
      surfaces[join.into] = join.surface;
    }
    for (std::uint32_t& parent : of_piece) {
      std::uint32_t root = parent;
      while (of_piece[root] != root) root = of_piece[root];
      parent = root;
    }
  }
};

std::vector<FittedSurface> surfaces_of(const AreaTree& tree) {
  std::vector<FittedSurface> surfaces;
  for (const AreaTree::Piece& piece : tree.pieces) surfaces.push_back(piece.surface);
  return surfaces;
}

/// Moves the borders of the usual areas to where they belong, and those of the pieces inside
/// each. `table` is as before in the end.
void settle(const Mesh& mesh, AreaTree& tree, FaceTable& table,
            const std::vector<float>& edge_length, const AreaBorderOptions& options,
            const Context& context) {
  const std::vector<FittedSurface> surfaces = surfaces_of(tree);
  const Roots usual(surfaces, tree.joins, 1.0F);
  std::vector<std::uint32_t> area(tree.of_face.size());
  parallel_for(area.size(), [&](std::size_t f) { area[f] = usual.of_piece[tree.of_face[f]]; });
  const AreaGround over{mesh, table, edge_length, usual.surfaces, tree.face_noise, tree.banded};
  settle_borders(over, options, area);
  if (context.cancelled()) return;
  context.report(0.4, "borders");
  straighten_borders(over, options, area);
  if (context.cancelled()) return;
  context.report(0.7, "borders");
  keep_largest_pieces(table, edge_length, area);

  const std::vector<std::array<FaceId, 3>> neighbours = table.neighbours;
  parallel_for(area.size(), [&](std::size_t f) {
    for (FaceId& g : table.neighbours[f])
      if (g != no_id && area[g] != area[f]) g = no_id;
  });
  // A face that went over takes the piece of what is nearest to it there.
  std::vector<FaceId> front;
  for (FaceId f = 0; f < table.size(); ++f) {
    if (usual.of_piece[tree.of_face[f]] != area[f])
      tree.of_face[f] = no_id;
    else
      front.push_back(f);
  }
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const FaceId g : table.neighbours[front[i]])
      if (g != no_id && tree.of_face[g] == no_id) {
        tree.of_face[g] = tree.of_face[front[i]];
        front.push_back(g);
      }
  for (FaceId f = 0; f < table.size(); ++f)
    if (tree.of_face[f] == no_id) tree.of_face[f] = area[f];
  const AreaGround within{mesh, table, edge_length, surfaces, tree.face_noise, tree.banded};
  settle_borders(within, options, tree.of_face);
  straighten_borders(within, options, tree.of_face);
  keep_largest_pieces(table, edge_length, tree.of_face);
  table.neighbours = neighbours;
}

/// The joining of areas for a part `scale` times as many edges across as usual.
AreaJoiningOptions scaled(AreaJoiningOptions options, double scale) {
  options.wide *= static_cast<float>(scale);
  options.blend *= static_cast<float>(scale);
  options.continuation = scaled(options.continuation, scale);
  return options;
}

/// What each piece holds and lies beside.
void measure_pieces(const Mesh& mesh, const FaceTable& table, const std::vector<float>& edge_length,
                    AreaTree& tree) {
  struct Side {
    std::uint32_t a, b;
    EdgeId edge;
  };
  std::vector<Side> sides;
  for (FaceId f = 0; f < table.size(); ++f) {
    AreaTree::Piece& own = tree.pieces[tree.of_face[f]];
    own.faces.push_back(f);
    own.area += face_area(mesh, f);
    for (std::size_t k = 0; k < 3; ++k)
      if (const FaceId g = table.neighbours[f][k]; g != no_id && tree.of_face[f] != tree.of_face[g])
        sides.push_back({tree.of_face[f], tree.of_face[g], table.sides[f][k]});
  }
  parallel_sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::tie(x.a, x.b, x.edge) < std::tie(y.a, y.b, y.edge);
  });
  for (const Side& side : sides) {
    auto& beside = tree.pieces[side.a].beside;
    if (beside.empty() || beside.back().first != side.b) beside.emplace_back(side.b, 0.0F);
    beside.back().second += edge_length[side.edge];
  }
}

}  // namespace

Areas AreaTree::cut(float height, std::uint32_t least) const {
  const Roots roots(surfaces_of(*this), joins, height);
  const auto count = static_cast<std::uint32_t>(pieces.size());
  // Connected pieces of one root; a root that is not connected is several areas.
  struct Group {
    std::vector<std::uint32_t> pieces;
    std::size_t faces = 0;
    std::uint32_t root = 0;
  };
  std::vector<std::uint32_t> group_of(count, no_id);
  std::vector<Group> groups;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (group_of[first] != no_id || pieces[first].faces.empty()) continue;
    const auto number = static_cast<std::uint32_t>(groups.size());
    Group group{{first}, 0, roots.of_piece[first]};
    group_of[first] = number;
    for (std::size_t i = 0; i < group.pieces.size(); ++i) {
      const Piece& piece = pieces[group.pieces[i]];
      group.faces += piece.faces.size();
      for (const auto& [other, length] : piece.beside)
        if (group_of[other] == no_id && roots.of_piece[other] == group.root) {
          group_of[other] = number;
          group.pieces.push_back(other);
        }
    }
    groups.push_back(std::move(group));
  }
  // Specks, the smallest first, so that what they go to may be a speck no longer.
  std::vector<std::uint32_t> specks;
  for (std::uint32_t g = 0; g < groups.size(); ++g)
    if (groups[g].faces < least) specks.push_back(g);
  std::ranges::stable_sort(specks, {}, [&](std::uint32_t g) { return groups[g].faces; });
  for (const std::uint32_t g : specks) {
    Group& speck = groups[g];
    if (speck.faces >= least) continue;
    std::map<std::uint32_t, float> beside;
    for (const std::uint32_t piece : speck.pieces)
      for (const auto& [other, length] : pieces[piece].beside)
        if (group_of[other] != g) beside[group_of[other]] += length;
    if (beside.empty()) continue;
    const std::uint32_t to =
        std::ranges::max_element(beside, {}, [](const auto& entry) { return entry.second; })->first;
    for (const std::uint32_t piece : speck.pieces) group_of[piece] = to;
    groups[to].faces += speck.faces;
    if (groups[to].faces < least + speck.faces)
      groups[to].pieces.insert(groups[to].pieces.end(), speck.pieces.begin(), speck.pieces.end());
    speck.pieces.clear();
  }
  Areas areas;
  areas.of_piece.assign(count, no_id);
  std::vector<std::uint32_t> order, number(groups.size(), no_id);
  for (std::uint32_t piece = 0; piece < count; ++piece)
    if (!pieces[piece].faces.empty()) order.push_back(piece);
  std::ranges::sort(order, {}, [&](std::uint32_t piece) { return pieces[piece].faces.front(); });
  for (const std::uint32_t piece : order) {
    const std::uint32_t group = group_of[piece];
    if (number[group] == no_id) {
      number[group] = static_cast<std::uint32_t>(areas.surfaces.size());
      areas.surfaces.push_back(roots.surfaces[groups[group].root]);
    }
    areas.of_piece[piece] = number[group];
  }
  return areas;
}

std::vector<std::uint32_t> AreaTree::by_face(const Areas& areas) const {
  std::vector<std::uint32_t> result(of_face.size());
  parallel_for(result.size(), [&](std::size_t f) { result[f] = areas.of_piece[of_face[f]]; });
  return result;
}

Result<AreaTree> grow_area_tree(const Mesh& mesh, const SharpLines& lines,
                                const AreaTreeOptions& options, const Context& context) {
  AreaTree tree;
  FaceTable table = table_between_lines(mesh, lines);
  tree.banded = faces_beside_lines(mesh, lines, table, options.smallest);
  std::vector<float> edge_length(mesh.edge_count());
  parallel_for(mesh.edge_count(), [&](std::size_t e) {
    edge_length[e] = static_cast<float>(mesh.edge_length(static_cast<EdgeId>(e)) / table.unit);
  });
  Result<CurvatureKinks> kinks =
      measure_curvature_kinks(mesh, table, tree.banded, options.kinks, context.part(0.0, 0.3));
  if (!kinks) return tl::unexpected<Error>(kinks.error());
  FaceRegions areas =
      smallest_areas(mesh, table, tree.banded, *kinks, edge_length, options.smallest);
  if (context.cancelled()) return cancelled();
  context.report(0.33, "areas");
  // Grains of a fine scan are larger: a part as such has no more to tell, and what a scan is off by
  // over long ways is noise of the samples then, too.
  constexpr double largest = 1e4;  // a part of absurd size is infinitely large
  double scale = part_size(mesh) / usual_part_size;
  if (!(scale < largest)) scale = largest;
  const int grain = static_cast<int>(options.grain * std::max(1.0, scale));
  Grains grains = make_grains(table, areas, tree.banded, grain);
  if (context.cancelled()) return cancelled();
  context.report(0.35, "surfaces");
  const SurfaceNoise least_noise{static_cast<double>(options.distance),
                                 static_cast<double>(options.angle) * in_radians<double>};
  tree.noise = noise_of(grain_windows(grains, options.growing.seed), least_noise);
  const SurfaceNoise near_noise = tree.noise;
  const FaceRegions old = areas;
  const double rounds = std::max(options.growths, 1);
  for (int round = 1;; ++round) {
    const std::vector<std::uint32_t> grown = grow_surfaces(
        grains, tree.noise, options.growing,
        context.part(0.35 + 0.15 * (round - 1) / rounds, 0.35 + 0.15 * round / rounds));
    if (context.cancelled()) return cancelled();
    // Over whole surfaces a scan is farther off than over a few edges: with the noise that they
    // show they grow again, until it stays.
    std::vector<Samples> by_surface;
    for (std::uint32_t k = 0; k < grains.size(); ++k)
      if (grown[k] != no_id) {
        if (grown[k] >= by_surface.size()) by_surface.resize(grown[k] + 1);
        by_surface[grown[k]].push_back(grains.samples[k]);
      }
    SurfaceNoise now = noise_of(by_surface, least_noise);
    now.distance = std::min(now.distance, options.most_drift * near_noise.distance);
    now.angle = std::min(now.angle, options.most_spread * near_noise.angle);
    const auto stays = [&](double before, double after) {
      return std::abs(after - before) <= options.settled * before;
    };
    if (round < options.growths &&
        !(stays(tree.noise.distance, now.distance) && stays(tree.noise.angle, now.angle))) {
      tree.noise = now;
      continue;
    }
    areas = areas_by_surface(table, old, grains, grown);
    break;
  }
  for (FaceId f = 0; f < table.size(); ++f)
    if (grains.of_face[f] != no_id) grains.area[grains.of_face[f]] = areas.of_face[f];
  const FaceRegions pieces = pieces_of(table, areas, old);
  JoinedAreas joined =
      join_areas({mesh, table, lines, areas, tree.banded, samples_by_area(grains, areas.count),
                  grain, tree.noise, kinks->noise},
                 scaled(options.joining, scale), context.part(0.5, 0.9));
  if (context.cancelled()) return cancelled();
  context.report(0.9, "pieces");
  tree.joins =
      join_pieces(table, pieces, areas, *kinks, edge_length, joined.surfaces, options.inner);
  // From here on an area goes by the piece that its pieces were joined to.
  std::vector<std::uint32_t> gone_to(pieces.count), piece_of(areas.count, no_id);
  std::iota(gone_to.begin(), gone_to.end(), 0U);
  for (const AreaJoin& join : tree.joins) gone_to[join.gone] = join.into;
  tree.pieces.resize(pieces.count);
  for (FaceId f = 0; f < table.size(); ++f) {
    const std::uint32_t piece = pieces.of_face[f];
    tree.pieces[piece].surface = joined.surfaces[areas.of_face[f]];
    if (gone_to[piece] == piece) piece_of[areas.of_face[f]] = piece;
  }
  for (AreaJoin join : joined.joins) {
    join.into = piece_of[join.into];
    join.gone = piece_of[join.gone];
    join.height = std::max(join.height, options.inner);
    tree.joins.push_back(join);
  }
  const auto free_where_missed = [&](FittedSurface& fit) {
    if (fit.misfit >= static_cast<double>(options.joining.free))
      fit.surface.type = SurfaceType::free;
  };
  for (AreaTree::Piece& piece : tree.pieces) free_where_missed(piece.surface);
  for (AreaJoin& join : tree.joins) free_where_missed(join.surface);
  tree.face_noise = {
      tree.noise.distance * options.face_noise,
      std::max(static_cast<double>(kinks->noise) * in_radians<double>, tree.noise.angle)};
  tree.of_face = pieces.of_face;
  if (context.cancelled()) return cancelled();
  settle(mesh, tree, table, edge_length, options.borders, context.part(0.93, 0.98));
  if (context.cancelled()) return cancelled();
  context.report(0.98, "pieces");
  measure_pieces(mesh, table, edge_length, tree);
  tree.neighbours = std::move(table.neighbours);
  if (context.cancelled()) return cancelled();
  return tree;
}

std::size_t AreaTree::bytes() const {
  std::size_t beside = 0;
  for (const Piece& own : pieces) beside += own.beside.size();
  return sizeof *this + neighbours.size() * sizeof(neighbours[0]) + banded.size() +
         of_face.size() * (sizeof(std::uint32_t) + sizeof(FaceId)) + pieces.size() * sizeof(Piece) +
         beside * sizeof(std::pair<std::uint32_t, float>) + joins.size() * sizeof(AreaJoin);
}

namespace {

/// Values of the criterion at the regular vertices of faces, one for each face it lies in.
struct ValueRange {
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::size_t count = 0;

  void add(const ValueRange& other) {
    sum += other.sum;
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    count += other.count;
  }
};

/// `banded`: faces whose vertices are not regular.
ValueRange values_in(const Mesh& mesh, const std::vector<FaceId>& faces,
                     const std::vector<std::uint8_t>& banded, const std::vector<double>& values) {
  ValueRange range;
  for (const FaceId f : faces) {
    if (banded[f]) continue;
    for (const VertexId v : mesh.triangle(f))
      if (!mesh.is_border(v) && !std::isnan(values[v]))
        range.add({values[v], values[v], values[v], 1});
  }
  return range;
}

/// One of found partitions, with the values that it holds.
void take_values(const ValueRange& range, Partition& partition) {
  if (range.count == 0) return;
  partition.mean_value = range.sum / static_cast<double>(range.count);
  partition.interval = {range.least, range.most};
}

/// The areas as they are.
FoundPartitions whole_areas(const Mesh& mesh, const AreaTree& tree, const Areas& areas,
                            const std::vector<double>& values) {
  FoundPartitions found;
  found.labels = tree.by_face(areas);
  parallel_for(found.labels.size(), [&](std::size_t f) { ++found.labels[f]; });
  found.partitions.resize(areas.surfaces.size());
  std::vector<ValueRange> of_piece(tree.pieces.size()), of_area(areas.surfaces.size());
  parallel_for(
      of_piece.size(),
      [&](std::size_t k) {
        of_piece[k] = values_in(mesh, tree.pieces[k].faces, tree.banded, values);
      },
      1);
  std::vector<FaceId> first(areas.surfaces.size(), no_id);
  for (std::size_t k = 0; k < tree.pieces.size(); ++k) {
    const AreaTree::Piece& piece = tree.pieces[k];
    if (piece.faces.empty()) continue;
    const std::uint32_t area = areas.of_piece[k];
    of_area[area].add(of_piece[k]);
    found.partitions[area].faces += static_cast<std::uint32_t>(piece.faces.size());
    found.partitions[area].area += piece.area;
    first[area] = std::min(first[area], piece.faces.front());
  }
  for (std::size_t a = 0; a < found.partitions.size(); ++a) {
    found.partitions[a].anchor = mesh.triangle(first[a]);
    take_values(of_area[a], found.partitions[a]);
  }
  return found;
}

/// What others took may part an area: each piece of what is left of it is a partition.
FoundPartitions parted_areas(const Mesh& mesh, const AreaTree& tree, const Areas& areas,
                             const std::vector<double>& values, const std::vector<bool>& taken) {
  const std::vector<std::uint32_t> area = tree.by_face(areas);
  FoundPartitions found;
  found.labels.assign(mesh.face_count(), 0);
  std::vector<FaceId> front;
  for (FaceId first = 0; first < mesh.face_count(); ++first) {
    if (found.labels[first] != 0 || taken[first]) continue;
    Partition partition;
    partition.anchor = mesh.triangle(first);
    const auto label = static_cast<std::uint32_t>(found.partitions.size() + 1);
    found.labels[first] = label;
    front.assign(1, first);
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const FaceId g : tree.neighbours[front[i]])
        if (g != no_id && found.labels[g] == 0 && area[g] == area[first] && !taken[g]) {
          found.labels[g] = label;
          front.push_back(g);
        }
    partition.faces = static_cast<std::uint32_t>(front.size());
    for (const FaceId f : front) partition.area += face_area(mesh, f);
    take_values(values_in(mesh, front, tree.banded, values), partition);
    found.partitions.push_back(partition);
  }
  return found;
}

}  // namespace

FoundPartitions partitions_of(const Mesh& mesh, const AreaTree& tree, float height,
                              std::uint32_t least, Criterion criterion,
                              const std::vector<double>& values, const std::vector<bool>& taken) {
  const Areas areas = tree.cut(height, least);
  FoundPartitions found = taken.empty() ? whole_areas(mesh, tree, areas, values)
                                        : parted_areas(mesh, tree, areas, values, taken);
  for (Partition& partition : found.partitions) partition.criterion = criterion;
  return found;
}

}  // namespace arris
