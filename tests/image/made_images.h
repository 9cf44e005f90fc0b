// SPDX-License-Identifier: Apache-2.0
// Label images of shapes that are known exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "incise/image/label_image.h"

namespace incise_test {

/// The label at a point, mm.
using Truth = std::function<std::int32_t(const incise::Vec3&)>;

struct MadeImage {
  std::string name;
  Truth truth;
  double extent = 128;                          ///< mm along each axis, from the middle of the first voxel on
  incise::Vec3 spacing = incise::Vec3::Ones();  ///< mm
  double noise = 0;                             ///< share of the voxels that get any label instead
  std::vector<std::int32_t> labels;
  std::vector<bool> is_wide;  ///< of each label: its radius is above two spacings of 4 mm
};

MadeImage ball_in_ball();
MadeImage triple_junctions();
/// A shell of two voxels around a ball.
MadeImage thin_shell(double radius = 40);
MadeImage vessel_tree();
MadeImage noisy_balls();
/// Two vertebrae (1) with a canal, the disc between them (2), and muscle around (3): a segment of a spine.
MadeImage spine_segment();
/// A block of 40 × 28 × 18 mm with sharp edges, along the axes or across them.
MadeImage block(bool is_turned);
/// Five labels in a box of 256 mm: an organ with two tumours, a vessel and a bone beside it.
MadeImage large_organ();
/// The first five.
std::vector<MadeImage> made_images();

/// Samples the truth at the middle of each voxel.
incise::image::LabelImage to_image(const MadeImage& made);

/// The volumes of the truth's labels, mm³: voxels at interfaces are sampled 5³ times.
std::vector<double> true_volumes(const MadeImage& made);

}  // namespace incise_test
