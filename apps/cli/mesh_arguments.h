// SPDX-License-Identifier: Apache-2.0
// What `incise mesh` is asked for.
#pragma once

#include <string>
#include <vector>

#include "mesh_output.h"

namespace incise_cli {

struct MeshArguments {
  std::string input, names, report, picture;
  MeshOutput output;
  bool as_json = false;
  double size = 0, smooth = 0.7, grade = 0.5;
  std::vector<int> labels;
  std::vector<std::string> merges, layers;
  std::vector<int> layers_in;
  std::vector<std::string> may_lose;  ///< labels, or "all"
  int halvings = 2;
  unsigned threads = 1;

  [[nodiscard]] bool has_report_on_stdout() const { return as_json || report == "-"; }
};

}  // namespace incise_cli
