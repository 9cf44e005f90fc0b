// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Whether there is a file that can be opened for reading. Errors: kBadFile, naming the file. Cost: O(1).
[[nodiscard]] Status check_readable(const std::filesystem::path& path);

/// Reads a whole file. Errors: kBadFile, naming the file, where it is missing, a directory, unreadable or larger than
/// `max_bytes`. Cost: O(size).
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Writes a file beside its place and renames it: either the whole text is seen under its name or what was there
/// before. Errors: kIo, naming the file. Cost: O(size).
[[nodiscard]] Status write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace app
}  // namespace v0
}  // namespace incise
