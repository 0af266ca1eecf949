#include "core/sharp_lines/jump_profile.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "core/mesh/geometry.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

namespace {

using Eigen::Vector3f;
// As in the border test (border_test.cpp).
constexpr int smoothing = 3;             // places on either side over which a line is smoothed
constexpr std::ptrdiff_t own_reach = 7;  // places along the line whose faces a place has
constexpr float far_side = 2.0F;  // beyond this a side shows whether it is wide enough for a slope
constexpr float least_own = 0.35F;  // share of it that has to be its own
constexpr auto bins = static_cast<std::size_t>(2.0F * JumpProfile::reach / JumpProfile::bin);

/// The faces about an edge as they are asked for, in mean edges from its middle.
class Surroundings {
 public:
  Surroundings(const Mesh& mesh, EdgeId e)
      : mesh_(mesh),
        unit_(mesh.mean_edge_length() > 0.0 ? mesh.mean_edge_length() : 1.0),
        middle_((mesh.point(mesh.edge(e)[0]) + mesh.point(mesh.edge(e)[1])) / 2.0) {}

  const FaceTable::Face& face(FaceId f) {
    const auto [known, fresh] = faces_.try_emplace(f);
    if (!fresh) return known->second;
    const auto [a, b, c] = mesh_.triangle(f);
    const Point normal =
        (mesh_.point(b) - mesh_.point(a)).cross(mesh_.point(c) - mesh_.point(a)) / (unit_ * unit_);
    const double twice = normal.norm();
    known->second.centre = (point(a) + point(b) + point(c)) / 3.0F;
    known->second.normal = (twice > 0.0 ? Point(normal / twice) : Point::Zero()).cast<float>();
    known->second.area = static_cast<float>(twice / 2.0);
    return known->second;
  }
  Vector3f point(VertexId v) const { return ((mesh_.point(v) - middle_) / unit_).cast<float>(); }

  /// Faces with centres within `radius` of a point, joined over sides to a half-edge's two, over
  /// which `admits(g, side)` lets into face g.
  template <class Admits>
  std::vector<FaceId> grow(std::vector<FaceId> front, const Vector3f& middle, float radius,
                           const Admits& admits) {
    std::unordered_set<FaceId> seen(front.begin(), front.end());
    for (std::size_t i = 0; i < front.size() && i < FaceWindow::most_faces; ++i) {
      HalfEdgeId h = mesh_.face_half_edge(front[i]);
      for (int k = 0; k < 3; ++k, h = mesh_.next(h)) {
        const FaceId g = mesh_.face(Mesh::opposite(h));
        if (g == no_id || seen.contains(g) || (face(g).centre - middle).norm() >= radius ||
            !admits(g, h >> 1))
          continue;
        seen.insert(g);
        front.push_back(g);
      }
    }
    return front;
  }
  std::vector<FaceId> about(HalfEdgeId h, const Vector3f& middle, float radius) {
    return grow({mesh_.face(h), mesh_.face(Mesh::opposite(h))}, middle, radius,
                [](FaceId, EdgeId) { return true; });
  }

 private:
  const Mesh& mesh_;
  const double unit_;
  const Point middle_;
  std::unordered_map<FaceId, FaceTable::Face> faces_;
};

/// A place on the line that the profile goes across.
struct Place {
  HalfEdgeId half_edge = no_id;
  std::ptrdiff_t index = 0;  // on the line
  Vector3f middle, tangent;
  float along = 0.0F;      // spread of the weights along the line, mean edges
  bool is_on_line = true;  // its two faces lie on either side of the line
};

/// The chain of candidates at least as strong as the edge itself, through it.
class StrongChain {
 public:
  StrongChain(const Mesh& mesh, const CandidateGraph& candidates, EdgeId e, int most)
      : mesh_(mesh), candidates_(candidates), path_{2 * e} {
    const BorderEdge* own = candidates.find(e);
    if (!own) return;
    constexpr float same = 1e-3F;
    least_ = own->height - same;
    for (int k = 0; k < most && follow(path_.back()); ++k) {
    }
    std::vector<HalfEdgeId> after = std::move(path_);
    path_ = {Mesh::opposite(2 * e)};
    for (int k = 0; k < most && follow(path_.back()); ++k) {
    }
    own_ = path_.size() - 1;
    std::reverse(path_.begin(), path_.end());
    for (HalfEdgeId& h : path_) h = Mesh::opposite(h);
    path_.insert(path_.end(), after.begin() + 1, after.end());
  }

