// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "incise/geom/vec.h"
#include "incise/sim/solver.h"

namespace incise {
inline namespace v0 {

/// What a suture, a staple or a plate is like: a spring between two places of the material.
struct Suture {
  double stiffness = 200;  ///< N/m, above 0
  double rest_length = 0;  ///< m, at least 0; 0 pulls its ends together
  bool pushes = true;      ///< below its rest length, as a plate does; a thread, which does not, hangs slack there
  double strength = std::numeric_limits<double>::infinity();  ///< N, above 0: the greatest force; above it tears
  std::uint64_t first_frame = 0;  ///< the frame of the simulation, counted from 0, from which on it acts
};

/// What a suture does at present.
enum class SutureStatus : std::uint8_t {
  kWaits,  ///< its first frame is to come
  kHolds,  ///< it acts
  kTorn,   ///< the force was above its strength; it never acts again
  kLost,   ///< there is no tissue where one of its ends was; it acts again when undo or redo brings that back
};

/// A suture as the body stands.
struct SutureState {
  std::uint32_t id = 0;                        ///< what `add_suture` returned
  Suture suture;                               ///< as it was given
  SutureStatus status = SutureStatus::kHolds;  ///< whether it holds
  std::array<TissuePoint, 2> ends;             ///< while it waits or holds, of the mesh as it stands
  std::array<Vec3, 2> rest;                    ///< where its ends are in the rest shape, length unit
  std::array<Vec3, 2> places;                  ///< where they are now, length unit; zero where it is torn or lost
  double length = 0;                           ///< m, likewise
  double force = 0;  ///< N: with which it pulls its ends together; below 0: pushes them apart; 0 unless it holds
};

}  // namespace v0
}  // namespace incise
