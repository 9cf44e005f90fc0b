// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "improve/care.h"
#include "improve/constants.h"
#include "incise/mesh/remesh.h"

namespace incise {
inline namespace v0 {

/// Swaps edges and faces away where that makes the worst tet around better. Keeps scratch memory.
class EdgeRemover {
 public:
  /// Tries the six edges of a tet. Where one was accepted `care.changed` holds the new tets.
  ///
  /// The best triangulation of the ring of an edge is found by dynamic programming; rings of 3 give the 3-2 swap, rings
  /// of 4 the 4-4 swap. On the boundary an edge is removed where its two faces lie in one plane and carry one tag.
  /// Cost: about 0.5 µs per edge, rings up to 8. **Source:** Shewchuk 2002, see `fill_edge_removal`; Paper §3.3.
  bool improve(Care& care, TetId tet);

 private:
  bool try_edge(Care& care, VertexId a, VertexId b, TetId seed);
  [[nodiscard]] bool is_removable(const Care& care) const;
  [[nodiscard]] bool makes_known_face(Care& care) const;
  [[nodiscard]] double rate(Care& care, VertexId a, VertexId b, unsigned i, unsigned j, unsigned k, double bound) const;
  [[nodiscard]] bool triangulate(Care& care, VertexId a, VertexId b, double bound);
  void collect_triangles(unsigned i, unsigned k);

  EdgeRing ring_;
  RemeshPlan plan_;
  std::vector<RingTriangle> triangles_;
  std::array<std::array<double, kMostRing>, kMostRing> best_{};        // worst tet of the polygon i..k
  std::array<std::array<std::uint8_t, kMostRing>, kMostRing> apex_{};  // of its triangle at the edge i, k
};

/// The 2-3 swap where it makes the worst tet better. Cost: about 0.1 µs per face.
class FaceRemover {
 public:
  /// Tries the four faces of a tet. Where one was accepted `care.changed` holds the new tets.
  bool improve(Care& care, TetId tet);

 private:
  bool try_face(Care& care, Side face);

  RemeshPlan plan_;
};

/// Whether an edge or face, given by its vertices, may exist in tets other than those of a cavity: a vertex may belong
/// to both lips of a cut, or of several; input that overlaps itself may have it inside; a pinched vertex belongs to
/// tets that no walk finds. Cost: O(star).
[[nodiscard]] bool exists_elsewhere(Care& care, std::span<const VertexId> vertices, const std::vector<TetId>& cavity);

/// Whether tets that stand upright now give way to such: true at rest.
bool keeps_current(const TetMesh& mesh, const RemeshPlan& plan);

}  // namespace v0
}  // namespace incise
