#include "core/partitions/partitions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_map>

#include "core/base/parallel.h"
#include "core/base/parallel_sort.h"
#include "core/mesh/geometry.h"
#include "core/partitions/front_rule.h"

namespace arris {

namespace {

constexpr std::uint32_t unassigned = 0;

/// The state of one propagation over one mesh.
class Propagation {
 public:
  Propagation(const Mesh& mesh, const std::vector<double>& values, const SharpLines& lines,
              const std::vector<bool>& taken)
      : mesh_(mesh), values_(values), lines_(lines), taken_(taken), rule_(mesh, values, lines) {
    rule_.count_all_votes();
    found_.labels.assign(mesh.face_count(), unassigned);
    areas_.resize(mesh.face_count());
    parallel_for(mesh.face_count(),
                 [&](std::size_t f) { areas_[f] = face_area(mesh_, static_cast<FaceId>(f)); });
    for (VertexId v = 0; v < mesh.vertex_count(); ++v)
      if (rule_.is_regular(v)) seeds_.push_back({values[v], v});
    parallel_sort(seeds_.begin(), seeds_.end(), [](const Seed& a, const Seed& b) {
      return a.value != b.value ? a.value > b.value : a.vertex < b.vertex;
    });
  }

  void run(const CurvatureInterval& interval, const PartitionOptions& options) {
    std::vector<std::uint8_t> passes(mesh_.face_count());
    parallel_for(mesh_.face_count(), [&](std::size_t f) {
      const FaceId face = static_cast<FaceId>(f);
      passes[f] = found_.labels[f] == unassigned && !is_taken(f) && rule_.passes(face, interval);
    });
    // Where the front may go from each face, side by side in memory: the front itself jumps about.
    ways_.resize(mesh_.face_count());
    parallel_for(mesh_.face_count(), [&](std::size_t f) {
      if (!passes[f]) return;
      std::size_t k = 0;
      for (const HalfEdgeId h : mesh_.sides(static_cast<FaceId>(f))) {
        const FaceId across = mesh_.face(Mesh::opposite(h));
        const bool open = across != no_id && passes[across] && !lines_.is_sharp(Mesh::edge_of(h));
        ways_[f][k++] = open ? across : no_id;
      }
    });
    // Seeds come in the order of their values, from all over the part: what is left round each is
    // counted, so that nearly all of them cost one look.
    open_faces_.assign(mesh_.vertex_count(), 0);
    for (FaceId f = 0; f < mesh_.face_count(); ++f)
      if (passes[f])
        for (const VertexId v : mesh_.triangle(f)) ++open_faces_[v];
    const auto first = std::partition_point(seeds_.begin(), seeds_.end(),
                                            [&](const Seed& s) { return s.value > interval.max; });
    for (auto seed = first; seed != seeds_.end() && seed->value >= interval.min; ++seed) {
      while (open_faces_[seed->vertex] > 0) {
        FaceId start = no_id;  // the passing face with the lowest number round the seed
        mesh_.for_ring(seed->vertex, [&](HalfEdgeId h) {
          const FaceId f = mesh_.face(h);
          if (f < start && passes[f] && found_.labels[f] == unassigned) start = f;
        });
        propagate(start, interval, options, passes);  // faces that fail may part those round it
      }
    }
  }

  FoundPartitions finish(const PartitionOptions& options) {
    join_faces_without_vote();
    if (options.bare_areas) take_bare_areas(options);
    if (options.fill_holes > 0) fill_holes(options.fill_holes);
    return std::move(found_);
  }

 private:
  bool is_taken(std::size_t f) const { return !taken_.empty() && taken_[f]; }

