#include "core/simplification/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/geometry.h"
#include "core/simplification/noise.h"
#include "core/simplification/vertex_queue.h"
#include "core/simplification/working_mesh.h"

namespace arris {

namespace {

using SideId = WorkingMesh::SideId;

constexpr double pi = std::numbers::pi;
/// A star whose modulus is below this share of a third of its area counts by its mixed area.
constexpr double least_modulus_share = 0.1;
/// Cosine of 120 degrees: a smaller one between neighbours is a flip.
constexpr double flip_cosine = -0.5;

/// Kabs (eq. 8) of an inner vertex from its star; 0 where the star has no area, so that it goes
/// first.
double absolute_curvature(const WorkingMesh& mesh, VertexId v) {
  const Point& p = mesh.point(v);
  double area = 0.0, modulus = 0.0, mixed = 0.0, betas_by_length = 0.0;
  // The sum of the angles as the argument of a product, its half turns counted: one arc tangent
  // for the whole star.
  double real = 1.0, imaginary = 0.0;
  int half_turns = 0;
  bool lower = false;
  SideId s = mesh.first_side(v);
  Point a = mesh.point(mesh.to(s)) - p;
  const SideId first = s;
  do {
    const SideId back = WorkingMesh::previous(s);
    const SideId after = mesh.twin(back);
    const Point b = mesh.point(mesh.from(back)) - p;
    const double cross = a.cross(b).norm();
    const double dot = a.dot(b);
    betas_by_length += b.norm() * [&] {
      const Point &m = mesh.normal(s >> 2), &n = mesh.normal(after >> 2);
      const double beta = angle_between(m, n);
      return m.cross(n).dot(b) < 0.0 ? beta : -beta;  // b leaves p with m on its right
    }();
    if (cross > 0.0) {
      const double cot = dot / cross;
      const double side2 = (b - a).squaredNorm();
      const double cell = 0.25 * cross - 0.125 * cot * side2;
      area += 0.5 * cross;
      modulus += cell;
      const double a2 = a.squaredNorm(), b2 = b.squaredNorm();
      mixed += dot < 0.0 ? 0.25 * cross : side2 + a2 < b2 || side2 + b2 < a2 ? 0.125 * cross : cell;
    }
    const double scale = 1.0 / (std::abs(dot) + cross + std::numeric_limits<double>::min());
    const double x = dot * scale, y = cross * scale;
    const double turned = real * x - imaginary * y;
    imaginary = real * y + imaginary * x;
    real = turned;
    if ((imaginary < 0.0) != lower) {
      lower = !lower;
      ++half_turns;
    }
    a = b;
    s = after;
  } while (s != first);
  if (!(area > 0.0)) return 0.0;
  const double angles =
      half_turns * pi + (lower ? std::atan2(-imaginary, -real) : std::atan2(imaginary, real));
  if (modulus < least_modulus_share * area / 3.0) modulus = mixed;
  const double h = 0.25 * betas_by_length / modulus;
  const double k = (2.0 * pi - angles) / modulus;
  return std::max(0.0, 4.0 * h * h - 2.0 * k);
}

/// Square of the curvature of the free border at a vertex of it: its turning angle over half the
/// length of its two edges. A Kabs of a cylinder, so that both sorts of vertices share one queue.
double border_curvature(const WorkingMesh& mesh, VertexId v) {
  SideId last = mesh.first_side(v);
  const Point out = mesh.point(mesh.to(last)) - mesh.point(v);
  mesh.for_sides(v, [&](SideId s) { last = s; });
  const Point in = mesh.point(v) - mesh.point(mesh.from(WorkingMesh::previous(last)));
  const double half = 0.5 * (out.norm() + in.norm());
  if (!(half > 0.0)) return 0.0;
  const double curvature = std::atan2(in.cross(out).norm(), in.dot(out)) / half;
  return curvature * curvature;
}

double key_of(const WorkingMesh& mesh, VertexId v) {
  return mesh.is_border(v) ? border_curvature(mesh, v) : absolute_curvature(mesh, v);
}

/// Takes out one vertex after the other. Buffers are kept between vertices: nothing is allocated in
/// the loop once they have grown.
class Simplifier {
 public:
  Simplifier(WorkingMesh& mesh, const SimplifyOptions& options)
      : mesh_(mesh),
        options_(options),
        queue_(mesh.vertex_slots()),
        corner_(mesh.vertex_slots(), no_corner) {
    polygon_.longest_edge = options.max_edge_length > 0.0 ? options.max_edge_length
                                                          : std::numeric_limits<double>::infinity();
  }