  std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(path_.size()); }
  std::ptrdiff_t own() const { return static_cast<std::ptrdiff_t>(own_); }
  HalfEdgeId at(std::ptrdiff_t i) const { return path_[static_cast<std::size_t>(i)]; }
  /// Vertex i, from 0 to size(); the ends go on.
  VertexId vertex(std::ptrdiff_t i) const {
    i = std::clamp<std::ptrdiff_t>(i, 0, size());
    return i == size() ? mesh_.to(path_.back()) : mesh_.from(at(i));
  }
  /// Whether the faces about place `to` may be those of place `from`: as in the border test, no
  /// farther along, nor on the far side of a small ring.
  bool is_own(std::ptrdiff_t from, std::ptrdiff_t to) const {
    std::ptrdiff_t apart = std::abs(to - from), reach = own_reach;
    if (mesh_.to(path_.back()) == mesh_.from(path_.front())) {
      apart = std::min(apart, std::abs(size() - apart));
      reach = std::min(reach, size() / 4);
    }
    return apart <= reach;
  }
  /// Where an edge is on the line; no_place: elsewhere.
  std::ptrdiff_t place_of(EdgeId e) const {
    const auto found = std::ranges::find(path_, e, [](HalfEdgeId h) { return h >> 1; });
    return found == path_.end() ? no_place : found - path_.begin();
  }
  static constexpr std::ptrdiff_t no_place = -1000;
  /// Another part of the surface begins there.
  bool is_barrier(EdgeId e) const {
    const BorderEdge* edge = candidates_.find(e);
    return edge && edge->height >= least_;
  }

 private:
  /// Goes on over a vertex at which just two of them meet.
  bool follow(HalfEdgeId h) {
    HalfEdgeId next = no_id;
    int met = 0;
    mesh_.for_ring(mesh_.to(h), [&](HalfEdgeId out) {
      if (!is_barrier(out >> 1)) return;
      ++met;
      if (out >> 1 != h >> 1) next = out;
    });
    if (met != 2 || next >> 1 == path_.front() >> 1) return false;
    path_.push_back(next);
    return true;
  }

  const Mesh& mesh_;
  const CandidateGraph& candidates_;
  std::vector<HalfEdgeId> path_;
  std::size_t own_ = 0;
  float least_ = 1e9F;  // in_degrees<float>: no barriers where the edge is no candidate
};

/// As BorderTest::sum_sides() places itself.
Place place_on(const Surroundings& near, const StrongChain& line, std::ptrdiff_t i,
               const BorderTestOptions& options) {
  Place place;
  place.half_edge = line.at(i);
  place.index = i;
  place.middle = Vector3f::Zero();
  for (std::ptrdiff_t k = 1 - smoothing; k <= smoothing; ++k)
    place.middle += near.point(line.vertex(i + k));
  place.middle /= static_cast<float>(2 * smoothing);
  const auto between = [&](std::ptrdiff_t a, std::ptrdiff_t b) -> Vector3f {
    return near.point(line.vertex(b)) - near.point(line.vertex(a));
  };
  place.tangent = between(i - smoothing, i + smoothing + 1).normalized();
  const Vector3f before = between(i - smoothing - 1, i + 1), after = between(i, i + smoothing + 2);
  const float lengths = before.norm() * after.norm();
  const float bend = lengths > 0.0F
                         ? std::acos(std::clamp(before.dot(after) / lengths, -1.0F, 1.0F)) /
                               std::max(0.5F * (before.norm() + after.norm()), 1e-6F)
                         : 0.0F;
  place.along = std::max(std::min(options.along, 0.6F / std::max(bend, 1e-6F)), 0.35F);
  return place;
}

/// Off the candidates: along the way in which the normals turn least, as the normal jump has it.
Place place_off(const Mesh& mesh, Surroundings& near, EdgeId e, const BorderTestOptions& options) {
  constexpr float radius = 4.0F;
  Place place;
  place.half_edge = 2 * e;
  const auto [a, b] = mesh.edge(e);
  place.middle = (near.point(a) + near.point(b)) / 2.0F;
  place.along = options.along;
  place.is_on_line = false;
  Vector3f sum = Vector3f::Zero(), moment = Vector3f::Zero();
  float weight = 0.0F;
  Eigen::Matrix3f change = Eigen::Matrix3f::Zero();
  for (const FaceId f : near.about(2 * e, place.middle, radius)) {
    const FaceTable::Face& face = near.face(f);
    const Vector3f d = face.centre - place.middle;
    const float w = face.area * std::exp(-0.5F * d.squaredNorm());
    sum += w * face.normal;
    weight += w;
    moment += w * d;
    change += w * face.normal * d.transpose();
  }
  place.tangent = (near.point(b) - near.point(a)).normalized();
  if (!(sum.norm() > 1e-6F * weight)) return place;
  change -= (sum / weight) * moment.transpose();
  const Vector3f n = sum.normalized();
  const Vector3f x =
      (std::abs(n[0]) < 0.7F ? Vector3f::UnitX() : Vector3f::UnitY()).cross(n).normalized();
  const Vector3f y = n.cross(x);
  const Vector3f by_x = change * x, by_y = change * y;
  const float angle =
      0.5F * std::atan2(2.0F * by_x.dot(by_y), by_x.squaredNorm() - by_y.squaredNorm());
  place.tangent = n.cross(std::cos(angle) * x + std::sin(angle) * y);
  return place;
}

