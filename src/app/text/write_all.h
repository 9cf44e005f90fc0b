// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// That a file or folder cannot be written, why, and what to do about it. Error: kIo.
[[nodiscard]] Error write_error(const std::filesystem::path& path, const std::error_code& why);
/// The same where the remedy is in the reason.
[[nodiscard]] Error write_error(const std::filesystem::path& path, const std::string& why);
/// The same, as the system says it: `errno`.
[[nodiscard]] Error write_error(const std::filesystem::path& path);

/// Writes all of a text to an open file descriptor, in one call of the system where it takes that much. `path` is for
/// the message. Errors: kIo, naming the file. Cost: O(size).
Status write_all(int file, std::string_view text, const std::filesystem::path& path);

}  // namespace app
}  // namespace v0
}  // namespace incise
