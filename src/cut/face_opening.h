// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "cut/incision_faces.h"
#include "cut/vertex_separation.h"

namespace incise {
inline namespace v0 {

/// Last stage of a rebuild: opens the incision faces, for good. Those that nothing separates stay joined: they are
/// latent. So do older faces of the same incision beside them that nothing separates any more.
///
/// Reads the corners of the tets, and the surface that the separation noted. Changes the links of the faces' sides,
/// leaves those that were opened in the faces, and marks the masters of latent ones. Paper §2.3.
class FaceOpening {
 public:
  /// What is kept from run to run, for its storage.
  struct Memory {
    std::vector<std::pair<std::array<VertexId, 3>, Side>> walls;
  };

  FaceOpening(RebuildState& state, IncisionFaces& faces, const VertexSeparation& separation, Memory& memory)
      : state_(state), faces_(faces), separation_(separation), memory_(memory) {}

  /// Opens them all. Cost: O(faces + surface noted · log).
  void open();

 private:
  void close_latent(const IncisionFace& face);
  void join_latent_walls();
  void collect_walls();
  [[nodiscard]] bool is_opened_now(Side side) const;

  RebuildState& state_;
  IncisionFaces& faces_;
  const VertexSeparation& separation_;
  Memory& memory_;
};

}  // namespace v0
}  // namespace incise
