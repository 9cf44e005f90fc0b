// SPDX-License-Identifier: Apache-2.0
// What resists a change of volume is averaged at the vertices, beyond the share that each tet keeps for itself: linear
// tets that each keep their own volume cannot bend (locking). Bonet and Burton (1998) average all of it, which leaves
// modes without stiffness; Puso and Solberg (2006) keep a share in each element.
//
// A vertex b has the six volumes W of its tets, R at rest. Its energy is k/2 (W - R)², k = 1 / (24 Σ R_t / Λ_t) over
// its tets: a pressure that is the same in all of them, so that of two materials each gives way as it must. Seen from
// one vertex all W around it are affine, so the energy stays a quadratic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "incise/geom/vec.h"
#include "sim/body/neighbours.h"
#include "sim/body/stars.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// The vertices' own part of the volumes. Pressures are k (W - R).
class NodalVolumes {
 public:
  /// Whether there is anything to average; without it nothing below is kept.
  bool is_on = false;

  void ensure(std::uint32_t vertex_slots, std::uint32_t tet_slots);
  /// Notes a tet that came, with its six volumes at rest.
  void put(TetId tet, double volume6, const Element& element);
  /// What follows from a vertex' star, its neighbours first. Cost: O(its tets).
  void update(VertexId vertex, const Stars& stars);

  [[nodiscard]] const Neighbours& neighbours() const { return neighbours_; }
  /// By vertex.
  [[nodiscard]] float* pressures() { return pressures_.data(); }
  /// By vertex: k.
  [[nodiscard]] const float* stiffnesses() const { return stiffnesses_.data(); }
  /// By vertex: six volumes at rest of its tets that take part.
  [[nodiscard]] const float* rest_volumes() const { return rest_volumes_.data(); }
  [[nodiscard]] double stiffness(VertexId vertex) const { return gives_[vertex] > 0 ? 1 / (24 * gives_[vertex]) : 0.0; }
  /// Whether a tet takes part.
  [[nodiscard]] bool has(TetId tet) const { return tets_[tet].give > 0; }

  /// Lists vertices and all their neighbours, each once.
  template <class Each>
  void gather(const Each& for_each, std::vector<std::uint32_t>& into) {
    into.clear();
    const auto take = [&](std::uint32_t slot) {
      if (is_taken_[slot] != 0) return;
      is_taken_[slot] = 1;
      into.push_back(slot);
    };
    for_each([&](std::uint32_t slot) {
      take(slot);
      for (const std::uint32_t n : neighbours_.of(VertexId(slot))) take(n);
    });
    for (const std::uint32_t slot : into) is_taken_[slot] = 0;
  }

 private:
  struct Share {
    double volume6 = 0, give = 0;
  };
  Neighbours neighbours_;
  IdArray<TetId, Share> tets_;
  IdArray<VertexId, double> gives_;
  GrowArray<float> pressures_, stiffnesses_, rest_volumes_;
  std::vector<std::uint8_t> is_taken_;  // scratch, zero between calls
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
