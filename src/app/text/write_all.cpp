// SPDX-License-Identifier: Apache-2.0
#include "app/text/write_all.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace incise {
inline namespace v0 {
namespace app {

Error write_error(const std::filesystem::path& path, const std::string& why) {
  return {ErrorCode::kIo, path.string() + ": cannot be written: " + why, {}};
}

Error write_error(const std::filesystem::path& path) {
  return write_error(path, std::strerror(errno));
}

Status write_all(int file, std::string_view text, const std::filesystem::path& path) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno != EINTR) return write_error(path);
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
