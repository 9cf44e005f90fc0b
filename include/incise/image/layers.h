// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/image/label_image.h"

namespace incise {
inline namespace v0 {
namespace image {

/// A layer of even thickness, such as skin.
struct Layer {
  std::string name;      ///< for messages
  double thickness = 0;  ///< mm, above 0
};

/// How layers grow.
struct LayerOptions {
  std::vector<Layer> layers;              ///< from the surface inwards; at least one
  std::vector<std::int32_t> within = {};  ///< labels that give their voxels to layers; empty: all but 0
  double smooth =
      0.7;  ///< as in `MeshLabelsOptions`; the surface that depths are measured from is smoothed by a voxel at least
  double size = 0;        ///< of the tets, mm, as in `MeshLabelsOptions`
  int most_halvings = 2;  ///< likewise: layers must not be thinner than the finest tets
  unsigned threads = 1;   ///< in [1, 256]; the result does not depend on it
};

/// A label image with layers as further labels.
struct LayeredImage {
  LabelImage image;                           ///< with the layers as its last labels
  std::vector<std::int32_t> labels;           ///< of each layer: those after the image's largest
  std::array<std::size_t, 3> finer{1, 1, 1};  ///< voxels along each axis for one of the image that was given
  double smooth = 0;                          ///< for `MeshLabelsOptions`: as given, more where voxels are finer
  std::uint64_t cut_off = 0;                  ///< voxels at the border of the image, where no layer grows
  std::vector<std::int32_t> swallowed;        ///< labels that had voxels and have none left
  std::vector<std::uint64_t> voxels;          ///< of each layer
};

/// The thinnest layer that tets can follow, in edges of the finest cubes of their lattice.
inline constexpr double kThinnestLayer = 1.2;
/// The most voxels that an image is made of for the sake of thin layers.
inline constexpr double kMostLayeredVoxels = 4e8;

/// Gives the voxels near the outer surface of a segmented body to layers, by their exact distance from it.
///
/// The surface is where the smoothed indicator of what lies around the body is a half: within a fraction of a voxel of
/// the true one, whatever the voxels' steps. Cavities within the body have no layers, nor has the body where the border
/// of the image cuts it off. Where a layer is thinner than two voxels the image is made finer first, axis by axis.
/// Errors: kBadArgument for thicknesses and sizes out of range, layers thinner than `kThinnestLayer` of the finest
/// tets, a layer that no part of the body is thick enough for, or one that would take more than `kMostLayeredVoxels`;
/// the message names the layer. Cost: about 1 µs per voxel near the surfaces of layers and 10 ns for the others.
/// Bit-identical on every compiler.
/// **Source:** S. Gibson, "Constrained elastic surface nets", 1998 (a point in each cell that the surface passes; here
/// at the mean of where it crosses the cell's edges).
[[nodiscard]] Result<LayeredImage> grow_layers(const LabelImage& image, const LayerOptions& options);

}  // namespace image
}  // namespace v0
}  // namespace incise
