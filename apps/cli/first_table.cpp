// SPDX-License-Identifier: Apache-2.0
// The commands of incise_first, which script/demo builds and runs before the rest is compiled
// (docs/decisions/0155).
#include <array>

#include "command.h"

namespace incise_cli {

Command add_check(CLI::App& root);
Command add_cut(CLI::App& root);

std::span<const AddCommand> command_table() {
  static constexpr std::array<AddCommand, 2> kCommands = {add_check, add_cut};
  return kCommands;
}

}  // namespace incise_cli
