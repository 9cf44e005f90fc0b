// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cut/cut_context.h"
#include "cut/incision_face.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// Gives each group of `star`, tets around `vertex` that hang together by faces other than `blocked` (ascending, both
/// sides), a vertex of its own; the first group keeps it. Returns how many copies that made. Cost: O(star · log).
std::uint64_t part_star(Transaction& transaction, VertexId vertex, const std::vector<TetId>& star,
                        const std::vector<Side>& blocked, StarWalker& walker);

/// Opens faces inside the mesh: at each of their vertices tets that hang together only by them come apart. A face whose
/// three vertices all stay in one stays joined. Walls get `tag`; counts go to `statistics`. Cost: O(faces · stars).
void open_faces(Transaction& transaction, const std::vector<IncisionFace>& faces, std::uint32_t tag,
                CutStatistics& statistics);

/// Commits, and parts the edges along which two fans of tets touch beside `walls` in a step of their own: see
/// `part_pinched_edges`.
void commit(const CutContext& context, Transaction& transaction, const std::vector<Side>& walls);

}  // namespace lab
}  // namespace v0
}  // namespace incise
