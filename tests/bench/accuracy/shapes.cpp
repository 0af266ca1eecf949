#include "tests/bench/accuracy/shapes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/number_text.h"
#include "core/samples/mould.h"
#include "core/samples/scan_surface.h"
#include "tests/bench/accuracy/curves.h"
#include "tests/bench/accuracy/kd_tree.h"
#include "tests/bench/accuracy/resample.h"

namespace arris::accuracy {

namespace {

using Eigen::Vector2d;

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::array<std::uint32_t, 6> block_faces{1, 2, 3, 4, 5, 6};
/// Of the block that features sit on, mm.
const Point block_high(40.0, 32.0, 24.0);

CleanPart scanned(const Solid& solid, const Point& low, const Point& high, double edge,
                  std::vector<TrueCurve> curves) {
  CleanPart part{resample(solid, low, high, edge), {std::move(curves), {}, {}}};
  const testing::Triangles& mesh = part.mesh;
  for (const Triangle& t : mesh.triangles) {
    const Point centre = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
    part.truth.patches.push_back(solid(centre).face);
  }
  return part;
}

CleanPart make_box(double edge) {
  return scanned(block(Point::Zero(), block_high, block_faces), Point::Zero(), block_high, edge,
                 block_edges(Point::Zero(), block_high));
}

/// A block whose top has a vertical step of `step` mm across the middle.
CleanPart make_step(double edge, double step) {
  const double x = 20.0, z = 12.0;
  const Point low_high(40.0, 32.0, z), raised_low(x, 0.0, 0.0), raised_high(40.0, 32.0, z + step);
  const Solid solid = united({block(Point::Zero(), low_high, block_faces),
                              block(raised_low, raised_high, {7, 2, 3, 4, 5, 8})});
  const double y = low_high.y(), right = low_high.x(), top = z + step;
  std::vector<TrueCurve> curves;
  // The outline of the two sides, and what joins its corners.
  const std::vector<Vector2d> outline{{0, 0}, {right, 0}, {right, top}, {x, top}, {x, z}, {0, z}};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector2d &a = outline[k], &b = outline[(k + 1) % outline.size()];
    for (const double side : {0.0, y})
      curves.push_back(segment({a.x(), side, a.y()}, {b.x(), side, b.y()}, 90.0));
    curves.push_back(segment({a.x(), 0.0, a.y()}, {a.x(), y, a.y()}, 90.0));
  }
  return scanned(solid, Point::Zero(), raised_high, edge, std::move(curves));
}

/// A block with one edge cut off by a chamfer of 45 degrees that is `width` mm wide.
CleanPart make_chamfer(double edge, double width) {
  const double leg = width / std::numbers::sqrt2;
  const double x = block_high.x(), y = block_high.y(), z = block_high.z();
  const Solid solid = common({block(Point::Zero(), block_high, block_faces),
                              half_space({x - leg, 0.0, z}, {1.0, 0.0, 1.0}, 7)});
  std::vector<TrueCurve> curves;
  const std::vector<Vector2d> outline{{0, 0}, {x, 0}, {x, z - leg}, {x - leg, z}, {0, z}};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector2d &a = outline[k], &b = outline[(k + 1) % outline.size()];
    for (const double side : {0.0, y})
      curves.push_back(segment({a.x(), side, a.y()}, {b.x(), side, b.y()}, 90.0));
    const bool beside_chamfer = k == 2 || k == 3;
    curves.push_back(segment({a.x(), 0.0, a.y()}, {a.x(), y, a.y()}, beside_chamfer ? 45.0 : 90.0));
  }
  return scanned(solid, Point::Zero(), block_high, edge, std::move(curves));
}

/// A flat block with a rib of `width` mm, five edges high.
CleanPart make_rib(double edge, double width) {
  const Point base_high(40.0, 32.0, 12.0);
  const Point low(20.0 - width / 2.0, 6.0, 0.0);
  const Point high(20.0 + width / 2.0, 26.0, base_high.z() + 5.0 * edge);
  const Solid solid = united(
      {block(Point::Zero(), base_high, block_faces), block(low, high, {7, 8, 9, 10, 5, 11})});
  std::vector<TrueCurve> curves = block_edges(Point::Zero(), base_high);
  const std::vector<TrueCurve> rib =
      block_edges({low.x(), low.y(), base_high.z()}, high);  // its foot included
  curves.insert(curves.end(), rib.begin(), rib.end());
  return scanned(solid, Point::Zero(), {base_high.x(), base_high.y(), high.z()}, edge,
                 std::move(curves));
}

