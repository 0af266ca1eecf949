#include "core/document/comparison.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "core/base/parallel.h"
#include "core/mesh/distance.h"
#include "core/mesh/geometry.h"

namespace arris {

namespace {

constexpr double reach = 1.5;  // mean edges

struct Segment {
  Point a, b;
};

/// Whether anything of a set of segments lies within a distance: a tree of boxes over them.
class SegmentTree {
 public:
  explicit SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments)) {
    if (!segments_.empty()) build(0, segments_.size());
  }

  bool has_within(const Point& p, double distance2) const {
    return !nodes_.empty() && search(0, p, distance2);
  }

 private:
  struct Node {
    Point low, high;
    std::size_t begin, end;  // segments of a leaf
    std::size_t right = 0;   // 0: a leaf; the left child is the next node
  };
  static constexpr std::size_t leaf = 8;

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t at = nodes_.size();
    Node node{segments_[begin].a, segments_[begin].a, begin, end};
    for (std::size_t k = begin; k < end; ++k)
      for (const Point& p : {segments_[k].a, segments_[k].b}) {
        node.low = node.low.cwiseMin(p);
        node.high = node.high.cwiseMax(p);
      }
    nodes_.push_back(node);
    if (end - begin <= leaf) return at;
    Eigen::Index axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto place = [&](std::size_t k) { return segments_.begin() + std::ptrdiff_t(k); };
    std::nth_element(place(begin), place(middle), place(end),
                     [axis](const Segment& s, const Segment& t) {
                       return s.a[axis] + s.b[axis] < t.a[axis] + t.b[axis];
                     });
    build(begin, middle);
    const std::size_t right = build(middle, end);
    nodes_[at].right = right;
    return at;
  }

  bool search(std::size_t at, const Point& p, double distance2) const {
    const Node& node = nodes_[at];
    if ((p - p.cwiseMax(node.low).cwiseMin(node.high)).squaredNorm() > distance2) return false;
    if (node.right != 0) return search(at + 1, p, distance2) || search(node.right, p, distance2);
    for (std::size_t k = node.begin; k < node.end; ++k)
      if (squared_distance_to_segment(p, segments_[k].a, segments_[k].b) <= distance2) return true;
    return false;
  }

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

SegmentTree tree_of(const Document& document, bool sharp_only) {
  std::vector<Segment> segments;
  for (const BoundaryPtr& boundary : *document.boundaries) {
    if (boundary->type == BoundaryType::border) continue;
    if (sharp_only && boundary->type != BoundaryType::c0) continue;
    for (std::size_t k = 1; k < boundary->vertices.size(); ++k)
      segments.push_back({document.mesh->point(boundary->vertices[k - 1]),
                          document.mesh->point(boundary->vertices[k])});
  }
  return SegmentTree(std::move(segments));
}

/// What `document` has beyond `other`; of its sharp lines alone where `sharp_only`.
Departure departure_of(const Document& document, const Document& other, double tolerance,
                       bool sharp_only) {
  const SegmentTree sharp = tree_of(other, true), any = tree_of(other, false);
  const double tolerance2 = tolerance * tolerance;
  const Mesh& mesh = *document.mesh;
  const Boundaries& boundaries = *document.boundaries;
  std::vector<Departure> found(boundaries.size());
  parallel_for(
      boundaries.size(),
      [&](std::size_t k) {
        const Boundary& boundary = *boundaries[k];
        const bool is_sharp = boundary.type == BoundaryType::c0;
        if (boundary.type == BoundaryType::border || (sharp_only && !is_sharp)) return;
        const SegmentTree& with = is_sharp ? sharp : any;
        const auto agrees = [&](const Point& p) { return with.has_within(p, tolerance2); };
        Departure& departure = found[k];
        bool going_on = false;  // the stretch made last ends where this edge starts
        bool start_agrees = agrees(mesh.point(boundary.vertices.front()));
        for (std::size_t i = 1; i < boundary.vertices.size(); ++i) {
          const VertexId from = boundary.vertices[i - 1], to = boundary.vertices[i];
          const Point &a = mesh.point(from), &b = mesh.point(to);
          const bool end_agrees = agrees(b);
          if (start_agrees && end_agrees && agrees((a + b) / 2.0)) {
            going_on = false;
          } else {
            if (!going_on) departure.stretches.push_back({from});
            departure.stretches.back().push_back(to);
            (is_sharp ? departure.sharp_length : departure.soft_length) += (b - a).norm();
            going_on = true;
          }
          start_agrees = end_agrees;
        }
      },
      4);
  Departure all;
  for (Departure& departure : found) {
    std::ranges::move(departure.stretches, std::back_inserter(all.stretches));
    all.sharp_length += departure.sharp_length;
    all.soft_length += departure.soft_length;
  }
  return all;
}

