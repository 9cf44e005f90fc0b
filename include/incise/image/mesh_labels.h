// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "incise/core/result.h"
#include "incise/image/label_image.h"
#include "incise/improve/options.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace image {

/// How a label image becomes tets.
struct MeshLabelsOptions {
  double size = 0;          ///< edge of the lattice's cubes at interfaces, mm, above 0; tets have edges of about that
  double smooth = 0.7;      ///< standard deviation of the smoothing of interfaces, voxels, in [0.4, 10]
  double grade = 0.5;       ///< growth of edges per mm of distance from interfaces, in [0, 10]; 0: none
  int most_halvings = 2;    ///< of `size` where a label is thinner than three spacings, in [0, 4]; never below a voxel
  double least_island = 0;  ///< islands of less volume join what is around them, mm³; 0: an eighth of size³
  bool improve = true;      ///< maintain the mesh at the end, see `Maintainer`
  unsigned threads = 1;     ///< in [1, 256]; the result does not depend on it
  /// Volumes that the labels shall have, mm³, beside `LabelImage::labels`; 0, or empty: those of their voxels.
  std::vector<double> volumes = {};
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< called between stages; may be empty
};

/// What became of a label.
struct LabelOutcome {
  std::int32_t label = 0;    ///< as in the image
  std::uint64_t voxels = 0;  ///< that were to be meshed, after islands were joined
  double image_volume = 0;   ///< of these, or as told, mm³
  std::uint64_t tets = 0;    ///< of this label
  double volume = 0;         ///< of these, mm³
};

/// Tets of a label image.
struct LabelMesh {
  TetMesh mesh;                       ///< in RAS millimetres; regions are labels
  std::vector<LabelOutcome> labels;   ///< of all labels but 0, rising
  std::uint64_t island_voxels = 0;    ///< that were given to what was around them
  std::uint64_t relabelled_tets = 0;  ///< so that no label touches itself in an edge or a point alone
  std::uint64_t pinched_points = 0;   ///< where that could not be had; 0 except for images finer than the lattice
  double finest_size = 0;             ///< edge of the smallest cubes, mm
  MaintainStatistics maintain;        ///< what maintenance did at the end
};

/// Makes tets of all labels but 0 of a segmented scan: conforming where labels meet, without gaps between them.
///
/// A body-centred cubic lattice, finer where a label is thin and coarser away from interfaces; each tet gets the label
/// that it has most of; points of interfaces move to where the smoothed indicators of the labels are alike, as far as
/// all dihedral angles stay above 12° and L/r below 20; the levels at which they are alike are set so that each label
/// has the volume of its voxels; then the mesh is maintained, which keeps the interfaces.
/// @param image  with at least one voxel of a label other than 0.
/// Errors: kBadArgument for options out of range, an image without labels, or a size so small that there would be more
/// than 10⁸ tets; kOutOfMemory. Cost: about 20 µs per tet and 5 ns per voxel; 600 bytes per tet. Bit-identical on every
/// compiler and for every number of threads.
/// **Source:** F. Labelle, J. Shewchuk, "Isosurface stuffing", 2007 (graded lattice); J. Bronson, J. Levine,
/// R. Whitaker, "Lattice cleaving", 2014 (interfaces of indicators). Differs from both: no tet is cut; whole tets get
/// labels.
[[nodiscard]] Result<LabelMesh> mesh_labels(const LabelImage& image, const MeshLabelsOptions& options);

}  // namespace image
}  // namespace v0
}  // namespace incise