/// A plate, eight edges thick, with a round hole of `radius` mm through it.
CleanPart make_hole(double edge, double radius) {
  const Point low(-20.0, -16.0, 0.0), high(20.0, 16.0, 8.0 * edge);
  const Solid drill = cylinder(radius, 7);
  const Solid solid = common({block(low, high, block_faces), [drill](const Point& p) {
                                const SurfaceValue value = drill(p);
                                return SurfaceValue{-value.distance, value.face};
                              }});
  std::vector<TrueCurve> curves = block_edges(low, high);
  for (const double z : {low.z(), high.z()}) curves.push_back(circle(radius, z, 90.0));
  return scanned(solid, low, high, edge, std::move(curves));
}

/// A plate with a round pin of `radius` mm on it, eight edges high.
CleanPart make_pin(double edge, double radius) {
  const Point low(-20.0, -16.0, 0.0), high(20.0, 16.0, 10.0);
  const double top = high.z() + 8.0 * edge;
  const Solid solid = united({block(low, high, block_faces),
                              common({cylinder(radius, 7), half_space(low, -Point::UnitZ(), 5),
                                      half_space({0.0, 0.0, top}, Point::UnitZ(), 8)})});
  std::vector<TrueCurve> curves = block_edges(low, high);
  for (const double z : {high.z(), top}) curves.push_back(circle(radius, z, 90.0));
  return scanned(solid, low, {high.x(), high.y(), top}, edge, std::move(curves));
}

/// A block with one edge rounded by a fillet. At a radius of one edge of the mesh a scan shows no
/// more than a sharp line, at two either, from four on a surface of its own.
CleanPart make_fillet(double edge, double edges) {
  const double radius = edges * edge;
  const double x = block_high.x(), y = block_high.y(), z = block_high.z();
  const double far = 2.0 * block_high.maxCoeff();
  const Solid solid = common({block(Point(0.0, 0.0, 0.0), Point(far, y, far), block_faces),
                              rounded(half_space(block_high, Point::UnitX(), 2),
                                      half_space(block_high, Point::UnitZ(), 6), radius, 7)});
  std::vector<TrueCurve> curves;
  const auto along_y = [&](double at_x, double at_z, Demand demand, double angle) {
    curves.push_back(segment({at_x, 0.0, at_z}, {at_x, y, at_z}, angle, demand));
  };
  along_y(0.0, 0.0, Demand::must, 90.0);
  along_y(x, 0.0, Demand::must, 90.0);
  along_y(0.0, z, Demand::must, 90.0);
  const double inset = radius * (1.0 - std::numbers::sqrt2 / 2.0);
  if (edges <= 2.0) along_y(x - inset, z - inset, edges <= 1.0 ? Demand::must : Demand::may, 90.0);
  if (edges > 1.0) {
    along_y(x - radius, z, Demand::may, 0.0);
    along_y(x, z - radius, Demand::may, 0.0);
  }
  for (const double side : {0.0, y}) {
    curves.push_back(segment({0.0, side, 0.0}, {x, side, 0.0}, 90.0));
    curves.push_back(segment({0.0, side, 0.0}, {0.0, side, z}, 90.0));
    curves.push_back(segment({0.0, side, z}, {x - radius, side, z}, 90.0));
    curves.push_back(segment({x, side, 0.0}, {x, side, z - radius}, 90.0));
    curves.push_back(
        arc({x - radius, side, z - radius}, Point::UnitX(), Point::UnitZ(), radius, 0.25, 90.0));
  }
  CleanPart part = scanned(solid, Point::Zero(), block_high, edge, std::move(curves));
  if (edges > 1.0) return part;
  for (FaceId f = 0; f < part.truth.patches.size(); ++f) {  // half to either side
    if (part.truth.patches[f] != 7) continue;
    const Triangle& t = part.mesh.triangles[f];
    const Point centre =
        (part.mesh.points[t[0]] + part.mesh.points[t[1]] + part.mesh.points[t[2]]) / 3.0;
    part.truth.patches[f] = x - centre.x() < z - centre.z() ? 2 : 6;
  }
  return part;
}

