// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "improve/care.h"
#include "incise/mesh/remesh.h"

namespace incise {
inline namespace v0 {

/// Takes bad tets away that lie flat on a surface. Keeps scratch memory.
class Peeler {
 public:
  /// Tries to take away a tet with two boundary faces on one surface, or with three of which at least two are; or the
  /// end of a spike between walls that is thinner than both together may leave their place. Where it was accepted
  /// `care.changed` holds the tets around the vertex that moved for it, and the one behind.
  ///
  /// The faces that come to light continue the surface. One of their vertices moves by the little that restores the
  /// volume, of each region where there are several. Accepted where the worst tet around becomes better, the surface
  /// stays in place and no edge gets more than two boundary faces. Cost: about 2 µs. **Source:** a 2-2 swap of Klingner
  /// & Shewchuk 2007. Differs: surfaces may be curved, since the volume is restored.
  bool improve(Care& care, TetId tet);

 private:
  bool find_sides(const Care& care);
  [[nodiscard]] bool find_tag(const Care& care);
  [[nodiscard]] bool is_bound(const Care& care) const;
  [[nodiscard]] bool opens_manifold(Care& care);
  [[nodiscard]] bool keeps_surface(const Care& care);
  [[nodiscard]] bool ends_in_spike(const Care& care);
  bool peel(Care& care);
  void add_heir(std::vector<TetId>& changed) const;
  void add_candidates(const TetMesh& mesh, TetId tet);
  [[nodiscard]] bool find_volume_step(const Care& care, VertexId vertex, Vec3& step) const;
  [[nodiscard]] bool find_step_at_spike(const Care& care, VertexId vertex, Vec3& step) const;
  [[nodiscard]] bool find_step_of_surface(const TetMesh& mesh, VertexId vertex, Vec3& step) const;
  [[nodiscard]] bool find_step_of_regions(const Care& care, VertexId vertex, Vec3& step) const;
  [[nodiscard]] VertexSurfaces surfaces_without(const TetMesh& mesh, VertexId vertex) const;
  [[nodiscard]] bool find_step(Care& care, VertexId vertex, Vec3& place);
  void take_away(Care& care);

  TetId tet_;
  std::vector<unsigned> outer_, inner_;  // its boundary sides, and the others
  std::uint32_t tag_ = 0;                // of the faces that come to light
  bool is_spike_ = false;                // rather than flat on a surface
  EdgeRing ring_;
  Piece before_, after_;
  std::vector<VertexId> candidates_;  // for the move that restores the volume
  std::vector<TetId> star_, produced_;
  RemeshPlan plan_;
};

}  // namespace v0
}  // namespace incise
