// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/image/label_image.h"

namespace incise {
inline namespace v0 {
namespace image {

/// A label's place in `LabelVolume::labels`; 0 is the background.
using LabelIndex = std::uint16_t;
inline constexpr LabelIndex kMixed = 0xFFFF;

/// A label image along its own axes: voxel (i, j, k) is centred at (i, j, k) times the spacing, and background is all
/// around. What is to be meshed is asked here.
class LabelVolume {
 public:
  /// The background comes first, whether the image has it or not.
  explicit LabelVolume(const LabelImage& image);

  [[nodiscard]] const std::array<std::int64_t, 3>& size() const { return size_; }
  [[nodiscard]] const Vec3& spacing() const { return spacing_; }
  [[nodiscard]] const std::vector<std::int32_t>& labels() const { return labels_; }
  [[nodiscard]] const std::vector<LabelIndex>& voxels() const { return voxels_; }
  /// The row of voxels along i.
  [[nodiscard]] const LabelIndex* row(std::int64_t j, std::int64_t k) const {
    return voxels_.data() + (k * size_[1] + j) * size_[0];
  }
  /// The label of a voxel; background outside.
  [[nodiscard]] LabelIndex at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    const bool is_in = i >= 0 && j >= 0 && k >= 0 && i < size_[0] && j < size_[1] && k < size_[2];
    return is_in ? row(j, k)[i] : LabelIndex{0};
  }
  /// The label of the voxel around a point, mm.
  [[nodiscard]] LabelIndex at(const Vec3& p) const;

  /// Joins every island (voxels of one label that faces connect) of fewer voxels than this to the label that it has
  /// most faces with; holes in a label too. Returns how many voxels changed. Cost: O(voxels).
  std::uint64_t join_islands(std::uint64_t least_voxels);
  /// Has `uniform_label` look at what the voxels are now.
  void index_blocks();
  /// The one label that all voxels have whose centres lie in a box, grown by half a voxel, or `kMixed`.
  [[nodiscard]] LabelIndex uniform_label(const Vec3& lo, const Vec3& hi) const;
  /// The first and last voxel along each axis that are no background, mm; false where there is none.
  [[nodiscard]] bool find_extent(Vec3& lo, Vec3& hi) const;
  [[nodiscard]] std::vector<std::uint64_t> count_voxels() const;

 private:
  using Range = std::array<std::int64_t, 6>;
  [[nodiscard]] bool has_only(const Range& range, LabelIndex label) const;

  std::array<std::int64_t, 3> size_, blocks_ = {0, 0, 0};
  Vec3 spacing_;
  std::vector<std::int32_t> labels_;
  std::vector<LabelIndex> voxels_;
  std::vector<LabelIndex> block_label_;  // of cubes of voxels, or kMixed
};

}  // namespace image
}  // namespace v0
}  // namespace incise
