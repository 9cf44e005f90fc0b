// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "incise/core/result.h"

namespace incise_cli {

/// What "-" stands for where a file is read: /dev/stdin.
[[nodiscard]] std::string input_of(const std::string& argument);
[[nodiscard]] bool is_stdin(const std::string& argument);
/// What such a file is called in messages and reports: stdin for "-" and /dev/stdin.
[[nodiscard]] std::string name_of_input(const std::string& argument);

/// The kinds of files that commands read.
enum class FileKind { kUnknown, kMesh, kScene, kBlade, kRecording, kPlan, kReport };

/// Says of a file that could not be read as what the command wants that it is something else, and what to do with it;
/// the error as it came where it is not, or cannot be told. Cost: reads the file once more.
[[nodiscard]] incise::Error explain_kind(incise::Error error, const std::string& file, FileKind wanted);

}  // namespace incise_cli
