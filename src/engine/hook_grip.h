// SPDX-License-Identifier: Apache-2.0
// What a hook takes hold of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "incise/engine/simulation.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/solver.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// The vertices that a hook holds, and where from it.
class HookGrip {
 public:
  /// Takes hold as `Hook::reach` says. `positions` by vertex slot. Cost: O(tets).
  HookGrip(const TetMesh& mesh, std::span<const Vec3> positions, const Hook& hook);

  /// Adds the pulls of this frame. Vertices that are gone, as those of a cut that was taken back, are let go.
  void add_to(const TetMesh& mesh, const Hook& hook, std::vector<Pull>& pulls);
  /// Of the tissue on the hook in this frame, N.
  [[nodiscard]] Vec3 force(const Solver& solver) const;
  /// Where it bears more than it can it tears out, or its springs slip, each by itself. Returns whether it tore.
  bool give_way(const Solver& solver, const Hook& hook, double length_unit);

 private:
  struct Held {
    VertexId vertex;
    std::uint32_t generation = 0;
    Vec3 offset = Vec3::Zero();
  };

  std::vector<Held> held_;
  std::vector<Pull> springs_;  // of this frame, where it bears only so much; one for each that is held
  double closed_ = 0;
  std::size_t first_pull_ = 0, pulls_ = 0;  // in this frame
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
