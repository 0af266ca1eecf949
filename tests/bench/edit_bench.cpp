// What an edit by hand costs beside deriving lines and boundaries from scratch, on the same mesh in
// the same run. Not a test: figures.

#include <memory>

#include "core/partitions/interactive_treatments.h"
#include "core/sharp_lines/interactive_treatments.h"
#include "tests/bench/beside.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

/// A cube with its lines and sides, and a change: ten edges of a line cease to be sharp.
struct Edit {
  Document document;
  std::vector<Origin> all;
  LineChanges changes;
  std::vector<EdgeId> touched;

  explicit Edit(int divisions) {
    document = testing::document_of(testing::divided_cube(100.0, divisions));
    document = testing::applied(document, {"find_sharp_lines", {{"angle", 30.0}}});
    document = testing::applied(document, {"find_partitions", {{"intervals", {{0.0, 1.0}}}}});
    for (EdgeId e = 0; e < document.mesh->edge_count(); ++e) all.push_back(document.lines.edges[e]);
    const Line& line = *document.lines.lines.front();
    changes = remove_path(*document.mesh, document.lines,
                          {line.vertices.begin() + 5, line.vertices.begin() + 16});
    for (const auto& [e, origin] : changes.edges) touched.push_back(e);
  }
  void from_scratch() const {
    std::uint32_t next_id = document.next_id;
    relink_lines(*document.mesh, *document.curvatures, all, document.lines, next_id);
    benchmark::DoNotOptimize(derive_boundaries(*document.mesh, *document.curvatures, document.lines,
                                               document.partitions));
  }
  void by_hand() const {
    std::uint32_t next_id = document.next_id;
    const SharpLines edited =
        edit_lines(*document.mesh, *document.curvatures, document.lines, changes, next_id);
    benchmark::DoNotOptimize(update_boundaries(
        *document.mesh, *document.curvatures, *document.boundaries,
        {document.lines, document.partitions}, {edited, document.partitions}, touched));
  }
};

}  // namespace
}  // namespace arris

int main(int argc, char** argv) {
  for (const int divisions : {29, 92, 290}) {
    const auto edit = std::make_shared<const arris::Edit>(divisions);
    arris::bench::beside(
        "ten edges of " + std::to_string(edit->document.mesh->face_count()) + " faces",
        {"from scratch",
         [edit](benchmark::State& state) {
           for (auto _ : state) edit->from_scratch();
         }},
        {"by hand", [edit](benchmark::State& state) {
           for (auto _ : state) edit->by_hand();
         }});
  }
  return arris::bench::run_beside(argc, argv);
}