/// Sums over faces about all places that are pooled.
class Sums {
 public:
  Sums(const Mesh& mesh, Surroundings& near, const StrongChain& line,
       const BorderTestOptions& options)
      : mesh_(mesh), near_(near), line_(line), options_(options) {}

  void add(const Place& place, float weight) {
    const FaceId left = mesh_.face(place.half_edge);
    const FaceId right = mesh_.face(Mesh::opposite(place.half_edge));
    if (left == no_id || right == no_id) return;
    const std::vector<FaceId> all =
        near_.about(place.half_edge, place.middle, JumpProfile::reach + 1.0F);
    // Which side a face is on: that which it is joined to without crossing a barrier.
    std::unordered_map<FaceId, int> side_of;
    const Vector3f flat =
        (near_.face(left).normal + near_.face(right).normal).normalized().cross(place.tangent);
    if (place.is_on_line) {
      for (const auto& [seed, sign] : {std::pair{right, -1}, std::pair{left, 1}})
        grow_side(place, flat, seed, sign, side_of);
    } else {
      for (const FaceId f : all)
        side_of[f] = (near_.face(f).centre - place.middle).dot(flat) > 0.0F ? 1 : -1;
    }
    std::array<Vector3f, 2> mean{Vector3f::Zero(), Vector3f::Zero()};
    for (const auto& [f, sign] : side_of)
      if ((near_.face(f).centre - place.middle).norm() < options_.far + 0.5F)
        mean[sign > 0] += near_.face(f).area * near_.face(f).normal;
    Vector3f up = mean[0].normalized() + mean[1].normalized();
    up -= place.tangent * up.dot(place.tangent);
    if (!(up.norm() > 1e-6F)) return;
    up.normalize();
    const Vector3f leftwards = up.cross(place.tangent);
    const std::vector<EdgeId> barriers = barriers_among(all);
    for (const FaceId f : all) {
      const Vector3f d = near_.face(f).centre - place.middle;
      const float y = d.dot(place.tangent);
      if (std::abs(y) > 2.0F * place.along) continue;
      const float t = (d - y * place.tangent).norm();
      const auto known = side_of.find(f);
      const bool own = known != side_of.end();
      const bool positive = own ? known->second > 0 : d.dot(leftwards) > 0.0F;
      const float turn =
          std::atan2(near_.face(f).normal.dot(leftwards), near_.face(f).normal.dot(up)) *
          in_degrees<float>;
      const float w = weight * near_.face(f).area * std::exp(-y * y / (place.along * place.along));
      if (!(w > 0.0F)) continue;
      if (t < JumpProfile::reach) {
        const float at = (positive ? t : -t) + JumpProfile::reach;
        std::array<float, 3>& bin =
            bins_[std::min(static_cast<std::size_t>(at / JumpProfile::bin), bins - 1)];
        bin[0] += w;
        bin[1] += w * (positive ? t : -t);
        bin[2] += w * turn;
      }
      if (!own || !place.is_on_line || t < options_.near || t > options_.far) continue;
      const bool is_nearest = answers_for(place, near_.face(f).centre, barriers);
      if (t > far_side) {
        all_far_[positive] += w;
        if (is_nearest) own_far_[positive] += w;
      }
      if (!is_nearest) continue;
      std::array<float, 5>& s = sides_[positive];
      s[0] += w;
      s[1] += w * t;
      s[2] += w * t * t;
      s[3] += w * turn;
      s[4] += w * t * turn;
    }
  }

