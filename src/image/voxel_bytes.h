// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "image/inflate.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace image {

/// The bytes of voxels, one piece after the other, so that no more than a piece of them is held unpacked.
class VoxelBytes {
 public:
  /// `name` is the file's; what they name outlives this.
  VoxelBytes(std::string_view raw, const std::string& name) : left_(raw), most_(raw.size()), name_(name) {}
  /// Of a gzip or zlib stream, from its byte `skip` on.
  VoxelBytes(std::string_view packed, std::uint64_t skip, const std::string& name);

  /// The next `size` bytes; fewer where they end before. They stay until the next call. Errors: kBadFile.
  [[nodiscard]] Result<std::string_view> next(std::size_t size);
  /// More bytes than these cannot come.
  [[nodiscard]] std::uint64_t most() const { return most_; }

 private:
  std::string_view left_;
  std::optional<InflateStream> stream_;
  std::uint64_t skip_ = 0, most_ = 0;
  std::string piece_;
  const std::string& name_;
};

}  // namespace image
}  // namespace v0
}  // namespace incise
