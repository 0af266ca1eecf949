#include "tests/bench/beside.h"

#include <cstdio>
#include <map>
#include <vector>

namespace arris::bench {

namespace {

struct Pair {
  std::string what, peer, own;
};

std::vector<Pair>& pairs() {
  static std::vector<Pair> all;
  return all;
}

/// Prints as Google Benchmark does and keeps the time of each.
class Reporter : public benchmark::ConsoleReporter {
 public:
  Reporter() : ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (!run.error_occurred) times_[run.run_name.function_name] = run.GetAdjustedRealTime();
  }
  void print_ratios() const {
    for (const Pair& pair : pairs()) {
      const auto peer = times_.find(pair.what + ": " + pair.peer);
      const auto own = times_.find(pair.what + ": " + pair.own);
      if (peer == times_.end() || own == times_.end()) continue;  // not chosen, or failed
      std::printf("%s: %s / %s = %.4g\n", pair.what.c_str(), pair.own.c_str(), pair.peer.c_str(),
                  own->second / peer->second);
    }
  }

 private:
  std::map<std::string, double> times_;
};

}  // namespace

void beside(const std::string& what, Side peer, Side own) {
  pairs().push_back({what, peer.name, own.name});
  alone(what, std::move(peer));
  alone(what, std::move(own));
}

void alone(const std::string& what, Side own) {
  auto* const made =
      benchmark::RegisterBenchmark((what + ": " + own.name).c_str(), std::move(own.body));
  made->Unit(benchmark::kMillisecond)->UseRealTime();
  if (own.rounds > 0) made->Iterations(own.rounds);
}

int run_beside(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratios();
  benchmark::Shutdown();
  return 0;
}

}  // namespace arris::bench
