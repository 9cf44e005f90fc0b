// SPDX-License-Identifier: Apache-2.0
// Any bytes go into the readers of label images; what reads is checked.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "incise/image/image_file.h"

namespace {

using namespace incise;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_image(const image::LabelImage& image) {
  require(!image.labels.empty() && image.labels.size() <= image::kMostLabels);
  require(std::is_sorted(image.labels.begin(), image.labels.end()));
  require(image.voxels.size() == image.size[0] * image.size[1] * image.size[2] && !image.voxels.empty());
  for (const std::uint16_t voxel : image.voxels) require(voxel < image.labels.size());
  for (const Vec3& step : image.step) require(step.allFinite());
  require(image.origin.allFinite() && image.voxel_volume() > 0);
}

}  // namespace

// The bytes 00 00 2D 2D 00 part the two files of a pair.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t gap = all.find("\0\0--\0", 0, 5);
  const std::string second(gap == std::string_view::npos ? std::string_view() : all.substr(gap + 5));
  const io::SiblingLoader sibling = [&second](const std::string&) -> Result<std::string> { return second; };
  const Result<image::ImageFile> file = image::read_labels_bytes(all.substr(0, gap), "fuzz", sibling);
  if (file) {
    check_image(file->image);
  } else {
    require(file.error().message.find(';') != std::string::npos);
  }
  return 0;
}
