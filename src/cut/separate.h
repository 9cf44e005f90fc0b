// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cut/edge_table.h"
#include "cut/subdivide.h"
#include "incise/mesh/star.h"

namespace incise::inline v0 {

/// What separation did.
struct Separation {
  std::uint64_t opened_faces = 0;
  std::uint64_t latent_faces = 0;  ///< incision faces none of whose vertices came apart: still joined
  std::uint64_t copied_vertices = 0;
  std::uint64_t pinched_edges = 0;       ///< bisected
  std::uint64_t singleton_vertices = 0;  ///< divided by Algorithm 2 (paper profile)
};

/// Notes on the vertices of an opened face that they lie on a wall, and on those that both its sides still share that
/// the cut ends there.
void mark_wall(Transaction& transaction, const IncisionFace& face);

/// Memory that separations reuse: marks by tet slot, all zero between separations.
struct SeparationScratch {
  using CornerCopies = std::array<std::uint32_t, 4>;

  EdgeTable edges;
  ZeroedArray<std::uint32_t> index_of_vertex;
  ZeroedArray<std::uint8_t> incision;  ///< bit s: side s is an incision face
  ZeroedArray<CornerCopies> copies;    ///< 1 + the copy that each corner gets; 0 not reached
  std::vector<TetId> marked, reached;  ///< tets with a non-zero entry in either
};

/// Separates the material along the incision faces, in one pass: every vertex of an incision face gets one copy per
/// face-connected part of its star after the incision faces are taken away.
///
/// This is the terminal state of the paper's Algorithms 1 and 2 iterated to the end, whatever their order; it also
/// separates where their literal form stalls (closed interior sheets, several sectors at a vertex). An edge both of
/// whose ends stay whole although two of its fans are apart (a neck one edge wide) is bisected first, so that its
/// midpoint comes apart. Every boundary edge that results has exactly two boundary faces.
/// Where the input touched itself, the new vertices of `new_tets` are checked for parts that share no face as well.
/// `before_copies` runs once all new vertices but the copies exist: vertices move then, so that twins start alike.
/// Source: paper §2.3, §2.4; proof of equivalence in docs/paper_map.md. Cost: O(stars of the incision's vertices).
Separation separate(
    Transaction& transaction, std::vector<IncisionFace> incision, const std::vector<TetId>& new_tets, std::uint32_t tag,
    SeparationScratch& scratch, const std::function<void()>& before_copies = [] {});

}  // namespace incise::inline v0
