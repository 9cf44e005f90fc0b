// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/incision_face.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

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

/// What the incision faces around a vertex let one do with it (paper §2.3, Figure 4).
enum class Dividability : std::uint8_t {
  kNot,
  kCircle,  ///< type I: some of the faces around the vertex form a closed circle
  kSector,  ///< type II: some of them form a sector between two surface edges
};

/// Algorithm 1 on a mesh as it stands: the vertices of `incision` that its joined faces make dividable, ascending.
/// `transaction` is left as it is. Cost: O(faces · stars).
std::vector<VertexId> find_dividable_vertices(Transaction& transaction, const std::vector<IncisionFace>& incision,
                                              StarWalker& walker);

/// The paper's separation to the letter: Algorithm 1 with both kinds of dividable vertex and Algorithm 2, in turn until
/// neither finds anything.
///
/// Readings: an edge is a surface edge where it lies on the current boundary, faces opened before included; line 9
/// asks for a path between two cutting edges, not between every two faces at the vertex (which stalls where a sector
/// and an unrelated face meet); the two groups are told apart by flooding the star without crossing incision faces.
/// Repair: where two fans of tets still touch along a whole edge, each gets a midpoint of its own; the paper leaves
/// such an edge with four boundary faces. Cost: O(faces · rounds), about one round per ring of faces from the contour
/// inwards.
Separation separate_as_paper(Transaction& transaction, std::vector<IncisionFace> incision, std::uint32_t tag,
                             StarWalker& walker);

}  // namespace v0
}  // namespace incise