  /// Faces without a regular vertex: round after round, each joins the partition across its longest
  /// edge that is not sharp.
  void join_faces_without_vote() {
    std::vector<FaceId> left;
    for (FaceId f = 0; f < mesh_.face_count(); ++f)
      if (rule_.votes(f) == 0 && !is_taken(f)) left.push_back(f);
    std::vector<std::pair<FaceId, std::uint32_t>> joined;
    do {
      joined.clear();
      std::vector<FaceId> still;
      for (const FaceId f : left) {
        const FaceId across = rule_.across_longest(f);
        const std::uint32_t label = across == no_id ? unassigned : found_.labels[across];
        if (label == unassigned)
          still.push_back(f);
        else
          joined.emplace_back(f, label);
      }
      for (const auto& [f, label] : joined) assign(f, label);
      left = std::move(still);
    } while (!joined.empty());
  }

  void take_bare_areas(const PartitionOptions& options) {
    for (const BareArea& area :
         find_bare_areas(mesh_, lines_, rule_.all_votes(), options.criterion)) {
      const auto interval = std::ranges::find_if(
          options.intervals, [&](const CurvatureInterval& i) { return i.holds(area.value); });
      if (interval == options.intervals.end() || area.faces.size() < options.min_faces ||
          std::ranges::any_of(area.faces, [&](FaceId f) { return is_taken(f); }))
        continue;
      Partition partition;
      partition.anchor = mesh_.triangle(area.faces.front());
      partition.mean_value = area.value;
      partition.criterion = options.criterion;
      partition.interval = *interval;
      found_.partitions.push_back(partition);
      const auto label = static_cast<std::uint32_t>(found_.partitions.size());
      for (const FaceId f : area.faces) assign(f, label);
    }
  }

