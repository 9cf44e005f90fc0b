// SPDX-License-Identifier: Apache-2.0
// Voxels come piece by piece, raw or unpacked on the way, so that an unpacked file is never held whole.
#include "image/voxel_bytes.h"

#include <algorithm>
#include <utility>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr std::uint64_t kSkippedAtOnce = std::uint64_t{1} << 20U;

}  // namespace

VoxelBytes::VoxelBytes(std::string_view packed, std::uint64_t skip, const std::string& name)
    : stream_(std::in_place, packed), skip_(skip), most_(kMaxInflation * (packed.size() + 1)), name_(name) {}

Result<std::string_view> VoxelBytes::next(std::size_t size) {
  if (!stream_) {
    const std::string_view piece = left_.substr(0, size);
    left_.remove_prefix(piece.size());
    return piece;
  }
  std::string why;
  bool is_sound = true;
  while (is_sound && skip_ > 0) {
    is_sound = stream_->read(static_cast<std::size_t>(std::min(skip_, kSkippedAtOnce)), piece_, why);
    skip_ = piece_.empty() ? 0 : skip_ - piece_.size();
  }
  if (is_sound && stream_->read(size, piece_, why)) return std::string_view(piece_);
  return Error{ErrorCode::kBadFile, name_ + ": " + why};
}

}  // namespace image
}  // namespace v0
}  // namespace incise
