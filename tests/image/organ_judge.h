// SPDX-License-Identifier: Apache-2.0
// What a mesh of a made image is worth, by checks that share nothing with what made it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/made_images.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/tet_mesh.h"

namespace incise_test {

struct OrganFigures {
  incise::QualityStats quality;
  std::vector<double> volume_error;                       ///< of each label, relative to the truth
  double mean_error = 0, p99_error = 0, worst_error = 0;  ///< of points of interfaces, in voxels
  std::uint64_t nonmanifold_edges = 0;                    ///< of the whole and of each label
  std::uint64_t singleton_vertices = 0;                   ///< likewise
  std::uint64_t surfaces = 0;  ///< closed ones that bound the whole: 1 where there is no hole
  bool is_valid = false;       ///< by the full level of `validate`
};

/// What a mesh is held against.
struct OrganTruth {
  Truth label_at;                    ///< in the coordinates of the mesh
  std::vector<std::int32_t> labels;  ///< the mesh's regions
  std::vector<double> volumes;       ///< of each label, mm³
  double voxel = 1;                  ///< the unit of distances, mm
};

OrganTruth truth_of(const MadeImage& made);
/// A scan has no other truth than its voxels: the label at a point is the one with the greatest share by linear
/// interpolation, which is less smooth than what the mesher asks; volumes are those of the voxels. The
/// unit of distances is the edge of a cube of a voxel's volume. `image` must live on.
OrganTruth truth_of(const incise::image::LabelImage& image);

OrganFigures judge(const OrganTruth& truth, const incise::TetMesh& mesh);
inline OrganFigures judge(const MadeImage& made, const incise::TetMesh& mesh) {
  return judge(truth_of(made), mesh);
}

}  // namespace incise_test
