// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "improve/care.h"
#include "improve/cavity_hull.h"
#include "improve/smooth.h"
#include "incise/mesh/remesh.h"

namespace incise {
inline namespace v0 {

/// Inserts a vertex where nothing else makes a bad tet better. Keeps scratch memory.
class VertexInserter {
 public:
  /// Tries to replace a tet and some of its neighbours by tets around one new vertex: inside, or on an edge of a
  /// surface. Where it was accepted `care.changed` holds the new tets.
  ///
  /// The cavity starts with the tet, or with those around the edge, and grows across the face whose new tet is worst;
  /// after every step the vertex goes to the optimum of `StarEnergy`, on a surface within what keeps the volume. The
  /// best cavity counts, and is accepted where its worst tet is better than that of the tets it replaces: nothing is
  /// changed before that is known. Cost: about 20 µs for each of the tet's edges on a surface, and as much inside.
  /// **Source:** Klingner & Shewchuk 2007, §3.3 (vertex insertion). Differs: the cavity follows the measure, not the
  /// Delaunay property.
  bool improve(Care& care, TetId tet);

 private:
  struct Base {
    Side side;     ///< of a tet of the cavity; behind it the mesh goes on or ends
    double ratio;  ///< of its tet with the new vertex
  };
  /// The two boundary faces that a vertex on a surface replaces.
  struct Opened {
    bool is_surface = false;
    std::uint32_t tag = 0;
    std::array<Side, 2> faces;
    std::array<Vec3, 2> edge;  ///< its ends
    Vec3 normal = Vec3::Zero();
    Piece piece;
  };

  bool improve_inside(Care& care, TetId tet);
  bool improve_at_edge(Care& care, TetId tet, VertexId a, VertexId b);
  [[nodiscard]] bool open_edge(const Care& care, VertexId a, VertexId b);
  bool search(Care& care);
  bool grow(Care& care);
  void collect_bases(const Care& care);
  void find_place(Care& care);
  [[nodiscard]] Vec3 newton_step(const StarEnergy::Value& here) const;
  double rate(Care& care);
  void keep_best(double worst);
  [[nodiscard]] bool keeps_surface(const Care& care);
  bool come_nearer(Care& care);
  [[nodiscard]] bool has_simple_hull(const TetMesh& mesh);
  [[nodiscard]] bool stays_sound(const TetMesh& mesh, const Vec3& current) const;
  bool carry_out(Care& care);

  EdgeRing ring_;
  Opened opened_;
  Piece piece_;  // of the surface with the new vertex
  std::vector<TetId> cavity_, best_cavity_;
  std::vector<Base> bases_;
  StarEnergy energy_;
  Vec3 place_ = Vec3::Zero(), best_place_ = Vec3::Zero();
  double before_ = 0;  // worst of the cavity as it is
  double best_gain_ = 0, best_before_ = 0;
  CavityHull hull_;
  std::vector<VertexId> enclosed_;
  RemeshPlan plan_;
};

}  // namespace v0
}  // namespace incise
