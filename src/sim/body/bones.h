// SPDX-License-Identifier: Apache-2.0
// Regions that are rigid: what hangs together of them moves as one, with six unknowns, among the vertices that the
// descent visits.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/id_array.h"
#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/body.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// All bones of a body. Their shape is that of rest: rounding and what corrects motions to first order never adds up.
/// Where a vertex of a bone is held rigidly, all of it stands still.
class Bones {
 public:
  /// Finds them anew, by the tets that share vertices. Cost: O(body).
  void find(DeformableBody::State& state);
  [[nodiscard]] bool is_fixed(VertexId vertex) const { return vertex.value < fixed_.size() && fixed_[vertex] != 0; }
  [[nodiscard]] std::size_t count() const { return bones_.size(); }

  /// A bone of which anything is awake wakes as a whole. To be called before the order is refreshed.
  void wake(DeformableBody::State& state) const;
  /// Takes up the awake ones, for an `advance`.
  void begin(const DeformableBody::State& state);
  /// Puts what their velocities have taken apart, in single precision, back to their shape.
  void straighten(DeformableBody::State& state) const;
  /// Makes steps rigid, to first order; 4 numbers per vertex slot.
  void make_rigid(const DeformableBody::State& state, std::span<std::array<float, 4>> steps) const;
  /// Moves each bone to where its tissue, pulls, contacts and inertia leave it, as all else stands.
  void visit(DeformableBody::State& state) const;
  /// The places in double precision take the shape of rest, about the same centre.
  void settle(DeformableBody::State& state) const;

 private:
  struct Bone {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint8_t> is_outer;  // by vertex of it: it has tets that are no bone
    bool is_held = false;
  };

  std::vector<Bone> bones_;
  std::vector<std::uint32_t> awake_;
  IdArray<VertexId, std::uint8_t> fixed_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
