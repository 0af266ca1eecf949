#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/documents.h"

/// Runs arris-cli as a user does.
namespace arris::testing {

using nlohmann::json;

/// What a run of the program left.
struct Outcome {
  int code = -1;  // 128 + signal where it was killed
  std::string out, err;
};

inline std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Each test has a folder of its own.
class Cli : public ::testing::Test {
 protected:
  TempFolder folder;

  Outcome run(const std::vector<std::string>& arguments, const std::string& before = "") const {
    std::string command = before + (before.empty() ? "" : " ") + quoted(ARRIS_CLI);
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    command += " > " + quoted(folder.file("out.txt")) + " 2> " + quoted(folder.file("err.txt"));
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = folder.read("out.txt");
    outcome.err = folder.read("err.txt");
    return outcome;
  }

  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }

  /// Exit code 1 and one sentence that names what is wrong.
  void expect_bad_input(const std::vector<std::string>& arguments, const std::string& shown) const {
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("arris-cli: ")) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with(".\n")) << outcome.err;
    EXPECT_NE(outcome.err.find(shown), std::string::npos) << outcome.err;
  }

  void expect_bad_usage(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err, "");
  }

  json summary(const std::string& results) const {
    return json::parse(folder.read(results + "/summary.json"));
  }

  std::string small_part() const {
    return write_mesh(folder, "part.ply", stepped_plate(10.0, 20.0, 4.0, 1.0));
  }
};

}  // namespace arris::testing