  Result<void> run(const Context& context) {
    std::vector<double> keys(mesh_.vertex_slots());
    parallel_for(keys.size(), [&](std::size_t i) {
      const VertexId v = static_cast<VertexId>(i);
      if (may_go(v)) keys[i] = key_of(mesh_, v);
    });
    for (VertexId v = 0; v < keys.size(); ++v)
      if (may_go(v)) queue_.set(v, keys[v]);
    keys = {};
    const double start = static_cast<double>(std::max<std::size_t>(queue_.size(), 1));
    for (std::uint64_t step = 0; !queue_.empty(); ++step) {
      if ((step & 0x3FF) == 0) {
        if (context.cancelled()) return cancelled();
        context.report(1.0 - static_cast<double>(queue_.size()) / start, "simplification");
      }
      if (options_.target_vertices > 0 && mesh_.vertices_in_mesh() <= options_.target_vertices)
        break;
      if (!try_remove(queue_.pop())) continue;
      for (int i = 0; i < polygon_.size; ++i)
        if (const VertexId w = polygon_.vertices[i]; may_go(w)) queue_.set(w, key_of(mesh_, w));
    }
    return {};
  }

 private:
  struct Zone {
    Point centre;
    double radius2;
    VertexId vertex;
    std::uint32_t face;  // index in faces_
  };
  static constexpr std::uint8_t no_corner = 0xFF;
  static constexpr int max_size = StarPolygon::max_size;

  bool may_go(VertexId v) const { return mesh_.is_in_mesh(v) && !mesh_.is_on_sharp(v); }

  bool try_remove(VertexId v) {
    vertex_ = v;
    is_border_ = mesh_.is_border(v);
    if (!read_star()) return false;
    if (is_border_ && !border_zones_fit()) return false;
    zones_read_ = is_exhausted_ = false;
    zones_.clear();
    if (!is_border_) add_zone(v);
    if (polygon_.size == 2) return try_remove_ear();
    if (!read_joined_corners()) return false;
    limit_angles();
    triangulator_.set(polygon_);
    const StarCost other = options_.cost == StarCost::flat ? StarCost::angle : StarCost::flat;
    const bool accepted = try_best(options_.cost) || (!is_exhausted_ && try_best(other));
    if (accepted) rebuild();
    return accepted;
  }

  /// Looks for the best triangulation that every zone meets. A zone that does not meet the best one
  /// most often lies over one of its faces, too far from it: all such faces are ruled out and the
  /// next best taken, until one will do, there is none, or the zone lies beside all its faces.
  bool try_best(StarCost cost) {
    for (;;) {
      if (!triangulator_.best(cost, faces_)) {
        is_exhausted_ = faces_.empty();
        return false;
      }
      if (!keeps_fans_open()) return false;
      const Zone* zone = find_unmet_zone();
      if (zone == nullptr) return true;
      const auto is_far = [&](const StarFace& face) {
        return triangulator_.query(face).is_far_over(zone->centre, zone->radius2);
      };
      if (std::ranges::none_of(faces_, is_far)) return false;
      triangulator_.rule_out(is_far);
    }
  }

  /// Polygon, faces and neighbours beyond them. False where there are too many corners.
  bool read_star() {
    int n = 0;
    const SideId first = mesh_.first_side(vertex_);
    SideId s = first;
    VertexId end = no_id;
    do {
      if (n + is_border_ == max_size) return false;
      const SideId side = WorkingMesh::next(s);
      star_faces_[n] = s >> 2;
      beyond_[n] = mesh_.twin(side);
      is_sharp_[n] = mesh_.is_sharp(side);
      add_corner(n, mesh_.from(side));
      ++n;
      end = mesh_.to(side);
      s = mesh_.twin(WorkingMesh::previous(s));
    } while (s != first && s != no_id);
    face_count_ = n;
    if (is_border_) {
      beyond_[n] = no_id;
      is_sharp_[n] = false;
      add_corner(n, end);
      ++n;
    }
    polygon_.size = n;
    return true;
  }

