// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace incise {
inline namespace v0 {
namespace app {

/// Whether files come without their folders, as they do to a page, whose people choose or drop them.
#ifdef __EMSCRIPTEN__
inline constexpr bool kFilesComeAlone = true;
#else
inline constexpr bool kFilesComeAlone = false;
#endif

/// Where a file is that another one names: seen from that one's folder, else as its path stands; where files come
/// alone, else by the last part of its path, of any system, in that folder. Nothing where it is in none of these.
[[nodiscard]] std::optional<std::filesystem::path> find_named(const std::filesystem::path& folder,
                                                              const std::string& file,
                                                              bool come_alone = kFilesComeAlone);

}  // namespace app
}  // namespace v0
}  // namespace incise
