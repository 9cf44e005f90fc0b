// SPDX-License-Identifier: Apache-2.0
// Voxels hold the place of their label in a sorted list, so that renaming and merging change the list and a table.
#include "incise/image/label_image.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Replaces the labels of an image, `renamed[index]` for each, and drops what has become double or is not used.
void rename_labels(LabelImage& image, const std::vector<std::int32_t>& renamed) {
  const std::vector<std::uint64_t> counts = image.count_voxels();
  std::vector<std::int32_t> labels;
  for (std::size_t l = 0; l < renamed.size(); ++l) {
    if (counts[l] > 0) labels.push_back(renamed[l]);
  }
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::vector<std::uint16_t> index(renamed.size(), 0);
  for (std::size_t l = 0; l < renamed.size(); ++l) {
    const auto found = std::lower_bound(labels.begin(), labels.end(), renamed[l]);
    if (counts[l] > 0) index[l] = static_cast<std::uint16_t>(found - labels.begin());
  }
  for (std::uint16_t& voxel : image.voxels) voxel = index[voxel];
  image.labels = std::move(labels);
}

}  // namespace

double LabelImage::voxel_volume() const {
  return std::abs(step[0].cross(step[1]).dot(step[2]));
}

std::size_t LabelImage::find_label(std::int32_t label) const {
  const auto found = std::lower_bound(labels.begin(), labels.end(), label);
  const bool is_there = found != labels.end() && *found == label;
  return is_there ? static_cast<std::size_t>(found - labels.begin()) : labels.size();
}

std::vector<std::uint64_t> LabelImage::count_voxels() const {
  std::vector<std::uint64_t> counts(labels.size(), 0);
  for (const std::uint16_t voxel : voxels) ++counts[voxel];
  return counts;
}

void merge_label(LabelImage& image, std::int32_t from, std::int32_t to) {
  std::vector<std::int32_t> renamed = image.labels;
  std::replace(renamed.begin(), renamed.end(), from, to);
  rename_labels(image, renamed);
}

void keep_labels(LabelImage& image, const std::vector<std::int32_t>& kept) {
  std::vector<std::int32_t> renamed = image.labels;
  for (std::int32_t& label : renamed) {
    if (std::find(kept.begin(), kept.end(), label) == kept.end()) label = 0;
  }
  rename_labels(image, renamed);
}

}  // namespace image
}  // namespace v0
}  // namespace incise
