// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/incision_faces.h"
#include "cut/old_material.h"
#include "cut/surface_edges.h"
#include "cut/vertex_separation.h"

namespace incise {
inline namespace v0 {

/// Seventh stage of a rebuild: closes the incision faces beside pinched edges, which are those along which two fans of
/// tets touch. The incision leaves them out until the blade has passed.
///
/// Reads the surface that the separation noted, and the old material. Changes the faces, and marks the masters of those
/// that are pinched. **Source:** docs/internals.md (separation).
class PinchedFaces {
 public:
  /// What is kept from run to run, for its storage.
  struct Memory {
    SurfaceEdges edges;
    std::vector<Side> sides;
  };

  PinchedFaces(RebuildState& state, OldMaterial& material, IncisionFaces& faces, const VertexSeparation& separation,
               Memory& memory)
      : state_(state), material_(material), faces_(faces), separation_(separation), memory_(memory) {}

  /// Closes those of this round. Returns whether there were any. Cost: O(surface noted).
  bool close();
  /// The boundary sides beside the pinched edges of this round, ascending, those of masters that are not rebuilt among
  /// them.
  [[nodiscard]] const std::vector<Side>& sides() const { return memory_.sides; }

 private:
  void collect_edges();
  void find_sides();
  [[nodiscard]] bool are_one_fan(const SurfaceEdges::Edge& edge, Side first, Side second) const;
  [[nodiscard]] bool is_pinched(const IncisionFace& face) const;
  [[nodiscard]] bool would_join_pieces(const IncisionFace& face);

  RebuildState& state_;
  OldMaterial& material_;
  IncisionFaces& faces_;
  const VertexSeparation& separation_;
  Memory& memory_;
};

}  // namespace v0
}  // namespace incise
