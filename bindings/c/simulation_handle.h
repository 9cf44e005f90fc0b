// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "app/scene/scene.h"
#include "handles.h"
#include "incise/engine/simulation.h"

// NOLINTBEGIN(readability-identifier-naming): a C name
struct incise_simulation {
  explicit incise_simulation(incise::Simulation made) : simulation(std::move(made)) {
    engine.engine = &simulation.engine();
    engine.turn = &turn;
  }

  incise::Simulation simulation;
  std::optional<incise::app::Scene> scene;
  incise::FrameReport last;
  std::uint64_t journal_first = 0;  // of the last frame
  mutable incise::c::Turn turn;
  incise_engine engine;  // to look at
};
// NOLINTEND(readability-identifier-naming)

namespace incise::c {

template <class Call>
incise_status look(const incise_simulation* handle, const Call& call) {
  if (handle == nullptr) return refuse("the simulation is null");
  return in_turn(handle->turn, true, [&] { return call(handle->simulation); });
}

template <class Call>
incise_status change(incise_simulation* handle, const Call& call) {
  if (handle == nullptr) return refuse("the simulation is null");
  return in_turn(handle->turn, false, [&] {
    ++handle->engine.version;
    return call(handle->simulation);
  });
}

/// The first `room` vectors, x y z each, and how many there are.
inline incise_status give_vecs(std::span<const Vec3> from, double* to, std::uint64_t room, std::uint64_t* count) {
  if (to == nullptr && room > 0) return refuse("the buffer is null, and its room is not 0");
  if (count != nullptr) *count = from.size();
  for (std::size_t i = 0; i < from.size() && i < room; ++i) from_vec(from[i], to + 3 * i);
  return INCISE_OK;
}

inline Error not_live(std::uint32_t vertex) {
  return {ErrorCode::kBadArgument, "vertex " + std::to_string(vertex) + " is not live", {vertex}};
}

}  // namespace incise::c
