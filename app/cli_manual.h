#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace arris {

/// arris-cli(1), from what the command line knows of itself and from the table of operations.
std::string cli_manual(const CLI::App& app, const std::string& version);

}  // namespace arris
