#include "core/samples/mould.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/samples/scan_surface.h"

namespace arris {

namespace {

using Eigen::Vector2d;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double line_step = 0.25;      // mm between the points of a true line
constexpr double least_blend = 1.0;     // mm; blends of a smaller radius are called sharp
constexpr double spacing_share = 0.86;  // least distance of two points over the edge length
constexpr double least_angle = 10.0;    // degrees; where a fading line ends

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Rises from 0 to 1 over t in [0, 1], with continuous curvature.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// Closed convex curve of tangent arcs, symmetric about two axes: corner arcs of radius `radius`
/// about (+-corner.x, +-corner.y), joined by flat arcs that pass through (+-half.x, 0) and
/// (0, +-half.y).
class Outline {
 public:
  Outline(const Vector2d& centre, double angle, const Vector2d& half, const Vector2d& corner,
          double radius)
      : centre_(centre), x_axis_(direction(angle)), y_axis_(-x_axis_.y(), x_axis_.x()) {
    const auto flat_radius = [radius](double reach, double along, double aside) {
      const double bulge = reach - along - radius;
      if (bulge <= 0.0) return radius;
      const double rest = reach - along;
      return (aside * aside + rest * rest - radius * radius) / (2.0 * bulge);
    };
    const double right = flat_radius(half.x(), corner.x(), corner.y());
    const double top = flat_radius(half.y(), corner.y(), corner.x());
    const Vector2d right_centre(half.x() - right, 0.0), top_centre(0.0, half.y() - top);
    const auto angle_of = [](const Vector2d& v, double otherwise) {
      return v.norm() < 1e-9 ? otherwise : std::atan2(v.y(), v.x());
    };
    const double from = angle_of(corner - right_centre, 0.0);
    const double to = angle_of(corner - top_centre, pi / 2.0);
    arcs_ = {Arc{right_centre, right, 0.0, from}, Arc{corner, radius, from, to},
             Arc{top_centre, top, to, pi / 2.0}};
  }
  static Outline circle(const Vector2d& centre, double radius) {
    return {centre, 0.0, Vector2d::Constant(radius), Vector2d::Zero(), radius};
  }

  /// Signed distance, negative inside; true up to the depth of the corner arcs' radius.
  double distance(const Vector2d& p) const {
    const Vector2d q(std::abs((p - centre_).dot(x_axis_)), std::abs((p - centre_).dot(y_axis_)));
    const auto left_of = [](const Vector2d& v, double angle) {
      const Vector2d u = direction(angle);
      return u.x() * v.y() - u.y() * v.x() > 0.0;
    };
    const Arc& right = arcs_[0];
    const Arc& top = arcs_[2];
    const Arc& arc = !left_of(q - right.centre, right.to) ? right
                     : left_of(q - top.centre, top.from)  ? top
                                                          : arcs_[1];
    return (q - arc.centre).norm() - arc.radius;
  }

  struct Place {
    Vector2d point;
    Vector2d outward;
  };
  /// Dense points round the curve at distance `offset` from the outline.
  std::vector<Place> places(double offset) const {
    std::vector<Place> result;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
      const bool mirrored = quadrant % 2 == 1;
      for (int k = 0; k < 3; ++k) {
        const Arc& arc = arcs_[mirrored ? 2 - k : k];
        const double radius = arc.radius + offset, sweep = arc.to - arc.from;
        const int steps = static_cast<int>(std::ceil(radius * sweep / line_step));
        for (int i = 0; i < steps; ++i) {
          const double t = sweep * i / steps;
          const Vector2d normal = direction(mirrored ? arc.to - t : arc.from + t);
          const Vector2d p = arc.centre + radius * normal;
          const auto to_plane = [&](const Vector2d& v) -> Vector2d {
            const double x = quadrant == 1 || quadrant == 2 ? -v.x() : v.x();
            const double y = quadrant >= 2 ? -v.y() : v.y();
            return x * x_axis_ + y * y_axis_;
          };
          result.push_back({centre_ + to_plane(p), to_plane(normal)});
        }
      }
    }
    return result;
  }

