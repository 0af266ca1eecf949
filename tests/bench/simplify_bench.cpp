// Simplification and swaps beside OpenMesh's Decimater with ModHausdorff at the same tolerance, on
// the same meshes in the same run: a generated plate of a million faces, and scans named on the
// command line ("FILE TOLERANCE" pairs).

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
// (order matters)
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "core/edge_swapping/equilateralize.h"
#include "core/edge_swapping/swap_edges.h"
#include "core/mesh/scan.h"
#include "core/simplification/noise.h"
#include "core/simplification/simplify.h"
#include "tests/support/meshes.h"

namespace {

using namespace arris;

/// Processor time of all threads: the machine may have other work.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_bytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Quadrics for the order, Hausdorff for the limit: the peer's usual pair.
void run_peer(const Mesh& mesh, double tolerance, double& time, std::size_t& vertices) {
  using Mutable = OpenMesh::TriMesh_ArrayKernelT<>;
  Mutable peer;
  std::vector<Mutable::VertexHandle> handles;
  for (const Point& p : mesh.points())
    handles.push_back(peer.add_vertex(Mutable::Point(
        static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]))));
  for (const Triangle& t : mesh.triangles())
    peer.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
  const double start = seconds();
  OpenMesh::Decimater::DecimaterT<Mutable> decimater(peer);
  OpenMesh::Decimater::ModHausdorffT<Mutable>::Handle hausdorff;
  OpenMesh::Decimater::ModQuadricT<Mutable>::Handle quadric;
  decimater.add(hausdorff);
  decimater.add(quadric);
  decimater.module(hausdorff).set_tolerance(static_cast<float>(tolerance));
  decimater.initialize();
  decimater.decimate();
  peer.garbage_collection();
  time = seconds() - start;
  vertices = peer.n_vertices();
}

void compare(const std::string& name, const Mesh& mesh, double tolerance, StarCost cost,
             bool with_peer) {
  std::printf("%s: %zu faces, %zu vertices, noise %.4f, tolerance %g\n", name.c_str(),
              mesh.face_count(), mesh.vertex_count(), estimate_noise(mesh), tolerance);
  SimplifyOptions options;
  options.error_zone = tolerance;
  options.cost = cost;
  double start = seconds();
  const Result<Prepared> simple = simplify(mesh, nullptr, {}, options);
  const double time = seconds() - start;
  if (!simple) std::abort();
  std::printf("  simplify             %8.2f s  %8llu vertices left, peak %.0f bytes per face\n",
              time, static_cast<unsigned long long>(simple->vertices_after),
              peak_bytes() / static_cast<double>(mesh.face_count()));
  const auto swap = [&](const char* what, const auto& function, const Mesh& on,
                        const ErrorZonesPtr& zones) {
    start = seconds();
    const Result<Prepared> swapped = function(on, zones, ChunkedArray<Origin>{}, {}, {});
    if (!swapped) std::abort();
    std::printf("  %-20s %8.2f s  %8llu swaps\n", what, seconds() - start,
                static_cast<unsigned long long>(swapped->swaps));
  };
  swap("swap_edges, after", swap_edges, *simple->mesh, simple->zones);
  swap("swap_edges, scan", swap_edges, mesh, nullptr);
  swap("equilateralize, scan", equilateralize, mesh, nullptr);
  if (!with_peer) return;
  double peer_time = 0.0;
  std::size_t peer_vertices = 0;
  run_peer(mesh, tolerance, peer_time, peer_vertices);
  std::printf(
      "  OpenMesh Decimater   %8.2f s  %8zu vertices left: %.1f times as long, %.2f as many\n",
      peer_time, peer_vertices, peer_time / time,
      static_cast<double>(peer_vertices) / static_cast<double>(simple->vertices_after));
}

}  // namespace

int main(int argc, char** argv) {
  bool with_peer = true, with_plate = true;
  StarCost cost = SimplifyOptions().cost;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--no-peer") with_peer = false;
    if (word == "--no-plate") with_plate = false;
    if (word == "--angle") cost = StarCost::angle;
    if (word == "--area") cost = StarCost::area;
  }
  if (with_plate) {
    const MeshPtr plate =
        arris::testing::mesh_of(arris::testing::noisy_plane(70.7, 0.1, 0.01, 0.2, 1));
    compare("plate", *plate, 0.05, cost, with_peer);
  }
  for (int i = 1; i + 1 < argc; ++i) {
    if (argv[i][0] == '-') continue;
    const Result<ScanPtr> scan = load_scan(argv[i]);
    if (!scan) {
      std::fprintf(stderr, "%s\n", scan.error().message.c_str());
      return 1;
    }
    compare(argv[i], *(*scan)->mesh, std::atof(argv[i + 1]), cost, with_peer);
    ++i;
  }
}
