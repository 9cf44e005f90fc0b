// SPDX-License-Identifier: Apache-2.0
// What a file is by its name.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace incise {
inline namespace v0 {
namespace app {

/// The extension in lower case, without `.gz`.
[[nodiscard]] inline std::string extension_of(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.size() > 3 && name.compare(name.size() - 3, 3, ".gz") == 0) name.resize(name.size() - 3);
  return std::filesystem::path(name).extension().string();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
