// SPDX-License-Identifier: Apache-2.0
// Here a command is registered: its declaration, since nobody else calls it, and its place in the list.
#include <array>

#include "command.h"

namespace incise_cli {

Command add_info(CLI::App& root);
Command add_check(CLI::App& root);
Command add_cut(CLI::App& root);
Command add_improve(CLI::App& root);
Command add_simulate(CLI::App& root);
Command add_replay(CLI::App& root);
Command add_batch(CLI::App& root);
Command add_convert(CLI::App& root);
Command add_mesh(CLI::App& root);
Command add_completion(CLI::App& root);
Command add_man(CLI::App& root);

namespace {

/// In the order of the help.
constexpr std::array<AddCommand, 11> kCommands = {add_info,     add_check,      add_cut,   add_improve,
                                                  add_simulate, add_replay,     add_batch, add_convert,
                                                  add_mesh,     add_completion, add_man};

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 a check failed, 5 no display, 130 interrupted.\n"
    "Formats: .mesh .msh .vtk .vtu .node/.ele .veg .inp, tetrahedral .ply (read only); all also gzipped.\n"
    "- for a mesh reads it from stdin, and -o - writes it to stdout, with --format.";

}  // namespace

std::vector<Command> add_commands(CLI::App& root) {
  root.require_subcommand(1);
  root.footer(std::string("incise help COMMAND tells more of a command.\n\nExamples:\n  incise info liver.msh\n  "
                          "incise cut cube.mesh --plane 1,0,0,0.5 -o halves.vtu\n"
                          "  incise improve halves.vtu -o better.vtu\n  incise help cut\n\n") +
              kExitCodes);
  std::vector<Command> commands;
  for (const AddCommand add : kCommands) commands.push_back(add(root));
  return commands;
}

}  // namespace incise_cli
