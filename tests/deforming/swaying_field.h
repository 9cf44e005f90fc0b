// SPDX-License-Identifier: Apache-2.0
// Prescribed motion of a body, cheap enough for many runs: it sways, bends and twists, and its wounds stand open.
#pragma once

#include <cstdint>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::test {

/// Places of all vertices as functions of their rest places, of time, and of the walls at them.
///
/// A wall's vertices draw back from it by up to `amplitude` each; at the front the two lips share their vertices, whose
/// pulls cancel, so that the wound closes there by itself.
class SwayingField {
 public:
  /// `amplitude`: of the sway and of the gap, a length. `seed` draws the phases.
  SwayingField(const Box& rest, double amplitude, std::uint64_t seed);

  /// By slot, at `seconds`. Cost: O(tets), about 50 ns each.
  [[nodiscard]] std::vector<Vec3> positions(const TetMesh& mesh, double seconds) const;

 private:
  [[nodiscard]] Vec3 sway(const Vec3& rest, double seconds) const;
  [[nodiscard]] std::vector<Vec3> gaps(const TetMesh& mesh) const;

  Vec3 middle_, size_, phase_;
  double amplitude_;
};

}  // namespace incise::test
