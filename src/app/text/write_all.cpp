// SPDX-License-Identifier: Apache-2.0
// Each reason that the system gives gets the remedy that a person can apply.
#include "app/text/write_all.h"

#include <unistd.h>

#include <cerrno>
#include <string>

namespace incise {
inline namespace v0 {
namespace app {

namespace {

const char* remedy_for(const std::error_code& why) {
  switch (why.value()) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "; make room on the disk, or choose another one";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a file and a folder that you may write to";
    case ENOENT:
      return "; choose a folder that is there and that files can be made in";
    case ENOTDIR:
      return "; a part of the path is a file: choose a folder";
    case ENAMETOOLONG:
      return "; choose a shorter name";
    default:
      return "; check the disk, or choose another folder";
  }
}

}  // namespace

Error write_error(const std::filesystem::path& path, const std::string& why) {
  return {ErrorCode::kIo, path.string() + ": cannot be written: " + why, {}};
}

Error write_error(const std::filesystem::path& path, const std::error_code& why) {
  return write_error(path, why.message() + remedy_for(why));
}

Error write_error(const std::filesystem::path& path) {
  return write_error(path, std::error_code(errno, std::generic_category()));
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
