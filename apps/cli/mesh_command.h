// SPDX-License-Identifier: Apache-2.0
// The command `incise mesh`: a segmented scan becomes tets.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "terminal.h"

namespace incise_cli {

struct MeshArguments {
  std::string input, output, names, report, picture;
  double size = 0, smooth = 0.7, grade = 0.5;
  std::vector<int> labels;
  std::vector<std::string> merges;
  int halvings = 2;
  unsigned threads = 1;
};

void add_mesh(CLI::App& root, MeshArguments& arguments);

/// Returns the command's exit code.
int run_mesh(const MeshArguments& arguments, const Terminal& terminal);

}  // namespace incise_cli
