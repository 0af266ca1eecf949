// arris-cli: the core without a window.

#include <deque>
#include <functional>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli_manual.h"
#include "app/commands.h"
#include "app/step_options.h"
#include "core/document/chain.h"
#include "core/mesh/length_unit.h"

namespace {

using namespace arris;
using namespace arris::commands;

/// What the command line says, and what has to be done then.
struct CommandLine {
  CLI::App app{
      "Arris: sharp lines and partitions of scanned moulds.\n"
      "Exit codes: 0 done, 1 bad input, 2 bad usage.",
      "arris-cli"};
  /// Of the command that was given; may still throw CLI::ParseError.
  std::function<int()> run;

  CLI::App* add(const std::string& name, const std::string& help,
                std::function<int()> action = nullptr) {
    CLI::App* command = app.add_subcommand(name, help);
    if (action) on(command, std::move(action));
    return command;
  }
  void on(CLI::App* command, std::function<int()> action) {
    command->callback([this, action = std::move(action)] { run = action; });
  }

  // Shared by several commands.
  Opening opening;
  bool no_weld = false, as_json = false;
  ResultPlaces places;
  Replaying replaying;
  std::string output;

  void take_scan(CLI::App* command) {
    command->add_option("SCAN", opening.scan, "STL, PLY, OBJ, OFF (also as .gz) or 3MF")
        ->required();
    command->add_flag("--no-weld", no_weld,
                      "Vertices that lie on one place stay apart, as the file has them (not the "
                      "corners of STL)");
    take_unit(command, opening.unit);
  }
  const Opening& scan() {
    opening.weld = !no_weld;
    return opening;
  }
  void take_unit(CLI::App* command, std::string& unit) {
    command
        ->add_option("--unit", unit,
                     "What lengths of the scan are in: " + length_unit_keys() +
                         "; left out: as the file says. Told, not computed with")
        ->check([](const std::string& text) {
          return find_length_unit(text) ? std::string()
                                        : "'" + text + "' is not one of " + length_unit_keys();
        });
  }
  void take_output(CLI::App* command, const std::string& help) {
    command->add_option("-o,--output", output, help)->required();
  }
  void take_places(CLI::App* command) {
    command->add_option("-o,--output", places.folder, "The folder for the results")->required();
    command->add_option("--session", places.session,
                        "Also write one file with scan and operations, for the window (*.arris)");
  }
  void take_replaying(CLI::App* command) {
    command
        ->add_option("OPERATIONS", replaying.operations,
                     "A session (*.arris), or a file of operations, one JSON a line")
        ->required();
    command->add_option("--scan", replaying.scan, "Open this scan instead of the named one");
    command->add_option("--at", replaying.version,
                        "Of the version of this name, not the last state");
    take_unit(command, replaying.unit);
  }
};

void add_scan_commands(CommandLine& line) {
  CLI::App* info_command = line.add("info", "What a scan holds and what was mended",
                                    [&line] { return info(line.scan(), line.as_json); });
  line.take_scan(info_command);
  info_command->add_flag("--json", line.as_json, "The whole load report as JSON");

  CLI::App* curvature_command =
      line.add("curvature", "Write K H Kabs IK IH IKabs as vertex properties of a PLY",
               [&line] { return curvature(line.scan(), line.output); });
  line.take_scan(curvature_command);
  line.take_output(curvature_command, "The PLY to write");
}

void add_simplify(CommandLine& line) {
  CLI::App* command = line.add("simplify", "Remove vertices inside error zones and write a PLY");
  line.take_scan(command);
  line.take_output(command, "The PLY to write");
  const auto options = std::make_shared<StepOptions>(*command, "simplify");
  line.on(command, [&line, options] {
    nlohmann::json parameters{{"max_edge_length", 0.0}};  // no limit, unless it is asked for
    parameters.update(options->given());
    return simplify(line.scan(), line.output, parameters);
  });
}

/// Options of `segment`, and what they mean together.
struct SegmentOptions {
  std::string flow = "scan";
  bool no_prepare = false, swap = false;
  std::deque<StepOptions> steps;  // in the order of the chain

  explicit SegmentOptions(CLI::App* command) {
    command
        ->add_option("--flow", flow,
                     "scan: lines and partitions on the scan's own mesh (default); paper: figure "
                     "2, simplify, lines by the walk, equilateralise, partitions")
        ->check(CLI::IsMember({"scan", "paper"}));
    command->add_flag("--no-prepare", no_prepare, "The same as --flow scan");
    // It costs more of the weak lines than it mends of the noise.
    command->add_flag("--swap", swap, "Swap edges before finding lines; --flow paper");
    for (const ChainStep& step : chain_steps)
      steps.emplace_back(*command, step.name, step.changes_mesh ? "With --flow paper" : "");
  }

  Flow which_flow() const { return flow == "paper" ? Flow::paper : Flow::scan; }

  /// Parameters of the steps that options name. Throws where options contradict one another.
  StepParameters wanted() const {
    const bool paper = which_flow() == Flow::paper;
    if (no_prepare && paper)
      throw CLI::ValidationError("--no-prepare", "it contradicts --flow paper");
    StepParameters wanted;
    if (swap) wanted["swap_edges"] = nlohmann::json::object();
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const CLI::Option* first = steps[k].first();
      if (!first) continue;
      if (chain_steps[k].changes_mesh && !paper) needs_paper_flow(first->get_name());
      wanted[std::string(chain_steps[k].name)] = steps[k].given();
    }
    if (swap && !paper) needs_paper_flow("--swap");
    check_methods(wanted);
    return wanted;
  }

