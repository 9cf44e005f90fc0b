// SPDX-License-Identifier: Apache-2.0
// The words of a command line: what they were meant to be where they are not known.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace incise_apps {

using Words = std::vector<std::string>;

/// " (did you mean ...?)" with the known word nearest to one that is not known; empty where none is near.
[[nodiscard]] std::string suggestion(const std::string& word, const Words& known);

/// Its long options, with their dashes.
[[nodiscard]] Words options_of(const CLI::App& command);

/// Nothing where there is none of that name.
[[nodiscard]] const CLI::App* command_named(const CLI::App& root, const std::string& name);

/// Says that a command is not known; empty where it is, or where none is named.
[[nodiscard]] std::string unknown_command(const CLI::App& root, const Words& words);

/// What is wrong with the words of a call whose command, if it has commands and names one, is known: in one line, with
/// where to read more.
[[nodiscard]] std::string explain(const CLI::App& root, const Words& words, const CLI::ParseError& error);

/// Makes `help` and `help COMMAND` the `--help` of either.
void take_help(Words& words);

}  // namespace incise_apps