CleanPart make_cone(double edge) {
  const double radius = 20.0, height = 34.0;
  const Solid solid =
      common({cone(radius, height, 1), half_space(Point::Zero(), -Point::UnitZ(), 2)});
  const double angle = 180.0 - std::atan2(height, radius) / degree;
  return scanned(
      solid, {-radius, -radius, 0.0}, {radius, radius, height}, edge,
      {circle(radius, 0.0, angle),
       // The tip: what is found within two edges of it counts neither way.
       segment({0.0, 0.0, height - 2.0 * edge}, {0.0, 0.0, height}, angle, Demand::may)});
}

CleanPart make_cylinder(double edge) {
  const double radius = 15.0, height = 30.0;
  const Solid solid = common({cylinder(radius, 1), half_space(Point::Zero(), -Point::UnitZ(), 2),
                              half_space({0.0, 0.0, height}, Point::UnitZ(), 3)});
  return scanned(solid, {-radius, -radius, 0.0}, {radius, radius, height}, edge,
                 {circle(radius, 0.0, 90.0), circle(radius, height, 90.0)});
}

CleanPart make_sphere(double edge) {
  const double radius = 18.0;
  return scanned(ball(Point::Zero(), radius, 1), Point::Constant(-radius), Point::Constant(radius),
                 edge, {});
}

CleanPart make_torus(double edge) {
  const double major = 20.0, minor = 8.0;
  return scanned(ring(major, minor, 1), {-major - minor, -major - minor, -minor},
                 {major + minor, major + minor, minor}, edge, {});
}

Solid moved(Solid solid, const Point& by) {
  return [solid = std::move(solid), by](const Point& p) { return solid(p - by); };
}

std::vector<TrueCurve> moved(std::vector<TrueCurve> curves, const Point& by) {
  for (TrueCurve& curve : curves)
    for (Point& p : curve.points) p += by;
  return curves;
}

/// A plate of 60 mm with a boss, a dome on it, a post and a frustum: 16 faces of four kinds.
CleanPart make_machined(double edge) {
  const Point plate(60.0, 44.0, 10.0), boss_low(6.0, 6.0, 0.0), boss_high(26.0, 38.0, 18.0);
  const Point post(43.0, 13.0, 0.0), frustum(43.0, 31.0, 0.0), dome(16.0, 22.0, 14.0);
  constexpr double top = 20.0, post_radius = 8.0, dome_radius = 7.0;
  constexpr double foot = 12.0, tip = 36.0;  // of the cone that the frustum is of, from z = 0
  const auto radius_at = [&](double z) { return foot * (1.0 - z / tip); };
  const Solid solid = united(
      {block(Point::Zero(), plate, block_faces), block(boss_low, boss_high, {7, 8, 9, 10, 5, 11}),
       moved(common({cylinder(post_radius, 12), half_space(Point::Zero(), -Point::UnitZ(), 5),
                     half_space({0.0, 0.0, top}, Point::UnitZ(), 13)}),
             post),
       moved(common({cone(foot, tip, 14), half_space(Point::Zero(), -Point::UnitZ(), 5),
                     half_space({0.0, 0.0, top}, Point::UnitZ(), 15)}),
             frustum),
       common({ball(dome, dome_radius, 16), half_space({0.0, 0.0, 9.0}, -Point::UnitZ(), 5)})});
  std::vector<TrueCurve> curves = block_edges(Point::Zero(), plate);
  const auto add = [&](std::vector<TrueCurve> more) {
    std::ranges::move(more, std::back_inserter(curves));
  };
  add(block_edges({boss_low.x(), boss_low.y(), plate.z()}, boss_high));
  add(moved({circle(post_radius, plate.z(), 90.0), circle(post_radius, top, 90.0)}, post));
  const double lean = std::atan2(foot, tip) / degree;
  add(moved({circle(radius_at(plate.z()), plate.z(), 90.0 - lean),
             circle(radius_at(top), top, 90.0 - lean)},
            frustum));
  const double rise = boss_high.z() - dome.z();
  add(moved({circle(std::sqrt(dome_radius * dome_radius - rise * rise), boss_high.z(),
                    std::acos(rise / dome_radius) / degree)},
            {dome.x(), dome.y(), 0.0}));
  return scanned(solid, Point::Zero(), {plate.x(), plate.y(), 21.0}, edge, std::move(curves));
}

