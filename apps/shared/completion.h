// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace incise_apps {

/// A script for bash that completes the commands, options and values of a program, and files elsewhere. What it knows
/// is what `--help` prints.
[[nodiscard]] std::string bash_completion(const CLI::App& root);

/// The same for zsh, with what each option does.
[[nodiscard]] std::string zsh_completion(const CLI::App& root);

/// For bash, of another program, whose options are asked for by its --help when they are wanted.
[[nodiscard]] std::string bash_completion_by_help(const std::string& name);

}  // namespace incise_apps
