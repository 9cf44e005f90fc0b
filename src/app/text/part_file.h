// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace incise {
inline namespace v0 {
namespace app {

/// Opens a new file beside `path`, named by `io::part_file`, and takes away what killed processes left there. Returns
/// what to write to and close; below 0, with `errno`, where none can be made, or what stands there is write-protected.
[[nodiscard]] int open_part(const std::filesystem::path& path, std::filesystem::path& part);

}  // namespace app
}  // namespace v0
}  // namespace incise