/// An open sheet of 40 mm by 40 mm.
testing::Triangles sheet(const std::function<double(const Vector2d&)>& height, double edge) {
  constexpr double half = 20.0;           // mm
  constexpr double edges_per_gap = 1.41;  // mean edge over the least distance of points; measured
  const HeightField field{height, [](const Vector2d& p) { return p.cwiseAbs().maxCoeff() < half; },
                          Vector2d::Constant(-half), Vector2d::Constant(half)};
  ScannedSurface scan = scan_height_field(field, edge / edges_per_gap, 1);
  return {std::move(scan.points), std::move(scan.triangles)};
}

CleanPart smooth_sheet(const std::function<double(const Vector2d&)>& height, double edge) {
  CleanPart part{sheet(height, edge), {}};
  part.truth.patches.assign(part.mesh.triangles.size(), 1);
  return part;
}

CleanPart make_plane(double edge) {
  return smooth_sheet([](const Vector2d&) { return 0.0; }, edge);
}

CleanPart make_saddle(double edge) {
  return smooth_sheet([](const Vector2d& p) { return (p.x() * p.x() - p.y() * p.y()) / 60.0; },
                      edge);
}

/// A free-form sheet with a fold that is sharp at one side of the sheet and fades to nothing before
/// it reaches the other.
namespace fold {

constexpr double largest = 60.0;                     // degrees
constexpr double full_to = -18.0, none_from = 14.0;  // x, mm

double turn(double x) {  // radians
  const double t = std::clamp((x - full_to) / (none_from - full_to), 0.0, 1.0);
  return largest * degree * (1.0 - t * t * (3.0 - 2.0 * t));
}
double middle(double x) { return 1.5 * std::sin(x / 9.0); }
double height(const Vector2d& p) {
  const double base = 1.2 * std::sin(p.x() / 11.0 + 0.5) * std::cos(p.y() / 13.0);
  return base - std::tan(turn(p.x()) / 2.0) * std::abs(p.y() - middle(p.x()));
}
/// Jump of the normal in degrees across the fold.
double jump(double x) {
  constexpr double h = 1e-4;
  const auto normal = [&](double side) {
    const Vector2d p(x, middle(x) + side * 4.0 * h);
    const Vector2d dx(h, 0.0), dy(0.0, h);
    return Point(height(p - dx) - height(p + dx), height(p - dy) - height(p + dy), 2.0 * h);
  };
  const Point a = normal(1.0), b = normal(-1.0);
  return std::atan2(a.cross(b).norm(), a.dot(b)) / degree;
}

}  // namespace fold

/// Cuts a line along which the jump varies where its demand changes; a jump that may not be found
/// leaves a gap. `angles`: degrees, per point.
void add_by_angle(const Polyline& points, const std::vector<double>& angles,
                  std::vector<TrueCurve>& curves) {
  const auto level = [&](std::size_t k) {
    return angles[k] >= must_angle ? 2 : angles[k] >= may_angle ? 1 : 0;
  };
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const int here = level(k);
    if (here == 0) continue;
    if (k == 0 || level(k - 1) != here)
      curves.push_back({{points[k]}, here == 2 ? Demand::must : Demand::may, 0.0});
    TrueCurve& curve = curves.back();
    curve.points.push_back(points[k + 1]);
    curve.angle = std::max(curve.angle, angles[k]);
  }
}

CleanPart make_fading_fold(double edge) {
  CleanPart part{sheet(fold::height, edge), {}};
  Polyline line;
  std::vector<double> angles;
  for (double x = -20.0; x <= 20.0; x += 0.1) {
    const Vector2d p(x, fold::middle(x));
    line.emplace_back(p.x(), p.y(), fold::height(p));
    angles.push_back(fold::jump(x));
  }
  add_by_angle(line, angles, part.truth.curves);
  return part;  // where the fold ends the sheet is one: no patches are true
}

