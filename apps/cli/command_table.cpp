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

std::span<const AddCommand> command_table() {
  static constexpr std::array<AddCommand, 11> kCommands = {add_info,     add_check,      add_cut,   add_improve,
                                                           add_simulate, add_replay,     add_batch, add_convert,
                                                           add_mesh,     add_completion, add_man};
  return kCommands;
}

}  // namespace incise_cli
