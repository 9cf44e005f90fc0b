// SPDX-License-Identifier: Apache-2.0
// Prints what the reader makes of a label image: sizes, origin and steps, then the labels, i fastest.
#include <cstdio>

#include "incise/image/image_file.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto file = incise::image::read_labels(argv[1]);
  if (!file) {
    std::fprintf(stderr, "%s\n", file.error().message.c_str());
    return 3;
  }
  const incise::image::LabelImage& image = file->image;
  std::printf("%zu %zu %zu\n", image.size[0], image.size[1], image.size[2]);
  for (const incise::Vec3& v : {image.origin, image.step[0], image.step[1], image.step[2]}) {
    std::printf("%.17g %.17g %.17g\n", v.x(), v.y(), v.z());
  }
  for (const std::uint16_t voxel : image.voxels) std::printf("%d\n", image.labels[voxel]);
  return 0;
}
