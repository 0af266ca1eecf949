#include "app/cli_manual.h"

#include "core/document/operation.h"
#include "core/document/operation_manual.h"

namespace arris {

namespace {

/// "-o,--output TEXT REQUIRED"
std::string name_of(const CLI::Option& option) {
  return option.get_name(option.get_positional(), true) +
         CLI::Formatter().make_option_opts(&option);
}

void add_options(ManualPage& page, const CLI::App& command) {
  for (const bool positional : {true, false})
    for (const CLI::Option* option : command.get_options())
      if (option->get_positional() == positional && option != command.get_help_ptr())
        page.entry(name_of(*option), option->get_description());
}

}  // namespace

std::string cli_manual(const CLI::App& app, const std::string& version) {
  ManualPage page(app.get_name(), version, "sharp lines and partitions of scanned moulds");
  page.section("SYNOPSIS");
  page.example(app.get_name() + " COMMAND [ARGUMENTS] [OPTIONS]");
  page.section("DESCRIPTION");
  page.paragraph(app.get_description());
  page.section("OPTIONS");
  page.entry(name_of(*app.get_help_ptr()), app.get_help_ptr()->get_description());
  add_options(page, app);
  page.section("COMMANDS");
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_group().empty()) continue;
    page.subsection(command->get_name());
    page.paragraph(command->get_description() + ".");
    add_options(page, *command);
  }
  page.section("OPERATIONS");
  page.paragraph(
      "The replay command runs operations from a file, one JSON object a line, as segment writes "
      "them to operations.jsonl:");
  page.example(Operation{"find_sharp_lines", {{"angle", 24.0}}}.text());
  page.paragraph(
      "Angles are in degrees, lengths in the unit of the scan. \"version\" may be given with each: "
      "that of the method when the operation was written.");
  add_operations(page);
  page.section("SEE ALSO");
  page.paragraph("arris(1)");
  return page.text();
}

}  // namespace arris