  void add_corner(int n, VertexId v) {
    polygon_.vertices[n] = v;
    polygon_.points[n] = mesh_.point(v);
    polygon_.outer_normals[n] = beyond_[n] == no_id ? nullptr : &mesh_.normal(beyond_[n] >> 2);
  }

  /// Which corners are joined already. False where the new border edge exists or is too long.
  bool read_joined_corners() {
    const int n = polygon_.size;
    for (int i = 0; i < n; ++i) corner_[polygon_.vertices[i]] = static_cast<std::uint8_t>(i);
    for (int i = 0; i < n; ++i) {
      std::uint32_t joined = 0;
      int neighbours = 0;
      mesh_.for_neighbours(polygon_.vertices[i], [&](VertexId w) {
        ++neighbours;
        if (corner_[w] != no_corner) joined |= 1u << corner_[w];
      });
      polygon_.joined[i] = static_cast<std::uint16_t>(joined);
      neighbours_[i] = neighbours;
    }
    for (int i = 0; i < n; ++i) corner_[polygon_.vertices[i]] = no_corner;
    if (!is_border_) return true;
    return !(polygon_.joined[0] >> (n - 1) & 1u) &&
           (polygon_.points[n - 1] - polygon_.points[0]).norm() <= polygon_.longest_edge;
  }

  /// No |beta| may be above both 120 degrees and the largest of the star before.
  void limit_angles() {
    double least = flip_cosine;
    for (int i = 0; i < face_count_; ++i) {
      const Point& normal = mesh_.normal(star_faces_[i]);
      if (beyond_[i] != no_id) least = std::min(least, normal.dot(*polygon_.outer_normals[i]));
      if (i + 1 < face_count_ || !is_border_)
        least = std::min(least, normal.dot(mesh_.normal(star_faces_[(i + 1) % face_count_])));
    }
    polygon_.least_cosine = least;
  }

  /// Whether the zones of the two border edges at the vertex, and its own, meet the one that takes
  /// their place.
  bool border_zones_fit() const {
    const Point& a = polygon_.points[0];
    const Point& b = polygon_.points[polygon_.size - 1];
    const auto fits = [&](VertexId zone) {
      return squared_distance_to_segment(mesh_.point(zone), a, b) <= mesh_.squared_radius(zone);
    };
    if (!fits(vertex_)) return false;
    for (const VertexId start : {vertex_, polygon_.vertices[polygon_.size - 1]})
      for (VertexId zone = mesh_.first_border_zone(start); zone != no_id;
           zone = mesh_.next_zone(zone))
        if (!fits(zone)) return false;
    return true;
  }

  void add_zone(VertexId v) { zones_.push_back({mesh_.point(v), mesh_.squared_radius(v), v, 0}); }

  /// The zones of the faces of the star.
  void read_zones() {
    zones_read_ = true;
    for (int i = 0; i < face_count_; ++i)
      for (VertexId v = mesh_.face(star_faces_[i]).first_zone; v != no_id; v = mesh_.next_zone(v))
        add_zone(v);
  }

  /// Whether faces_ leaves every inner vertex three faces or more.
  bool keeps_fans_open() const {
    std::array<int, max_size> after;
    for (int i = 0; i < polygon_.size; ++i) after[i] = neighbours_[i] - 1;
    for (const StarFace& face : faces_)
      if (face.last - face.first < polygon_.size - 1) ++after[face.first], ++after[face.last];
    for (int i = 0; i < polygon_.size; ++i)
      if (after[i] < 3 && !mesh_.is_border(polygon_.vertices[i])) return false;
    return true;
  }

