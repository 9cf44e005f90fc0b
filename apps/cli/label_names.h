// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "incise/core/result.h"

namespace incise_cli {

using LabelNames = std::map<std::int32_t, std::string>;

/// Reads a text file with a label and its name on each line: "3 left kidney", or with "=" or "," between, or as
/// ITK-SNAP writes it, the name in quotes at the end. Empty lines, and lines that begin with #, are passed over.
/// Errors: kBadFile, naming file and line.
[[nodiscard]] incise::Result<LabelNames> read_label_names(const std::filesystem::path& file);

}  // namespace incise_cli
