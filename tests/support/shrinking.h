#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace arris::testing {

/// What a test does at random, as data: each number decides one thing that it does.
using Choices = std::vector<std::uint64_t>;

/// As many as wanted, the same for the same seed.
Choices choices_of(std::size_t count, std::uint64_t seed);

/// A part of the choices with which a test still fails, and how it fails then.
struct Shrunk {
  Choices choices;
  std::string fault;
};

/// Does `test` with all choices. Where it fails (by gtest's failures or an exception), looks for as
/// few of them as still fail, by RapidCheck, for as long as `at_most`; the failures do not count as
/// the running test's. Nothing: it did not fail.
std::optional<Shrunk> shrink(const Choices& choices,
                             const std::function<void(const Choices&)>& test,
                             std::chrono::seconds at_most = std::chrono::seconds(120));

/// The running test fails where `test` does, with the fewest choices that make it.
void expect_holds(const Choices& choices, const std::function<void(const Choices&)>& test);

}  // namespace arris::testing
