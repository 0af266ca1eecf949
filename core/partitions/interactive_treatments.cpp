#include "core/partitions/interactive_treatments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "core/base/disjoint_sets.h"
#include "core/mesh/distance.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

template <class Visit>
void for_sides(const Mesh& mesh, FaceId f, const Visit& visit) {
  for (const HalfEdgeId h : mesh.sides(f)) visit(h);
}

/// Faces joined to `starts` by edges, all of which satisfy `may_enter(half-edge crossed, face)`.
template <class MayEnter>
std::vector<FaceId> flood(const Mesh& mesh, const std::vector<FaceId>& starts,
                          const MayEnter& may_enter) {
  std::unordered_set<FaceId> reached(starts.begin(), starts.end());
  std::vector<FaceId> front(starts);
  for (std::size_t next = 0; next < front.size(); ++next)
    for_sides(mesh, front[next], [&](HalfEdgeId h) {
      const FaceId f = mesh.face(Mesh::opposite(h));
      if (f != no_id && !reached.contains(f) && may_enter(h, f)) {
        reached.insert(f);
        front.push_back(f);
      }
    });
  return front;
}

/// Of the faces joined to `left` and those joined to `right`, the fewer (tie: left); none where
/// they are the same. Both grow in turn, so that the cost follows the smaller side.
template <class MayEnter>
std::optional<std::vector<FaceId>> smaller_side(const Mesh& mesh, const std::vector<FaceId>& left,
                                                const std::vector<FaceId>& right,
                                                const MayEnter& may_enter) {
  std::array<std::vector<FaceId>, 2> fronts;
  std::array<std::size_t, 2> next{0, 0};
  std::unordered_map<FaceId, std::size_t> side_of;
  const auto reach = [&](FaceId f, std::size_t side) {
    const auto [it, fresh] = side_of.try_emplace(f, side);
    if (fresh) fronts[side].push_back(f);
    return it->second == side;
  };
  for (const FaceId f : left) reach(f, 0);
  for (const FaceId f : right)
    if (!reach(f, 1)) return std::nullopt;
  for (std::size_t side = 0;; side = 1 - side) {
    bool apart = true;
    for_sides(mesh, fronts[side][next[side]++], [&](HalfEdgeId h) {
      const FaceId f = mesh.face(Mesh::opposite(h));
      if (f != no_id && may_enter(h, f)) apart = reach(f, side) && apart;
    });
    if (!apart) return std::nullopt;
    if (next[side] == fronts[side].size()) return std::move(fronts[side]);
  }
}

