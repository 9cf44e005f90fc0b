// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The mean length of a mesh's edges at rest, each counted once for each of its tets; 1 where there are none. Cost:
/// O(tets).
[[nodiscard]] double mean_edge_length(const TetMesh& mesh);

/// The mean distance at rest from a vertex to its neighbours, each counted once. `star`: the tets at the vertex, at
/// least one. Cost: O(star · neighbours).
[[nodiscard]] double mean_edge_length_at(const TetMesh& mesh, VertexId vertex, std::span<const TetId> star);

/// The same with each neighbour counted once for each tet that it shares with the vertex: cheaper, and neighbours that
/// share more of the star count more. Cost: O(star).
[[nodiscard]] double mean_edge_length_by_tets(const TetMesh& mesh, VertexId vertex, std::span<const TetId> star);

}  // namespace v0
}  // namespace incise
