// SPDX-License-Identifier: Apache-2.0
// Files for tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incise_test {

/// A folder of its own, with a space in its name, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file, in place of what had its name, and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  /// The names of what is in it, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string read(const std::string& path);

/// The unit cube of 6·n³ tets as a MEDIT file; `fraction` as in `incise::jitter`.
std::string cube_mesh(unsigned n, double fraction = 0);

}  // namespace incise_test
