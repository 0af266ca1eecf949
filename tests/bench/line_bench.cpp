// What sharp lines by the normal jump cost beside the walk, in the same run: the evidence once for
// a mesh, and a move of the threshold after it.
//
//   arris_line_bench SCAN     (for a million faces: any scan of that size)

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
    std::cerr << "arris_line_bench: " << done.error().message << "\n";
    std::exit(1);
  }
  result = std::move(*done);
  return spent.count();
}

/// The median time of a move of the threshold, all other parameters as they were resolved.
double slider_seconds(const Document& found) {
  std::vector<double> times;
  nlohmann::json parameters = found.find_sharp_lines->parameters;
  for (const double angle : {12.0, 16.0, 20.0, 24.0, 28.0, 33.0, 40.0, 50.0}) {
    parameters["angle"] = angle;
    Document moved;
    times.push_back(seconds_of(found, {"find_sharp_lines", parameters}, moved));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: arris_line_bench SCAN\n";
    return 2;
  }
  Document opened, walked, jumped;
  seconds_of({}, {"open", {{"file", argv[1]}}}, opened);
  const double walk = seconds_of(opened, {"find_sharp_lines", {{"method", "walk"}}}, walked);
  const double jump = seconds_of(opened, {"find_sharp_lines"}, jumped);
  const double walk_slider = slider_seconds(walked), jump_slider = slider_seconds(jumped);
  const auto row = [](const char* what, double by_walk, double by_jump) {
    std::cout << what << ": walk " << number_text(1e3 * by_walk, 3) << " ms, normal jump "
              << number_text(1e3 * by_jump, 3) << " ms, ratio " << number_text(by_jump / by_walk, 3)
              << "\n";
  };
  std::cout << opened.mesh->face_count() << " faces; lines by the walk "
            << walked.lines.lines.size() << ", by the normal jump " << jumped.lines.lines.size()
            << "\n";
  row("once", walk, jump);
  row("a move of the threshold (median of 8)", walk_slider, jump_slider);
  return 0;
}
