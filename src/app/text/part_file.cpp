// SPDX-License-Identifier: Apache-2.0
// Opens what is written beside its place under a name of its own, so that two writers never share one.
#include "app/text/part_file.h"

#include <fcntl.h>

#include <cerrno>

#include "incise/io/part_file.h"

namespace incise {
inline namespace v0 {
namespace app {

int open_part(const std::filesystem::path& path, std::filesystem::path& part) {
  constexpr mode_t kMode = 0666;
  constexpr unsigned kMostAtOnce = 1000;
  if (io::is_protected(path)) return errno = EACCES, -1;
  io::remove_stale_parts(path);
  int file = -1;
  for (unsigned i = 0; i < kMostAtOnce; ++i) {
    part = io::part_file(path, i);
    file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
    if (file >= 0 || errno != EEXIST) break;
  }
  return file;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
