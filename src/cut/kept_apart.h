// SPDX-License-Identifier: Apache-2.0
// Whether steps that are tried would join pieces that are apart.
#pragma once

#include <span>
#include <vector>

#include "cut/piece_finder.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Compares which tets around a part of a mesh hang together before and after some steps that change it: those tets
/// that hang on to the part through faces, and are touched by no step. So a piece may be remade as a whole, and what
/// the steps cut apart besides makes up for nothing that they join.
///
/// Usage: `look_after` once the steps were made, then, with these taken back, `would_stay`. Cost: O(tets of the steps),
/// and that of `PieceFinder`, each. Source: ours (docs/decisions/0169).
class KeptApart {
 public:
  /// The mesh after the steps of a journal from `first` on.
  void look_after(const TetMesh& mesh, const Journal& journal, std::size_t first);
  /// The mesh as it was. Returns whether the steps would leave all pieces apart. A piece that nothing tells of, since
  /// the steps touch all that it has, counts as joined.
  [[nodiscard]] bool would_stay(const TetMesh& mesh);

 private:
  [[nodiscard]] bool is_touched(TetId tet) const;

  PieceFinder finder_;
  std::vector<TetId> touched_;                // sorted
  std::vector<TetId> beside_;                 // in no order
  std::vector<std::uint32_t> pieces_after_;   // of those beside
  std::vector<std::uint32_t> pieces_before_;  // by piece after
};

}  // namespace v0
}  // namespace incise