 private:
  struct Arc {
    Vector2d centre;
    double radius, from, to;
  };
  Vector2d centre_, x_axis_, y_axis_;
  std::array<Arc, 3> arcs_;  ///< Right, corner and top in the first quadrant.
};

/// Where a profile bends: at distance d from the outline and height z, with a blend of `radius`.
struct Bend {
  double d, z, radius;
  std::string name;
};

/// Height over the distance from an outline: straight between bends, flat beyond the first and the
/// last. `areas[k]` names the part before bend k; empty names belong to what lies below.
class Profile {
 public:
  Profile(std::vector<Bend> bends, std::vector<std::string> areas)
      : bends_(std::move(bends)), areas_(std::move(areas)) {
    const auto slope = [&](std::size_t k) {  // of the part before bend k
      if (k == 0 || k == bends_.size()) return 0.0;
      return std::atan2(bends_[k].z - bends_[k - 1].z, bends_[k].d - bends_[k - 1].d);
    };
    for (std::size_t k = 0; k < bends_.size(); ++k) {
      const double before = slope(k), after = slope(k + 1);
      const double tangent = bends_[k].radius * std::tan(std::abs(after - before) / 2.0);
      const double from = bends_[k].d - tangent * std::cos(before);
      const double height = bends_[k].z - tangent * std::sin(before);
      const double side = after > before ? 1.0 : -1.0;  // of the arc's centre
      blends_.push_back({from, bends_[k].d + tangent * std::cos(after),
                         from - side * bends_[k].radius * std::sin(before),
                         height + side * bends_[k].radius * std::cos(before), side,
                         std::tan(before)});
    }
  }

  double height(double d) const {
    for (std::size_t k = 0; k < bends_.size(); ++k) {
      const Blend& blend = blends_[k];
      if (d <= blend.from) return bends_[k].z + (d - bends_[k].d) * blend.slope_before;
      if (d < blend.to) {
        const double r = bends_[k].radius, x = d - blend.centre_d;
        return blend.centre_z - blend.side * std::sqrt(r * r - x * x);
      }
    }
    return bends_.back().z;
  }

  const std::string& area(double d) const {
    for (std::size_t k = 0; k < bends_.size(); ++k) {
      const bool sharp = is_sharp(k);
      if (d <= (sharp ? bends_[k].d : blends_[k].from)) return areas_[k];
      if (!sharp && d < blends_[k].to) return bends_[k].name;
    }
    return areas_.back();
  }

  const std::vector<Bend>& bends() const { return bends_; }
  bool is_sharp(std::size_t k) const { return bends_[k].radius < least_blend; }
  double blend_from(std::size_t k) const { return blends_[k].from; }
  double blend_to(std::size_t k) const { return blends_[k].to; }

 private:
  struct Blend {
    double from, to, centre_d, centre_z, side, slope_before;
  };
  std::vector<Bend> bends_;
  std::vector<Blend> blends_;
  std::vector<std::string> areas_;
};

struct Feature {
  Outline outline;
  Profile profile;
};

/// The step that fades out: along x, its foot and its edge a wall of lessening height apart.
namespace step {

constexpr double fade_from = 34.0, fade_to = -14.0;  // x where the height starts to fall, and is 0
constexpr double full_height = 3.2;

double height(double x) { return full_height * smooth_step((x - fade_to) / (fade_from - fade_to)); }
/// Of the wall seen from above: 10 degrees of draft at full height, gentler as the step fades.
double width(double x) {
  const double faded = 1.0 - height(x) / full_height;
  return full_height * std::tan(10.0 * degree) + 1.8 * faded;
}
double edge_y(double x) { return -33.0 + 0.0025 * (x - 18.0) * (x - 18.0); }
double foot_y(double x) { return edge_y(x) + width(x); }
/// The raised side runs out into the base again.
double raise(const Vector2d& p) {
  const double beyond = edge_y(p.x()) - p.y();
  const double wall = std::clamp(1.0 + beyond / width(p.x()), 0.0, 1.0);
  return height(p.x()) * wall * (1.0 - smooth_step((beyond - 5.0) / 17.0));
}
bool on_wall(const Vector2d& p) {
  return p.y() > edge_y(p.x()) && p.y() < foot_y(p.x()) &&
         height(p.x()) > width(p.x()) * std::tan(least_angle * degree);
}

}  // namespace step

/// The part without noise.
class Part {
 public:
  explicit Part(std::uint64_t seed) : border_({0.0, 0.0}, 0.0, {53.1, 51.2}, {36.6, 35.2}, 14.0) {
    const auto run = [](double height, double angle) { return height / std::tan(angle * degree); };
    constexpr double tilt = 6.0 * degree;
    const double draft = 80.0;
    features_.push_back(
        {Outline({-12.0, 9.0}, tilt, {32.0, 25.0}, {20.5, 13.8}, 10.0),
         Profile({{-run(7.0, draft), 7.0, 0.0, "boss edge"}, {0.0, 0.0, 0.0, "boss foot"}},
                 {"boss top", "boss wall", ""})});
    features_.push_back({Outline({-12.5, 8.5}, tilt, {19.0, 12.5}, {10.0, 0.0}, 9.0),
                         Profile({{-run(3.0, 38.0), 1.0, 6.0, "cushion blend"},
                                  {0.0, -2.0, 0.6, "oval line"},
                                  {run(2.0, 38.0), 0.0, 3.0, "groove blend"}},
                                 {"cushion", "inner flank", "outer flank", ""})});
    features_.push_back(
        {Outline({39.0, 16.0}, -4.0 * degree, {8.5, 17.0}, {1.0, 9.0}, 7.2),
         Profile({{-run(4.5, 55.0), 4.5, 3.0, "pad top blend"}, {0.0, 0.0, 6.0, "pad foot blend"}},
                 {"pad top", "pad wall", ""})});
    features_.push_back(
        {Outline::circle({-36.0, -33.0}, 5.5),
         Profile({{-run(4.0, 82.0), 4.0, 2.0, "stub blend"}, {0.0, 0.0, 0.0, "stub foot"}},
                 {"stub top", "stub wall", ""})});
    Random random(seed);
    for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
  }

