// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

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

/// Why a file that begins so is of no use; nothing where it may be of some.
using BeginningCheck = std::function<std::optional<Error>(std::string_view beginning)>;

/// The same, but of a pipe that gives more than 256 KiB, those are shown to `check` before the rest is read: it may
/// have no end.
///
/// Errors: those of `load_file`, and what `check` says. Cost: O(bytes).
[[nodiscard]] Result<std::string> load_file_if(const std::filesystem::path& path, const ReadLimits& limits,
                                               const BeginningCheck& check);

/// The same of a mesh or a surface, for `read_mesh_bytes` and `read_surface_bytes`. What begins as neither is refused
/// once its first 256 KiB are there, so that a pipe without an end is not read.
///
/// Errors: those of `load_file`; `kUnsupported` for what is neither. Cost: O(bytes).
[[nodiscard]] Result<std::string> load_mesh_or_surface(const std::filesystem::path& path,
                                                       const ReadLimits& limits = {});

}  // namespace io
}  // namespace v0
}  // namespace incise
