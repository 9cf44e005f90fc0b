// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/improve/options.h"
#include "incise/mesh/transaction.h"
#include "paper/held.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// The paper's two thresholds for a tet that is negligible beside its neighbours, and one for tets that are too small
/// in all the mesh (Figure 7's yellow ones). It gives no values: with these, and blades like those of its Figure 13,
/// about as many tets go as in its Table 2, and none of a straight cut of CUBE.
struct MergeThresholds {
  /// L/r above which a tet is badly shaped: twice that of a good mesh's tets (CUBE: 8.36).
  double shape = 15.0;
  /// An edge is short where `length` times its length is less than the longest edge. At least 3, so that Figure 6 has
  /// all cases: a chain of three short edges would not reach as far as the longest edge. More than 2√3, the greatest
  /// ratio in CUBE cut at mid-cell in whatever order its edges are bisected: there merging is to remove nothing.
  double length = 3.5;
  /// A tet is too small where its volume is less than this share of a regular tet's with edges of the mesh's typical
  /// length; an edge of it is short where `length` times its length is less than that.
  double size = 0.01;
};

/// The configurations of Figure 6: how the corners of a thin tet cluster.
enum class ThinShape : std::uint8_t {
  kNone,           ///< not thin by the thresholds
  kShortEdge,      ///< (a) two corners close together
  kTwoShortEdges,  ///< (b) two pairs
  kShortFace,      ///< (c) three corners close together
  kSmall,          ///< not thin, but too small in all the mesh
};

/// A thin or small tet with the edges that shall vanish (those with a red "z" in Figure 6), the shortest first.
struct ThinTet {
  ThinShape shape = ThinShape::kNone;
  std::array<std::array<VertexId, 2>, 6> edges;
  unsigned count = 0;
};

/// Sorts a tet into Figure 6 by the lengths of its edges at rest; whether it is badly shaped is up to the caller.
/// `length`: see `MergeThresholds`. Cost: about 20 ns.
ThinTet find_thin_shape(const TetMesh& mesh, TetId tet, double length);

/// The edges of a tet that is too small in all the mesh by which it may be eliminated: those short against `typical`,
/// the mesh's typical edge, in length units. `ThinShape::kNone` where there are none. Whether the tet is too small is
/// up to the caller. **Source:** Paper §2.5, which takes tets that are "globally too small" from [14], and Figure 7.
ThinTet find_short_edges(const TetMesh& mesh, TetId tet, double length, double typical);

/// The paper's two conditions under which BC may vanish, as far as face ABC is concerned. Each flag: Surf(…), whether
/// the edge or face is on the boundary as it is now. Literal. **Source:** Paper §2.5, conditions 1 and 2.
constexpr bool is_safe_at_face(bool ba, bool ca, bool abc, bool abd, bool acd) {
  return (!ba || !ca) || (ba && ca && abc && (!abd || !acd));
}

/// The same for one tet around the edge (b, c), at both its faces there: the second by the paper's exchange of A and D.
/// Necessary, but not sufficient for a safe merge: it looks at one tet (see `CollapsePlanner`). Cost: O(its edges'
/// rings).
bool is_safe_to_merge(const TetMesh& mesh, TetId tet, VertexId b, VertexId c);

/// The same for all tets around an edge, `ring`. Cost: the same, for each of them.
bool is_safe_around(const TetMesh& mesh, std::span<const TetId> ring, VertexId b, VertexId c);

/// What merging asked: edges that the paper's conditions were asked of, and those that they refused.
struct MergeCensus {
  std::uint64_t asked = 0, refused = 0;
};

/// Edge Merging: eliminates thin tets, and tets that are too small in all the mesh, by merging the ends of their short
/// edges, over and over until none can go.
///
/// An end that is freer than the other moves to it; two of a kind meet in the middle or, where that may not be, at
/// either end. Contour vertices merge along their contour alone, corners stay. A merge is done where the paper's
/// conditions and the link condition hold, no tet turns over, the worst tet afterwards is not bad-shaped (`kBadShape`)
/// or no worse than the worst before, no boundary face turns by more than a sharp angle (`kSharpCosine`), so that
/// smooth surfaces stay smooth, and the skin stays where it is but for 1 % of the volume there (`kMostSkinChange`).
/// @param tets  to look at, ascending; dead ones are passed over, and those that are held.
/// @param census  is added to, where given.
/// Cost: O(tets) per round; few rounds. **Source:** Paper §2.5, Figure 6. Differs: the link condition, and the limits
/// on shapes and skin; without those on shapes a few merges leave tets of L/r up to 1e6.
MaintainStatistics merge_edges(Transaction& transaction, const std::vector<TetId>& tets,
                               const MergeThresholds& thresholds = {}, const Held& held = {},
                               MergeCensus* census = nullptr);

}  // namespace paper
}  // namespace v0
}  // namespace incise