  double height(const Vector2d& p) const {
    const double x = p.x(), y = p.y();
    double z = 6.5 - x * x / 360.0 - y * y / 480.0 +
               0.9 * std::sin(x / 17.0 + 0.4) * std::cos(y / 21.0 - 0.3) + x * y / 900.0;
    z += step::raise(p);
    for (const Feature& feature : features_)
      z += feature.profile.height(feature.outline.distance(p));
    return z;
  }
  Point lift(const Vector2d& p) const { return {p.x(), p.y(), height(p)}; }

  Point normal(const Vector2d& p) const {
    constexpr double h = 1e-3;
    const Vector2d dx(h, 0.0), dy(0.0, h);
    return Point(height(p - dx) - height(p + dx), height(p - dy) - height(p + dy), 2.0 * h)
        .normalized();
  }

  /// Inside the ragged border.
  bool inside(const Vector2d& p) const {
    constexpr std::array<double, 4> waves{9.0, 37.0, 101.0, 151.0};  // round the part
    constexpr std::array<double, 4> sizes{0.3, 0.25, 0.2, 0.15};     // mm
    const double angle = std::atan2(p.y(), p.x());
    double ragged = border_.distance(p);
    for (std::size_t k = 0; k < waves.size(); ++k)
      ragged += sizes[k] * std::sin(waves[k] * angle + phases_[k]);
    return ragged < 0.0;
  }

  std::string area(const Vector2d& p) const {
    std::string name = step::on_wall(p) ? "step wall" : "base";
    for (const Feature& feature : features_) {
      const std::string& own = feature.profile.area(feature.outline.distance(p));
      if (!own.empty()) name = own;
    }
    return name;
  }

  std::vector<TrueLine> lines() const {
    std::vector<TrueLine> result;
    for (const Feature& feature : features_) {
      const Profile& profile = feature.profile;
      for (std::size_t k = 0; k < profile.bends().size(); ++k) {
        const Bend& bend = profile.bends()[k];
        const double from = profile.blend_from(k), to = profile.blend_to(k);
        if (profile.is_sharp(k)) {
          result.push_back(line(bend.name, feature.outline.places(bend.d), bend.d - from));
          result.back().closed = true;
          continue;
        }
        for (const auto& [name, d] :
             {std::pair("inner border", from), std::pair("outer border", to)}) {
          TrueLine border = line(bend.name + ", " + name, feature.outline.places(d), 0.0);
          border.closed = true;
          border.fillet = true;
          border.angle = 0.0;
          result.push_back(std::move(border));
        }
      }
    }
    const auto add_step_line = [&](const std::string& name, double (*y)(double)) {
      std::vector<Outline::Place> places;
      for (double x = 60.0; x > step::fade_to; x -= line_step) {
        const Outline::Place place{{x, y(x)}, Vector2d::UnitY()};
        if (inside(place.point) && std::abs(angle(place, 0.0)) >= least_angle)
          places.push_back(place);
      }
      result.push_back(line(name, places, 0.0));
    };
    add_step_line("step edge", step::edge_y);
    add_step_line("step foot", step::foot_y);
    return result;
  }

