// SPDX-License-Identifier: Apache-2.0
// Which vertices one `advance` looks at besides those that it moves, or more often than those.
#include <cmath>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {

/// Visits bring the pressures of what they move up to date: not those of what rests beside it, nor of bones.
void DeformableBody::State::list_beside() {
  beside_rows.clear();
  if (!nodal.is_on) return;
  for (const std::uint32_t slot : resting) {
    bool is_beside = false;
    detail::SweepOrder::for_each_neighbour(stars, VertexId(slot),
                                           [&](VertexId n) { is_beside = is_beside || order.is_awake(n); });
    if (is_beside) beside_rows.push_back(rows.of(VertexId(slot)));
  }
  if (!has_bones) return;
  for_each_awake([&](std::uint32_t slot) {
    if (motions[VertexId(slot)].is_rigid) beside_rows.push_back(rows.of(VertexId(slot)));
  });
}

/// The rows of what has tets in common with vertices and is none of them.
void DeformableBody::State::list_around(std::span<const std::uint32_t> vertices, std::vector<std::uint32_t>& around) {
  is_resting.resize(places.size(), 0);
  for (const std::uint32_t v : vertices) is_resting[VertexId(v)] = 1;
  around.clear();
  for (const std::uint32_t v : vertices) {
    detail::SweepOrder::for_each_neighbour(stars, VertexId(v), [&](VertexId n) {
      if (is_resting[n] != 0) return;
      is_resting[n] = 1;
      around.push_back(n.value);
    });
  }
  for (const std::uint32_t v : vertices) is_resting[VertexId(v)] = 0;
  for (std::uint32_t& v : around) {
    is_resting[VertexId(v)] = 0;
    v = rows.of(VertexId(v));
  }
}

/// Where tissue has stiffened a hundred times under a load, sweeps carry a change through it far more slowly than
/// through what is around it: what pulls with a limit act on, the blade's, and some rings of neighbours, are swept
/// more.
void DeformableBody::State::list_strained() {
  strained.clear();
  if (!stars.stiffens) return;
  is_resting.resize(places.size(), 0);
  const auto take = [&](VertexId v) {
    if (is_resting[v] != 0 || !order.is_awake(v)) return;
    is_resting[v] = 1;
    strained.push_back(v.value);
  };
  for (const Pull& pull : pulls) {
    if (std::isinf(pull.limit) || pull.axis.isZero(0))
      continue;  // tools and hooks do not press tissue as hard as a blade
    for (unsigned i = 0; i < 4; ++i) {
      if (pull.weights[i] != 0 && pull.stiffness > 0) take(pull.vertices[i]);
    }
  }
  std::size_t next = 0;
  for (unsigned ring = 0; ring < detail::kStrainedRings; ++ring) {
    for (const std::size_t end = strained.size(); next < end; ++next) {
      detail::SweepOrder::for_each_neighbour(stars, VertexId(strained[next]), take);
    }
  }
  for (const std::uint32_t v : strained) is_resting[VertexId(v)] = 0;
  if (nodal.is_on) list_around(strained, around_strained);
}

}  // namespace v0
}  // namespace incise
