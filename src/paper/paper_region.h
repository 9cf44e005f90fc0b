// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// The paper's "divided vertices": those that the journal's steps from `first_step` on made (split points), copied or
/// copied from, or moved, as far as they live. Ascending. Cost: O(n log n) in the records.
/// **Source:** Paper §3.2, Algorithm 3, line 1.
std::vector<VertexId> find_divided_vertices(const TetMesh& mesh, const Journal& journal, std::size_t first_step);

/// The vertices of slots, given with their generations, that still live, in the order given. Cost: O(n).
std::vector<VertexId> find_live(const TetMesh& mesh, const std::vector<std::pair<VertexId, std::uint32_t>>& vertices);

/// Every live vertex, ascending. Cost: O(vertices).
std::vector<VertexId> find_all_vertices(const TetMesh& mesh);

/// The tets at any of some vertices, dead ones passed over. Ascending. Cost: O(n log n) in their stars.
std::vector<TetId> find_tets_at(const TetMesh& mesh, const std::vector<VertexId>& vertices);

/// The corners of some live tets, each once. Ascending. Cost: O(n log n).
std::vector<VertexId> find_corners_of(const TetMesh& mesh, const std::vector<TetId>& tets);

}  // namespace paper
}  // namespace v0
}  // namespace incise
