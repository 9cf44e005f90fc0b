// SPDX-License-Identifier: Apache-2.0
// Runs the built command as a user's shell would, without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incise_test {

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal where one ended it
  std::string out, err;
};

/// Runs `incise` with these arguments, stdin empty.
Outcome run(const std::vector<std::string>& arguments);
/// The same, and sends SIGINT after `seconds`.
Outcome run_interrupted(const std::vector<std::string>& arguments, double seconds);

/// A folder of its own, with a space in its name, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;
  /// The names of what is in it, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string read(const std::string& path);

/// The unit cube of 6·n³ tets as a MEDIT file.
std::string cube_mesh(unsigned n);

}  // namespace incise_test
