#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/document/operation.h"

namespace arris {

/// The parameters of one operation as options of a command. Names, ranges, choices, help and what
/// stands for one left out come from the operation table; an option is there once its parameter
/// names it.
class StepOptions {
 public:
  /// `note` is said after the help of each: "With --flow paper".
  StepOptions(CLI::App& command, std::string_view operation, const std::string& note = {});
  StepOptions(const StepOptions&) = delete;
  StepOptions& operator=(const StepOptions&) = delete;

  /// What was given, as parameters of the operation.
  nlohmann::json given() const;
  /// The first option that was given; null: none was.
  const CLI::Option* first() const;
  /// The first one that was given and counts with another method only; says with which.
  struct Stray {
    const CLI::Option* option;
    std::string_view method;
  };
  std::optional<Stray> stray(std::string_view method) const;

 private:
  struct Entry {
    const Parameter* parameter;
    CLI::Option* option;
    std::string text;
    std::vector<std::string> texts;  // of one that may be repeated
  };
  std::deque<Entry> entries_;  // which CLI11 fills: they stay where they are
};

}  // namespace arris
