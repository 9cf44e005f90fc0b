// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::inline v0 {

/// A point of the material: it moves with the tet that it is in.
struct TissuePoint {
  TetId tet;
  std::array<double, 4> weights{};  ///< barycentric, sum 1

  /// Where it stands.
  [[nodiscard]] Vec3 place(const TetMesh& mesh, std::span<const Vec3> positions) const;
};

/// Finds the tissue at a place as the body stands (`positions`: one per vertex slot), walking from tet to tet.
///
/// @param near  a live tet to start from; the nearer the faster.
/// @return nothing where the walk leaves the body, or goes astray among tets that are turned inside out: in a body that
///   is not convex it may leave and the place be inside all the same.
/// Cost: O(tets on the way), about 50 ns each. Thread-safe. **Source:** the visibility walk of Devillers et al. 2001.
[[nodiscard]] std::optional<TissuePoint> walk_to(const TetMesh& mesh, std::span<const Vec3> positions,
                                                 const Vec3& place, TetId near);

/// Finds the tissue at each of some places, or nothing where there is none. Cost: O(tets), about 5 ns each where they
/// are far from all places.
[[nodiscard]] std::vector<std::optional<TissuePoint>> find_tissue(const TetMesh& mesh, std::span<const Vec3> positions,
                                                                  std::span<const Vec3> places);

}  // namespace incise::inline v0
