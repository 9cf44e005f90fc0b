// SPDX-License-Identifier: Apache-2.0
// Files are opened with stdio rather than streams, which do not say why they fail.
#include "app/text/text_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "app/text/write_all.h"

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

bool write_file(const fs::path& path, std::string_view text) {
  File file(std::fopen(path.string().c_str(), "wb"));
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size()) return false;
  return std::fclose(file.release()) == 0;
}

Status write_in_place(const fs::path& path, std::string_view text) {
  if (write_file(path, text)) return {};
  return write_error(path);
}

}  // namespace

Status check_readable(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (path.empty()) return Error{ErrorCode::kBadFile, "the name of the file is empty; give one", {}};
  if (!fs::exists(status)) return bad_file(path, "no such file; check the path");
  if (fs::is_directory(status)) return bad_file(path, "is a directory; name a file");
  if (::access(path.c_str(), R_OK) == 0) return {};
  return bad_file(path, std::string("cannot be opened: ") + std::strerror(errno));
}

Result<std::string> read_text_file(const fs::path& path, std::size_t max_bytes) {
  if (const Status status = check_readable(path); !status.ok()) return status.error();
  File file(std::fopen(path.string().c_str(), "rb"));
  if (!file) return bad_file(path, std::string("cannot be opened: ") + std::strerror(errno));
  std::string text;
  char buffer[1U << 16U];
  std::size_t got = 0;
  while ((got = std::fread(buffer, 1, sizeof buffer, file.get())) > 0) {
    text.append(buffer, got);
    if (text.size() > max_bytes) return bad_file(path, "is larger than " + std::to_string(max_bytes >> 20U) + " MiB");
  }
  if (std::ferror(file.get()) != 0) return bad_file(path, "cannot be read");
  return text;
}

Status write_text_file(const fs::path& path, std::string_view text) {
  fs::path beside = path;
  beside += ".incise-part";
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) return io_error(path, "is a directory; name a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_in_place(path, text);  // a pipe or a device
  if (!write_file(beside, text)) {
    Error error = write_error(path);
    fs::remove(beside, code);
    return error;
  }
  fs::rename(beside, path, code);
  if (!code) return {};
  Error error = write_error(path, code);
  fs::remove(beside, code);
  return error;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
