#include "tests/bench/accuracy/cases.h"

#include <memory>
#include <utility>

#include "core/base/hash.h"
#include "core/base/number_text.h"
#include "core/base/random.h"
#include "tests/bench/accuracy/shapes.h"

namespace arris::accuracy {

namespace {

constexpr std::pair<const char*, double> densities[] = {  // mean edge in mm, of parts of 40 mm
    {"coarse", 2.0},
    {"medium", 1.25},
    {"fine", 0.8}};
constexpr double noises[] = {0.0, 0.05, 0.1, 0.3};  // mean edges
constexpr double lines_reach = 1.5;                 // mean edges
/// On a clean tessellation a line must run along the true edge, whatever the length of the edges:
/// shares of the diagonal.
constexpr double exact_reach = 1.0 / 500.0;

/// Gaussian noise along the normals; `sigma` in mm.
std::vector<Point> with_noise(const testing::Triangles& mesh, double sigma, std::uint64_t seed) {
  std::vector<Point> normals(mesh.points.size(), Point::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Point normal =
        (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    for (const VertexId v : t) normals[v] += normal;
  }
  Random random(seed);
  std::vector<Point> points = mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v] += sigma * random.gaussian() * normals[v].normalized();
  return points;
}

/// A scan may leave faces of the mesh out: the truth of those that stay.
Result<Part> part_of(const CleanPart& clean, std::vector<Point> points) {
  Result<ScanPtr> scan = scan_of(std::move(points), clean.mesh.triangles);
  if (!scan) return tl::unexpected<Error>(scan.error());
  Part part;
  part.scan = std::move(*scan);
  part.truth.curves = clean.truth.curves;
  if (!clean.truth.patches.empty())
    for (const std::uint32_t f : part.scan->source_faces)
      part.truth.patches.push_back(clean.truth.patches[f]);
  return part;
}

/// The last shape made, which cases of more noise take over.
struct Memo {
  std::string name;
  CleanPart part;
  double mean_edge = 0.0;
};

Result<Part> make_scanned(const Shape& shape, double edge, double noise, const std::string& key,
                          const std::string& name, Memo& memo) {
  if (memo.name != key) {
    memo.part = shape.make(edge);
    const Result<ScanPtr> clean = scan_of(memo.part.mesh.points, memo.part.mesh.triangles);
    if (!clean) return tl::unexpected<Error>(clean.error());
    memo.mean_edge = mean_inner_edge(*(*clean)->mesh);
    memo.name = key;
  }
  Result<Part> part = part_of(memo.part, with_noise(memo.part.mesh, noise * memo.mean_edge,
                                                    hash_bytes(name.data(), name.size())));
  if (!part) return part;
  part->edge = memo.mean_edge;
  part->tolerance = lines_reach * part->edge;
  return part;
}

Result<Part> make_clean(const CadMesh& cad) {
  const CleanPart clean = cad.make();
  Result<Part> part = part_of(clean, clean.mesh.points);
  if (!part) return part;
  part->tolerance = exact_reach * part->scan->mesh->diagonal();
  part->edge = part->tolerance / lines_reach;
  return part;
}

}  // namespace

std::vector<Case> generated_cases() {
  std::vector<Case> cases;
  const auto memo = std::make_shared<Memo>();
  for (const Shape& shape : scanned_shapes())
    for (const auto& [density, edge] : densities)
      for (const double noise : noises) {
        const std::string key = shape.name + "-" + density;
        const std::string level = number_text(noise, 3);
        const std::string name = key + "-n" + level;
        cases.push_back({name,
                         {"generated, noise " + level, "generated, " + shape.name},
                         [shape, edge = edge, noise, key, name, memo] {
                           return make_scanned(shape, edge, noise, key, name, *memo);
                         }});
      }
  for (const CadMesh& cad : cad_meshes())
    cases.push_back({cad.name, {"generated, clean CAD"}, [cad] { return make_clean(cad); }});
  return cases;
}

}  // namespace arris::accuracy
