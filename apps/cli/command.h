// SPDX-License-Identifier: Apache-2.0
// A command of the program: what it is called, what it takes, what it does.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "terminal.h"

namespace incise_cli {

/// One command, with its arguments in `run`: read when the words were parsed.
struct Command {
  CLI::App* words;                          ///< its name, help and options
  std::function<int(const Terminal&)> run;  ///< returns its exit code
};

/// Adds a command to the program.
using AddCommand = Command (*)(CLI::App& root);

/// Adds all commands; what is read here, `--help`, the manual pages and the completion all tell.
std::vector<Command> add_commands(CLI::App& root);

}  // namespace incise_cli
