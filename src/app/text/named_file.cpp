// SPDX-License-Identifier: Apache-2.0
// Looks for what scenes and recordings name.
#include "app/text/named_file.h"

#include <system_error>

namespace incise {
inline namespace v0 {
namespace app {

std::optional<std::filesystem::path> find_named(const std::filesystem::path& folder, const std::string& file,
                                                bool come_alone) {
  std::error_code code;
  for (const std::filesystem::path& path : {folder / file, std::filesystem::path(file)}) {
    if (std::filesystem::exists(path, code)) return path;
  }
  const std::string last = file.substr(file.find_last_of("/\\") + 1);
  if (!come_alone || last.empty() || !std::filesystem::exists(folder / last, code)) return std::nullopt;
  return folder / last;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
