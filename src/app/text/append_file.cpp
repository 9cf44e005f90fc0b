// SPDX-License-Identifier: Apache-2.0
// The first text is written under another name and renamed, with signals held back; all others are single writes to
// the file's end.
#include "app/text/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <system_error>

#include "app/text/part_file.h"
#include "app/text/write_all.h"
#include "incise/io/part_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

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
  Status status = file_ < 0 ? open_and_write(text) : write_all(file_, text, path_);
  if (!status.ok()) broken_ = status.error();
  return status;
}

Status AppendFile::open_and_write(std::string_view text) {
  std::error_code code;
  const fs::file_status status = fs::status(path_, code);
  if (fs::is_directory(status)) return write_error(path_, "it is a folder; give a file in it");
  if (!fs::exists(status) || fs::is_regular_file(status)) return create(text);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  return file_ < 0 ? write_error(path_) : write_all(file_, text, path_);
}

Status AppendFile::create(std::string_view text) {
  const SignalsWait signals_wait;
  fs::path beside;
  file_ = open_part(path_, beside);
  if (file_ < 0) return write_error(path_);
  std::error_code code;
  Status status = write_all(file_, text, path_);
  if (status.ok()) code = io::put_in_place(beside, path_);
  if (status.ok() && code) status = write_error(path_, code);
  if (!status.ok()) fs::remove(beside, code);
  return status;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