/// Pieces that are no longer joined to the rest of a label, the largest piece left out. `starts`:
/// faces of the label beside those that left it. `barrier`: lines that part it; null: none do. The
/// fronts from all of them grow in turn, so that the cost follows the small pieces (and the way
/// round where nothing was parted).
std::vector<std::vector<FaceId>> parted_pieces(const Mesh& mesh,
                                               const ChunkedArray<std::uint32_t>& labels,
                                               std::uint32_t label,
                                               const std::vector<FaceId>& starts,
                                               const SharpLines* barrier = nullptr) {
  DisjointSets joined(starts.size());
  std::unordered_map<FaceId, std::uint32_t> front_of;
  std::vector<std::queue<FaceId>> fronts(starts.size());
  for (std::uint32_t k = 0; k < starts.size(); ++k) {
    front_of[starts[k]] = k;
    fronts[k].push(starts[k]);
  }
  std::vector<bool> grows(starts.size());
  for (;;) {
    std::fill(grows.begin(), grows.end(), false);
    for (std::uint32_t k = 0; k < fronts.size(); ++k)
      if (!fronts[k].empty()) grows[joined.find(k)] = true;
    if (std::count(grows.begin(), grows.end(), true) <= 1) break;
    for (std::uint32_t k = 0; k < fronts.size(); ++k) {
      if (fronts[k].empty()) continue;
      const FaceId f = fronts[k].front();
      fronts[k].pop();
      for_sides(mesh, f, [&](HalfEdgeId h) {
        const FaceId g = mesh.face(Mesh::opposite(h));
        if (g == no_id || labels[g] != label) return;
        if (barrier && barrier->is_sharp(h >> 1)) return;
        const auto [it, fresh] = front_of.try_emplace(g, k);
        if (fresh)
          fronts[k].push(g);
        else
          joined.join(k, it->second);
      });
    }
  }
  std::map<std::uint32_t, std::vector<FaceId>> pieces;
  for (const auto& [f, k] : front_of) pieces[joined.find(k)].push_back(f);
  std::vector<std::vector<FaceId>> result;
  std::size_t largest = 0;
  bool rest_grows = false;
  for (auto& [k, faces] : pieces) {
    std::sort(faces.begin(), faces.end());
    if (grows[k])
      rest_grows = true;
    else
      result.push_back(std::move(faces));
  }
  if (!rest_grows && !result.empty()) {
    for (std::size_t k = 1; k < result.size(); ++k)
      if (result[k].size() > result[largest].size() ||
          (result[k].size() == result[largest].size() && result[k] < result[largest]))
        largest = k;
    result.erase(result.begin() + static_cast<std::ptrdiff_t>(largest));
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Unassigned faces without a regular vertex join what lies across their longest edge that is not
/// sharp, one after the other from `beside` on (method.md 6). `owner`: of the faces taken so far.
template <class OwnerBefore>
void join_faces_without_vote(const PartitionGround& ground, std::vector<FaceId> beside,
                             std::unordered_map<FaceId, std::uint32_t>& owner,
                             const OwnerBefore& owner_before) {
  const Mesh& mesh = ground.mesh;
  const FrontRule rule = ground.rule();
  for (std::size_t next = 0; next < beside.size(); ++next) {
    const FaceId f = beside[next];
    if (owner.contains(f) || ground.partitions.label(f) != 0) continue;
    if (rule.votes(f) > 0) continue;
    const FaceId across = rule.across_longest(f);
    if (across == no_id) continue;
    const auto taken = owner.find(across);
    const std::uint32_t label = taken != owner.end() ? taken->second : owner_before(across);
    if (label == 0) continue;
    owner[f] = label;
    for_sides(mesh, f, [&](HalfEdgeId h) {
      if (const FaceId g = mesh.face(Mesh::opposite(h)); g != no_id) beside.push_back(g);
    });
  }
}

/// Faces beside those of `faces`, once each, in order.
std::vector<FaceId> neighbours_of(const Mesh& mesh, const std::vector<FaceId>& faces) {
  std::vector<FaceId> result;
  for (const FaceId f : faces)
    for_sides(mesh, f, [&](HalfEdgeId h) {
      if (const FaceId g = mesh.face(Mesh::opposite(h)); g != no_id) result.push_back(g);
    });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Mean of the criterion over the regular vertices of a face; NaN where it has none.
double value_of(const PartitionGround& ground, FaceId f) {
  double sum = 0.0;
  int count = 0;
  for (const VertexId v : ground.mesh.triangle(f))
    if (ground.rule().is_regular(v)) {
      sum += ground.values[v];
      ++count;
    }
  return count > 0 ? sum / count : std::nan("");
}

void add_face(const PartitionGround& ground, FaceId f, Partition& partition) {
  const double area = face_area(ground.mesh, f), value = value_of(ground, f);
  if (!std::isnan(value) && partition.area + area > 0.0)
    partition.mean_value += (value - partition.mean_value) * area / (partition.area + area);
  partition.area += area;
  ++partition.faces;
}

void take_face(const PartitionGround& ground, FaceId f, Partition& partition) {
  const double area = face_area(ground.mesh, f), value = value_of(ground, f);
  if (!std::isnan(value) && partition.area - area > 0.0)
    partition.mean_value += (partition.mean_value - value) * area / (partition.area - area);
  partition.area = std::max(partition.area - area, 0.0);
  --partition.faces;
}

}  // namespace

std::vector<FaceId> faces_of(const Mesh& mesh, const Partitions& partitions,
                             const Partition& partition) {
  std::vector<FaceId> faces =
      flood(mesh, {*mesh.find_face(partition.anchor)},
            [&](HalfEdgeId, FaceId f) { return partitions.label(f) == partition.id; });
  std::sort(faces.begin(), faces.end());
  return faces;
}

Result<std::vector<FaceId>> extend_partition(const PartitionGround& ground,
                                             const Partition& partition,
                                             const Boundaries& boundaries,
                                             const CurvatureInterval& interval) {
  const Mesh& mesh = ground.mesh;
  std::vector<FaceId> beyond;
  bool has_undefined = false;
  const auto unassigned = [&](FaceId f) { return f != no_id && ground.partitions.label(f) == 0; };
  for (const BoundaryPtr& boundary : boundaries) {
    if (boundary->type != BoundaryType::undefined ||
        (boundary->left != partition.id && boundary->right != partition.id))
      continue;
    has_undefined = true;
    for (const HalfEdgeId h : half_edges_of(mesh, boundary->vertices))
      for (const FaceId f : {mesh.face(h), mesh.face(Mesh::opposite(h))})
        if (unassigned(f)) beyond.push_back(f);
  }
  if (!has_undefined)
    return fail("Partition " + std::to_string(partition.id) +
                " has no undefined boundary: sharp lines, other partitions and the border are all "
                "round it, so there is nothing to extend into.");
  std::sort(beyond.begin(), beyond.end());
  beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
  std::vector<FaceId> starts;
  for (const FaceId f : beyond)
    if (ground.rule().passes(f, interval)) starts.push_back(f);
  std::vector<FaceId> taken = flood(mesh, starts, [&](HalfEdgeId h, FaceId f) {
    return unassigned(f) && !ground.lines.is_sharp(Mesh::edge_of(h)) &&
           ground.rule().passes(f, interval);
  });
  std::unordered_map<FaceId, std::uint32_t> owner;
  for (const FaceId f : taken) owner[f] = partition.id;
  std::sort(taken.begin(), taken.end());
  std::vector<FaceId> beside = neighbours_of(mesh, taken);
  beside.insert(beside.end(), beyond.begin(), beyond.end());
  join_faces_without_vote(ground, std::move(beside), owner, [&](FaceId f) {
    return ground.partitions.label(f) == partition.id ? partition.id : 0u;
  });
  std::vector<FaceId> result;
  for (const auto& [f, id] : owner) result.push_back(f);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::vector<FaceId>> find_areas(const PartitionGround& ground,
                                            const std::vector<FaceId>& faces,
                                            const CurvatureInterval& interval,
                                            std::uint32_t min_faces) {
  std::unordered_set<FaceId> passing;
  for (const FaceId f : faces)
    if (ground.partitions.label(f) == 0 && ground.rule().passes(f, interval)) passing.insert(f);
  std::vector<std::tuple<double, VertexId, std::vector<FaceId>>> areas;
  std::unordered_set<FaceId> seen;
  for (const FaceId start : faces) {
    if (!passing.contains(start) || seen.contains(start)) continue;
    std::vector<FaceId> area = flood(ground.mesh, {start}, [&](HalfEdgeId h, FaceId f) {
      return passing.contains(f) && !ground.lines.is_sharp(Mesh::edge_of(h));
    });
    seen.insert(area.begin(), area.end());
    if (area.size() < min_faces) continue;
    std::sort(area.begin(), area.end());
    double highest = -1.0;
    VertexId seed = no_id;
    for (const FaceId f : area)
      for (const VertexId v : ground.mesh.triangle(f))
        if (ground.rule().is_regular(v) &&
            (ground.values[v] > highest || (ground.values[v] == highest && v < seed))) {
          highest = ground.values[v];
          seed = v;
        }
    areas.emplace_back(-highest, seed, std::move(area));
  }
  std::sort(areas.begin(), areas.end());
  std::unordered_map<FaceId, std::uint32_t> owner;  // place in `areas` from 1
  std::vector<FaceId> taken;
  for (std::uint32_t k = 0; k < areas.size(); ++k)
    for (const FaceId f : std::get<2>(areas[k])) {
      owner[f] = k + 1;
      taken.push_back(f);
    }
  std::sort(taken.begin(), taken.end());
  join_faces_without_vote(ground, neighbours_of(ground.mesh, taken), owner,
                          [](FaceId) { return 0u; });
  std::vector<std::vector<FaceId>> result(areas.size());
  for (const auto& [f, k] : owner) result[k - 1].push_back(f);
  for (std::vector<FaceId>& area : result) std::sort(area.begin(), area.end());
  return result;
}

Result<std::vector<FaceId>> cut_off(const PartitionGround& ground, const Partition& partition,
                                    const std::vector<VertexId>& path) {
  const Mesh& mesh = ground.mesh;
  std::unordered_set<EdgeId> cut;
  std::vector<FaceId> left, right;
  const auto own = [&](FaceId f) {
    return f != no_id && ground.partitions.label(f) == partition.id;
  };
  for (const HalfEdgeId h : half_edges_of(mesh, path)) {
    const FaceId a = mesh.face(h), b = mesh.face(Mesh::opposite(h));
    cut.insert(Mesh::edge_of(h));
    if (own(a) && own(b)) {
      left.push_back(a);
      right.push_back(b);
    }
  }
  const std::string nothing = "The path does not part partition " + std::to_string(partition.id) +
                              ": draw it from one of its boundaries to another.";
  if (left.empty()) return fail(nothing);
  // An inner sharp line counts as part of the cut only where the path alone does not do.
  for (const bool lines_cut : {false, true}) {
    const auto may_enter = [&](HalfEdgeId h, FaceId f) {
      return own(f) && !cut.contains(Mesh::edge_of(h)) &&
             !(lines_cut && ground.lines.is_sharp(Mesh::edge_of(h)));
    };
    std::optional<std::vector<FaceId>> smaller = smaller_side(mesh, left, right, may_enter);
    if (!smaller) continue;
    std::sort(smaller->begin(), smaller->end());
    // A path that touches the boundary on its way may cut off several pieces: one is split off
    // here, and what else was parted by that is told apart by edit_partitions().
    std::vector<FaceId> largest;
    std::unordered_set<FaceId> seen;
    for (const FaceId f : *smaller) {
      if (seen.contains(f)) continue;
      std::vector<FaceId> piece = flood(mesh, {f}, may_enter);
      seen.insert(piece.begin(), piece.end());
      if (piece.size() > largest.size()) largest = std::move(piece);
    }
    std::sort(largest.begin(), largest.end());
    largest.erase(std::unique(largest.begin(), largest.end()), largest.end());
    return largest;
  }
  return fail(nothing);
}

std::vector<FaceId> faces_touched(const Mesh& mesh, const BrushedRegion& region,
                                  const SharpLines* stop_at) {
  std::vector<VertexId> stroke;
  for (const VertexId v : region.stroke)
    if (v < mesh.vertex_count() && !mesh.is_isolated(v)) stroke.push_back(v);
  std::vector<FaceId> starts;
  for (const VertexId v : stroke)
    mesh.for_ring(v, [&](HalfEdgeId h) {
      if (mesh.face(h) != no_id) starts.push_back(mesh.face(h));
    });
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  const double radius2 = region.radius * region.radius;
  std::vector<FaceId> faces = flood(mesh, starts, [&](HalfEdgeId h, FaceId f) {
    if (stop_at && stop_at->is_sharp(Mesh::edge_of(h))) return false;
    const Triangle& t = mesh.triangle(f);
    return std::any_of(stroke.begin(), stroke.end(), [&](VertexId v) {
      return squared_distance_to_triangle(mesh.point(v), mesh.point(t[0]), mesh.point(t[1]),
                                          mesh.point(t[2])) <= radius2;
    });
  });
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<FaceId> joined_to(const PartitionGround& ground, const std::vector<FaceId>& faces,
                              std::uint32_t partition) {
  const std::unordered_set<FaceId> wanted(faces.begin(), faces.end());
  std::vector<FaceId> starts;
  for (const FaceId f : faces) {
    bool beside = ground.partitions.label(f) == partition;
    for_sides(ground.mesh, f, [&](HalfEdgeId h) {
      const FaceId g = ground.mesh.face(Mesh::opposite(h));
      beside = beside || (g != no_id && ground.partitions.label(g) == partition &&
                          !ground.lines.is_sharp(Mesh::edge_of(h)));
    });
    if (beside) starts.push_back(f);
  }
  std::vector<FaceId> joined = flood(ground.mesh, starts, [&](HalfEdgeId h, FaceId f) {
    return wanted.contains(f) && !ground.lines.is_sharp(Mesh::edge_of(h));
  });
  std::sort(joined.begin(), joined.end());
  return joined;
}

std::vector<FaceId> with_unassigned_round(const PartitionGround& ground,
                                          const std::vector<FaceId>& faces) {
  std::vector<FaceId> area = flood(ground.mesh, faces, [&](HalfEdgeId h, FaceId f) {
    return ground.partitions.label(f) == 0 && !ground.lines.is_sharp(Mesh::edge_of(h));
  });
  std::sort(area.begin(), area.end());
  return area;
}

FaceLabels smooth_boundaries(const PartitionGround& ground, const Boundaries& boundaries,
                             const std::unordered_set<std::uint32_t>& ids, int rounds) {
  const Mesh& mesh = ground.mesh;
  std::unordered_map<FaceId, std::uint32_t> changed;
  const auto label_of = [&](FaceId f) {
    const auto it = changed.find(f);
    return it != changed.end() ? it->second : ground.partitions.label(f);
  };
  const auto is_locked = [&](std::uint32_t id) {
    const Partition* partition = ground.partitions.find(id);
    return !partition || partition->locked;
  };
  std::vector<FaceId> work;
  for (const BoundaryPtr& boundary : boundaries) {
    if (boundary->type != BoundaryType::gn) continue;
    if (!ids.empty() && !ids.contains(boundary->left) && !ids.contains(boundary->right)) continue;
    for (const HalfEdgeId h : half_edges_of(mesh, boundary->vertices))
      for (const FaceId f : {mesh.face(h), mesh.face(Mesh::opposite(h))}) work.push_back(f);
  }
  for (int round = 0; round < rounds && !work.empty(); ++round) {
    std::sort(work.begin(), work.end());
    work.erase(std::unique(work.begin(), work.end()), work.end());
    std::vector<FaceId> next;
    for (const FaceId f : work) {
      const std::uint32_t own = label_of(f);
      if (own == 0 || is_locked(own)) continue;
      double kept = 0.0;
      int own_sides = 0;
      std::map<std::uint32_t, double> gained;
      for_sides(mesh, f, [&](HalfEdgeId h) {
        const FaceId g = mesh.face(Mesh::opposite(h));
        if (g == no_id) return;
        const std::uint32_t label = label_of(g);
        if (label == own) {
          ++own_sides;
          kept += mesh.edge_length(Mesh::edge_of(h));
        } else if (label != 0 && !ground.lines.is_sharp(Mesh::edge_of(h)) && !is_locked(label)) {
          gained[label] += mesh.edge_length(Mesh::edge_of(h));
        }
      });
      if (own_sides != 1) continue;  // it would part its partition, or take its last face
      std::uint32_t best = 0;
      double longest = kept * (1.0 + 1e-9);
      for (const auto& [label, length] : gained)
        if (length > longest) {
          longest = length;
          best = label;
        }
      if (best == 0) continue;
      changed[f] = best;
      for_sides(mesh, f, [&](HalfEdgeId h) {
        if (const FaceId g = mesh.face(Mesh::opposite(h)); g != no_id) next.push_back(g);
      });
    }
    work = std::move(next);
  }
  FaceLabels result(changed.begin(), changed.end());
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::pair<std::uint32_t, std::vector<std::vector<FaceId>>>> parted_by_lines(
    const PartitionGround& ground, const std::vector<EdgeId>& edges) {
  std::map<std::uint32_t, std::vector<FaceId>> beside;
  for (const EdgeId e : edges) {
    const auto [left, right] = ground.mesh.edge_faces(e);
    if (left == no_id || right == no_id) continue;
    const std::uint32_t label = ground.partitions.label(left);
    if (label == 0 || ground.partitions.label(right) != label) continue;
    beside[label].push_back(left);
    beside[label].push_back(right);
  }
  std::vector<std::pair<std::uint32_t, std::vector<std::vector<FaceId>>>> result;
  for (auto& [label, starts] : beside) {
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    auto pieces =
        parted_pieces(ground.mesh, ground.partitions.labels, label, starts, &ground.lines);
    if (!pieces.empty()) result.emplace_back(label, std::move(pieces));
  }
  return result;
}

EditedPartitions edit_partitions(const PartitionGround& ground, const FaceLabels& changes,
                                 const std::vector<Partition>& fresh, std::uint32_t& next_id) {
  const Mesh& mesh = ground.mesh;
  EditedPartitions result{ground.partitions, {}};
  ChunkedArray<std::uint32_t>& labels = result.partitions.labels;
  if (labels.empty()) labels = ChunkedArray<std::uint32_t>(mesh.face_count(), 0u);
  std::map<std::uint32_t, Partition> changed;  // by id
  for (const Partition& partition : fresh) changed[partition.id] = partition;
  const auto partition_of = [&](std::uint32_t id) -> Partition& {
    const auto it = changed.find(id);
    return it != changed.end() ? it->second
                               : changed.emplace(id, *ground.partitions.find(id)).first->second;
  };
  std::map<std::uint32_t, std::vector<FaceId>> left;  // faces that each label lost
  for (const auto& [f, label] : changes) {
    const std::uint32_t old = labels[f];
    if (old == label) continue;
    labels.set(f, label);
    if (old != 0) {
      take_face(ground, f, partition_of(old));
      left[old].push_back(f);
    }
    if (label != 0) add_face(ground, f, partition_of(label));
    for_sides(mesh, f, [&](HalfEdgeId h) { result.touched.push_back(Mesh::edge_of(h)); });
  }
  // New partitions stand on the face that they got first.
  for (const auto& [f, label] : changes)
    if (label != 0)
      if (Partition& partition = partition_of(label); partition.anchor == Triangle{})
        partition.anchor = mesh.triangle(f);

  for (const auto& [id, faces] : left) {
    Partition& partition = partition_of(id);
    if (partition.faces == 0) continue;
    std::vector<FaceId> starts;
    for (const FaceId f : faces)
      for_sides(mesh, f, [&, id = id](HalfEdgeId h) {
        if (const FaceId g = mesh.face(Mesh::opposite(h)); g != no_id && labels[g] == id)
          starts.push_back(g);
      });
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    for (const std::vector<FaceId>& piece : parted_pieces(mesh, labels, id, starts)) {
      Partition part;
      part.id = next_id++;
      part.anchor = mesh.triangle(piece.front());
      part.criterion = partition.criterion;
      part.interval = partition.interval;
      part.locked = partition.locked;
      for (const FaceId f : piece) {
        labels.set(f, part.id);
        take_face(ground, f, partition);
        add_face(ground, f, part);
        for_sides(mesh, f, [&](HalfEdgeId h) { result.touched.push_back(Mesh::edge_of(h)); });
      }
      changed[part.id] = part;
    }
    const auto anchor = mesh.find_face(partition.anchor);
    if (!anchor || labels[*anchor] != id) {
      // Another face of it: beside those it lost, or, where it moved away altogether, one it got.
      for (const auto& [f, label] : changes) starts.push_back(f);
      for (const FaceId f : starts)
        if (labels[f] == id) {
          partition.anchor = mesh.triangle(f);
          break;
        }
    }
  }
  std::sort(result.touched.begin(), result.touched.end());
  result.touched.erase(std::unique(result.touched.begin(), result.touched.end()),
                       result.touched.end());
  std::vector<PartitionPtr>& partitions = result.partitions.partitions;
  std::erase_if(partitions, [&](const PartitionPtr& p) { return changed.contains(p->id); });
  for (const auto& [id, partition] : changed)
    if (partition.faces > 0) partitions.push_back(std::make_shared<const Partition>(partition));
  std::sort(partitions.begin(), partitions.end(),
            [](const PartitionPtr& a, const PartitionPtr& b) { return a->id < b->id; });
  return result;
}

}  // namespace arris