 private:
  /// Exterior angle in degrees across a line, read `blend` off it on either side.
  double angle(const Outline::Place& place, double blend) const {
    const Vector2d aside = (blend + 5e-3) * place.outward;
    const Vector2d inner = place.point - aside, outer = place.point + aside;
    const Point a = normal(inner), b = normal(outer);
    const bool convex = height(place.point) > (height(inner) + height(outer)) / 2.0;
    return (convex ? 1.0 : -1.0) * std::atan2(a.cross(b).norm(), a.dot(b)) / degree;
  }

  TrueLine line(const std::string& name, const std::vector<Outline::Place>& places,
                double blend) const {
    TrueLine result;
    result.name = name;
    for (const Outline::Place& place : places) {
      result.points.push_back(lift(place.point));
      const double here = angle(place, blend);
      if (std::abs(here) > std::abs(result.angle)) result.angle = here;
    }
    return result;
  }

  Outline border_;
  std::vector<Feature> features_;
  std::array<double, 4> phases_;
};

/// For each point the index of the sharp line nearest to it within `reach`, or -1.
std::vector<std::int32_t> nearest_lines(const std::vector<Point>& points,
                                        const std::vector<TrueLine>& lines, double reach) {
  std::vector<std::int32_t> result(points.size(), -1);
  std::vector<double> best(points.size(), reach * reach);
  std::vector<VertexId> by_x(points.size());
  for (VertexId v = 0; v < by_x.size(); ++v) by_x[v] = v;
  std::ranges::sort(by_x, {}, [&](VertexId v) { return std::pair(points[v].x(), v); });
  for (std::size_t l = 0; l < lines.size(); ++l) {
    if (lines[l].fillet) continue;
    const std::vector<Point>& chain = lines[l].points;
    for (std::size_t i = 0; i < chain.size() - (lines[l].closed ? 0 : 1); ++i) {
      const Point& a = chain[i];
      const Point along = chain[(i + 1) % chain.size()] - a;
      const auto x_of = [&](VertexId v) { return points[v].x(); };
      const double low = a.x() + std::min(0.0, along.x()) - reach;
      const double high = a.x() + std::max(0.0, along.x()) + reach;
      for (auto v = std::ranges::lower_bound(by_x, low, {}, x_of);
           v != by_x.end() && points[*v].x() <= high; ++v) {
        const Point offset = points[*v] - a;
        const double t = std::clamp(offset.dot(along) / along.squaredNorm(), 0.0, 1.0);
        const double distance = (offset - t * along).squaredNorm();
        if (distance >= best[*v]) continue;
        best[*v] = distance;
        result[*v] = static_cast<std::int32_t>(l);
      }
    }
  }
  return result;
}

}  // namespace

SampleMould make_mould(const MouldOptions& options) {
  const double length = options.edge_length >= 0.1 ? std::min(options.edge_length, 5.0) : 0.1;
  const double noise = options.noise >= 0.0 ? options.noise : 0.0;
  Random seeds(options.seed);
  const Part part(seeds.bits());
  const HeightField field{[&](const Vector2d& p) { return part.height(p); },
                          [&](const Vector2d& p) { return part.inside(p); },
                          {-56.0, -54.0},
                          {56.0, 54.0}};
  ScannedSurface scan = scan_height_field(field, spacing_share * length, seeds.bits());

  SampleMould mould;
  mould.lines = part.lines();
  mould.vertex_lines = nearest_lines(scan.points, mould.lines, length / 2.0);
  mould.face_areas.reserve(scan.triangles.size());
  for (const Triangle& t : scan.triangles) {
    const Point centre = (scan.points[t[0]] + scan.points[t[1]] + scan.points[t[2]]) / 3.0;
    const std::string name = part.area(centre.head<2>());
    auto place = std::ranges::find(mould.area_names, name);
    if (place == mould.area_names.end()) place = mould.area_names.insert(place, name);
    mould.face_areas.push_back(static_cast<std::uint32_t>(place - mould.area_names.begin()));
  }
  Random random(seeds.bits());
  for (Point& p : scan.points) p += noise * random.gaussian() * part.normal(p.head<2>());
  mould.points = std::move(scan.points);
  mould.triangles = std::move(scan.triangles);
  return mould;
}

}  // namespace arris
