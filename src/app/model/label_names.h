// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "incise/core/result.h"
#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Reads a text file with a label and its name on each line: "3 left kidney", or with "=" or "," between, or as
/// ITK-SNAP writes it, the name in quotes at the end. Empty lines, and lines that begin with #, are passed over.
/// Errors: kBadFile, naming file and line.
[[nodiscard]] Result<io::RegionNames> read_label_names(const std::filesystem::path& file);

}  // namespace app
}  // namespace v0
}  // namespace incise
