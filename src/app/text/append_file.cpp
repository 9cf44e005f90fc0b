// SPDX-License-Identifier: Apache-2.0
#include "app/text/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kMode = 0666;

Error io_error(const fs::path& path, const std::string& why) {
  return {ErrorCode::kIo, path.string() + ": cannot be written: " + why, {}};
}

Error io_error(const fs::path& path) {
  return io_error(path, std::strerror(errno));
}

/// While it lives, signals wait: one that ends the program would leave the file beside.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

AppendFile::~AppendFile() {
  if (file_ >= 0) ::close(file_);
}

Status AppendFile::append(std::string_view text) {
  if (broken_) return *broken_;
  Status status = file_ < 0 ? open_and_write(text) : write(text);
  if (!status.ok()) broken_ = status.error();
  return status;
}

Status AppendFile::open_and_write(std::string_view text) {
  std::error_code code;
  const fs::file_status status = fs::status(path_, code);
  if (fs::is_directory(status)) return io_error(path_, "it is a directory; name a file");
  if (!fs::exists(status) || fs::is_regular_file(status)) return create(text);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  return file_ < 0 ? io_error(path_) : write(text);
}

Status AppendFile::create(std::string_view text) {
  const SignalsWait signals_wait;
  fs::path beside = path_;
  beside += ".incise-part";
  file_ = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (file_ < 0) return io_error(path_);
  std::error_code code;
  Status status = write(text);
  if (status.ok()) fs::rename(beside, path_, code);
  if (status.ok() && code) status = io_error(path_, code.message());
  if (!status.ok()) fs::remove(beside, code);
  return status;
}

Status AppendFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file_, text.data(), text.size());
    if (count < 0 && errno != EINTR) return io_error(path_);
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
