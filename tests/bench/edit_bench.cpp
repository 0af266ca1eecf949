// What an edit by hand costs beside deriving lines and boundaries from scratch, on the same mesh in
// the same run. Not a test: figures.

#include <chrono>
#include <cstdio>

#include "core/partitions/interactive_treatments.h"
#include "core/sharp_lines/interactive_treatments.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using Clock = std::chrono::steady_clock;

template <class Work>
double milliseconds(int rounds, const Work& work) {
  const auto start = Clock::now();
  for (int k = 0; k < rounds; ++k) work(k);
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count() / rounds;
}

void run(int divisions) {
  Document document = testing::document_of(testing::divided_cube(100.0, divisions));
  document = testing::applied(document, {"find_sharp_lines", {{"angle", 30.0}}});
  document = testing::applied(document, {"find_partitions", {{"intervals", {{0.0, 1.0}}}}});
  const Mesh& mesh = *document.mesh;
  const Line& line = *document.lines.lines.front();
  std::vector<Origin> all(mesh.edge_count());
  for (EdgeId e = 0; e < all.size(); ++e) all[e] = document.lines.edges[e];

  // Ten edges of a line cease to be sharp.
  const std::vector<VertexId> path(line.vertices.begin() + 5, line.vertices.begin() + 16);
  const LineChanges changes = remove_path(mesh, document.lines, path);
  std::vector<EdgeId> touched;
  for (const auto& [e, origin] : changes.edges) touched.push_back(e);
  std::uint32_t next_id = document.next_id;
  SharpLines edited;
  constexpr int edits = 100, derivations = 3;
  const double edit = milliseconds(edits, [&](int) {
    edited = edit_lines(mesh, *document.curvatures, document.lines, changes, next_id);
    update_boundaries(mesh, *document.curvatures, *document.boundaries,
                      {document.lines, document.partitions}, {edited, document.partitions},
                      touched);
  });
  const double derive = milliseconds(derivations, [&](int) {
    relink_lines(mesh, *document.curvatures, all, document.lines, next_id);
    derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions);
  });
  std::printf("%8zu faces: an edit of ten edges %.3f ms, from scratch %.1f ms: %.0f times\n",
              mesh.face_count(), edit, derive, derive / edit);
}

}  // namespace
}  // namespace arris

int main() {
  for (const int divisions : {29, 92, 290}) arris::run(divisions);
}
