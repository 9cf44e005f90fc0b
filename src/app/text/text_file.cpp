// SPDX-License-Identifier: Apache-2.0
// Files are opened with stdio rather than streams, which do not say why they fail.
#include "app/text/text_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "app/text/part_file.h"
#include "app/text/write_all.h"
#include "incise/io/part_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error bad_file(const fs::path& path, const std::string& what) {
  return {ErrorCode::kBadFile, path.string() + ": " + what, {}};
}

Error io_error(const fs::path& path, const std::string& what) {
  return {ErrorCode::kIo, path.string() + ": " + what, {}};
}

/// Writes to what was opened for `path`, and closes it.
Status write_and_close(int file, std::string_view text, const fs::path& path) {
  if (file < 0) return write_error(path);
  Status status = write_all(file, text, path);
  if (::close(file) != 0 && status.ok()) status = write_error(path);
  return status;
}

}  // namespace

Status check_readable(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (path.empty()) return Error{ErrorCode::kBadFile, "the name of the file is empty; give one", {}};
  if (!fs::exists(status)) return bad_file(path, "no such file; check the path");
  if (fs::is_directory(status)) return bad_file(path, "is a folder; give a file in it");
  if (::access(path.c_str(), R_OK) == 0) return {};
  return bad_file(path, std::string("cannot be opened: ") + std::strerror(errno));
}

Result<std::string> read_text_file(const fs::path& path, std::size_t max_bytes) {
  if (const Status status = check_readable(path); !status.ok()) return status.error();
  const auto too_large = [&] { return bad_file(path, "is larger than " + std::to_string(max_bytes >> 20U) + " MiB"); };
  std::error_code code;
  if (fs::is_regular_file(path, code) && fs::file_size(path, code) > max_bytes && !code) return too_large();
  File file(std::fopen(path.string().c_str(), "rb"));
  if (!file) return bad_file(path, std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  char buffer[1U << 16U];
  std::size_t got = 0;
  while ((got = std::fread(buffer, 1, sizeof buffer, file.get())) > 0) {
    text.append(buffer, got);
    if (text.size() > max_bytes) return too_large();
  }
  if (std::ferror(file.get()) != 0) return bad_file(path, "cannot be read");
  return text;
}

Status write_text_file(const fs::path& path, std::string_view text) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) return io_error(path, "is a folder; give a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status)) {  // a pipe or a device
    return write_and_close(::open(path.c_str(), O_WRONLY | O_CLOEXEC), text, path);
  }
  fs::path beside;
  const int file = open_part(path, beside);
  Status written = write_and_close(file, text, path);
  if (written.ok()) code = io::put_in_place(beside, path);
  if (written.ok() && code) written = write_error(path, code);
  if (!written.ok() && file >= 0) fs::remove(beside, code);
  return written;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