  JumpProfile profile() const {
    JumpProfile result;
    result.near = options_.near;
    result.far = options_.far;
    for (const std::array<float, 3>& bin : bins_)
      if (bin[0] > 0.0F) result.dots.push_back({bin[1] / bin[0], bin[2] / bin[0]});
    for (std::size_t k = 0; k < 2; ++k) {
      const std::array<float, 5>& s = sides_[k];
      if (!(s[0] > 0.0F)) continue;
      JumpProfile::Side& side = result.sides[k];
      const float distance = s[1] / s[0];
      side.fitted = true;
      side.distance = distance;
      side.mean = s[3] / s[0];
      // As the border test: a side whose faces lie at one distance has no slope.
      const float spread = s[2] / s[0] - distance * distance;
      side.slope = spread < 0.05F ? 0.0F : (s[4] / s[0] - distance * side.mean) / (spread + 0.03F);
      // Too narrow for a slope: another line is near, and beyond it another surface.
      if (own_far_[k] < least_own * all_far_[k] + 1e-12F) {
        side.slope = 0.0F;
        side.mean *= options_.narrow;
      }
      side.at_line = side.mean - side.slope * distance;
    }
    return result;
  }

 private:
  std::vector<EdgeId> barriers_among(const std::vector<FaceId>& faces) const {
    std::vector<EdgeId> barriers;
    for (const FaceId f : faces) {
      HalfEdgeId h = mesh_.face_half_edge(f);
      for (int k = 0; k < 3; ++k, h = mesh_.next(h))
        if (line_.is_barrier(h >> 1)) barriers.push_back(h >> 1);
    }
    std::ranges::sort(barriers);
    barriers.erase(std::unique(barriers.begin(), barriers.end()), barriers.end());
    return barriers;
  }

  /// Whether the nearest line to a point is this one, and near the place along it.
  bool answers_for(const Place& place, const Vector3f& point,
                   const std::vector<EdgeId>& barriers) const {
    float least = 1e9F;
    EdgeId nearest = no_id;
    for (const EdgeId e : barriers) {
      const auto [a, b] = mesh_.edge(e);
      const float distance = ((near_.point(a) + near_.point(b)) / 2.0F - point).norm();
      if (distance >= least) continue;
      least = distance;
      nearest = e;
    }
    return nearest == no_id || line_.is_own(place.index, line_.place_of(nearest));
  }

  void grow_side(const Place& place, const Vector3f& leftwards, FaceId seed, int sign,
                 std::unordered_map<FaceId, int>& side_of) const {
    constexpr float slack = 0.5F;  // a line bends a little
    const auto admits = [&](FaceId g, EdgeId side) {
      const float offset = (near_.face(g).centre - place.middle).dot(leftwards);
      return !line_.is_barrier(side) && static_cast<float>(sign) * offset >= -slack;
    };
    for (const FaceId f : near_.grow({seed}, place.middle, options_.far + 2.0F, admits))
      side_of.try_emplace(f, sign);
  }

  const Mesh& mesh_;
  Surroundings& near_;
  const StrongChain& line_;
  const BorderTestOptions& options_;
  std::array<std::array<float, 3>, bins> bins_{};  // weight, distance, turn
  std::array<float, 2> own_far_{}, all_far_{};
  std::array<std::array<float, 5>, 2> sides_{};  // weight, t, t^2, turn, t * turn
};

}  // namespace

float JumpProfile::jump() const {
  const float between = sides[1].at_line - sides[0].at_line;
  return turn() > 0.0F ? std::max(between, 0.0F) : std::min(between, 0.0F);
}

JumpProfile profile_across(const Mesh& mesh, const CandidateGraph& candidates, EdgeId e,
                           const BorderTestOptions& options) {
  if (mesh.is_border_edge(e)) return {};
  const StrongChain line(mesh, candidates, e, options.pooled + static_cast<int>(own_reach));
  Surroundings near(mesh, e);
  Sums sums(mesh, near, line, options);
  const BorderEdge* border = candidates.find(e);
  if (!border) {
    sums.add(place_off(mesh, near, e, options), 1.0F);
    return sums.profile();
  }
  for (int k = -options.pooled; k <= options.pooled; ++k) {
    const std::ptrdiff_t i = line.own() + k;
    if (i < 0 || i >= line.size()) continue;
    sums.add(place_on(near, line, i, options),
             1.0F - static_cast<float>(std::abs(k)) / static_cast<float>(options.pooled + 1));
  }
  JumpProfile result = sums.profile();
  if (result.fitted() && !border->exact) {
    const float turned = (border->place.turn - result.turn()) / 2.0F;
    const float jumped =
        (border->place.jump - (result.sides[1].at_line - result.sides[0].at_line)) / 2.0F;
    for (std::size_t k = 0; k < 2; ++k) {
      JumpProfile::Side& side = result.sides[k];
      side.mean += k == 1 ? turned : -turned;
      side.at_line += k == 1 ? jumped : -jumped;
      side.slope = (side.mean - side.at_line) / std::max(side.distance, options.near);
    }
  }
  return result;
}

}  // namespace arris
