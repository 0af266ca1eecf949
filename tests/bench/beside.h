#pragma once

#include <functional>
#include <string>

#include <benchmark/benchmark.h>

/// Benchmarks that come in pairs: what we do, beside a peer in the same run of the same program.
namespace arris::bench {

/// One of the two. The body loops over its state, as Google Benchmark wants it.
struct Side {
  std::string name;
  std::function<void(benchmark::State&)> body;
  int rounds = 0;  ///< 0: as many as it takes to measure well
};

/// Registers both under "what: name".
void beside(const std::string& what, Side peer, Side own);
/// Registers one that has no peer.
void alone(const std::string& what, Side own);

/// Measures what was registered, by the options of Google Benchmark that `argv` may have, and
/// closes with the ratio of each pair. What a program wants of its command line is taken out
/// before.
int run_beside(int argc, char** argv);

}  // namespace arris::bench
