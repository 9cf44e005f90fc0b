// SPDX-License-Identifier: Apache-2.0
// Options that several commands have.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh_output.h"

namespace incise_cli {

inline constexpr const char* kMeshHelp = "Mesh file, or - for stdin; the format is found from its content";

/// A command of the program, with examples below its help.
CLI::App* add_command(CLI::App& root, const std::string& name, const std::string& what, const std::string& examples);
void add_json(CLI::App& command, bool& as_json);
/// Refuses an empty name: that of a variable that is not set.
const CLI::Validator& names_a_file();
/// The same of a result: /dev/stdout is -.
const CLI::Validator& names_a_result();
/// A whole number from 0 up, in decimal digits.
const CLI::Validator& is_whole();
void add_report(CLI::App& command, std::string& report, bool& as_json);
/// `more`: names of formats besides those of meshes.
void add_format(CLI::App& command, std::string& format, const std::vector<std::string>& more = {});
void add_output(CLI::App& command, MeshOutput& output);
void add_profile(CLI::App& command, std::string& profile);
void add_budget(CLI::App& command, std::uint64_t& budget_us, const std::string& what);
/// `seed`: std::uint64_t, or an optional of it.
template <class Seed>
void add_seed(CLI::App& command, Seed& seed, const std::string& what) {
  command.add_option("--seed", seed, what)->transform(is_whole());
}
void add_threads(CLI::App& command, unsigned& threads);

}  // namespace incise_cli
