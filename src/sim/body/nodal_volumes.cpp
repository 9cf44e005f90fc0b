// SPDX-License-Identifier: Apache-2.0
// Each tet's rest volume and give stay by slot; a vertex sums those of its star when the star changes
// (docs/internals.md, 4).
#include "sim/body/nodal_volumes.h"

namespace incise {
inline namespace v0 {
namespace detail {

void NodalVolumes::ensure(std::uint32_t vertex_slots, std::uint32_t tet_slots) {
  if (vertex_slots > terms_.size()) {
    terms_.resize(vertex_slots);
    gives_.resize(vertex_slots, 0);
  }
  if (tet_slots > tets_.size()) tets_.resize(tet_slots);
}

void NodalVolumes::put(TetId tet, double volume6, const Element& element) {
  tets_[tet] = {volume6, element.give};
}

void NodalVolumes::update(VertexId vertex, const Stars& stars) {
  double volume6 = 0, give = 0;
  stars.for_each_tet(vertex, [&](TetId t) {
    const Share& share = tets_[t];
    if (!(share.give > 0)) return;
    volume6 += share.volume6;
    give += share.give;
  });
  gives_[vertex] = give;
  terms_[vertex] = {static_cast<float>(stiffness(vertex)), static_cast<float>(volume6)};
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
