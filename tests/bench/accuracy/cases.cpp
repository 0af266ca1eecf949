#include "tests/bench/accuracy/cases.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "core/base/hash.h"
#include "core/base/number_text.h"
#include "core/base/random.h"
#include "tests/bench/accuracy/shapes.h"

namespace arris::accuracy {

namespace {

struct Sampling {
  const char* name;
  double edge;  ///< Mean edge in mm, of parts of 40 mm.
  int blur;     ///< Rounds of smoothing, as an optic blurs: two round an edge by about one edge.
};
constexpr Sampling samplings[] = {
    {"coarse", 2.0, 0}, {"medium", 1.25, 0}, {"fine", 0.8, 0}, {"blurred", 1.25, 2}};
constexpr double noises[] = {0.0, 0.05, 0.1, 0.3};  // mean edges
constexpr double lines_reach = 1.5;                 // mean edges
/// On a clean tessellation a line must run along the true edge, whatever the length of the edges:
/// shares of the diagonal.
constexpr double exact_reach = 1.0 / 500.0;

/// Moves each vertex half way to the mean of its neighbours; the border stays.
void smooth(testing::Triangles& mesh) {
  std::map<EdgeVertices, int> faces_of;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      ++faces_of[{low, high}];
    }
  std::vector<Point> sums(mesh.points.size(), Point::Zero());
  std::vector<double> counts(mesh.points.size(), 0.0);
  std::vector<char> stays(mesh.points.size(), 0);
  for (const auto& [edge, faces] : faces_of)
    for (const int end : {0, 1}) {
      sums[edge[end]] += mesh.points[edge[1 - end]];
      counts[edge[end]] += 1.0;
      if (faces == 1) stays[edge[end]] = 1;
    }
  for (VertexId v = 0; v < mesh.points.size(); ++v)
    if (!stays[v] && counts[v] > 0.0)
      mesh.points[v] = 0.5 * mesh.points[v] + 0.5 / counts[v] * sums[v];
}

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

Result<Part> make_scanned(const Shape& shape, const Sampling& sampling, double noise,
                          const std::string& name, Memo& memo) {
  const std::string key = shape.name + "-" + sampling.name;
  if (memo.name != key) {
    memo.part = shape.make(sampling.edge);
    for (int round = 0; round < sampling.blur; ++round) smooth(memo.part.mesh);
    const Result<ScanPtr> clean = scan_of(memo.part.mesh.points, memo.part.mesh.triangles);
    if (!clean) return tl::unexpected<Error>(clean.error());
    memo.mean_edge = mean_inner_edge(*(*clean)->mesh);
    memo.name = key;
  }
  Result<Part> part = part_of(memo.part, with_noise(memo.part.mesh, noise * memo.mean_edge,
                                                    hash_bytes(name.data(), name.size())));
  if (!part) return part;
  part->edge = mean_inner_edge(*part->scan->mesh);
  part->tolerance = lines_reach * part->edge;
  return part;
}

/// A scan of the machined part with noise in mm, and spikes.
Result<Part> make_machined_scan(double sigma) {
  constexpr double edge = 0.6, spike = 0.6;  // mm
  constexpr double spikes = 0.001;           // share of the vertices
  const CleanPart clean = machined_part().make(edge);
  testing::Triangles noisy{with_noise(clean.mesh, sigma, 1), clean.mesh.triangles};
  Random random(2);
  const std::vector<Point> spiked = with_noise(noisy, spike, 3);
  for (std::size_t v = 0; v < noisy.points.size(); ++v)
    if (random.uniform() < spikes) noisy.points[v] = spiked[v];
  Result<Part> part = part_of(clean, noisy.points);
  if (!part) return part;
  part->edge = mean_inner_edge(*part->scan->mesh);
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
    for (const Sampling& sampling : samplings)
      for (const double noise : noises) {
        const std::string level = number_text(noise, 3);
        const std::string name = shape.name + "-" + sampling.name + "-n" + level;
        const std::string kind = sampling.blur > 0 ? "generated, blurred" : "generated";
        cases.push_back({name,
                         {kind + ", noise " + level, "generated, " + shape.name},
                         [shape, sampling, noise, name, memo] {
                           return make_scanned(shape, sampling, noise, name, *memo);
                         }});
      }
  for (const double sigma : {0.03, 0.06})  // mm
    cases.push_back({"machined-s" + number_text(sigma, 2) + "-spikes",
                     {"generated, 16 faces with spikes"},
                     [sigma] { return make_machined_scan(sigma); }});
  for (const CadMesh& cad : cad_meshes())
    cases.push_back({cad.name, {"generated, clean CAD"}, [cad] { return make_clean(cad); }});
  return cases;
}

}  // namespace arris::accuracy
