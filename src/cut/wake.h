// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "incise/geom/intersect.h"

namespace incise {
inline namespace v0 {

/// What the front of a blade leaves behind it: which masters of its sheet are to be settled, and which let go.
///
/// A master is near while the front may lie in it or is close by, or its incision waits for the blade to pass. It is
/// settled when none of its vertices is a vertex of a near one: what the sheet does to it is known then, and vertices
/// land, front points move to their last place. It is let go when all masters that share a vertex with it are settled,
/// so that a rebuild never meets a vertex around which tets were let go. What is kept is O(front), whatever the length
/// of the stroke. **Source:** docs/decisions/0024 (bake behind the blade); the division
/// of a tet that the tool has left is made final in A. Mor and T. Kanade, "Modifying soft tissue models", 2000.
class Wake {
 public:
  /// Finds what is near a front that lies along `row`, within `band` in length units; nothing where `row` is empty.
  /// Masters of `pinned` count as near. Those behind stay behind, wherever the front goes. Cost: O(masters), for near
  /// ones times the segments of the row.
  void find(const TetMesh& mesh, ClosedComplex& complex, std::span<const SosPoint> row, double band,
            std::span<const std::uint32_t> pinned);
  /// The masters to be settled now, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& settling() const { return settling_; }
  /// Whether a closed vertex belongs to a master that is near.
  [[nodiscard]] bool is_near(VertexId vertex) const {
    return vertex.value < marks_.capacity() && marks_[vertex.value] == round_;
  }
  /// Whether some vertex of a master does.
  [[nodiscard]] bool has_near(const Master& master) const;
  /// Notes that those are settled, and lets go of what is out of reach. Returns how many were let go. Cost: O(masters).
  std::size_t let_go(ClosedComplex& complex);

 private:
  void mark(const Master& master);
  void mark_kept(const ClosedComplex& complex);

  std::vector<std::uint32_t> settling_;
  std::vector<std::uint32_t> kept_;   // pinned, or near though the sheet has not touched them yet
  ZeroedArray<std::uint32_t> marks_;  // by vertex slot: the round in which it was near
  std::uint32_t round_ = 0;
};

}  // namespace v0
}  // namespace incise
