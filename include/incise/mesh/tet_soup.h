// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/geom/vec.h"

namespace incise::inline v0 {

/// Points and tets without connectivity: what a file holds, and what `TetMesh::build` takes.
struct TetSoup {
  std::vector<Vec3> points;                        ///< `n_points`, in the file's length unit
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< `n_tets × 4`, indices into `points`
  std::vector<std::int32_t> regions;               ///< `n_tets`, or empty where all are region 0
};

}  // namespace incise::inline v0
