// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "improve/constants.h"
#include "improve/piece.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The skin of a body at rest as it was before anything changed it.
///
/// It is measured once and never changes, so that what is judged by it depends neither on what was cut before nor on
/// what was undone. Walls of older cuts are no skin.
class OriginalSkin {
 public:
  /// Measures the skin of a mesh as it stands, instead of what was measured before. Cost: O(tets), and about 1 µs and
  /// 200 bytes for each triangle of skin.
  void measure(const TetMesh& mesh);

  [[nodiscard]] bool is_empty() const { return tree_.size() == 0; }
  /// The squared distance to the skin as it was; infinite beyond `greatest`. Cost: O(log n).
  [[nodiscard]] double distance2(const Vec3& place, double greatest) const {
    return tree_.closest(place, greatest).distance2;
  }
  /// Whether a piece of skin may give way to another: the new one lies within `share` of the local edge from where the
  /// skin was, or at least no further off than the old piece did; and so do the vertices that the skin had there from
  /// the new piece. The local edge: of the new piece or of the skin as it was, whichever is shorter; of the skin as it
  /// was for `kBadSkinTolerance`. True where no skin was measured. Cost: O(log n) for each sample.
  [[nodiscard]] bool keeps(const Piece& before, const Piece& after, double share = kSkinTolerance) const;
  /// The same for a vertex that moves, at a piece of skin with this mean edge.
  [[nodiscard]] bool keeps_vertex(const Vec3& old_place, const Vec3& place, double edge,
                                  double share = kSkinTolerance) const;

 private:
  /// In length units, at a piece of skin with this mean edge.
  [[nodiscard]] double tolerance_at(const Vec3& place, double edge, double share) const;
  [[nodiscard]] bool is_near(const Piece& after, const Piece& before, double tolerance) const;
  [[nodiscard]] bool is_covered(const Vec3& point, const Piece& before, const Piece& after, double tolerance) const;

  TriangleTree tree_;
  std::vector<TriangleTree::Triangle> triangles_;  // of points_
  std::vector<Vec3> points_;
  std::vector<std::uint32_t>
      owned_from_;  // by triangle: the first of the points that it owns; each point has one owner
};

}  // namespace v0
}  // namespace incise
