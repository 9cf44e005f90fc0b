// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace image {

/// The most different labels that an image may have: more than atlases have, fewer than the grey values of a scan.
inline constexpr std::size_t kMostLabels = 4096;

/// A segmented scan: one label per voxel, and where the voxels lie.
///
/// The centre of voxel (i, j, k) is `origin` + i·`step[0]` + j·`step[1]` + k·`step[2]`, in RAS millimetres: x to the
/// patient's right hand, y to the front, z to the head. Steps are finite and linearly independent.
struct LabelImage {
  std::array<std::size_t, 3> size = {0, 0, 0};                               ///< voxels along i, j, k, each at least 1
  std::array<Vec3, 3> step = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  ///< from a voxel to the next, mm
  Vec3 origin = Vec3::Zero();                                                ///< centre of voxel (0, 0, 0), mm
  std::vector<std::uint16_t> voxels;  ///< `size[0]·size[1]·size[2]`, i fastest: indices into `labels`
  std::vector<std::int32_t> labels;   ///< rising; at most `kMostLabels`

  /// Where voxel (i, j, k) stands in `voxels`; each below its `size`.
  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * size[1] + j) * size[0] + i;
  }
  /// The label of voxel (i, j, k).
  [[nodiscard]] std::int32_t label(std::size_t i, std::size_t j, std::size_t k) const {
    return labels[voxels[index(i, j, k)]];
  }
  /// Distance between neighbouring voxels along each axis, mm.
  [[nodiscard]] Vec3 spacing() const { return {step[0].norm(), step[1].norm(), step[2].norm()}; }
  /// Volume of one voxel, mm³.
  [[nodiscard]] double voxel_volume() const;
  /// The index of a label in `labels`; `labels.size()` where no voxel has it.
  [[nodiscard]] std::size_t find_label(std::int32_t label) const;
  /// Voxels of each label, beside `labels`. Cost: O(voxels).
  [[nodiscard]] std::vector<std::uint64_t> count_voxels() const;
};

/// Give all voxels of label `from` the label `to`, which need not have been there. Cost: O(voxels).
void merge_label(LabelImage& image, std::int32_t from, std::int32_t to);

/// Give all voxels of other labels than these the label 0, the background. Cost: O(voxels).
void keep_labels(LabelImage& image, const std::vector<std::int32_t>& kept);

}  // namespace image
}  // namespace v0
}  // namespace incise
