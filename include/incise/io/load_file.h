// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "incise/core/result.h"
#include "incise/io/mesh_file.h"

namespace incise {
inline namespace v0 {
namespace io {

/// All bytes of a file, as they are: nothing is gunzipped.
///
/// Errors: `kBadFile` for what cannot be opened or read, folders and devices; `kOutOfMemory` beyond
/// `limits.max_inflated_bytes`. Cost: O(bytes).
[[nodiscard]] Result<std::string> load_file(const std::filesystem::path& path, const ReadLimits& limits = {});

}  // namespace io
}  // namespace v0
}  // namespace incise
