// SPDX-License-Identifier: Apache-2.0
// What the headers of all formats come down to, and what makes labels of the bytes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "image/voxel_bytes.h"
#include "incise/core/result.h"
#include "incise/image/label_image.h"

namespace incise {
inline namespace v0 {
namespace image {

enum class VoxelType : std::uint8_t {
  kUint8,
  kInt8,
  kUint16,
  kInt16,
  kUint32,
  kInt32,
  kUint64,
  kInt64,
  kFloat32,
  kFloat64,
  kUnknown
};

/// Bytes of one voxel.
[[nodiscard]] std::size_t bytes_of(VoxelType type);
/// For people, for instance "16-bit integers".
[[nodiscard]] std::string name_of(VoxelType type);

/// A header: how the voxels lie in the file, and in space.
struct VoxelLayout {
  std::array<std::uint64_t, 3> size = {1, 1, 1};
  VoxelType type = VoxelType::kUnknown;
  bool is_big_endian = false;
  double slope = 1, intercept = 0;  ///< label = slope · value + intercept
  std::array<Vec3, 3> step = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  Vec3 origin = Vec3::Zero();
};

/// Most voxels along an axis, and in all: sizes beyond are taken for damage.
inline constexpr std::uint64_t kMostAlongAxis = std::uint64_t{1} << 20U, kMostVoxels = std::uint64_t{1} << 34U;

/// Turns LPS coordinates into RAS.
void turn_to_ras(VoxelLayout& layout);

/// Whether sizes, steps and origin make sense; else why not, without the file's name.
[[nodiscard]] std::string problem_of(const VoxelLayout& layout);

/// Bytes that all voxels take; only where `problem_of` has nothing to say.
[[nodiscard]] std::uint64_t bytes_of(const VoxelLayout& layout);

/// Makes labels of the first `bytes_of(layout)` bytes. Errors: kBadFile where there are fewer, kUnsupported for values
/// that are no labels; `name` is the file's. Memory: 2 bytes per voxel that there can be.
[[nodiscard]] Result<LabelImage> decode(const VoxelLayout& layout, VoxelBytes& bytes, const std::string& name);

/// That there are not as many bytes as the header says.
[[nodiscard]] Error too_few(const std::string& name, std::uint64_t there, std::uint64_t wanted);

}  // namespace image
}  // namespace v0
}  // namespace incise
