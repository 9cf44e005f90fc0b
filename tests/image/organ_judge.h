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

/// `mesh`: in the coordinates of the truth, regions are its labels.
OrganFigures judge(const MadeImage& made, const incise::TetMesh& mesh);

}  // namespace incise_test
