// SPDX-License-Identifier: Apache-2.0
// The files that lines of a batch name: whether they still are as they were written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/jobs/batch_lines.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Judges files of a folder, line by line. Disks fill and lose power: a line may be there, and its file cut off.
class BatchFiles {
 public:
  enum class Care : std::uint8_t {
    kSizes,    ///< whether they are there, and meshes after cuts as long as they were; a look at each file
    kContent,  ///< the bytes of meshes after cuts; those before them, and strokes, by reading them
  };
  BatchFiles(std::filesystem::path folder, Care care) : folder_(std::move(folder)), care_(care) {}

  /// The files of a line that are not there, or not as they were written, seen from the folder. A mesh before its cuts,
  /// which many lines name, is judged for the first of them alone.
  [[nodiscard]] std::vector<std::string> broken(const BatchLine& line);

 private:
  [[nodiscard]] bool is_mesh_as_written(const BatchLine& line) const;
  [[nodiscard]] bool is_input_sound(const BatchLine& line) const;
  [[nodiscard]] bool are_strokes_sound(const std::string& file) const;

  std::filesystem::path folder_;
  Care care_;
  std::set<std::string> inputs_;  // that were judged
};

/// Takes away what killed workers left half-written in the folder of a batch; files of a worker that is at its shard
/// stay. Cost: O(files).
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace app
}  // namespace v0
}  // namespace incise
