// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image/label_field.h"
#include "image/octree.h"

namespace incise {
inline namespace v0 {
namespace image {

/// How fine the lattice is.
struct LatticeOptions {
  double size = 1;        ///< edge of the cubes at interfaces, mm
  double grade = 0.5;     ///< edges grow by so much per mm from the interfaces; 0: not at all
  int most_halvings = 2;  ///< of `size`, where labels are thin
};

/// The most halvings and doublings of `size`.
inline constexpr int kMostHalvings = 4, kDoublings = 2;

/// How often `size` is halved at most: cubes of less than half a voxel tell nothing more.
[[nodiscard]] int count_halvings(double voxel, double size, int most_halvings);

/// The leaves of the lattice around all labels of a volume: fine where labels are thin, coarse away from interfaces.
/// `volume` has some label beside the background.
[[nodiscard]] Octree make_octree(const LabelField& field, const LatticeOptions& options);

/// How many cubes of `size` the labels extend over, along the longest axis; at most 2^15 can be meshed.
[[nodiscard]] double cubes_along(const LabelVolume& volume, double size);

/// The tets of a lattice, but for those in the background far from labels.
[[nodiscard]] LatticeTets make_lattice(const LabelField& field, const LatticeOptions& options);

}  // namespace image
}  // namespace v0
}  // namespace incise
