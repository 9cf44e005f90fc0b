// SPDX-License-Identifier: Apache-2.0
// Blocks of 4³ voxels with one label are known as such: whole boxes are told uniform by their blocks.
#include "image/label_volume.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr std::int64_t kBlock = 4;

}  // namespace

LabelVolume::LabelVolume(const LabelImage& image)
    : size_{static_cast<std::int64_t>(image.size[0]), static_cast<std::int64_t>(image.size[1]),
            static_cast<std::int64_t>(image.size[2])},
      spacing_(image.spacing()),
      labels_{0} {
  std::vector<LabelIndex> index(image.labels.size(), 0);
  for (std::size_t l = 0; l < image.labels.size(); ++l) {
    if (image.labels[l] == 0) continue;
    index[l] = static_cast<LabelIndex>(labels_.size());
    labels_.push_back(image.labels[l]);
  }
  voxels_.resize(image.voxels.size());
  std::transform(image.voxels.begin(), image.voxels.end(), voxels_.begin(), [&](std::uint16_t v) { return index[v]; });
  index_blocks();
}

LabelIndex LabelVolume::at(const Vec3& p) const {
  std::array<std::int64_t, 3> v{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto c = static_cast<Eigen::Index>(a);
    v[a] = static_cast<std::int64_t>(std::floor(p[c] / spacing_[c] + 0.5));
  }
  return at(v[0], v[1], v[2]);
}

bool LabelVolume::has_only(const Range& range, LabelIndex label) const {
  for (std::int64_t k = range[4]; k < range[5]; ++k) {
    for (std::int64_t j = range[2]; j < range[3]; ++j) {
      const LabelIndex* voxel = row(j, k);
      for (std::int64_t i = range[0]; i < range[1]; ++i) {
        if (voxel[i] != label) return false;
      }
    }
  }
  return true;
}

void LabelVolume::index_blocks() {
  for (std::size_t a = 0; a < 3; ++a) blocks_[a] = (size_[a] + kBlock - 1) / kBlock;
  block_label_.resize(static_cast<std::size_t>(blocks_[0] * blocks_[1] * blocks_[2]));
  std::size_t b = 0;
  for (std::int64_t z = 0; z < blocks_[2]; ++z) {
    for (std::int64_t y = 0; y < blocks_[1]; ++y) {
      for (std::int64_t x = 0; x < blocks_[0]; ++x) {
        const Range range = {x * kBlock, std::min((x + 1) * kBlock, size_[0]),
                             y * kBlock, std::min((y + 1) * kBlock, size_[1]),
                             z * kBlock, std::min((z + 1) * kBlock, size_[2])};
        const LabelIndex first = at(range[0], range[2], range[4]);
        block_label_[b++] = has_only(range, first) ? first : kMixed;
      }
    }
  }
}

LabelIndex LabelVolume::uniform_label(const Vec3& lo, const Vec3& hi) const {
  Range range{};
  bool is_within = true;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto c = static_cast<Eigen::Index>(a);
    const auto first = static_cast<std::int64_t>(std::floor(lo[c] / spacing_[c] - 0.5));
    const auto last = static_cast<std::int64_t>(std::floor(hi[c] / spacing_[c] + 1.5));
    is_within = is_within && first >= 0 && last < size_[a];
    range[2 * a] = std::clamp<std::int64_t>(first, 0, size_[a]);
    range[2 * a + 1] = std::clamp<std::int64_t>(last + 1, 0, size_[a]);
    if (range[2 * a] >= range[2 * a + 1]) return 0;
  }
  const LabelIndex label = is_within ? at(range[0], range[2], range[4]) : LabelIndex{0};
  for (std::int64_t z = range[4] / kBlock; z * kBlock < range[5]; ++z) {
    for (std::int64_t y = range[2] / kBlock; y * kBlock < range[3]; ++y) {
      for (std::int64_t x = range[0] / kBlock; x * kBlock < range[1]; ++x) {
        const LabelIndex block = block_label_[static_cast<std::size_t>((z * blocks_[1] + y) * blocks_[0] + x)];
        if (block == label) continue;
        const Range part = {std::max(x * kBlock, range[0]), std::min((x + 1) * kBlock, range[1]),
                            std::max(y * kBlock, range[2]), std::min((y + 1) * kBlock, range[3]),
                            std::max(z * kBlock, range[4]), std::min((z + 1) * kBlock, range[5])};
        if (block != kMixed || !has_only(part, label)) return kMixed;
      }
    }
  }
  return label;
}

bool LabelVolume::find_extent(Vec3& lo, Vec3& hi) const {
  std::array<std::int64_t, 3> first = size_, last = {-1, -1, -1};
  for (std::int64_t k = 0; k < size_[2]; ++k) {
    for (std::int64_t j = 0; j < size_[1]; ++j) {
      const LabelIndex* voxel = row(j, k);
      std::int64_t i = 0, end = size_[0];
      while (i < end && voxel[i] == 0) ++i;
      if (i == end) continue;
      while (voxel[end - 1] == 0) --end;
      first = {std::min(first[0], i), std::min(first[1], j), std::min(first[2], k)};
      last = {std::max(last[0], end - 1), std::max(last[1], j), std::max(last[2], k)};
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const auto c = static_cast<Eigen::Index>(a);
    lo[c] = static_cast<double>(first[a]) * spacing_[c];
    hi[c] = static_cast<double>(last[a]) * spacing_[c];
  }
  return last[0] >= 0;
}

std::vector<std::uint64_t> LabelVolume::count_voxels() const {
  std::vector<std::uint64_t> counts(labels_.size(), 0);
  for (const LabelIndex voxel : voxels_) ++counts[voxel];
  return counts;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