/// The jump in degrees along a line of the sample, measured on its mesh without noise: the angle
/// between the mean normals of the two areas that share most of its neighbourhood.
std::vector<double> measured_jumps(const SampleMould& mould, const TrueLine& line) {
  constexpr double reach = 1.6;  // mm
  std::vector<Point> centres, normals;
  for (const Triangle& t : mould.triangles) {
    const Point &a = mould.points[t[0]], &b = mould.points[t[1]], &c = mould.points[t[2]];
    centres.push_back((a + b + c) / 3.0);
    normals.push_back((b - a).cross(c - a));
  }
  const KdTree tree(line.points);
  std::vector<std::vector<Point>> sums(line.points.size(),
                                       std::vector<Point>(mould.area_names.size(), Point::Zero()));
  for (std::size_t f = 0; f < centres.size(); ++f)
    if (const KdTree::Hit hit = tree.nearest(centres[f], reach); hit.index != no_id)
      sums[hit.index][mould.face_areas[f]] += normals[f];
  constexpr std::size_t along = 16;  // points of the line on either side, 0.25 mm each
  std::vector<double> jumps;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    std::vector<Point> windows(mould.area_names.size(), Point::Zero());
    for (std::size_t i = k > along ? k - along : 0; i <= std::min(k + along, sums.size() - 1); ++i)
      for (std::size_t area = 0; area < windows.size(); ++area) windows[area] += sums[i][area];
    std::ranges::sort(windows, std::greater(), [](const Point& sum) { return sum.norm(); });
    jumps.push_back(std::atan2(windows[0].cross(windows[1]).norm(), windows[0].dot(windows[1])) /
                    degree);
  }
  return jumps;
}

CleanPart make_sample(double edge) {
  MouldOptions options;
  options.edge_length = edge / 1.22;  // its mean edge is about 1.22 of what is asked for
  options.noise = 0.0;
  SampleMould mould = make_mould(options);
  CleanPart part;
  for (const TrueLine& line : mould.lines) {
    TrueCurve curve{line.points, Demand::may, std::abs(line.angle)};
    if (line.closed) curve.points.push_back(line.points.front());
    if (!line.fillet && line.closed) curve.demand = Demand::must;
    if (line.fillet || line.closed)
      part.truth.curves.push_back(std::move(curve));
    else
      add_by_angle(line.points, measured_jumps(mould, line), part.truth.curves);
  }
  part.truth.patches = std::move(mould.face_areas);
  part.mesh = {std::move(mould.points), std::move(mould.triangles)};
  return part;
}

}  // namespace

Shape machined_part() { return {"machined", make_machined}; }

std::vector<Shape> scanned_shapes() {
  std::vector<Shape> shapes{{"box", make_box}};
  const auto add = [&](const std::string& name, std::initializer_list<double> sizes,
                       CleanPart (*make)(double, double)) {
    for (const double size : sizes)
      shapes.push_back({name + "_" + number_text(size),
                        [make, size](double edge) { return make(edge, size * edge); }});
  };
  add("step", {2.0, 4.0, 8.0}, make_step);
  add("chamfer", {2.0, 3.0, 4.0}, make_chamfer);
  add("rib", {2.0, 3.0, 4.0}, make_rib);
  add("hole", {1.5, 2.0, 3.0, 4.0}, make_hole);
  add("pin", {1.5, 2.0, 3.0, 4.0}, make_pin);
  for (const double radius : {1.0, 2.0, 4.0, 8.0})
    shapes.push_back({"fillet_" + number_text(radius),
                      [radius](double edge) { return make_fillet(edge, radius); }});
  const std::vector<Shape> others{{"cone", make_cone},
                                  {"cylinder", make_cylinder},
                                  {"sphere", make_sphere},
                                  {"torus", make_torus},
                                  {"plane", make_plane},
                                  {"saddle", make_saddle},
                                  {"fading_fold", make_fading_fold},
                                  {"sample", make_sample}};
  shapes.insert(shapes.end(), others.begin(), others.end());
  return shapes;
}

}  // namespace arris::accuracy
