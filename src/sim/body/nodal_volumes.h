// SPDX-License-Identifier: Apache-2.0
// What resists a change of volume is averaged at the vertices, beyond the share that each tet keeps for itself: linear
// tets that each keep their own volume cannot bend (locking). Bonet and Burton (1998) average all of it, which leaves
// modes without stiffness; Puso and Solberg (2006) keep a share in each element.
//
// A vertex b has the six volumes W of its tets, R at rest. Its energy is k/2 (W - R)², k = 1 / (24 Σ R_t / Λ_t) over
// its tets: a pressure that is the same in all of them, so that of two materials each gives way as it must.
#pragma once

#include <cstdint>

#include "incise/core/id_array.h"
#include "sim/body/kernel_rows.h"
#include "sim/body/stars.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// What a vertex makes its pressure of, k (W − R).
struct NodeTerm {
  float stiffness = 0;    ///< k
  float rest_volume = 0;  ///< R
};

/// The vertices' own part of the volumes.
class NodalVolumes {
 public:
  explicit NodalVolumes(const KernelRows& rows) : terms_(rows) {}

  /// Whether there is anything to average; without it nothing below is kept.
  bool is_on = false;

  void ensure(std::uint32_t vertex_slots, std::uint32_t tet_slots);
  /// Notes a tet that came, with its six volumes at rest.
  void put(TetId tet, double volume6, const Element& element);
  /// What follows from a vertex' star. Cost: O(its tets).
  void update(VertexId vertex, const Stars& stars);

  /// By row.
  [[nodiscard]] const NodeTerm* terms() const { return terms_.data(); }
  [[nodiscard]] const NodeTerm& term(VertexId vertex) const { return terms_[vertex]; }
  [[nodiscard]] double stiffness(VertexId vertex) const { return gives_[vertex] > 0 ? 1 / (24 * gives_[vertex]) : 0.0; }
  /// Whether a tet takes part.
  [[nodiscard]] bool has(TetId tet) const { return tets_[tet].give > 0; }

 private:
  struct Share {
    double volume6 = 0, give = 0;
  };
  IdArray<TetId, Share> tets_;
  IdArray<VertexId, double> gives_;
  ByRow<NodeTerm> terms_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