  /// A zone that meets none of faces_; null where there is none, and each knows which face is to
  /// answer for it. The vertex's own comes first: it is the one most often, and the others need not
  /// be gathered then.
  const Zone* find_unmet_zone() {
    for (std::size_t k = 0; k < faces_.size(); ++k) queries_[k] = &triangulator_.query(faces_[k]);
    std::uint32_t k = 0;  // neighbours in the list tend to lie over the same face
    for (std::size_t i = 0;; ++i) {
      if (i == zones_.size() && !zones_read_) read_zones();
      if (i == zones_.size()) return nullptr;
      if (!find_face(zones_[i], k)) {
        std::swap(zones_[i], zones_[0]);  // it may well be the one the next time, too
        return &zones_[0];
      }
      zones_[i].face = k;
    }
  }

  /// The face that is to answer for a zone: one it lies over, else the nearest. `k`: where to look
  /// first, and the result. False where none is near enough.
  bool find_face(const Zone& zone, std::uint32_t& k) const {
    if (queries_[k]->is_over(zone.centre, zone.radius2)) return true;
    const std::uint32_t first = k;
    for (k = 0; k < faces_.size(); ++k)
      if (k != first && queries_[k]->is_over(zone.centre, zone.radius2)) return true;
    double least = std::numeric_limits<double>::infinity();
    k = first;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      const double distance2 = queries_[i]->squared_distance(zone.centre);
      if (distance2 < least) least = distance2, k = i;
    }
    return least <= zone.radius2;
  }

  void rebuild() {
    const int n = polygon_.size;
    std::array<std::array<SideId, max_size>, max_size> base;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      const auto [first, middle, last] = faces_[k];
      mesh_.set_face(star_faces_[k], polygon_.vertices[first], polygon_.vertices[middle],
                     polygon_.vertices[last], triangulator_.normal(faces_[k]));
      base[first][last] = 4 * star_faces_[k] + 2;
    }
    const auto join = [&](SideId side, int i, int j) {
      if (j > i + 1) {
        mesh_.link(side, base[i][j]);
        return;
      }
      mesh_.link(side, beyond_[i]);
      if (is_sharp_[i]) mesh_.set_sharp(side);
    };
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      join(4 * star_faces_[k], faces_[k].first, faces_[k].middle);
      join(4 * star_faces_[k] + 1, faces_[k].middle, faces_[k].last);
    }
    mesh_.link(base[0][n - 1], beyond_[n - 1]);
    if (is_sharp_[n - 1]) mesh_.set_sharp(base[0][n - 1]);
    for (std::size_t k = 0; k < faces_.size(); ++k)
      for (SideId side = 0; side < 3; ++side) mesh_.update_first_side(4 * star_faces_[k] + side);
    for (int k = static_cast<int>(faces_.size()); k < face_count_; ++k)
      mesh_.drop_face(star_faces_[k]);
    for (const Zone& zone : zones_) mesh_.add_zone(star_faces_[zone.face], zone.vertex);
    if (is_border_) pass_border_zones();
    mesh_.drop_vertex(vertex_);
  }

  void pass_border_zones() {
    const VertexId start = polygon_.vertices[polygon_.size - 1];
    for (VertexId zone = mesh_.first_border_zone(vertex_); zone != no_id;) {
      const VertexId next = mesh_.next_zone(zone);
      mesh_.add_border_zone(start, zone);
      zone = next;
    }
    mesh_.clear_border_zones(vertex_);
    mesh_.add_border_zone(start, vertex_);
  }

  /// A border vertex with a single face: the face goes, its zones pass to the one beyond it.
  bool try_remove_ear() {
    const SideId beyond = beyond_[0];
    if (beyond == no_id || is_sharp_[0]) return false;
    read_zones();
    const FaceId heir = beyond >> 2;
    const Triangle& t = mesh_.face(heir).vertices;
    for (const Zone& zone : zones_)
      if (squared_distance_to_triangle(zone.centre, mesh_.point(t[0]), mesh_.point(t[1]),
                                       mesh_.point(t[2])) > zone.radius2)
        return false;
    mesh_.link(beyond, no_id);
    mesh_.update_first_side(beyond);
    for (const Zone& zone : zones_) mesh_.add_zone(heir, zone.vertex);
    pass_border_zones();
    mesh_.drop_face(star_faces_[0]);
    mesh_.drop_vertex(vertex_);
    return true;
  }

  WorkingMesh& mesh_;
  const SimplifyOptions& options_;
  VertexQueue queue_;
  std::vector<std::uint8_t> corner_;  // of the polygon at hand, or no_corner

  // The star at hand.
  VertexId vertex_ = no_id;
  bool is_border_ = false;
  int face_count_ = 0;
  StarPolygon polygon_;
  std::array<FaceId, max_size> star_faces_;
  std::array<SideId, max_size> beyond_;  // the neighbour's side of polygon side i
  std::array<bool, max_size> is_sharp_;  // polygon side i
  std::array<int, max_size> neighbours_;
  StarTriangulator triangulator_;
  std::vector<StarFace> faces_;
  std::array<const TriangleQuery*, max_size> queries_;  // of faces_
  bool zones_read_ = false;
  bool is_exhausted_ = false;  // no triangulation is left, for any cost
  std::vector<Zone> zones_;
};

