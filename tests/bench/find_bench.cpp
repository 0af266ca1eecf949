// What sharp lines by the normal jump cost beside the walk, and partitions by fitted surfaces
// beside fronts, in the same run: once for a mesh, and a move of the threshold or of the detail
// after it.
//
//   arris_find_bench SCAN     (for a million faces: any scan of that size)

#include <iostream>
#include <vector>

#include "core/document/document.h"
#include "core/document/operation.h"
#include "tests/bench/beside.h"
#include "tests/support/documents.h"

namespace {

using namespace arris;
using nlohmann::json;

/// An operation as if it were the first: `from` has nothing yet that such work leaves behind.
bench::Side once(const std::string& name, const Document& from, const Operation& operation) {
  return {name,
          [&from, operation](benchmark::State& state) {
            for (auto _ : state) {
              state.PauseTiming();
              Document fresh = from;
              fresh.evidence =
                  std::make_shared<const SharedLineEvidence>(fresh.mesh, fresh.curvatures);
              fresh.opened.evidence = fresh.evidence;
              fresh.areas = nullptr;
              if (operation.name == "find_partitions") fresh.evidence = from.evidence;
              state.ResumeTiming();
              const Document done = arris::testing::applied(fresh, operation);
              state.counters["lines"] = static_cast<double>(done.lines.lines.size());
              state.counters["partitions"] = static_cast<double>(done.partitions.partitions.size());
            }
          },
          3};
}

/// Moves of one parameter of a step that was done, all others as they were resolved.
bench::Side moves(const std::string& name, const Document& found, std::string_view step,
                  const char* parameter, const std::vector<json>& values) {
  return {
      name,
      [&found, step, parameter, values](benchmark::State& state) {
        json parameters = found.step(step)->parameters;
        std::size_t k = 0;
        for (auto _ : state) {
          parameters[parameter] = values[k++ % values.size()];
          benchmark::DoNotOptimize(arris::testing::applied(found, {std::string(step), parameters}));
        }
      },
      static_cast<int>(values.size())};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') {
    std::cerr << "usage: arris_find_bench SCAN [options of Google Benchmark]\n";
    return 2;
  }
  const Document opened = arris::testing::applied({}, {"open", {{"file", argv[1]}}});
  const Operation walk{"find_sharp_lines", {{"method", "walk"}}}, jump{"find_sharp_lines"};
  const Document walked = arris::testing::applied(opened, walk),
                 jumped = arris::testing::applied(opened, jump);
  const std::vector<json> angles{12.0, 16.0, 20.0, 24.0, 28.0, 33.0, 40.0, 50.0};
  std::cout << opened.mesh->face_count() << " faces\n";
  bench::beside("lines, once", once("walk", opened, walk), once("normal jump", opened, jump));
  bench::beside("a move of the threshold",
                moves("walk", walked, "find_sharp_lines", "angle", angles),
                moves("normal jump", jumped, "find_sharp_lines", "angle", angles));

  const Operation front{"find_partitions", {{"method", "fronts"}}}, surface{"find_partitions"};
  const Document fronts = arris::testing::applied(jumped, front),
                 surfaces = arris::testing::applied(jumped, surface);
  bench::beside("partitions, once", once("fronts", jumped, front),
                once("surfaces", jumped, surface));
  const json& interval = fronts.step("find_partitions")->parameters["intervals"][0][1];
  const double bound = interval.is_number() ? interval.get<double>() : 1.0;
  std::vector<json> bounds;
  for (const double share : {0.5, 0.7, 0.8, 0.9, 1.1, 1.3, 1.6, 2.0})
    bounds.push_back({{0.0, share * bound}, {share * bound, nullptr}});
  bench::beside("a move of Kmax or of the detail",
                moves("fronts", fronts, "find_partitions", "intervals", bounds),
                moves("surfaces", surfaces, "find_partitions", "detail",
                      {0.2, 0.4, 0.6, 0.8, 1.2, 1.6, 2.5, 4.0}));
  argv[1] = argv[0];
  return bench::run_beside(argc - 1, argv + 1);
}