/// A label per face for each of the two, on the mesh they share or else on the scan.
struct CommonGround {
  const Mesh& mesh;
  std::array<std::vector<std::uint32_t>, 2> labels;
};

CommonGround common_ground(const Document& left, const Document& right) {
  if (left.mesh != right.mesh)
    return {*left.scan->mesh, {labels_on_scan(left), labels_on_scan(right)}};
  CommonGround ground{*left.mesh, {}};
  const std::array<const Document*, 2> documents{&left, &right};
  for (std::size_t side = 0; side < 2; ++side) {
    ground.labels[side].resize(ground.mesh.face_count());
    for (FaceId f = 0; f < ground.mesh.face_count(); ++f)
      ground.labels[side][f] = documents[side]->partitions.label(f);
  }
  return ground;
}

void compare_partitions(const CommonGround& ground, Comparison& result) {
  std::unordered_map<std::uint64_t, double> shared;  // area by the two labels
  double all = 0.0, otherwise = 0.0;
  for (FaceId f = 0; f < ground.mesh.face_count(); ++f) {
    const std::uint32_t a = ground.labels[0][f], b = ground.labels[1][f];
    const double area = face_area(ground.mesh, f);
    all += area;
    if (a != 0 && b != 0) shared[std::uint64_t{a} << 32 | b] += area;
    if ((a == 0) != (b == 0)) otherwise += area;
  }
  std::vector<std::pair<std::uint64_t, double>> pairs(shared.begin(), shared.end());
  std::ranges::sort(pairs, [](const auto& p, const auto& q) {
    return p.second != q.second ? p.second > q.second : p.first < q.first;
  });
  std::array<std::unordered_set<std::uint32_t>, 2> taken;
  for (const auto& [labels, area] : pairs) {
    const auto a = static_cast<std::uint32_t>(labels >> 32);
    const auto b = static_cast<std::uint32_t>(labels);
    if (taken[0].contains(a) || taken[1].contains(b)) {
      otherwise += area;
      continue;
    }
    taken[0].insert(a);
    taken[1].insert(b);
    result.partitions.push_back({a, b});
  }
  result.divided_otherwise = all > 0.0 ? otherwise / all : 0.0;
}

}  // namespace

bool are_of_one_scan(const Document& left, const Document& right) {
  // A scan that a replay opened again is another object.
  return !left.empty() && !right.empty() &&
         (left.scan == right.scan || left.scan->mesh->hash() == right.scan->mesh->hash());
}

Result<Comparison> compare(const Document& left, const Document& right, const Context& context) {
  if (left.empty() || right.empty())
    return fail("Two versions of a part can be compared; here one of them has no part open.");
  if (!are_of_one_scan(left, right))
    return fail("These versions are not of one scan: " + left.scan_path + " and " +
                right.scan_path + ".");
  Comparison result;
  result.tolerance =
      reach * std::max(left.mesh->mean_edge_length(), right.mesh->mean_edge_length());
  const bool sharp_only = left.partitions.labels.empty() || right.partitions.labels.empty();
  result.only[0] = departure_of(left, right, result.tolerance, sharp_only);
  if (context.cancelled()) return cancelled();
  result.only[1] = departure_of(right, left, result.tolerance, sharp_only);
  if (context.cancelled()) return cancelled();
  if (!sharp_only) compare_partitions(common_ground(left, right), result);
  return result;
}

}  // namespace arris
