#include "tests/support/shrinking.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/base/random.h"

namespace arris::testing {

namespace {

/// The failures of one run in gtest's words; empty: none.
std::string faults_of(const Choices& choices, const std::function<void(const Choices&)>& test) {
  ::testing::TestPartResultArray parts;
  std::string faults;
  {
    using Reporter = ::testing::ScopedFakeTestPartResultReporter;
    const Reporter reporter(Reporter::INTERCEPT_ALL_THREADS, &parts);
    try {
      test(choices);
    } catch (const std::exception& thrown) {
      faults = thrown.what();
    }
  }
  for (int k = 0; k < parts.size(); ++k)
    if (parts.GetTestPartResult(k).failed())
      faults += (faults.empty() ? "" : "\n") + std::string(parts.GetTestPartResult(k).message());
  return faults;
}

}  // namespace

Choices choices_of(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Choices choices(count);
  for (std::uint64_t& choice : choices) choice = random.bits();
  return choices;
}

std::optional<Shrunk> shrink(const Choices& choices,
                             const std::function<void(const Choices&)>& test,
                             std::chrono::seconds at_most) {
  const auto end = std::chrono::steady_clock::now() + at_most;
  std::optional<Shrunk> least;
  const auto smaller = [](const Choices& all) { return rc::shrink::removeChunks(all); };
  const rc::Gen<Choices> parts(
      [&](const rc::Random&, int) { return rc::shrinkable::shrinkRecur(choices, smaller); });
  const auto property = [&] {
    const Choices part = *parts;
    // A test that is stopped by force would say nothing at all.
    if (least && std::chrono::steady_clock::now() > end) return;
    std::string fault = faults_of(part, test);
    if (fault.empty()) return;
    least = Shrunk{part, std::move(fault)};
    RC_FAIL("see what was shrunk");
  };
  rc::detail::TestParams once;
  once.maxSuccess = 1;
  rc::detail::checkTestable(property, rc::detail::TestMetadata(), once);
  return least;
}

void expect_holds(const Choices& choices, const std::function<void(const Choices&)>& test) {
  const std::optional<Shrunk> fault = shrink(choices, test);
  if (!fault) return;
  std::string numbers;
  for (const std::uint64_t choice : fault->choices) numbers += " " + std::to_string(choice);
  ADD_FAILURE() << "It fails with " << fault->choices.size() << " of " << choices.size()
                << " choices (" << numbers << " ):\n"
                << fault->fault;
}

}  // namespace arris::testing
