// SPDX-License-Identifier: Apache-2.0
// Springs that hold vertices and bear only so much: pins that slip, or tear out.
#include <cmath>
#include <string>
#include <vector>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

Status DeformableBody::hold(VertexId vertex, double stiffness, const HoldLimit& limit) {
  if (!(stiffness > 0 && std::isfinite(stiffness))) {
    return Error{
        ErrorCode::kBadArgument, "a pin needs a finite stiffness above 0 N/m: what is held rigidly bears all", {}};
  }
  if (!(limit.force > 0)) return Error{ErrorCode::kBadArgument, "a pin must bear more than 0 N", {}};
  if (Status status = hold(vertex, stiffness); !status) return status;
  state_->holds[vertex.value].limit = limit;
  return {};
}

/// As the body stands after a step: a pin that slips is left behind until it bears just its limit, as a slipping
/// spring is; that takes energy away, and never adds any. Returns how many have torn out.
std::size_t DeformableBody::State::give_way() {
  std::vector<std::uint32_t> torn;
  for (auto& [slot, hold] : holds) {
    if (hold.is_rigid() || !std::isfinite(hold.limit.force)) continue;
    const Vec3 off = places[slot] - hold.target;
    const double most = hold.limit.force / (hold.stiffness * unit()), length = off.norm();
    if (!(length > most)) continue;
    order.wake(VertexId(slot));
    if (hold.limit.tears) {
      torn.push_back(slot);
    } else {
      hold.target += (1 - most / length) * off;
    }
  }
  for (const std::uint32_t slot : torn) {
    clear_hold(VertexId(slot));
    settle_vertex(VertexId(slot));
    order.wake_star(VertexId(slot), stars);
  }
  return torn.size();
}

}  // namespace v0
}  // namespace incise
