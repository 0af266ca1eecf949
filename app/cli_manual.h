#pragma once

#include <CLI/CLI.hpp>

#include "core/base/result.h"

namespace arris {

/// arris-cli(1), from what the command line knows of itself and from the table of operations.
Result<std::string> cli_manual(const CLI::App& app, const std::string& version);

}  // namespace arris
