// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "incise/core/result.h"

namespace incise_view {

/// Makes a film of pictures that are named 000000.png, 000001.png, … in a folder, by the program ffmpeg.
/// Errors: kIo where there is no ffmpeg, with what to do, or where it fails.
[[nodiscard]] incise::Status make_film(const std::filesystem::path& folder, const std::filesystem::path& film,
                                       double pictures_per_second);

/// A new folder for temporary files, removed with what is in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  /// Empty where none could be made.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace incise_view
