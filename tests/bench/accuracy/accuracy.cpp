// How well several ways to find sharp lines and partitions do on parts with known truth: parts made
// by code, and those of a folder (truth_folder.h). Not a test: figures.

#include <fnmatch.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/bench/accuracy/cases.h"
#include "tests/bench/accuracy/leave_one_out.h"
#include "tests/bench/accuracy/methods.h"
#include "tests/bench/accuracy/save.h"
#include "tests/bench/accuracy/summary.h"
#include "tests/bench/accuracy/truth_folder.h"
#include "tests/bench/accuracy/turned.h"

namespace {

using namespace arris;
using namespace arris::accuracy;

constexpr int bad_input = 1;
constexpr int bad_usage = 2;

int complain(const std::string& message, int code) {
  std::cerr << "arris_accuracy: " << message << "\n";
  return code;
}

/// Those of `methods` that were asked for by name, in that order.
Result<std::vector<Method>> chosen_methods(const std::vector<Method>& methods,
                                           const std::vector<std::string>& names) {
  std::vector<Method> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(methods, name, &Method::name);
    if (found != methods.end()) {
      chosen.push_back(*found);
      continue;
    }
    std::string known;
    for (const Method& method : methods) known += (known.empty() ? "" : ", ") + method.name;
    return fail("There is no method '" + name + "'; there are " + known + ".");
  }
  return chosen;
}

/// "NAME=[operations]" as a method.
Result<Method> method_from(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    return fail("A method is NAME=[operations], not '" + text + "'.");
  return operations_method(text.substr(0, equals), std::string_view(text).substr(equals + 1));
}

/// A name as a folder.
std::string folder_name(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '/' || c == '\\'; }, '_');
  return name;
}

struct Wishes {
  std::string glob = "*";
  std::string save;  // folder; empty: nothing is saved
  bool quiet = false;
};

/// Runs all methods on a case and adds their rows. What fails is said and left out.
Result<void> run_case(const Case& item, const std::vector<Method>& methods, const Wishes& wishes,
                      std::vector<Row>& rows, int& failures) {
  if (!wishes.quiet) std::cerr << item.name << "\n";
  const Result<Part> part = item.make();
  if (!part) {
    complain(item.name + ": " + part.error().message, 0);
    ++failures;
    return {};
  }
  const auto folder = std::filesystem::path(wishes.save) / folder_name(item.name);
  if (!wishes.save.empty())
    if (auto saved = save_part(folder.string(), *part); !saved) return saved;
  const Scorer scorer(*part);
  for (const Method& method : methods) {
    const Result<Found> found = method.run(part->scan);
    if (!found) {
      complain(item.name + ", " + method.name + ": " + found.error().message, 0);
      ++failures;
      continue;
    }
    if (!wishes.save.empty())
      if (auto saved = save_found((folder / folder_name(method.name)).string(), *part, *found);
          !saved)
        return saved;
    Result<Score> score = scorer.score(*found);
    if (!score) {
      complain(item.name + ", " + method.name + ": " + score.error().message, 0);
      ++failures;
      continue;
    }
    rows.push_back({item.name, item.groups, method.name, std::move(*score), found->seconds});
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "How well ways to find sharp lines and partitions do on parts with known truth.\n"
      "Exit codes: 0 done, 1 bad input or a method that failed, 2 bad usage.",
      "arris_accuracy");
  app.footer(legend());
  std::string data;
  Wishes wishes;
  std::vector<std::string> names, added;
  bool markdown = false, generated = true, summary_only = false;
  app.add_option("--data", data, "A folder with truth/, pairs/ and controls/");
  app.add_option("--cases", wishes.glob, "Only cases whose name matches, as \"rib_*-fine-*\"");
  app.add_option("--methods", names, "Only these, by name: a,b")->delimiter(',');
  app.add_option("--method", added,
                 "Another one: 'NAME=[{\"operation\": \"find_sharp_lines\", ...}, ...]'");
  app.add_option("--save", wishes.save, "Write parts and results for each case and method there");
  app.add_flag("--markdown", markdown, "Tables as Markdown");
  app.add_flag("--generated,!--no-generated", generated, "With or without parts made by code");
  bool with_ideas = false;
  app.add_flag("--ideas", with_ideas, "The default method with each of its ideas off, too");
  bool only_leave_one_out = false;
  app.add_flag("--leave-one-out", only_leave_one_out,
               "Instead: what the constants of the default are worth on parts left out");
  int turns = 0;
  app.add_option("--turned", turns, "Each case so many times more, turned in space")
      ->check(CLI::Range(0, 100));
  app.add_flag("--summary", summary_only, "Leave the table of single cases out");
  app.add_flag("--quiet", wishes.quiet, "Do not name each case on standard error");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_usage;
  }

  std::vector<Method> methods = method_table(with_ideas);
  for (const std::string& text : added) {
    Result<Method> method = method_from(text);
    if (!method) return complain(method.error().message, bad_usage);
    if (!names.empty() && std::ranges::find(names, method->name) == names.end())
      names.push_back(method->name);
    methods.push_back(std::move(*method));
  }
  if (!names.empty()) {
    Result<std::vector<Method>> chosen = chosen_methods(methods, names);
    if (!chosen) return complain(chosen.error().message, bad_usage);
    methods = std::move(*chosen);
  }

  std::vector<Case> cases;
  if (!data.empty()) {
    Result<std::vector<Case>> found = folder_cases(data);
    if (!found) return complain(found.error().message, bad_input);
    cases = std::move(*found);
  }
  if (generated) {
    std::vector<Case> made = generated_cases();
    std::ranges::move(made, std::back_inserter(cases));
  }
  std::erase_if(cases, [&](const Case& item) {
    return ::fnmatch(wishes.glob.c_str(), item.name.c_str(), 0) != 0;
  });
  if (cases.empty()) return complain("There is no case " + wishes.glob + ".", bad_usage);

  std::vector<Case> turned = turned_cases(cases, turns);
  std::ranges::move(turned, std::back_inserter(cases));
  if (only_leave_one_out) {
    const Result<Table> table = leave_one_out(cases, wishes.quiet);
    if (!table) return complain(table.error().message, bad_input);
    table->print(markdown);
    return 0;
  }
  std::vector<Row> rows;
  int failures = 0;
  for (const Case& item : cases)
    if (const auto done = run_case(item, methods, wishes, rows, failures); !done)
      return complain(done.error().message, bad_input);
  if (!summary_only) {
    case_table(rows).print(markdown);
    std::printf("\n");
    if (const std::optional<Table> proposals = proposal_table(rows)) {
      proposals->print(markdown);
      std::printf("\n");
    }
  }
  group_table(rows).print(markdown);
  std::printf("\n%s", legend().c_str());
  return failures == 0 ? 0 : bad_input;
}
