// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A file that grows in place, and whose content outlives the program at any moment: nothing is buffered here.
///
/// The first text is written beside the file's place and renamed, so that the file begins with all of it or is what it
/// was before. Pipes and devices are written to as they are.
class AppendFile {
 public:
  explicit AppendFile(std::filesystem::path path) : path_(std::move(path)) {}
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();

  /// Appends in one write. Errors: kIo, naming the file; then everything later fails likewise. Cost: O(size).
  Status append(std::string_view text);

 private:
  Status open_and_write(std::string_view text);
  Status create(std::string_view text);

  std::filesystem::path path_;
  int file_ = -1;
  std::optional<Error> broken_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
