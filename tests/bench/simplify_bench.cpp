// Simplification and swaps beside OpenMesh's Decimater with ModHausdorff at the same tolerance, on
// the same meshes in the same run: a generated plate of a million faces, and scans named on the
// command line ("FILE TOLERANCE" pairs; what begins with a minus is an option of Google Benchmark).

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
// (order matters)
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "core/base/process.h"
#include "core/edge_swapping/equilateralize.h"
#include "core/edge_swapping/swap_edges.h"
#include "core/mesh/scan.h"
#include "core/simplification/noise.h"
#include "core/simplification/simplify.h"
#include "tests/bench/beside.h"
#include "tests/support/documents.h"

namespace {

using namespace arris;

/// Quadrics for the order, Hausdorff for the limit: the peer's usual pair.
void run_peer(const Mesh& mesh, double tolerance, benchmark::State& state) {
  using Mutable = OpenMesh::TriMesh_ArrayKernelT<>;
  Mutable peer;
  std::vector<Mutable::VertexHandle> handles;
  for (const Point& p : mesh.points())
    handles.push_back(peer.add_vertex(Mutable::Point(
        static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]))));
  for (const Triangle& t : mesh.triangles())
    peer.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
  for (auto _ : state) {
    OpenMesh::Decimater::DecimaterT<Mutable> decimater(peer);
    OpenMesh::Decimater::ModHausdorffT<Mutable>::Handle hausdorff;
    OpenMesh::Decimater::ModQuadricT<Mutable>::Handle quadric;
    decimater.add(hausdorff);
    decimater.add(quadric);
    decimater.module(hausdorff).set_tolerance(static_cast<float>(tolerance));
    decimater.initialize();
    decimater.decimate();
    peer.garbage_collection();
  }
  state.counters["vertices_left"] = static_cast<double>(peer.n_vertices());
}

/// Simplification beside its peer, and swaps, of one mesh.
void compare(const std::string& name, const MeshPtr& mesh, double tolerance) {
  std::printf("%s: %zu faces, %zu vertices, noise %.4f, tolerance %g\n", name.c_str(),
              mesh->face_count(), mesh->vertex_count(), estimate_noise(*mesh), tolerance);
  const auto own = [mesh, tolerance](StarCost cost) {
    SimplifyOptions options;
    options.error_zone = tolerance;
    options.cost = cost;
    return arris::testing::value_of(simplify(*mesh, nullptr, {}, options));
  };
  const auto by = [own, mesh](StarCost cost) {
    return [own, mesh, cost](benchmark::State& state) {
      for (auto _ : state)
        state.counters["vertices_left"] = static_cast<double>(own(cost).vertices_after);
      state.counters["peak_bytes_a_face"] =
          static_cast<double>(peak_memory()) / static_cast<double>(mesh->face_count());
    };
  };
  bench::beside(
      name,
      {"OpenMesh Decimater",
       [mesh, tolerance](benchmark::State& state) { run_peer(*mesh, tolerance, state); }, 1},
      {"simplify", by(SimplifyOptions().cost), 1});
  for (const auto& [what, cost] :
       {std::pair{"simplify by angles", StarCost::angle}, {"simplify by areas", StarCost::area}})
    bench::alone(name, {what, by(cost), 1});

  using Swapping = std::function<Result<Prepared>(const Mesh&, const ErrorZonesPtr&)>;
  const auto swaps = [&](const char* what, const Swapping& swapping, bool simplified) {
    bench::alone(name, {what,
                        [=](benchmark::State& state) {
                          for (auto _ : state) {
                            state.PauseTiming();
                            Prepared before;
                            if (simplified) before = own(SimplifyOptions().cost);
                            state.ResumeTiming();
                            const Prepared swapped = arris::testing::value_of(
                                swapping(simplified ? *before.mesh : *mesh, before.zones));
                            state.counters["swaps"] = static_cast<double>(swapped.swaps);
                          }
                        },
                        1});
  };
  const Swapping by_angles = [](const Mesh& on, const ErrorZonesPtr& zones) {
    return swap_edges(on, zones, ChunkedArray<Origin>{}, {}, {});
  };
  const Swapping to_equilateral = [](const Mesh& on, const ErrorZonesPtr& zones) {
    return equilateralize(on, zones, ChunkedArray<Origin>{}, {}, {});
  };
  swaps("swap_edges, simplified", by_angles, true);
  swaps("swap_edges, scan", by_angles, false);
  swaps("equilateralize, scan", to_equilateral, false);
}

}  // namespace

int main(int argc, char** argv) {
  // Options are Google Benchmark's; all others are pairs of a file and a tolerance.
  const auto is_option = [](const char* word) { return word[0] == '-'; };
  char** const options = std::stable_partition(argv + 1, argv + argc, std::not_fn(is_option));
  compare("plate", arris::testing::mesh_of(arris::testing::noisy_plane(70.7, 0.1, 0.01, 0.2, 1)),
          0.05);
  for (char** word = argv + 1; word + 1 < options; word += 2)
    compare(word[0], arris::testing::value_of(load_scan(word[0]))->mesh, std::atof(word[1]));
  std::vector<char*> rest{argv[0]};
  rest.insert(rest.end(), options, argv + argc);
  const int count = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  return bench::run_beside(count, rest.data());
}