 private:
  [[noreturn]] static void needs_paper_flow(const std::string& option) {
    throw CLI::ValidationError(option,
                               "it changes the mesh before lines are found, which only the paper's "
                               "flow does: add --flow paper");
  }

  /// Options count with one method; for partitions they choose it where neither flow nor
  /// --partitions does.
  void check_methods(StepParameters& wanted) const {
    for (const Operation& operation : operations_of(which_flow())) {
      const std::size_t place = place_in_chain(operation.name);
      const Parameter* parameter = find_operation(operation.name)->find("method");
      if (!parameter || !steps[place].first()) continue;
      nlohmann::json& own = wanted[operation.name];
      const bool chooses = !parameter->otherwise.from().empty() &&
                           !operation.parameters.contains("method") && !own.contains("method");
      const std::string usual(parameter->choices.front().key);
      auto stray =
          steps[place].stray(own.value("method", operation.parameters.value("method", usual)));
      if (stray && chooses) {
        own["method"] = stray->method;
        stray = steps[place].stray(stray->method);
      }
      if (stray)
        throw CLI::ValidationError(stray->option->get_name(),
                                   "it counts with another method only: add --" +
                                       std::string(parameter->option) + " " +
                                       std::string(stray->method));
    }
  }
};

void add_segment(CommandLine& line) {
  CLI::App* command =
      line.add("segment", "Find sharp lines and partitions; defaults come from the part");
  line.take_scan(command);
  line.take_places(command);
  const auto options = std::make_shared<SegmentOptions>(command);
  line.on(command, [&line, options] {
    return segment(line.scan(), line.places, options->which_flow(), options->wanted());
  });
}

void add_session_commands(CommandLine& line) {
  CLI::App* replay_command = line.add("replay", "Run a session or list of operations",
                                      [&line] { return replay(line.replaying, line.places); });
  line.take_replaying(replay_command);
  line.take_places(replay_command);

  auto what = std::make_shared<std::string>();
  const std::string exports = exports_text("");
  CLI::App* export_command =
      line.add("export", "Write one thing of a session for another program",
               [&line, what] { return export_one(line.replaying, *what, line.output); });
  line.take_replaying(export_command);
  export_command->add_option("--what", *what, exports)
      ->required()
      ->check([exports](const std::string& given) {
        return exports_text(given).empty() ? "one of " + exports : std::string();
      });
  line.take_output(export_command, "The file to write; its ending says the format");

  auto versions = std::make_shared<std::array<std::string, 2>>();
  CLI::App* compare_command = line.add(
      "compare", "Where two named versions of a session divide the part otherwise",
      [&line, versions] { return compare(line.replaying.operations, *versions, line.as_json); });
  compare_command
      ->add_option("OPERATIONS", line.replaying.operations,
                   "A session (*.arris), or its operations")
      ->required();
  compare_command->add_option("VERSION", (*versions)[0], "The name of a version")->required();
  compare_command->add_option("OTHER", (*versions)[1], "Another one; left out: the last state");
  compare_command->add_flag("--json", line.as_json, "All numbers as JSON");
}

void add_report_commands(CommandLine& line) {
  auto request = std::make_shared<ReportRequest>();
  CLI::App* report_command =
      line.add("report", "Write a report of a session: HTML with its histograms",
               [&line, request] { return report(line.replaying, *request); });
  line.take_replaying(report_command);
  report_command
      ->add_option("-o,--output", request->folder,
                   "The folder for it; what changed since a report there is marked")
      ->required();
  report_command->add_option("--title", request->options.title, "Left out: the name of the part");
  report_command->add_option("--company", request->options.company, "Who reports");
  report_command->add_option("--logo", request->logo, "A picture, copied beside the report");
  report_command->add_option("--page", request->page,
                             "A page of one's own, HTML with places as {{partitions}}");

  CLI::App* page_command =
      line.add("report-page", "Write the page of reports, to be changed for --page",
               [&line] { return commands::report_page(line.output); });
  line.take_output(page_command, "The HTML to write");
}

void add_other_commands(CommandLine& line) {
  CLI::App* sample_command = line.add("sample", "Write the sample mould as a PLY",
                                      [&line] { return sample(line.output); });
  line.take_output(sample_command, "The PLY to write");
  line.add("schema", "Print the JSON schema of operations, for programs that write lists of them",
           schema);

  // For the build and the file manager; not in the help.
  line.add("manual-page", "Write arris-cli(1)",
           [&line] {
             std::cout << cli_manual(line.app, ARRIS_VERSION);
             return std::cout.flush() ? 0 : bad_input;
           })
      ->group("");
  CLI::App* thumbnail_command =
      line.add("thumbnail", "Write the picture that a session holds",
               [&line] { return thumbnail(line.places.session, line.output); });
  thumbnail_command->group("");
  thumbnail_command->add_option("SESSION", line.places.session, "A session (*.arris)")->required();
  line.take_output(thumbnail_command, "The PNG to write");
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  line.app.require_subcommand(1);
  line.app.set_version_flag("--version", std::string("arris-cli ") + ARRIS_VERSION);
  add_scan_commands(line);
  add_simplify(line);
  add_segment(line);
  add_session_commands(line);
  add_report_commands(line);
  add_other_commands(line);
  try {
    line.app.parse(argc, argv);
    return line.run();
  } catch (const CLI::ParseError& error) {
    return line.app.exit(error) == 0 ? 0 : bad_usage;
  }
}
