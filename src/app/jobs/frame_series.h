// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Writes a body over time as ParaView reads it: NAME.pvd, and one .vtu per moment in the folder NAME_frames beside.
///
/// All is written beside its place and moved there by `finish`: until then what had these names stays as it was, and
/// without it nothing is left. A series that is there already is replaced; a folder of that name that holds anything
/// else is not touched. Of two that are written at once under one name the second is refused. Not thread-safe.
class FrameSeries {
 public:
  /// @param path  NAME.pvd. Errors: kIo, naming the folder that cannot be made, is in the way, or is being written.
  static Result<FrameSeries> begin(const std::filesystem::path& path);
  FrameSeries(FrameSeries&& other) noexcept;
  FrameSeries& operator=(FrameSeries&&) = delete;
  ~FrameSeries();

  /// Adds a moment, at `time` in s. Errors: as `io::write_mesh`. Cost: O(size).
  Status add(double time, const io::MeshData& mesh);
  /// Puts the series in its place. Errors: kIo; then what was there before is there again.
  Status finish();

  [[nodiscard]] std::size_t size() const { return times_.size(); }

 private:
  explicit FrameSeries(std::filesystem::path path);

  [[nodiscard]] Status take_beside();
  [[nodiscard]] std::string collection() const;

  std::filesystem::path path_, folder_, beside_;
  std::vector<double> times_;
  int lock_ = -1;  // `beside_`, locked; below 0: not ours
};

}  // namespace app
}  // namespace v0
}  // namespace incise
