// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Whether a tet stands deformed without being inverted; true at rest. Cost: O(1).
bool is_sound_now(const TetMesh& mesh, const TetVertices& vertices);

/// A rest point in the barycentric coordinates of a tet.
struct MaterialPoint {
  TetVertices basis;
  std::array<double, 4> weights{};
};

/// The tet that holds a rest point, or is nearest to that, with the point's coordinates there. Cost: O(tets).
MaterialPoint locate(const TetMesh& mesh, const Vec3& place, const std::vector<TetId>& tets);
/// Where a material point is as the mesh stands.
Vec3 current_at(const TetMesh& mesh, const MaterialPoint& point);

/// Whether a vertex may move: no tet of `star`, its star, would stand inverted that does not now. Cost:
/// O(star).
bool may_move(const TetMesh& mesh, VertexId vertex, const Vec3& place, const std::vector<TetId>& star);

}  // namespace v0
}  // namespace incise
