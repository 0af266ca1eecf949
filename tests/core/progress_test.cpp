// Long work tells how far it is, evenly, and hears a stop soon: both as shares of the work, which
// is measured by the processor time of this process, so that a busy machine changes nothing.

#include <ctime>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/machine_memory.h"
#include "core/base/watched_for.h"
#include "core/document/document.h"
#include "core/document/operation.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What is worked out once for a mesh is not there yet.
Document fresh(const Document& document) {
  Document result = document;
  if (!result.mesh) return result;
  result.evidence = std::make_shared<const SharedLineEvidence>(result.mesh, result.curvatures);
  result.opened.evidence = result.evidence;
  result.areas = nullptr;
  return result;
}

struct Told {
  double whole = 0.0;    // seconds of the processor
  double longest = 0.0;  // share of it without a word
  double back = 0.0;     // the largest step back of the fraction
  std::size_t reports = 0;
  std::string before;  // the longest silence
};

Told listen(const Document& document, const Operation& operation, Document& result) {
  std::mutex mutex;
  std::vector<std::pair<double, std::string>> times;
  Told told;
  double fraction = 0.0;
  const double begin = processor_seconds();
  result =
      value_of(apply(fresh(document), operation, Context([&](double now, std::string_view what) {
                       const std::lock_guard lock(mutex);
                       times.emplace_back(processor_seconds(), what);
                       told.back = std::max(told.back, fraction - now);
                       fraction = now;
                     })));
  times.emplace_back(processor_seconds(), "the end");
  told.whole = times.back().first - begin;
  told.reports = times.size() - 1;
  double last = begin;
  for (const auto& [time, what] : times) {
    if (const double share = (time - last) / told.whole; share > told.longest) {
      told.longest = share;
      told.before = what;
    }
    last = time;
  }
  return told;
}

/// The largest share of the work that is still done after it was told to stop, at `times` reports
/// spread over it.
double after_stop(const Document& document, const Operation& operation, const Told& told,
                  std::size_t times) {
  double longest = 0.0;
  for (std::size_t k = 0; k < times; ++k) {
    const std::size_t at = (2 * k + 1) * told.reports / (2 * times);
    std::stop_source stop;
    std::size_t count = 0;
    double asked = 0.0;
    const Result<Document> done = apply(fresh(document), operation,
                                        Context(
                                            [&](double, std::string_view) {
                                              if (count++ != at) return;
                                              asked = processor_seconds();
                                              stop.request_stop();
                                            },
                                            stop.get_token()));
    const double heard = processor_seconds();
    if (asked > 0.0 && !done) {
      EXPECT_TRUE(done.error().cancelled) << done.error().message;
      longest = std::max(longest, (heard - asked) / told.whole);
    }
  }
  return longest;
}

TEST(Progress, IsToldEvenlyAndAStopIsHeardSoon) {
  // Longer than it takes to start threads; shares of what is shorter would be theirs.
  const TempFolder folder;
  const std::string part = write_mesh(folder, "part.ply", sample_mould(0.8));
  Document opened, found;
  struct Work {
    Operation operation;
    double most_silent, most_after_stop;  // shares
  };
  const auto check = [&](const Document& base, const Work& work) {
    SCOPED_TRACE(work.operation.name);
    Document result;
    const Told told = listen(base, work.operation, result);
    EXPECT_GT(told.reports, 20u);
    EXPECT_LT(told.longest, work.most_silent) << "before " << told.before;
    EXPECT_LT(told.back, 0.01) << "it never goes back";
    const double stopped = after_stop(base, work.operation, told, 6);
    EXPECT_LT(stopped, work.most_after_stop);
    std::printf("%s: %.1f %% silent before \"%s\", %.1f %% after a stop, %zu reports\n",
                work.operation.name.c_str(), 100.0 * told.longest, told.before.c_str(),
                100.0 * stopped, told.reports);
    return result;
  };
  opened = value_of(apply({}, {"open", {{"file", part}}}));
  ASSERT_GT(opened.mesh->face_count(), 30000u);
  found = check(opened, {{"find_sharp_lines", json::object()}, 0.2, 0.1});
  check(found, {{"find_partitions", json::object()}, 0.3, 0.05});
}

TEST(Progress, AWatchedLoopMakesEachCallOnceAndStopsBetweenSlices) {
  for (const std::size_t count : {0u, 1u, 7u, 4095u, 4097u, 300000u}) {
    std::vector<std::uint8_t> calls(count, 0);
    std::vector<double> fractions;
    EXPECT_TRUE(watched_for(
        count, Context([&](double fraction, std::string_view) { fractions.push_back(fraction); }),
        "counting", [&](std::size_t i) { ++calls[i]; }));
    EXPECT_TRUE(std::ranges::all_of(calls, [](std::uint8_t n) { return n == 1; })) << count;
    EXPECT_TRUE(std::ranges::is_sorted(fractions));
  }
  std::stop_source stop;
  std::vector<std::uint8_t> calls(300000, 0);
  EXPECT_FALSE(watched_for(calls.size(),
                           Context(
                               [&](double fraction, std::string_view) {
                                 if (fraction > 0.5) stop.request_stop();
                               },
                               stop.get_token()),
                           "counting", [&](std::size_t i) { ++calls[i]; }));
  const auto made = std::ranges::count(calls, 1);
  EXPECT_GT(made, 150000);
  EXPECT_LT(made, 180000);
}

TEST(Memory, WhatCannotFitIsRefusedInASentenceBeforeItIsTried) {
  EXPECT_TRUE(check_memory("part.ply", 8'000'000'000, 8'000'000'000));
  EXPECT_TRUE(check_memory("part.ply", 8'000'000'000, 0)) << "not known how much there is";
  const Result<void> refused = check_memory("part.ply", 40'000'000'000, 8'400'000'000);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "part.ply needs about 40 GB of memory; this computer has 8.4 GB.");
  EXPECT_GT(machine_memory(), 100'000'000u);
}

}  // namespace
}  // namespace arris
