// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace incise {
inline namespace v0 {
namespace app {

/// A file's path as seen from a recording's folder, so that both can be moved together; empty for an empty path.
inline std::string seen_from(const std::filesystem::path& recording, const std::filesystem::path& file) {
  if (file.empty()) return {};
  std::error_code code;
  const std::filesystem::path folder =
      recording.parent_path().empty() ? std::filesystem::path(".") : recording.parent_path();
  const std::filesystem::path seen = std::filesystem::proximate(file, folder, code);
  return (code ? file : seen).generic_string();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
