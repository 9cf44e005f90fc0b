// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace incise_view {

/// A list of files to choose from: GLFW brings none of its own.
class FileList {
 public:
  /// Shows it, in the folder where it was left, at first the current one.
  void open();
  /// Draws it where it is open. Returns the file that was chosen in this frame.
  [[nodiscard]] std::optional<std::filesystem::path> draw();

 private:
  struct Entry {
    std::string name;
    bool is_folder;
  };

  void read();
  std::filesystem::path draw_names();

  std::filesystem::path folder_;
  std::vector<Entry> names_;
};

}  // namespace incise_view
