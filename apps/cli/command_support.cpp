// SPDX-License-Identifier: Apache-2.0
// What kind of error ends the program with which code is decided here alone.
#include "command_support.h"

#include <filesystem>
#include <system_error>

#include "input_kind.h"
#include "mesh_output.h"

namespace incise_cli {

namespace fs = std::filesystem;
using namespace incise;

int fail(const Terminal& terminal, const Error& error, ExitCode code) {
  terminal.error(error.message);
  return code;
}

int fail(const Terminal& terminal, const std::string& message, ExitCode code) {
  terminal.error(message);
  return code;
}

int finish(const Terminal& terminal, const Status& status) {
  return status.ok() ? int{kDone} : fail(terminal, status.error(), kFailure);
}

ExitCode exit_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::kBadArgument:
      return kUsage;
    case ErrorCode::kIo:
    case ErrorCode::kInternal:
      return kFailure;
    case ErrorCode::kBadFile:
    case ErrorCode::kUnsupported:
    case ErrorCode::kOutOfMemory:
      return kBadInput;
  }
  return kFailure;
}

void print_notes(const std::vector<std::string>& notes, const std::string& file, const Terminal& terminal) {
  for (const std::string& text : notes) terminal.note(name_of_input(file) + ": " + text);
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code code;
  if (fs::exists(a, code) && fs::exists(b, code)) return fs::equivalent(a, b, code);
  return fs::absolute(a, code).lexically_normal() == fs::absolute(b, code).lexically_normal();
}

std::string clash_of(const std::vector<NamedFile>& files, const std::vector<std::string>& others) {
  std::vector<std::string> taken;
  for (const std::string& other : others) {
    const std::vector<std::string> all = files_of(other);
    taken.insert(taken.end(), all.begin(), all.end());
  }
  for (const auto& [option, file] : files) {
    if (file.empty() || file == "-") continue;
    for (const std::string& other : taken) {
      if (other.empty() || other == "-" || !is_same_file(file, other)) continue;
      return std::string(option) + " " + file + " is another file of this command; give it a name of its own";
    }
    taken.push_back(file);
  }
  return {};
}

bool has_folder(const std::string& file) {
  if (file.empty() || file == "-") return true;
  const fs::path folder = fs::path(file).parent_path();
  std::error_code code;
  return folder.empty() || fs::is_directory(folder, code);
}

Profile profile_of(const std::string& name) {
  return name == "paper" ? Profile::kPaper : Profile::kIncise;
}

}  // namespace incise_cli
