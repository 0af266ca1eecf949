// What sharp lines by the normal jump cost beside the walk, and partitions by fitted surfaces
// beside fronts, in the same run: once for a mesh, and a move of the threshold or of the detail
// after it.
//
//   arris_find_bench SCAN     (for a million faces: any scan of that size)

#include <algorithm>
#include <chrono>
#include <iostream>
#include <vector>

#include "core/base/number_text.h"
#include "core/document/document.h"
#include "core/document/operation.h"

namespace {

using namespace arris;

double seconds_of(const Document& document, const Operation& operation, Document& result) {
  const auto start = std::chrono::steady_clock::now();
  Result<Document> done = apply(document, operation);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (!done) {
    std::cerr << "arris_find_bench: " << done.error().message << "\n";
    std::exit(1);
  }
  result = std::move(*done);
  return spent.count();
}

/// The median time of a move of one parameter of a step, all others as they were resolved.
double slider_seconds(const Document& found, std::string_view step, const char* name,
                      const std::vector<nlohmann::json>& values) {
  std::vector<double> times;
  nlohmann::json parameters = found.step(step)->parameters;
  for (const nlohmann::json& value : values) {
    parameters[name] = value;
    Document moved;
    times.push_back(seconds_of(found, {std::string(step), parameters}, moved));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void print_row(const char* what, const char* peer, double by_peer, const char* own, double by_own) {
  std::cout << what << ": " << peer << " " << number_text(1e3 * by_peer, 3) << " ms, " << own << " "
            << number_text(1e3 * by_own, 3) << " ms, ratio " << number_text(by_own / by_peer, 3)
            << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: arris_find_bench SCAN\n";
    return 2;
  }
  Document opened, walked, jumped;
  seconds_of({}, {"open", {{"file", argv[1]}}}, opened);
  const double walk = seconds_of(opened, {"find_sharp_lines", {{"method", "walk"}}}, walked);
  const double jump = seconds_of(opened, {"find_sharp_lines"}, jumped);
  const std::vector<nlohmann::json> angles{12.0, 16.0, 20.0, 24.0, 28.0, 33.0, 40.0, 50.0};
  std::cout << opened.mesh->face_count() << " faces; lines by the walk "
            << walked.lines.lines.size() << ", by the normal jump " << jumped.lines.lines.size()
            << "\n";
  print_row("lines, once", "walk", walk, "normal jump", jump);
  print_row("a move of the threshold (median of 8)", "walk",
            slider_seconds(walked, "find_sharp_lines", "angle", angles), "normal jump",
            slider_seconds(jumped, "find_sharp_lines", "angle", angles));

  Document fronts, surfaces;
  const double by_fronts = seconds_of(jumped, {"find_partitions", {{"method", "fronts"}}}, fronts);
  const double by_surfaces = seconds_of(jumped, {"find_partitions"}, surfaces);
  std::cout << "partitions by fronts " << fronts.partitions.partitions.size() << ", by surfaces "
            << surfaces.partitions.partitions.size() << "\n";
  print_row("partitions, once", "fronts", by_fronts, "surfaces", by_surfaces);
  std::vector<nlohmann::json> bounds;
  const double bound =
      fronts.step("find_partitions")->parameters["intervals"][0][1].is_number()
          ? fronts.step("find_partitions")->parameters["intervals"][0][1].get<double>()
          : 1.0;
  for (const double share : {0.5, 0.7, 0.8, 0.9, 1.1, 1.3, 1.6, 2.0})
    bounds.push_back({{0.0, share * bound}, {share * bound, nullptr}});
  print_row("a move of Kmax or of the detail (median of 8)", "fronts",
            slider_seconds(fronts, "find_partitions", "intervals", bounds), "surfaces",
            slider_seconds(surfaces, "find_partitions", "detail",
                           {0.2, 0.4, 0.6, 0.8, 1.2, 1.6, 2.5, 4.0}));
  return 0;
}
