// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "incise/core/result.h"

namespace incise_web {

/// A folder of its own in the module's memory, for the files that something is opened from. Goes with the object.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();

  /// Where a file of this name stands; what leads out of the folder is cut off its name.
  [[nodiscard]] std::filesystem::path place_of(const std::string& name) const;
  /// The error with names instead of places in this folder, which nobody outside knows.
  [[nodiscard]] incise::Error named(incise::Error error) const;
  [[nodiscard]] incise::Status named(const incise::Status& status) const;
  /// Writes a file. Errors: kIo where memory is out.
  [[nodiscard]] incise::Status write(const std::string& name, std::string_view bytes) const;
  /// Reads one. Errors: kIo where it is not there.
  [[nodiscard]] incise::Result<std::string> read(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

}  // namespace incise_web
