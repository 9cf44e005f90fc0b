// SPDX-License-Identifier: Apache-2.0
// What the commands share.
#pragma once

#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "terminal.h"

namespace incise_cli {

/// Says what went wrong, and returns the exit code.
int fail(const Terminal& terminal, const incise::Error& error, ExitCode code);
int fail(const Terminal& terminal, const std::string& message, ExitCode code);

/// The exit code of a command whose last step this was; an error is told.
int finish(const Terminal& terminal, const incise::Status& status);

/// How an error of a stage that reads and writes files ends the program.
ExitCode exit_of(const incise::Error& error);

void print_notes(const std::vector<std::string>& notes, const std::string& file, const Terminal& terminal);

bool is_same_file(const std::string& a, const std::string& b);

/// A file that an option names.
struct NamedFile {
  const char* option;
  std::string file;  ///< empty: none; "-": stdout
};
/// In words: which of some files would take the place of another one of them, or of others that the command reads or
/// writes, or of what belongs to these (`files_of`). Empty: none.
std::string clash_of(const std::vector<NamedFile>& files, const std::vector<std::string>& others);
/// Whether the folder of an output exists: found out before the work, not after.
bool has_folder(const std::string& file);

incise::Profile profile_of(const std::string& name);

}  // namespace incise_cli
