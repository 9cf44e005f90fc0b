// SPDX-License-Identifier: Apache-2.0
// The commands with their options: what is read here, `--help`, the manual pages and the completion all tell.
#pragma once

#include <CLI/CLI.hpp>

#include "commands.h"

namespace incise_cli {

struct Arguments {
  InfoArguments info, check;
  CutArguments cut;
  ImproveArguments improve;
  SimulateArguments simulate;
  ReplayArguments replay;
  ConvertArguments convert;
  std::string shell;   // that is to be completed
  std::string manual;  // the command whose page is asked for; empty: the program's
};

/// Adds all commands; parsing `root` fills `arguments`.
void add_commands(CLI::App& root, Arguments& arguments);

}  // namespace incise_cli
