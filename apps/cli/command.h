// SPDX-License-Identifier: Apache-2.0
// A command of the program: what it is called, what it takes, what it does.
#pragma once

#include <functional>
#include <span>

#include "terminal.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's
class App;
}  // namespace CLI

namespace incise_cli {

/// One command, with its arguments in `run`: read when the words were parsed.
struct Command {
  CLI::App* words;                          ///< its name, help and options
  std::function<int(const Terminal&)> run;  ///< returns its exit code
};

/// Adds a command to the program.
using AddCommand = Command (*)(CLI::App& root);

/// The commands of this program, in the order of the help.
std::span<const AddCommand> command_table();

}  // namespace incise_cli
