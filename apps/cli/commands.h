// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "terminal.h"

namespace incise_cli {

struct InfoArguments {
  std::string mesh;
  bool as_json = false;
};

/// Where a mesh is written, and as what.
struct MeshOutput {
  std::string file;    ///< "-": stdout; empty: nowhere
  std::string format;  ///< a name of `io::write_options_named`; empty: what the extension says

  [[nodiscard]] bool is_wanted() const { return !file.empty(); }
  [[nodiscard]] bool is_stdout() const { return file == "-"; }
};

struct CutArguments {
  std::string mesh, blade, plane, report, record, picture;
  MeshOutput output;
  bool as_json = false;
  std::string profile = "incise";
  double snap = 0.2;
  bool has_snap = false;
  bool no_merge = false, no_improve = false, no_smooth_boundary = false;
  std::uint64_t budget_us = 0;  // 0: none
  std::uint64_t seed = 0;
  unsigned threads = 1;
};

struct ImproveArguments {
  std::string mesh, report;
  MeshOutput output;
  bool as_json = false;
  std::string profile = "incise";
  std::uint64_t budget_us = 0;  // 0: none
};

struct ReplayArguments {
  std::string recording;
  MeshOutput output;
  bool verify = false;
  bool as_json = false;
};

struct SimulateArguments {
  std::string scene, output, report, record;
  std::string profile;                // empty: the scene's
  std::uint64_t frames = 0;           // 0: the scene's
  std::uint64_t every = 0;            // 0: as `SimulateJob`
  std::uint64_t budget_us = 0;        // 0: the scene's work units
  std::optional<std::uint64_t> seed;  // unset: the scene's
  unsigned threads = 1;
  bool as_json = false;
  bool is_ideal = false;  // the exercise's ideal strokes instead of the scene's
};

struct ConvertArguments {
  std::string in;
  MeshOutput out;
  bool as_json = false;
};

/// Each runs one command and returns its exit code.
int run_info(const InfoArguments& arguments, const Terminal& terminal);
int run_check(const InfoArguments& arguments, const Terminal& terminal);
int run_cut(const CutArguments& arguments, const Terminal& terminal);
int run_improve(const ImproveArguments& arguments, const Terminal& terminal);
int run_simulate(const SimulateArguments& arguments, const Terminal& terminal);
int run_replay(const ReplayArguments& arguments, const Terminal& terminal);
int run_convert(const ConvertArguments& arguments, const Terminal& terminal);

}  // namespace incise_cli