  void fill_holes(std::uint32_t limit) {
    std::vector<bool> seen(mesh_.face_count(), false);
    std::vector<std::pair<std::vector<FaceId>, std::uint32_t>> holes;  // with the label to take
    std::vector<std::pair<std::uint32_t, double>> shared;              // border with each partition
    for (FaceId start = 0; start < mesh_.face_count(); ++start) {
      if (seen[start] || found_.labels[start] != unassigned || is_taken(start)) continue;
      front_.assign(1, start);
      seen[start] = true;
      shared.clear();
      for (std::size_t next = 0; next < front_.size(); ++next) {
        for (const HalfEdgeId h : mesh_.sides(front_[next])) {
          const FaceId f = mesh_.face(Mesh::opposite(h));
          if (f == no_id || lines_.is_sharp(Mesh::edge_of(h))) continue;
          if (found_.labels[f] != unassigned)
            shared.emplace_back(found_.labels[f], mesh_.edge_length(Mesh::edge_of(h)));
          else if (!seen[f] && !is_taken(f)) {
            seen[f] = true;
            front_.push_back(f);
          }
        }
      }
      if (front_.size() >= limit || shared.empty()) continue;
      std::stable_sort(shared.begin(), shared.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
      std::uint32_t best = unassigned;
      double longest = -1.0;
      for (std::size_t k = 0; k < shared.size();) {
        const std::uint32_t label = shared[k].first;
        double length = 0.0;
        for (; k < shared.size() && shared[k].first == label; ++k) length += shared[k].second;
        if (length > longest) {
          longest = length;
          best = label;
        }
      }
      holes.emplace_back(front_, best);
    }
    for (const auto& [faces, label] : holes)
      for (const FaceId f : faces) assign(f, label);
  }

  void assign(FaceId f, std::uint32_t label) {
    found_.labels[f] = label;
    Partition& partition = found_.partitions[label - 1];
    ++partition.faces;
    partition.area += areas_[f];
  }

  void propagate(FaceId start, const CurvatureInterval& interval, const PartitionOptions& options,
                 std::vector<std::uint8_t>& passes) {
    const std::uint32_t label = static_cast<std::uint32_t>(found_.partitions.size() + 1);
    front_.assign(1, start);
    found_.labels[start] = label;
    for (std::size_t next = 0; next < front_.size(); ++next) {
      for (const FaceId f : ways_[front_[next]]) {
        if (f == no_id || found_.labels[f] != unassigned) continue;
        found_.labels[f] = label;
        front_.push_back(f);
      }
    }
    for (const FaceId f : front_)
      for (const VertexId v : mesh_.triangle(f)) --open_faces_[v];
    if (front_.size() < options.min_faces) {
      for (const FaceId f : front_) {
        found_.labels[f] = unassigned;
        passes[f] = 0;  // not to be tried again from its other vertices
      }
      return;
    }
    Partition partition;
    partition.anchor = mesh_.triangle(start);
    partition.faces = static_cast<std::uint32_t>(front_.size());
    partition.criterion = options.criterion;
    partition.interval = interval;
    double sum = 0.0;
    std::size_t count = 0;
    for (const FaceId f : front_) {
      partition.area += areas_[f];
      for (const VertexId v : mesh_.triangle(f))
        if (rule_.is_regular(v)) {
          sum += values_[v];
          ++count;
        }
    }
    partition.mean_value = count > 0 ? sum / static_cast<double>(count) : 0.0;
    found_.partitions.push_back(partition);
  }

  const Mesh& mesh_;
  const std::vector<double>& values_;
  const SharpLines& lines_;
  const std::vector<bool>& taken_;
  FrontRule rule_;
  struct Seed {
    double value;
    VertexId vertex;
  };
  std::vector<Seed> seeds_;                  // regular vertices by decreasing value
  std::vector<double> areas_;                // of the faces
  std::vector<std::array<FaceId, 3>> ways_;  // to the faces that pass across edges not sharp
  std::vector<std::uint32_t> open_faces_;    // round a vertex: they pass, and no front came yet
  std::vector<FaceId> front_;
  FoundPartitions found_;
};

}  // namespace

std::string_view name_of(Criterion criterion) {
  return criterion == Criterion::kabs ? "kabs" : "ikabs";
}

const std::vector<double>& values_of(const Curvatures& curvatures, Criterion criterion) {
  return criterion == Criterion::kabs ? curvatures.kabs : curvatures.ikabs;
}

const Partition* Partitions::find(std::uint32_t id) const {
  const auto found =
      std::lower_bound(partitions.begin(), partitions.end(), id,
                       [](const PartitionPtr& p, std::uint32_t x) { return p->id < x; });
  return found != partitions.end() && (*found)->id == id ? found->get() : nullptr;
}

Result<FoundPartitions> propagate_fronts(const Mesh& mesh, const std::vector<double>& values,
                                         const SharpLines& lines, const PartitionOptions& options,
                                         const Context& context, const std::vector<bool>& taken) {
  context.report(0.0, "partitions");
  Propagation propagation(mesh, values, lines, taken);
  for (std::size_t k = 0; k < options.intervals.size(); ++k) {
    if (context.cancelled()) return cancelled();
    propagation.run(options.intervals[k], options);
    context.report(static_cast<double>(k + 1) / static_cast<double>(options.intervals.size() + 1),
                   "partitions");
  }
  FoundPartitions found = propagation.finish(options);
  context.report(1.0, "partitions");
  return found;
}

std::vector<BareArea> find_bare_areas(const Mesh& mesh, const SharpLines& lines,
                                      const std::vector<std::uint8_t>& votes, Criterion criterion) {
  std::vector<BareArea> result;
  std::vector<bool> seen(mesh.face_count(), false);
  for (FaceId start = 0; start < mesh.face_count(); ++start) {
    if (seen[start] || votes[start] > 0) continue;
    BareArea found;
    found.faces.push_back(start);
    seen[start] = true;
    bool is_bare = true;
    double area = 0.0, turn = 0.0, turn_by_length = 0.0;  // each edge counts at both its ends
    for (std::size_t next = 0; next < found.faces.size(); ++next) {
      const FaceId f = found.faces[next];
      area += face_area(mesh, f);
      for (const HalfEdgeId h : mesh.sides(f)) {
        const FaceId across = mesh.face(Mesh::opposite(h));
        if (across == no_id || lines.is_sharp(Mesh::edge_of(h))) continue;
        if (votes[across] > 0) {
          is_bare = false;
          continue;
        }
        const Point own = unit_normal(mesh, f), other = unit_normal(mesh, across);
        if (!own.isZero(0.0) && !other.isZero(0.0)) {
          const double beta = angle_between(own, other);
          turn += beta;
          turn_by_length += beta * mesh.edge_length(Mesh::edge_of(h));
        }
        if (seen[across]) continue;
        seen[across] = true;
        found.faces.push_back(across);
      }
    }
    if (!is_bare) continue;
    const double angles = std::numbers::pi * static_cast<double>(found.faces.size());
    double h = 0.0;
    if (criterion == Criterion::ikabs)
      h = 1.5 * turn / angles;
    else if (area > 0.0)
      h = 0.25 * turn_by_length / area;
    found.value = 4.0 * h * h;
    result.push_back(std::move(found));
  }
  return result;
}

Partitions number_partitions(const Mesh& mesh, const FoundPartitions& found,
                             const Partitions& previous, std::uint32_t& next_id) {
  std::vector<Partition> partitions = found.partitions;
  std::vector<const PartitionPtr*> successor_of(partitions.size(), nullptr);
  if (!previous.labels.empty() && previous.labels.size() == mesh.face_count()) {
    std::unordered_map<std::uint64_t, double> area;  // (new label, old id) to shared area
    for (FaceId f = 0; f < mesh.face_count(); ++f)
      if (found.labels[f] != unassigned && previous.labels[f] != unassigned)
        area[static_cast<std::uint64_t>(found.labels[f] - 1) << 32 | previous.labels[f]] +=
            face_area(mesh, f);
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> shared;  // area, old id, new
    for (const auto& [key, value] : area)
      shared.emplace_back(value, static_cast<std::uint32_t>(key),
                          static_cast<std::uint32_t>(key >> 32));
    std::sort(shared.begin(), shared.end(), [](const auto& a, const auto& b) {
      return std::get<0>(a) != std::get<0>(b)   ? std::get<0>(a) > std::get<0>(b)
             : std::get<1>(a) != std::get<1>(b) ? std::get<1>(a) < std::get<1>(b)
                                                : std::get<2>(a) < std::get<2>(b);
    });
    std::vector<bool> taken(previous.partitions.size(), false);
    for (const auto& [value, id, k] : shared) {
      const auto old =
          std::lower_bound(previous.partitions.begin(), previous.partitions.end(), id,
                           [](const PartitionPtr& p, std::uint32_t x) { return p->id < x; });
      const std::size_t place = static_cast<std::size_t>(old - previous.partitions.begin());
      if (taken[place] || successor_of[k]) continue;
      taken[place] = true;
      successor_of[k] = &*old;
      partitions[k].id = id;
    }
  }

  Partitions result;
  std::vector<std::uint32_t> id_of(partitions.size() + 1, unassigned);
  for (std::size_t k = 0; k < partitions.size(); ++k) {
    if (partitions[k].id == 0) partitions[k].id = next_id++;
    id_of[k + 1] = partitions[k].id;
    if (successor_of[k] && **successor_of[k] == partitions[k])
      result.partitions.push_back(*successor_of[k]);
    else
      result.partitions.push_back(std::make_shared<const Partition>(partitions[k]));
  }
  std::sort(result.partitions.begin(), result.partitions.end(),
            [](const PartitionPtr& a, const PartitionPtr& b) { return a->id < b->id; });
  std::vector<std::uint32_t> labels(found.labels.size());
  for (std::size_t f = 0; f < labels.size(); ++f) labels[f] = id_of[found.labels[f]];
  result.labels = ChunkedArray<std::uint32_t>(labels, previous.labels);
  return result;
}

}  // namespace arris