bool is_length(double value) { return std::isfinite(value) && value >= 0.0; }

/// The radii to go on with: the new ones, and the old one where a removed vertex had a larger one.
std::vector<double> radii_of(const Mesh& mesh, const ErrorZones& zones,
                             const SimplifyOptions& options) {
  std::vector<double> radii = options.radii;
  if (radii.empty()) {
    if (!options.error_zone) return zones.radii();
    if (zones.removed_count() == 0 ||
        (zones.radii().size() == 1 && zones.radii()[0] <= *options.error_zone))
      return {*options.error_zone};
    radii.assign(mesh.vertex_count(), *options.error_zone);
  }
  const auto keep = [&](std::span<const VertexId> vertices) {
    for (const VertexId v : vertices) radii[v] = std::max(radii[v], zones.radius(v));
  };
  for (FaceId f = 0; f < mesh.face_count(); ++f) keep(zones.of_face(f));
  for (EdgeId e = 0; e < mesh.edge_count(); ++e)
    if (mesh.is_border_edge(e)) keep(zones.of_border_edge(e));
  return radii;
}

}  // namespace

Result<ErrorZonesPtr> zones_or_start(const Mesh& mesh, const ErrorZonesPtr& zones) {
  if (!zones)
    return std::make_shared<const ErrorZones>(ErrorZones::start(mesh, default_error_zone(mesh)));
  if (const Result<void> fits = zones->check(mesh); !fits) return tl::unexpected(fits.error());
  return zones;
}

Result<Prepared> simplify(const Mesh& mesh, const ErrorZonesPtr& zones,
                          const ChunkedArray<Origin>& sharp, const SimplifyOptions& options,
                          const Context& context) {
  if ((options.error_zone && !is_length(*options.error_zone)) ||
      !std::ranges::all_of(options.radii, is_length))
    return fail("The error zone has to be a length, 0 or more.");
  if (!is_length(options.max_edge_length))
    return fail("The longest edge has to be a length; 0 sets no limit.");
  if (!options.radii.empty() && options.radii.size() != mesh.vertex_count())
    return fail("There are " + std::to_string(options.radii.size()) + " error zones for " +
                std::to_string(mesh.vertex_count()) + " vertices: one for each is needed.");
  if (!sharp.empty() && sharp.size() != mesh.edge_count())
    return fail("The sharp edges belong to another mesh: find them again.");
  context.report(0.0, "simplification");
  ErrorZonesPtr start = zones;
  if (!start && options.error_zone)
    start = std::make_shared<const ErrorZones>(ErrorZones::start(mesh, *options.error_zone));
  Result<ErrorZonesPtr> known = zones_or_start(mesh, start);
  if (!known) return tl::unexpected(known.error());

  WorkingMesh working(mesh, **known, sharp);
  working.set_radii(radii_of(mesh, **known, options));
  {
    Simplifier simplifier(working, options);
    if (const Result<void> done = simplifier.run(context.part(0.02, 0.9)); !done)
      return tl::unexpected(done.error());
  }
  Result<Prepared> result = working.finish();
  context.report(1.0, "simplification");
  return result;
}

}  // namespace arris
