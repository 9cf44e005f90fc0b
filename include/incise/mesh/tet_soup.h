// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// A boundary face that a cut made.
struct SoupWall {
  std::array<std::uint32_t, 3> points;  ///< in any order, indices into the soup's points
  std::uint32_t stroke;                 ///< that made it, from 1
};

/// Points and tets without connectivity: what a file holds, and what `TetMesh::build` takes. The last three are there
/// where the mesh has been cut before.
struct TetSoup {
  std::vector<Vec3> points;                        ///< `n_points`, in the file's length unit
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< `n_tets × 4`, indices into `points`
  std::vector<std::int32_t> regions;               ///< `n_tets`, or empty where all are region 0
  std::vector<SoupWall> walls = {};                ///< one per lip: every other boundary face is skin
  std::vector<std::int32_t> origins = {};          ///< `n_points`: the vertex before all cuts that a point is or was
                                                   ///< copied from, below 0: none; or empty: points are their own
  std::vector<std::uint8_t> fronts = {};           ///< `n_points`: 1 where a cut ends; or empty: seen from the walls
};

}  // namespace v0
}  // namespace incise
